# make demo   set up, then design a shipped spec
# make test   set up, then run all tests
# Needs Python 3.11 or newer and make; everything else is installed into .venv from the lock file.

VENV    := .venv
PYTHON  := $(VENV)/bin/python
READY   := $(VENV)/.springcad-ready
SPEC    ?= specs/S2.yaml
OUT     ?= out

# One thread in every numeric library: same bytes everywhere, and tests do not fight for cores.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export MKL_NUM_THREADS := 1

.PHONY: help setup demo test lint types imports bench docs lock clean
.DELETE_ON_ERROR:

help:
	@echo "make demo     design $(SPEC) into $(OUT)/"
	@echo "make test     run all tests"
	@echo "make lint     ruff: rules and layout of the code"
	@echo "make types    mypy, strict"
	@echo "make imports  import-linter: dependencies run one way"
	@echo "make bench    compare optimiser, beam and finite elements with others; writes bench*.json"
	@echo "make docs     renew what the docs quote from the program"
	@echo "make lock     renew requirements.lock from pyproject.toml (needs uv)"
	@echo "make clean    remove .venv, caches and out/"

setup: $(READY)

# Quiet unless it fails: then the whole log of pip is shown.
$(READY): requirements.lock pyproject.toml
	@python=; for name in python3 python3.14 python3.13 python3.12 python3.11 python; do \
	  if $$name -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; \
	  then python=$$name; break; fi; \
	done; \
	if [ -z "$$python" ]; then \
	  echo "springcad needs Python 3.11 or newer; found: $$(python3 --version 2>&1)" >&2; exit 1; \
	fi; \
	echo "setting up $(VENV) with $$($$python --version) (once, a minute or two)"; \
	if ! [ -x $(PYTHON) ] && ! $$python -m venv $(VENV); then \
	  rm -rf $(VENV); echo "on Debian and Ubuntu: apt install python3-venv" >&2; exit 1; \
	fi
	@run() { "$$@" >$(VENV)/setup.log 2>&1 || { cat $(VENV)/setup.log >&2; exit 1; }; }; \
	run $(PYTHON) -m pip install --disable-pip-version-check --require-hashes -r requirements.lock; \
	run $(PYTHON) -m pip install --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

demo: $(READY)
	@$(VENV)/bin/springcad design $(SPEC) -o $(OUT)

test: $(READY)
	@$(PYTHON) -m pytest -n auto --dist worksteal $(PYTEST_ARGS)

lint: $(READY)
	@$(PYTHON) -m ruff check .
	@$(PYTHON) -m ruff format --check .

types: $(READY)
	@$(PYTHON) -m mypy

imports: $(READY)
	@$(VENV)/bin/lint-imports

bench: $(READY)
	@$(PYTHON) bench/optimiser.py --json bench.json
	@$(PYTHON) bench/mechanics.py --json bench-mechanics.json

docs: $(READY)
	@$(PYTHON) docs/generate.py

# One lock for every supported Python: hashes of every wheel, markers where versions must differ.
lock:
	uv pip compile pyproject.toml --extra dev --generate-hashes --universal \
	  --python-version 3.11 --no-header --no-annotate -o requirements.lock

clean:
	rm -rf $(VENV) out build dist bench.json bench-mechanics.json .mypy_cache .ruff_cache .pytest_cache \
	  .import_linter_cache .hypothesis *.egg-info
	find . -name __pycache__ -prune -exec rm -rf {} +
