"""Writes the reference that follows from the code: settings, commands, REST API, metrics, what can be said.

A page asks for one with a line `<!-- generated: NAME -->`; NAME is a key of `GENERATORS`.
"""

from __future__ import annotations

import re
from typing import Any

from command_reference import commands
from language_reference import intents
from metrics_reference import metrics
from rest_reference import operations, schemas
from settings_reference import settings
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

GENERATORS = {
    "commands": commands,
    "intents": intents,
    "metrics": metrics,
    "operations": operations,
    "schemas": schemas,
    "settings": settings,
}
_REQUEST = re.compile(r"<!-- generated: (\w+) -->")


def setup(app: Sphinx) -> dict[str, Any]:
    """Registers the extension."""
    app.connect("source-read", _insert)
    app.connect("env-get-outdated", _outdated)
    return {"parallel_read_safe": False, "parallel_write_safe": True}


def _insert(_: Sphinx, _page: str, source: list[str]) -> None:
    source[0] = _REQUEST.sub(lambda found: GENERATORS[found[1]](), source[0])


def _outdated(_app: Sphinx, env: BuildEnvironment, *_: set[str]) -> list[str]:
    """Generated pages are read in every build: Sphinx does not watch what they are made of."""
    texts = {page: env.doc2path(page).read_text(encoding="utf-8") for page in env.found_docs}
    return [page for page, text in texts.items() if _REQUEST.search(text)]
