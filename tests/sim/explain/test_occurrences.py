"""What is counted over a drive, against a slow walk over a log that is written while it is driven."""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from itertools import pairwise

import pytest

from sim.actions import Reset, Set
from sim.config import Config
from sim.explain.facts import QuestionError
from sim.explain.occurrences import Event, Query, Stretch, occurrences
from sim.explain.query import SAID_OF
from sim.explain.waits import waits
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Kind, Move, Outcome

WEATHERS = ("clear", "rain", "fog")
TIMES = ("day", "night")


@dataclass
class Row:
    """One tick, as it was driven."""

    tick: int
    episode: int
    lane: int
    weather: str
    time_of_day: str
    move: Move
    end: Outcome | None
    hit: Kind | None


def driven_and_logged(seed: int, ticks: int = 50) -> tuple[Timeline, list[Row]]:
    """A drive with changes of the weather and resets, and its log."""
    draw = random.Random(seed)
    timeline = Timeline(
        Config(
            seed=seed,
            columns=5,
            rows=12,
            potholes=10,
            vehicles=9,
            pedestrians=4,
            planner=draw.choice(["rules", "astar", "priority"]),
            attentive=draw.choice([0.0, 0.7]),
        )
    )
    log: list[Row] = []
    for number in range(ticks):
        if draw.random() < 0.1:
            timeline.apply(number, [Set(parameter="weather", value=draw.choice(WEATHERS))])
        if draw.random() < 0.1:
            timeline.apply(number, [Set(parameter="time_of_day", value=draw.choice(TIMES))])
        if draw.random() < 0.05:
            timeline.apply(number, [Reset()])
        before = timeline.state
        made = timeline.advance()
        if before.world.outcome is not Outcome.RUNNING:
            continue
        assert made.decision is not None
        after = made.state.world
        ended = after.outcome is not Outcome.RUNNING
        log.append(
            Row(
                before.world.tick,
                before.world.episode,
                before.world.road.cell(before.world.av)[0] + 1,
                before.config.weather,
                before.config.time_of_day,
                made.decision.move,
                after.outcome if ended else None,
                after.cause.kind if ended and after.cause else None,
            )
        )
    return timeline, log


def walked(timeline: Timeline, log: list[Row], query: Query) -> tuple[list[tuple[int, int]], int]:
    """The slow way: ticks with how long each took, and the ticks driven under the conditions."""
    world, now = timeline.state.world, timeline.tick
    end = now if world.ended is None else world.ended
    driven = end - world.episode_start
    rows = []
    for row in log:
        since = row.tick - world.episode_start
        if query.first is not None:
            inside = query.first <= row.tick and (query.last is None or row.tick <= query.last)
        elif query.stretch is Stretch.SESSION:
            inside = True
        elif query.stretch is Stretch.FIRST_HALF:
            inside = since >= 0 and 2 * since < driven
        elif query.stretch is Stretch.SECOND_HALF:
            inside = since < driven and 2 * since >= driven
        else:
            inside = 0 <= since < driven
        if inside and all(
            wanted in (None, given)
            for wanted, given in (
                (query.lane, row.lane),
                (query.weather, row.weather),
                (query.time_of_day, row.time_of_day),
            )
        ):
            rows.append(row)
    found: list[tuple[int, int]] = []
    before: Row | None = None
    for row in rows:
        if query.event is Event.STOP and row.move is Move.STAY:
            joined = (
                before is not None
                and before.move is Move.STAY
                and (before.tick + 1, before.episode) == (row.tick, row.episode)
            )
            found[-1:] = [(found[-1][0], found[-1][1] + 1)] if joined else [*found[-1:], (row.tick, 1)]
        aside = row.move.offset[0] != 0
        meant = query.move is None or row.move in SAID_OF.get(query.move, (query.move,))
        if meant and (query.event is Event.MOVE or (query.event is Event.LANE_CHANGE and aside)):
            found.append((row.tick, 1))
        before = row
    return found, len(rows)


