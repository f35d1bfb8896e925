"""What is said of decisions of `rules`: dead ends, ways that a mover closes, and why this side."""

from __future__ import annotations

import pytest

from service.narration import Narrator
from service.narration.explanation import Explained
from service.narration.sayings import Sayings
from sim.decide import decide
from sim.explain.why_causes import explain_why
from sim.explain.why_not import explain_why_not
from sim.state import SimState
from sim.types import Move
from tests.support.roads import road, run_on

EXPLAINED = Explained(Sayings.load())
NARRATOR = Narrator.load()

DEAD_END = (".oooooo", ".oo...o", "...A..o", ".......")
CLOSED = ("oo.oooo", "...<...", "A......", ".......")
NEARER = (".......", ".oooo.o", "...A...", ".......")
EVEN = (".......", "o.ooo.o", "...A...", ".......")
WALLED = (".......", "ooooooo", ".......", "...A...", ".......")


def moment(rows: tuple[str, ...]) -> SimState:
    return run_on(road(*rows), planner="rules")


def log(rows: tuple[str, ...]) -> str:
    decision = decide(moment(rows))
    assert decision is not None
    return NARRATOR.decision(decision, moment(rows))


def why(rows: tuple[str, ...]) -> str:
    decision = decide(moment(rows))
    assert decision is not None
    return EXPLAINED.text(explain_why(moment(rows), decision))


def why_not(rows: tuple[str, ...], foil: Move) -> str:
    decision = decide(moment(rows))
    assert decision is not None
    return EXPLAINED.text(explain_why_not(moment(rows), decision, foil))


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (DEAD_END, "Left: the cell ahead leads into a dead end."),
        (
            CLOSED,
            "Staying: from the cell ahead, the car 5 m ahead in the third lane to my right comes between",
        ),
        (NEARER, "Right: there is a pothole in the cell ahead."),
        (WALLED, "Staying: no way leads on from here."),
    ],
)
def test_the_line_of_the_log(rows: tuple[str, ...], said: str) -> None:
    assert log(rows).startswith(said)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (DEAD_END, "because the cell ahead led into a dead end. On the left was the only way on."),
        (
            CLOSED,
            "the car 5 m ahead in the third lane to my right would have come between me and the way on.",
        ),
        (NEARER, "The way on was nearer on the right: 2 columns against 3."),
        (EVEN, "Either side was as near (2 columns); left comes first."),
        (WALLED, "because no way led on from there."),
    ],
)
def test_why(rows: tuple[str, ...], said: str) -> None:
    assert said in why(rows)


def test_what_shuts_a_way_is_told_and_its_removal_makes_the_move() -> None:
    told = why_not(DEAD_END, Move.FORWARD)
    assert "I could have, but the cell ahead led into a dead end." in told
    assert told.endswith("I would go forward.")
    decision = decide(moment(DEAD_END))
    assert decision is not None
    explanation = explain_why_not(moment(DEAD_END), decision, Move.FORWARD)
    (flip,) = explanation.counterfactuals
    after = moment(DEAD_END)
    without = decide(SimState(after.config, after.world.without(frozenset(flip.removed))))
    assert without is not None
    assert without.move is Move.FORWARD
    assert explanation.verified.sufficient
    assert {cause.id for cause in explanation.causes} == set(flip.removed)


def test_the_other_side_is_farther() -> None:
    assert "the way on was nearer on the right: 2 columns against 3." in why_not(NEARER, Move.LEFT)
