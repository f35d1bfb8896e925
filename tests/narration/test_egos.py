"""What is said of a move that another ego keeps this one from."""

from __future__ import annotations

import pytest

from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.decide import decide_each
from sim.forecast import StepVerdict
from sim.render.theme import REASONS
from sim.state import SimState
from sim.types import Mode, Move
from tests.support.roads import road, run_on

SAYINGS = Sayings.load()


@pytest.mark.parametrize(
    ("reason", "text"),
    [
        ("ego_stays", "an autonomous vehicle stays in the cell to my left"),
        ("ego_enters", "the autonomous vehicle 5 m ahead on my left is about to enter the cell to my left"),
        ("ego_swaps", "an autonomous vehicle is coming out of the cell to my left towards me"),
        (
            "ego_crosses",
            "the autonomous vehicle 5 m ahead on my left is about to cut across my way to "
            "the cell to my left",
        ),
    ],
)
def test_another_ego_is_told_of(reason: str, text: str) -> None:
    run = run_on(road("....", "....", "....", "...A", "....", lines=("av 3,3 2,2",)))
    assert SAYINGS.in_the_way(reason, Move.LEFT, ("av-2",), "now", Naming(SAYINGS, run)) == text


def test_a_mover_is_told_alone_where_an_ego_is_in_the_way_as_well() -> None:
    run = run_on(road("....", "....", "....", ".>.A", "....", lines=("av 3,3 2,2",)))
    alone, both = (
        SAYINGS.in_the_way("mover_enters", Move.LEFT, ids, "now", Naming(SAYINGS, run))
        for ids in (("vehicle-1",), ("vehicle-1", "av-2"))
    )
    assert alone == both


def test_every_reason_has_words() -> None:
    for verdict in StepVerdict:
        assert SAYINGS.words("words", "reasons")[verdict]
        assert verdict in REASONS


def test_a_parked_ego_ahead_is_the_reason_not_to_go_forward() -> None:
    world = road("....", "....", "..A.", "..A.", "....")
    state = SimState.start(run_on(world).config, world).with_ego(mode=Mode.MANUAL)
    decision = decide_each(state)["av-2"].decision
    forward = decision.option(Move.FORWARD)
    assert (forward.reason, forward.causes) == (StepVerdict.EGO_STAYS, ("av-1",))
    told = SAYINGS.met(forward, "now", Naming(SAYINGS, state))
    assert told == "an autonomous vehicle stays in the cell ahead"
