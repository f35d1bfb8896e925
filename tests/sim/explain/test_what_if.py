"""What a what-if states is what comes of it, the session is left as it is, and what cannot be is said."""

from __future__ import annotations

import pytest

from sim.actions import Add, Prefer, Remove, Reset, Scenario, Set, Where, WorldAction
from sim.config import Config
from sim.explain import QuestionError
from sim.explain.what_if import WhatIf, what_if
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome
from tests.support.judged_drives import drives
from tests.support.roads import road, run_on
from tools.check_what_if import checked

NEAREST = Remove(kind="pothole", count=1, where=Where(nearest=True))


def at(state: SimState) -> Timeline:
    timeline = Timeline(state.config)
    timeline.state = state
    return timeline


def test_what_is_stated_is_what_comes_of_it() -> None:
    figures = checked(60, seed=77)
    assert figures.wrong == []
    assert figures.cases["asked"] == 54
    assert figures.cases["a difference"] > 8


def test_where_they_part_and_what_the_real_move_costs() -> None:
    timeline = at(run_on(road("........", "........", "...oo...", "...A....")))
    found = what_if(timeline, [Remove(kind="pothole", count="all")])
    assert found.first_difference is not None
    assert (found.first_difference.ahead, found.first_difference.tick) == (0, 0)
    assert (found.first_difference.real, found.first_difference.changed) == (Move.LEFT, Move.FORWARD)
    assert (found.real.driven, found.changed.driven) == (4, 3)
    assert found.regret is not None
    assert found.regret.ticks == 1
    assert found.certain


def test_what_changes_nothing_is_known_as_that() -> None:
    found = what_if(Timeline(Config(seed=3)), [Set(parameter="planner", value="rules")])
    assert found.no_effect
    assert found.real == found.changed
    assert found.first_difference is None


@pytest.mark.parametrize("change", [Reset(), Scenario(potholes=2), Set(parameter="rows", value=12)])
@pytest.mark.parametrize("ticks", [9, 34])
def test_another_road_is_not_compared_move_by_move(change: WorldAction, ticks: int) -> None:
    timeline = Timeline(Config(seed=3))
    for _ in range(ticks):
        timeline.advance()
    found = what_if(timeline, [change])
    assert not found.same_road
    assert found.first_difference is None
    assert found.changed.outcome is not Outcome.RUNNING


def test_what_cannot_be_done_is_refused_and_nothing_is_done() -> None:
    timeline = Timeline(Config(seed=3, potholes=0))
    before = timeline.state
    with pytest.raises(EditError, match=r"none there \(kind=pothole"):
        what_if(timeline, [Add(kind="barrier", count=2), NEAREST])
    for tick in (-1, 1):
        with pytest.raises(QuestionError) as raised:
            what_if(timeline, [Prefer(preference="cautious")], tick)
        assert raised.value.code == "no_such_tick"
    assert timeline.state is before
    assert timeline.entries == []


def test_of_the_past_only_the_change_differs() -> None:
    timeline = Timeline(Config(seed=5, potholes=20))
    for tick in range(12):
        if tick == 8:
            timeline.apply(1, [Remove(kind="vehicle", count="all")])
        timeline.advance()
    found: WhatIf = what_if(timeline, [NEAREST], 4)
    assert found.state == timeline.at(4)
    assert found.said_since == 1
    assert found.real.tick == found.changed.tick == 4
    assert what_if(timeline, [NEAREST], 9).said_since == 0


def test_where_only_one_side_is_left_to_chance_both_have_chances() -> None:
    told = 0
    for timeline in drives(40, 3, "priority"):
        state = timeline.state
        if state.config.certain or state.world.outcome is not Outcome.RUNNING:
            continue
        found = what_if(timeline, [Set(parameter="courtesy", value=0.0)])
        assert found.done[-1].state.config.certain
        real, changed = found.real_chances, found.changed_chances
        assert real is not None
        assert changed is not None
        assert changed.settled
        assert found.by_chance is not real.settled
        told += found.by_chance
    assert told > 3
