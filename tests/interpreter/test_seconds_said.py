"""Seconds that are said of the clock are ticks of the session, however long its ticks are."""

from __future__ import annotations

from dataclasses import replace

import pytest

from service.actions import Rewind, Step
from service.grammar import Language, Understood
from service.grammar.topic import ALONE
from tests.interpreter.conftest import Opening


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


async def test_a_session_counts_in_its_own_ticks(opening: Opening) -> None:
    talk = await opening(config={"step_seconds": 0.25})
    assert (await talk.say("forward 3 seconds"))["actions"] == [{"do": "step", "ticks": 12}]
    assert (await talk.say("go back 2 seconds"))["actions"] == [{"do": "rewind", "ticks": 8}]
    assert (await talk.state())["tick"] == 4
