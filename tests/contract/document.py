"""An application to ask, and every call of its document as a case for tests."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from fastapi import FastAPI

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from sim.evaluate.executor import InProcess
from tests.support.fakes import FewSentences, HandClock

Json = dict[str, Any]


def asked() -> FastAPI:
    """The service in memory, with a clock that is moved by hand."""
    return create_app(
        Settings(database="memory:"),
        store=MemoryStore(),
        language=FewSentences(),
        clock=HandClock(),
        make_executor=InProcess,
    )


@cache
def document() -> Json:
    """The service's own document; alike in every application, and made once since that takes a second."""
    return asked().openapi()


def operations(document: Json) -> list[Any]:
    """Path, method and what the document says of it, for each call."""
    return [
        pytest.param(path, method, operation, id=f"{method} {path}")
        for path, item in document["paths"].items()
        for method, operation in item.items()
    ]
