"""What if it goes on: nothing else is supposed, so it is told what comes of the drive."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.grammar import Language, Understood
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline


@pytest.mark.parametrize("text", ["what if you keep going?", "what would happen if you just go on?"])
def test_what_if_it_goes_on_is_answered_with_what_comes(text: str) -> None:
    timeline, narrator = Timeline(Config(seed=7)), Narrator.load()
    parse = Language.load("en").parse(text)
    assert isinstance(parse, Understood)
    (ask,) = parse.actions
    assert isinstance(ask, Ask)
    arrival = narrator.answer(Asked(Ask(about="outlook", what="arrival"), timeline))
    assert narrator.answer(Asked(ask, timeline))["text"] == arrival["text"]


def test_what_if_it_stopped_the_clock_supposes_nothing_of_the_drive() -> None:
    parse = Language.load("en").parse("what if we pause?")
    assert isinstance(parse, Understood)
    told = Narrator.load().answer(Asked(parse.actions[0], Timeline(Config(seed=7))))  # type: ignore[arg-type]
    assert "no difference" in told["text"]