def queries(draw: random.Random, now: int) -> Query:
    """A query with any conditions."""
    event = draw.choice([Event.STOP, Event.LANE_CHANGE, Event.MOVE, Event.DRIVE])
    first = draw.choice([None, draw.randrange(now + 1)])
    last = None if first is None else draw.choice([None, draw.randrange(first, now + 1)])
    moves: dict[Event, list[Move | None]] = {
        Event.MOVE: list(Move),
        Event.LANE_CHANGE: [None, Move.LEFT, Move.FORWARD_RIGHT],
    }
    return Query(
        event=event,
        move=draw.choice(moves.get(event, [None])),
        first=first,
        last=last,
        stretch=draw.choice(list(Stretch)),
        lane=draw.choice([None, None, draw.randrange(1, 6)]),
        weather=draw.choice([None, None, *WEATHERS]),
        time_of_day=draw.choice([None, None, *TIMES]),
    )


@pytest.mark.parametrize("seed", range(12))
def test_what_is_counted_is_what_the_log_holds(seed: int) -> None:
    timeline, log = driven_and_logged(seed)
    draw = random.Random(seed)
    counted = 0
    for _ in range(60):
        query = queries(draw, timeline.tick)
        found = occurrences(timeline, query)
        there, driven = walked(timeline, log, query)
        assert [(each.tick, each.ticks) for each in found.found] == there, query
        assert found.driven == driven, query
        assert sum(ticks for _, ticks in found.lanes) == driven
        counted += len(there)
    assert counted


@pytest.mark.parametrize("seed", range(12))
def test_ends_are_those_of_the_log(seed: int) -> None:
    timeline, log = driven_and_logged(seed, 80)
    ends = [row for row in log if row.end is not None]
    for query in (
        Query(event=Event.END, stretch=Stretch.SESSION),
        Query(event=Event.END, stretch=Stretch.SESSION, outcome=Outcome.CRASH),
        Query(event=Event.END, stretch=Stretch.SESSION, outcome=Outcome.CRASH, cause=Kind.VEHICLE),
        Query(event=Event.END, outcome=Outcome.SUCCESS, first=20, last=60),
        Query(event=Event.END, stretch=Stretch.SESSION, weather="rain"),
    ):
        found = occurrences(timeline, query)
        assert [each.tick for each in found.found] == [
            row.tick + 1
            for row in ends
            if query.outcome in (None, row.end)
            and query.cause in (None, row.hit)
            and query.weather in (None, row.weather)
            and (query.first is None or query.first <= row.tick + 1 <= (query.last or 0))
        ], query
    crashes = occurrences(timeline, Query(event=Event.END, stretch=Stretch.SESSION, outcome=Outcome.CRASH))
    assert len(crashes.found) == timeline.state.metrics.crashes


def test_what_a_stop_was_for_is_proved_by_running_it_again() -> None:
    kinds = set()
    for seed in range(10):
        timeline, _ = driven_and_logged(seed)
        every = occurrences(timeline, Query(event=Event.STOP, stretch=Stretch.SESSION))
        for stop in every.found:
            if stop.ids:
                gone = replace(stop.before, world=stop.before.world.without(frozenset(stop.ids)))
                own = step(gone).of(None)
                assert own is not None
                assert own.decision.move is not Move.STAY
                kinds |= set(stop.kinds)
        for kind in (Kind.VEHICLE, Kind.POTHOLE):
            asked = Query(event=Event.STOP, stretch=Stretch.SESSION, cause=kind)
            found = [each.tick for each in occurrences(timeline, asked).found]
            assert found == [stop.tick for stop in every.found if kind in stop.kinds]
    assert len(kinds) > 1


def test_stops_of_an_episode_are_its_waits() -> None:
    for seed in range(10):
        timeline, _ = driven_and_logged(seed, 20)
        found = occurrences(timeline, Query(event=Event.STOP))
        assert found.ticks == waits(timeline).total
        assert all(one.tick + one.ticks < other.tick for one, other in pairwise(found.found))


def test_a_step_that_slips_is_no_lane_change_and_no_stop() -> None:
    timeline = Timeline(Config(seed=3, planner="astar", weather="snow", slip_probability=1.0))
    for _ in range(20):
        timeline.advance()
    assert occurrences(timeline, Query(event=Event.LANE_CHANGE)).found == ()
    for stop in occurrences(timeline, Query(event=Event.STOP)).found:
        decided = timeline.decided(stop.before)
        assert decided is not None
        assert decided.move is Move.STAY


def test_ticks_that_are_not_yet_are_refused() -> None:
    timeline, _ = driven_and_logged(1, 5)
    with pytest.raises(QuestionError, match="no_such_tick"):
        occurrences(timeline, Query(event=Event.STOP, first=6))
