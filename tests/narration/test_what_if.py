"""What if, in words: read as a person would hear it, and true to the facts beside it."""

from __future__ import annotations

from typing import Any

import pytest

from service import actions as contract
from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Add, Drive, Set
from sim.config import Config
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences
from tests.support.roads import road, run_on
from tools.check_what_if import a_change, sessions

NARRATOR = Narrator.load()
HOLE = run_on(road("........", "........", "........", "...o....", "...A...."))
REMOVE = {"do": "remove", "kind": "pothole", "count": 1, "where": {"nearest": True}}


def asked(run: SimState, *change: dict[str, Any]) -> dict[str, Any]:
    timeline = Timeline(run.config)
    timeline.state = run
    return NARRATOR.answer(Asked(Ask(about="what_if", change=contract.load(list(change))), timeline))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            [REMOVE],
            "If the pothole right ahead were not there, I would go forward now instead of moving left, "
            "and arrive in 2 s rather than 2.5 s. "
            "As it is, moving left costs me 0.5 s against the best I could do.",
        ),
        (
            [{"do": "drive", "move": "right"}],
            "If you had me move right now instead of moving left, I would arrive in 2.5 s all the same.",
        ),
        (
            [{"do": "drive", "move": "forward"}],
            "If you had me go forward, I would stay now instead of moving left, and arrive in 3 s "
            "rather than 2.5 s. The cell you would send me to will not be free, so I would stay.",
        ),
        (
            [{"do": "prefer", "preference": "cautious"}],
            "If I kept my distance, nothing would change: I would make the same moves, and arrive in "
            "2.5 s. But the planner “Priority rules” does not weigh such wishes: "
            "say “use A*” for one that does.",
        ),
        (
            [{"do": "set", "parameter": "planner", "value": "bfs"}],
            "If I planned with the quickest planner, I would move diagonally left now instead of moving "
            "left, and arrive in 2 s rather than 2.5 s. "
            "As it is, moving left costs me 0.5 s against the best I could do.",
        ),
        (
            [{"do": "set", "parameter": "planner", "value": "priority"}],
            "That would change nothing: it is so already. As it is, I arrive in 2.5 s.",
        ),
        (
            [{"do": "remove", "kind": "barrier", "count": 1, "where": {"nearest": True}}],
            "That could not be. There is no barrier on the road.",
        ),
        (
            [{"do": "pause"}],
            "That would make no difference: what counts for me is what is on the road, how I am set and "
            "who drives.",
        ),
        (
            [{"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [7, 1]}}, {"do": "pause"}],
            "If there were a barrier 15 m ahead in the fourth lane to my right, nothing would change: I "
            "would make the same moves, and arrive in 2.5 s. The rest of that would make no difference "
            "on the road.",
        ),
    ],
)
def test_read_aloud(change: list[dict[str, Any]], words: str) -> None:
    assert str(asked(HOLE, *change)["text"]).startswith(words)


def test_driven_by_hand() -> None:
    told = asked(HOLE.with_ego(mode=Mode.MANUAL), REMOVE)
    assert told["text"] == (
        "You are driving, and as long as you ask for nothing I stay where I am. If the pothole right ahead "
        "were not there, nothing would change: I would make the same moves, and get stuck."
    )


def test_after_the_end_the_drive_that_has_ended_is_meant() -> None:
    timeline = Timeline(Config(seed=2, vehicles=0))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    change = (Set(parameter="planner", value="bfs"),)
    told = NARRATOR.answer(Asked(Ask(about="what_if", change=change), timeline))
    assert str(told["text"]).startswith("Driven again from the start of this drive: If I planned")
    again = NARRATOR.answer(Asked(Ask(about="what_if", change=change, tick=0), timeline))
    assert told["changed"] == again["changed"]


def test_what_was_said_during_a_drive_holds_when_it_is_driven_again() -> None:
    timeline = Timeline(Config(seed=2, vehicles=0))
    timeline.advance()
    timeline.apply(1, [Add(kind="barrier", count=1)])
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    change = (Set(parameter="planner", value="bfs"),)
    told = NARRATOR.answer(Asked(Ask(about="what_if", change=change), timeline))
    assert str(told["text"]).startswith("Driven again from tick 1: If I planned")


def test_things_at_a_place_are_those_of_the_last_decision_of_a_drive_that_has_ended() -> None:
    timeline = Timeline(Config(seed=2, vehicles=0))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    told = NARRATOR.answer(Asked(Ask(about="what_if", change=(Drive(move=Move.LEFT),)), timeline))
    assert str(told["text"]).startswith(f"Driven again from tick {timeline.tick - 1}:")


def test_whatever_is_asked_the_words_hold_to_the_facts() -> None:
    for number, (draw, timeline) in enumerate(sessions(4)):
        if number == 120:
            break
        told = NARRATOR.answer(Asked(Ask(about="what_if", change=a_change(draw)), timeline))
        text = told.pop("text")
        assert looks_like_sentences(text), text
        assert ids_in(text) <= ids_in(told), text
