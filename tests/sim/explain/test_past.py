"""What is told of the past against a slow recount: tick by tick from the log, gaps by sampling."""

from __future__ import annotations

import random
from itertools import pairwise
from math import hypot

import pytest

from sim.actions import Add, Drive, Reset, SetMode
from sim.config import Config
from sim.explain.closest_call import closest_call, least_gap, ticks_to_contact
from sim.explain.past import latest_crash, past
from sim.rules.collision_geometry import SIZES, Path, first_contact
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Mode, Move, Outcome, kind_of

SAMPLES = 400


def session(seed: int) -> tuple[Timeline, list[SimState]]:
    """A session with changes on the way, and its states, each run anew from the one before."""
    draw = random.Random(seed)
    timeline = Timeline(
        Config(seed=seed, planner=draw.choice(("priority", "rules")), pedestrians=3, reset_delay_s=1.0)
    )
    states = []
    for tick in range(90):
        if draw.random() < 0.05:
            timeline.apply(tick + 1, [draw.choice((Add(kind="vehicle", count=1), Reset()))])
        states.append(timeline.state)
        timeline.advance()
    return timeline, [*states, timeline.state]


def sampled_gap(one: Path, other: Path) -> float:
    """The least gap of two bodies at many moments of a tick."""
    a, b = SIZES[one.kind], SIZES[other.kind]
    found = []
    for step in range(SAMPLES + 1):
        share = step / SAMPLES
        apart = [
            other.start[axis]
            - one.start[axis]
            + share * (other.end[axis] - other.start[axis] - one.end[axis] + one.start[axis])
            for axis in (0, 1)
        ]
        reach = [float(a.across + b.across) / 2, float(a.along + b.along) / 2]
        found.append(hypot(*(max(0.0, abs(apart[axis]) - reach[axis]) for axis in (0, 1))))
    return min(found)


def paths() -> list[tuple[Path, Path]]:
    draw = random.Random(3)
    found = []
    for _ in range(300):
        start = draw.randint(-3, 3), draw.randint(-3, 3)
        one = Path(Kind.AV, (0, 0), (draw.randint(-1, 1), draw.randint(-1, 0)))
        kind = draw.choice((Kind.VEHICLE, Kind.PEDESTRIAN, Kind.AV))
        found.append((one, Path(kind, start, (start[0] + draw.randint(-1, 1), start[1]))))
    return found


def test_gaps_are_those_of_many_samples() -> None:
    for one, other in paths():
        exact, sampled = least_gap(one, other), sampled_gap(one, other)
        assert exact <= sampled + 1e-9
        assert sampled - exact < 2 / SAMPLES


def test_contact_within_the_tick_is_that_of_the_judge() -> None:
    for one, other in paths():
        contact, ticks = first_contact(one, other), ticks_to_contact(one, other)
        if contact is not None:
            assert ticks == pytest.approx(float(contact))
            assert least_gap(one, other) == pytest.approx(0, abs=1e-9)
        else:
            assert ticks is None or ticks >= 1


@pytest.mark.parametrize("seed", range(4))
def test_the_closest_call_is_the_least_of_a_recount(seed: int) -> None:
    _, states = session(seed)
    gaps = []
    for before, after in pairwise(states):
        old, new = before.world, after.world
        if old.ended is not None or old.episode_start != new.episode_start:
            continue
        own = Path(Kind.AV, old.road.cell(old.av), new.road.cell(new.av))
        places = {id: new.road.cell(index) for index, id in new.movers.items()}
        for index, id in old.movers.items():
            start = old.road.cell(index)
            if id in places:
                gap = sampled_gap(own, Path(kind_of(id), start, places[id])) * before.config.cell_m
                if gap > 0:
                    gaps.append((gap, old.tick))
    call = closest_call(states)
    assert call is not None
    least = min(gaps)[0]
    assert call.gap_m == pytest.approx(least, abs=0.05)
    assert min(gap for gap, tick in gaps if tick == call.tick) == pytest.approx(call.gap_m, abs=0.05)


@pytest.mark.parametrize("seed", range(4))
def test_counts_are_those_of_a_recount(seed: int) -> None:
    timeline, states = session(seed)
    draw = random.Random(seed)
    for _ in range(5):
        first, last = sorted(draw.sample(range(91), 2))
        found = past(timeline, first, last)
        moved = [state for state in states[first:last] if state.world.outcome is Outcome.RUNNING]
        assert found.counted.steps == len(moved)
        assert found.ticks == last - first
        ends = [s.world.tick for s in states[first + 1 : last + 1] if s.world.ended == s.world.tick]
        assert [tick for tick, _ in found.ends] == ends
        said = {
            entry.sequence
            for entry in timeline.entries
            if first <= entry.tick <= last and not isinstance(entry.action, SetMode)
        }
        assert found.changes == len(said)


def test_moves_by_hand_change_neither_the_road_nor_a_setting() -> None:
    timeline = Timeline(Config(rows=12, vehicles=0, potholes=0))
    for tick in range(4):
        timeline.apply(tick, [SetMode(mode=Mode.MANUAL), Drive(move=Move.STAY)])
        timeline.advance()
    timeline.apply(9, [Add(kind="pothole", count=1)])
    assert past(timeline, 0, 4).changes == 1


@pytest.mark.parametrize("seed", range(6))
def test_the_latest_crash_is_found(seed: int) -> None:
    timeline, states = session(seed)
    crashes = [s.world.tick for s in states if s.world.ended == s.world.tick and s.metrics.crashes]
    crashes = [tick for tick in crashes if states[tick].world.outcome is Outcome.CRASH]
    assert latest_crash(timeline) == (crashes[-1] if crashes else None)


def test_ticks_that_never_were_are_an_error() -> None:
    timeline, _ = session(0)
    with pytest.raises(IndexError):
        past(timeline, 5, 500)
    assert timeline.apply(999, [SetMode(mode=Mode.MANUAL)])
