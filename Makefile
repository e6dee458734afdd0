# make compare and make test do all set-up on a machine that has Python 3.11+ and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: compare test test-slow test-all docs lint types mypy pyright wheel clean

# Processes of the tests start faster where bytecode is kept, which images of containers often turn off.
unexport PYTHONDONTWRITEBYTECODE

compare: $(VENV)/.installed
	$(BIN)/gbnbench compare $(ARGS)

# Files are dealt out whole, in the order of tests/conftest.py.
PYTEST := $(BIN)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder

# The everyday loop; test-slow is the rest, and test-all is both.
test: $(VENV)/.installed
	$(PYTEST) -m "not slow" $(ARGS)

test-slow: $(VENV)/.installed
	$(PYTEST) -m slow $(ARGS)

test-all: $(VENV)/.installed
	$(PYTEST) $(ARGS)

# Every cross reference must resolve, and any warning fails.
docs: $(VENV)/.installed
	$(BIN)/python -m sphinx --quiet --fail-on-warning --keep-going --nitpicky docs build/docs
	@echo "built build/docs/index.html"

lint: $(VENV)/.installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

types: mypy pyright

mypy: $(VENV)/.installed
	$(BIN)/mypy

pyright: $(VENV)/.installed
	$(BIN)/pyright

wheel: $(VENV)/.installed
	$(BIN)/python -m build --no-isolation --outdir dist . > build.log 2>&1 || { cat build.log; exit 1; }

$(VENV)/.installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	touch $@

clean:
	rm -rf $(VENV) build dist *.egg-info
