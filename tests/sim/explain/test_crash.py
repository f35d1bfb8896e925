"""What is claimed of a crash holds when it is really run: without its causes, or with the saving move."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from sim.actions import Add, Drive, Reset, SetMode, Where
from sim.config import Config
from sim.explain import QuestionError
from sim.explain.alternatives import after_move
from sim.explain.crash import Crash, led_to_crash, why_crashed
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome


def driven(config: Config) -> Timeline:
    """A timeline at the end of its first episode."""
    timeline = Timeline(config)
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


CARELESS = Config(potholes=30, vehicles=25, planner="priority", attentive=0.0)
"""Roads on which it comes to crashes: nobody brakes, and the source's rule drives."""


def crashes(count: int, **config: object) -> Iterator[tuple[Timeline, Crash]]:
    seed = 0
    while count:
        timeline = driven(CARELESS.with_parts(seed=seed, **config))
        seed += 1
        if timeline.state.world.outcome is Outcome.CRASH:
            count -= 1
            yield timeline, why_crashed(timeline)


def outcome_after(state: SimState) -> Outcome:
    return step(state).state.world.outcome


def test_what_a_crash_hung_on_is_enough_for_it_and_cannot_be_spared() -> None:
    for timeline, crash in crashes(25):
        explained = crash.explanation
        moment = timeline.at(crash.end - 1)
        assert outcome_after(moment) is Outcome.CRASH
        assert crash.cause == timeline.state.world.cause
        assert explained.causes
        names = [cause.id for cause in explained.causes]
        alone = replace(moment, world=moment.world.keeping(names))
        assert (outcome_after(alone) is Outcome.CRASH) is explained.verified.sufficient is True
        for flip in explained.counterfactuals:
            changed = moment
            for action in flip.change:
                changed = apply(changed, action).state
            tick = step(changed)
            assert tick.state.world.outcome is not Outcome.CRASH
            assert tick.decision is not None
            assert tick.decision.move is flip.move


def test_the_move_that_would_have_saved_it_does_when_the_quickest_way_is_taken_from_there() -> None:
    saved = 0
    for timeline, crash in crashes(25):
        saving = crash.saving
        if saving is None:
            continue
        saved += 1
        moment = timeline.at(saving.tick)
        assert timeline.decision(saving.tick).move is saving.made  # type: ignore[union-attr]
        state = after_move(moment, saving.instead)
        state = replace(state, config=state.config.with_parts(planner="bfs"))
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        assert state.world.outcome is Outcome.SUCCESS
        assert state.world.episode_tick == saving.ticks
        for tick in range(saving.tick + 1, crash.end):
            lost = timeline.at(tick)
            lost = replace(lost, config=lost.config.with_parts(planner="bfs"))
            while lost.world.outcome is Outcome.RUNNING:
                lost = step(lost).state
            assert lost.world.outcome is not Outcome.SUCCESS
    assert saved > 15


def test_the_latest_crash_is_found_after_the_next_road_has_begun() -> None:
    timeline, crash = next(crashes(1))
    for _ in range(timeline.state.config.reset_delay_ticks + 3):
        timeline.advance()
    assert timeline.state.world.episode == 2
    again = why_crashed(timeline)
    assert (again.end, again.cause) == (crash.end, crash.cause)
    assert why_crashed(timeline, crash.end).end == why_crashed(timeline, crash.end - 1).end == crash.end
    assert led_to_crash(timeline, crash.end - 1)
    assert not led_to_crash(timeline, crash.end - 2)
    assert not led_to_crash(timeline, None)


def test_a_crash_is_found_where_the_road_was_begun_again_at_that_very_tick() -> None:
    timeline, crash = next(crashes(1))
    timeline.apply(1, [Reset()])
    timeline.advance()
    assert why_crashed(timeline).end == crash.end


@pytest.mark.parametrize(
    ("tick", "code"), [(None, "no_crash"), (2, "no_crash_then"), (5, "no_crash_then"), (6, "no_such_tick")]
)
def test_where_there_was_no_crash_that_is_said(tick: int | None, code: str) -> None:
    timeline = Timeline(Config(vehicles=0, potholes=0))
    for _ in range(5):
        timeline.advance()
    with pytest.raises(QuestionError) as raised:
        why_crashed(timeline, tick)
    assert raised.value.code == code


def test_nothing_is_claimed_of_the_ticks_before_where_somebody_may_give_way() -> None:
    _, crash = next(crashes(1, courtesy=0.3))
    assert not crash.certain
    assert crash.saving is None
    assert crash.looked_back == 0


def test_a_person_who_stands_still_is_told_which_moves_were_free() -> None:
    timeline = Timeline(Config(seed=3, potholes=0, vehicles=0, attentive=0.0))
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    column, row = timeline.state.world.road.cell(timeline.state.world.av)
    timeline.apply(2, [Add(kind="vehicle", count=1, where=Where(cell=(column - 2, row)))])
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < 20:
        timeline.advance()
    crash = why_crashed(timeline)
    assert crash.explanation.decision.asked is Move.STAY
    assert Move.FORWARD in crash.free
    assert [cause.id for cause in crash.explanation.causes] == ["vehicle-1"]
    assert crash.saving is not None
    assert crash.saving.tick == crash.end - 1


def test_an_edit_on_the_way_ends_what_is_known_of_the_ticks_before() -> None:
    timeline = Timeline(Config(seed=3, potholes=0, vehicles=0, attentive=0.0))
    timeline.advance()
    timeline.apply(1, [Drive(move=Move.LEFT)])
    timeline.advance()
    timeline.apply(2, [SetMode(mode=Mode.MANUAL)])
    column, row = timeline.state.world.road.cell(timeline.state.world.av)
    walls = [(column + x, row - y) for x in (-1, 0, 1) for y in (0, 1) if (x, y) != (0, 0) and x != -1]
    walls += [(column - 1, row - 1), (column - 2, row)]
    for place in walls:
        timeline.apply(3, [Add(kind="barrier", count=1, where=Where(cell=place))])
    timeline.apply(4, [Add(kind="vehicle", count=1, where=Where(cell=(column - 1, row)))])
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < 20:
        timeline.advance()
    assert timeline.state.world.outcome is Outcome.CRASH
    crash = why_crashed(timeline)
    assert (crash.saving, crash.whole, crash.looked_back, crash.free) == (None, False, 1, ())
