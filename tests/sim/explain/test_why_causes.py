"""Every cause named is a cause: checked by editing the road and letting it run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

import pytest

from sim.explain import Role, why
from sim.explain.why_causes import minimal_sufficient_set
from sim.oracle.ddmin import ddmin
from sim.types import Mode, Move
from tests.support.moments import all_ids, moments, move_after
from tests.support.roads import road, run_on
from tests.support.timelines import timeline_on


def test_of_1000_moments_every_cause_flips_and_the_causes_are_enough() -> None:
    named = alone = 0
    for timeline in moments(1000):
        explanation = why(timeline)
        state = timeline.at(explanation.decision.tick)
        fact = explanation.decision.move
        causes = [cause.id for cause in explanation.causes]
        for cause in explanation.causes:
            named += 1
            alone += cause.necessary
            assert move_after(state, removed=cause.group) is not fact
            assert (move_after(state, removed=(cause.id,)) is not fact) is cause.necessary
            if not cause.necessary:
                assert len(cause.group) > 1
        kept = tuple(all_ids(state) - set(causes))
        assert move_after(state, removed=kept) is fact
        for flip in explanation.counterfactuals:
            assert move_after(state, change=flip.change) is flip.move is not fact
        assert explanation.verified.sufficient is True
        assert explanation.verified.necessary is all(cause.necessary for cause in explanation.causes)
    assert alone > 0.5 * named > 100


def test_no_part_of_the_causes_is_enough() -> None:
    for timeline in moments(150, seed=1):
        explanation = why(timeline)
        state = timeline.at(explanation.decision.tick)
        causes = [cause.id for cause in explanation.causes]
        if not explanation.verified.minimal or len(causes) > 4:
            continue
        for size in range(len(causes)):
            for part in combinations(causes, size):
                gone = tuple(all_ids(state) - set(part))
                assert move_after(state, removed=gone) is not explanation.decision.move


def test_things_out_of_reach_are_never_causes() -> None:
    for timeline in moments(200, seed=2):
        explanation = why(timeline)
        state = timeline.at(explanation.decision.tick)
        row = state.world.road.cell(state.world.av)[1]
        assert all(row - 1 <= cause.cell[1] <= row for cause in explanation.causes)


def test_a_free_road_has_no_causes() -> None:
    timeline = timeline_on(run_on(road("........", "........", "........", "...A....")))
    explanation = why(timeline)
    assert explanation.decision.move is Move.FORWARD
    assert explanation.causes == ()
    (flip,) = explanation.counterfactuals
    assert (flip.added, flip.move) == ((("barrier", (3, 2)),), Move.LEFT)
    assert explanation.verified.sufficient


def test_one_pothole_ahead_is_the_cause() -> None:
    timeline = timeline_on(run_on(road("........", "........", "...o....", "...A....")))
    (cause,) = why(timeline).causes
    assert (cause.id, cause.role, cause.moves, cause.necessary) == (
        "pothole-1",
        Role.BLOCKS,
        (Move.FORWARD,),
        True,
    )


def test_what_turns_a_mover_round_has_its_part() -> None:
    # The vehicle faces left but the pothole beside it sends it right, into the cell ahead.
    timeline = timeline_on(run_on(road("........", "........", ".o<.....", "...A....")))
    roles = {cause.id: cause.role for cause in why(timeline).causes}
    assert roles == {"vehicle-1": Role.BLOCKS, "pothole-1": Role.DRIVES}


def test_an_overdetermined_decision_names_the_stand_in() -> None:
    # Were the pothole not there, the vehicle that it turns away would enter its cell.
    timeline = timeline_on(run_on(road("........", "........", "...o<...", "...A....")))
    (cause,) = why(timeline).causes
    assert (cause.id, cause.necessary, cause.group) == ("pothole-1", False, ("pothole-1", "vehicle-1"))


def test_a_move_held_back_is_explained_by_what_it_would_have_met() -> None:
    state = run_on(road("........", "........", "........", "..#A...."))
    held = state.with_ego(mode=Mode.MANUAL, queue=(Move.LEFT,))
    explanation = why(timeline_on(held))
    assert explanation.decision.held_back
    assert [cause.id for cause in explanation.causes] == ["barrier-1"]
    assert explanation.counterfactuals[0].move is Move.LEFT


@pytest.mark.parametrize("needed", [set(), {"a"}, {"b", "d"}, set("abcdefg")])
def test_sparing_leaves_what_is_needed(needed: set[str]) -> None:
    assert set(ddmin("abcdefg", lambda kept: needed <= set(kept))) == needed


class OneOfMany:
    """A fact that holds while any of these is left; and two of them alone flip it as well."""

    def __init__(self, names: list[str]) -> None:
        self.names = frozenset(names)

    def without(self, names: Iterable[str]) -> bool:
        gone = frozenset(names)
        return gone != self.names and gone != frozenset(("b", "c"))

    def keeping(self, names: Iterable[str]) -> bool:
        return self.without(self.names - frozenset(names))


@pytest.mark.parametrize(("names", "group"), [("abcd", ()), ("adefgh", tuple("adefgh")), ("adefghi", ())])
def test_no_group_is_told_of_which_a_part_does_or_might(names: str, group: tuple[str, ...]) -> None:
    """Every part of up to six is tried; of more, a part may do though no one can be spared."""
    _, groups, _ = minimal_sufficient_set(OneOfMany([*names]), True, [*names])
    assert groups["a"] == group
