# make compare   the paper's experiment: creates .venv, installs, runs (ARGS="--quick" for the short form)
# make test      the same set-up, all tests
# make bench     speed beside other libraries, which it installs; writes docs/performance.md (ARGS="--quick": does not)
# make soak     kills, full disks, spoilt files, lost workers; writes docs/reliability.md (ARGS="--quick": does not)
# make docs      the site of docs, examples and docstrings in build/docs
# make lint      ruff and mypy

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
PEERS := $(VENV)/.peers

.PHONY: compare test bench soak docs lint clean

compare: $(READY)
	$(BIN)/python scripts/compare.py $(ARGS)

# Two processes with a thread of linear algebra each: threads of both would wait for one another.
test: $(READY)
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n 2 --dist worksteal $(ARGS)

bench: $(PEERS)
	$(BIN)/python benchmarks/benchmark.py $(or $(ARGS),--docs docs)
	$(BIN)/python -m pytest benchmarks/bench --benchmark-only --benchmark-group-by=group

soak: $(READY)
	cd benchmarks && ../$(BIN)/python -m soak $(or $(ARGS),--docs ../docs)

docs: $(READY)
	MPLBACKEND=agg $(BIN)/sphinx-build --fail-on-warning --keep-going --quiet docs build/docs

lint: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable ".[dev]"
	touch $@

# One by one: what cannot be installed here is left out, listed as absent, and tried again the next time.
$(PEERS): $(READY)
	@missing=; for peer in $$($(BIN)/python -c "import tomllib; \
	  print(*tomllib.load(open('pyproject.toml', 'rb'))['project']['optional-dependencies']['bench'])"); do \
	  $(BIN)/python -m pip install --quiet --constraint constraints.txt "$$peer" || missing="$$missing $$peer"; \
	done; \
	if [ -z "$$missing" ]; then touch $@; else echo "not installed:$$missing"; fi

clean:
	rm -rf $(VENV) results build dist
	find . -name '*.nb[ic]' -delete
