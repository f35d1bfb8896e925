"""The course of a drive against the record, and what is foretold against what then happens."""

from __future__ import annotations

from itertools import pairwise

import pytest

from sim.actions import Drive, Remove, SetMode
from sim.config import Config
from sim.decide import moves_where
from sim.explain.drive_story import Happened, drive_story, what_went_wrong
from sim.explain.drive_track import drive_track
from sim.explain.last_detected import last_detected
from sim.explain.least_ttc import least_ttc
from sim.explain.place_then import place_then
from sim.explain.places_before import places_before
from sim.explain.question_error import QuestionError
from sim.explain.stays_free import stays_free
from sim.session.timeline import Timeline
from sim.transition import transition
from sim.types import Mode, Move, Outcome

SEEDS = range(8)


def driven(seed: int, ticks: int = 80, **more: object) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=16, pedestrians=3, potholes=4, seed=seed)
    timeline = Timeline(config.with_parts(**more))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def test_the_track_is_that_of_the_record() -> None:
    turned = 0
    for seed in SEEDS:
        timeline = driven(seed)
        track = drive_track(timeline)
        states = list(timeline.between(track.first, track.last + 1))
        cells = [state.world.road.cell(state.world.av) for state in states]
        assert list(track.cells) == cells
        sides = [now[0] - was[0] for was, now in pairwise(cells) if now[0] != was[0]]
        assert len(track.reversals) == sum(one != other for one, other in pairwise(sides))
        assert sum(ticks for _, ticks in track.stops) == sum(was == now for was, now in pairwise(cells))
        assert all(cell == cells[-1] for cell in cells[track.here_since - track.first :])
        assert all(cell[0] == cells[-1][0] for cell in cells[track.lane_since - track.first :])
        if track.lane_since > track.first:
            assert cells[track.lane_since - track.first - 1][0] != cells[-1][0]
        turned += bool(track.reversals)
    assert turned


@pytest.mark.parametrize("move", [Move.FORWARD, Move.LEFT, Move.RIGHT])
def test_what_stays_free_does_so_where_the_ego_stands(move: Move) -> None:
    stayed = came = 0
    for seed in SEEDS:
        timeline = driven(seed, 4)
        world = timeline.state.world
        column = world.road.cell(world.av)[0] + move.offset[0]
        if world.outcome is not Outcome.RUNNING or not 0 <= column < world.road.columns:
            with pytest.raises(QuestionError):
                stays_free(timeline, move, 4)
            continue
        found = stays_free(timeline, move, 4)
        if found.taken_now is not None:
            continue
        state = timeline.state
        column, row = state.world.road.cell(state.world.av)
        across = move.offset[0]
        cells = {(column + across, row - 1)} | ({(column + across, row)} if across else set())
        for tick in range(found.free_for):
            state = transition(state, moves_where(state, Move.STAY, None)).state
            assert not cells & {thing.cell for thing in state.world.things()}, tick
        stayed += found.stays
        came += found.comes is not None
        assert found.share == float(found.stays)  # nothing is left to chance
    assert stayed or came


def test_where_it_will_be_is_where_it_then_is() -> None:
    for seed in SEEDS:
        timeline = driven(seed, 3)
        now = timeline.tick
        found = [place_then(timeline, now + ahead) for ahead in (1, 3, 60)]
        for each in found:
            while timeline.tick < each.tick and timeline.state.world.outcome is Outcome.RUNNING:
                timeline.advance()
            world = timeline.state.world
            over = world.outcome is not Outcome.RUNNING
            assert each.cell == (None if over else world.road.cell(world.av))
            assert each.share == 1.0
        past = place_then(timeline, 2)
        world = timeline.at(2).world
        assert past.past
        assert past.cell == world.road.cell(world.av)


def test_chances_of_places_make_up_all() -> None:
    from sim.explain.foresight import driving
    from sim.explain.futures import Futures

    for seed in range(3):
        state = driving(driven(seed, 3, courtesy=0.5).state)
        shares, _ = Futures(state).places(3)
        assert abs(sum(shares.values()) - 1.0) < 1e-9


def test_the_least_ttc_is_of_something_ahead_in_the_lane() -> None:
    known = 0
    for seed in SEEDS:
        found = least_ttc(driven(seed))
        if found.before is None or found.id is None:
            continue
        known += 1
        world = found.before.world
        thing, own = world.find(found.id), world.road.cell(world.av)
        assert thing is not None
        assert thing.cell[0] == own[0]
        assert thing.cell[1] == own[1] - found.rows
        # one cell a tick at most: the bodies are each shorter than a cell
        assert found.ttc_s is not None
        assert found.ttc_s >= (found.rows - 1) * found.before.config.step_seconds - 1e-9
    assert known


def test_events_and_what_went_wrong_are_in_order_and_end_as_the_drive_did() -> None:
    for seed in SEEDS:
        timeline = driven(seed)
        for story in (drive_story(timeline), what_went_wrong(timeline)):
            assert all(one.tick <= other.tick for one, other in pairwise(story.events))
        outcome = timeline.state.world.outcome
        assert drive_story(timeline).events[-1].what == str(outcome)
        bad = [each.what for each in what_went_wrong(timeline).events]
        assert Happened.SUCCESS not in bad
        track = drive_track(timeline)
        events = drive_story(timeline).events
        lanes = sum(each.ticks for each in events if each.what in (Happened.LEFT, Happened.RIGHT))
        assert lanes == len(track.across)


def test_moves_by_hand_are_no_changes_of_the_road_in_a_story() -> None:
    timeline = Timeline(Config(columns=5, rows=18, vehicles=6, seed=1))
    for tick in range(6):
        if tick in (1, 3):
            timeline.apply(tick, [SetMode(mode=Mode.MANUAL), Drive(move=Move.STAY)])
        if tick == 4:
            timeline.apply(tick, [Remove(kind="vehicle", count=1)])
        timeline.advance()
    changed = [each.tick for each in drive_story(timeline).events if each.what is Happened.CHANGED]
    assert changed == [4]


def test_where_what_was_hit_was_before_the_crash() -> None:
    crashes = 0
    for seed in range(12):
        timeline = driven(seed, sensor="camera")
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        crashes += 1
        found = places_before(timeline, 3)
        assert found.crashed
        assert [state.world.tick for state, _, _ in found.places] == list(
            range(max(0, found.tick - 3), found.tick)
        )
        for state, lanes, rows in found.places:
            thing = state.world.find(found.id)
            column, row = state.world.road.cell(state.world.av)
            assert thing is not None
            assert thing.cell == (column + lanes, row - rows)
    assert crashes or places_before(driven(0, 5), 2, "vehicle-1").places


def test_what_a_faithful_sensor_shows_is_of_this_tick_and_others_have_a_tick_that_was() -> None:
    timeline = driven(0, 5)
    assert {each.tick for each in last_detected(timeline).found} == {5}
    for seed in range(4):
        timeline = driven(seed, 6, sensor="camera")
        found = last_detected(timeline)
        ticks = [each.tick for each in found.found]
        assert all(tick is None or found.first <= tick <= timeline.tick for tick in ticks)
        known = [tick for tick in ticks if tick is not None]
        assert known == sorted(known)
