"""Seconds that are said of the clock are ticks of the session, however long its ticks are."""

from __future__ import annotations

from dataclasses import replace

import pytest

from service.actions import Rewind, Step
from service.grammar import Language, Understood
from service.grammar.topic import ALONE
from tests.support.service import Service


@pytest.mark.parametrize(("step_seconds", "ticks"), [(0.5, 10), (0.25, 20), (2.0, 2), (5.0, 1)])
def test_ticks_are_as_many_as_fit(step_seconds: float, ticks: int) -> None:
    language = Language.load("en")
    topic = replace(ALONE, step_seconds=step_seconds)
    for text, action in (("go back 5 seconds", Rewind(ticks=ticks)), ("forward 5 s", Step(ticks=ticks))):
        parsed = language.parse(text, topic)
        assert isinstance(parsed, Understood)
        assert parsed.actions == (action,)


def test_less_than_half_a_tick_is_no_tick() -> None:
    parsed = Language.load("en").parse("go back 2 seconds", replace(ALONE, step_seconds=5.0))
    assert not isinstance(parsed, Understood)


async def test_a_session_counts_in_its_own_ticks(service: Service) -> None:
    path = await service.session(config={"step_seconds": 0.25})
    forth = (await service.say(path, "forward 3 seconds")).json()
    assert forth.get("actions") == [{"do": "step", "ticks": 12}], forth
    back = (await service.say(path, "go back 2 seconds")).json()
    assert back["actions"] == [{"do": "rewind", "ticks": 8}]
    assert back["reply"] == "Back at tick 4."
