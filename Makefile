# make compare   the paper's experiment: creates .venv, installs, runs (ARGS="--quick" for the short form)
# make test      the same set-up, all tests
# make bench     speed beside other libraries, which it installs; writes docs/performance.md (ARGS="--quick": does not)
# make lint      ruff and mypy

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
PEERS := $(VENV)/.peers

.PHONY: compare test bench lint clean

compare: $(READY)
	$(BIN)/python scripts/compare.py $(ARGS)

test: $(READY)
	$(BIN)/python -m pytest $(ARGS)

bench: $(PEERS)
	$(BIN)/python scripts/benchmark.py $(or $(ARGS),--docs docs)
	$(BIN)/python -m pytest tests/bench --benchmark-only --benchmark-group-by=group

lint: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable ".[dev]"
	touch $@

# One by one: what cannot be installed here is left out, and the benchmark lists it as absent.
$(PEERS): $(READY)
	$(BIN)/python -c "import tomllib; \
	  print(*tomllib.load(open('pyproject.toml', 'rb'))['project']['optional-dependencies']['bench'], sep='\n')" | \
	while read -r peer; do \
	  $(BIN)/python -m pip install --quiet --constraint constraints.txt "$$peer" || echo "not installed: $$peer"; \
	done
	touch $@

clean:
	rm -rf $(VENV) results build dist
	find . -name '*.nb[ic]' -delete
