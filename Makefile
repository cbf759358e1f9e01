# make compare   the paper's experiment: creates .venv, installs, runs (ARGS="--quick" for the short form)
# make test      the same set-up, all tests
# make bench     speed, as ratios measured in one run
# make lint      ruff and mypy

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

.PHONY: compare test bench lint clean

compare: $(READY)
	$(BIN)/python scripts/compare.py $(ARGS)

test: $(READY)
	$(BIN)/python -m pytest $(ARGS)

bench: $(READY)
	$(BIN)/python -m pytest tests/bench --benchmark-only --benchmark-group-by=group $(ARGS)

lint: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable ".[dev]"
	touch $@

clean:
	rm -rf $(VENV) results build dist
