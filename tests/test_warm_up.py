from __future__ import annotations

import pytest

from service import warm_up
from service.contract.requests import Sent, TypedActions
from service.grammar import Language
from service.interpreter.languages import Languages


async def test_what_the_first_requests_need_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(warm_up, "START_S", 0.0)
    monkeypatch.setattr(warm_up.gc, "freeze", lambda: None)
    grammar = Language.load("de")
    await warm_up.warm_up(Languages({"de": grammar}))
    assert all(model.__pydantic_complete__ for model in (TypedActions, *Sent.__subclasses__()))
    assert "suggestions" in vars(grammar)
