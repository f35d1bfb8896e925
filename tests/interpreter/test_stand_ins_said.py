"""A word for what there is none of is told where something else is put on the road for it."""

from __future__ import annotations

import pytest

from service.grammar import Language, Understood


@pytest.mark.parametrize(
    ("code", "text", "told"),
    [
        ("en", "put a truck 30 m ahead", [("truck", "car")]),
        ("en", "add two cars and a Bus", [("Bus", "car")]),
        ("de", "stelle einen Lastwagen 30 m voraus", [("Lastwagen", "Auto")]),
        ("en", "put a car 30 m ahead", []),
        ("en", "remove that truck", []),
        ("en", "add a self-driving taxi", []),
    ],
)
def test_what_is_put_instead_is_told(code: str, text: str, told: list[tuple[str, str]]) -> None:
    parsed = Language.load(code).parse(text)
    assert isinstance(parsed, Understood)
    assert [(each.wrote, each.read) for each in parsed.corrections] == told
