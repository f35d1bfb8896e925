"""Since when things were detected, against a plain look at every tick, and against what the road says."""

from __future__ import annotations

from typing import Any

import pytest

from sim.config import Config
from sim.decide import sense
from sim.explain.closest_call import closest_call, closest_calls
from sim.explain.occurrences import Event, Query, occurrences
from sim.explain.question_error import QuestionError
from sim.explain.sightings import noticed, sightings
from sim.session.timeline import Timeline
from sim.types import Kind, Move

SENSORS = (("camera", "fog", "night"), ("fusion", "rain", "day"), ("perfect", "clear", "day"))


def driven(seed: int, sensor: str = "perfect", weather: str = "clear", light: str = "day") -> Timeline:
    conditions: dict[str, Any] = {"weather": weather, "time_of_day": light}
    config = Config(
        columns=6,
        rows=18,
        potholes=10,
        vehicles=8,
        pedestrians=2,
        barriers=3,
        seed=seed,
        sensor=sensor,
        **conditions,
    )
    timeline = Timeline(config)
    for _ in range(16):
        timeline.advance()
        if timeline.state.world.ended is not None:
            break
    return timeline


def detected_at(timeline: Timeline, tick: int) -> set[str]:
    """The ids that are shown where they are, by cells and kinds alone."""
    state = timeline.at(tick)
    shown = {
        (kind, road_index): name
        for road_index, name in {**sense(state)[0].hazards, **sense(state)[0].movers}.items()
        for kind in [name.rpartition("-")[0]]
    }
    return {
        thing.id
        for thing in state.world.things()
        if shown.get((thing.kind.value, state.world.road.index(thing.cell))) == thing.id
    }


@pytest.mark.parametrize(("sensor", "weather", "light"), SENSORS)
def test_the_first_tick_is_the_first_at_which_it_is_shown_where_it_is(
    sensor: str, weather: str, light: str
) -> None:
    never = later = 0
    for seed in range(6):
        timeline = driven(seed, sensor, weather, light)
        found = sightings(timeline)
        seen = {tick: detected_at(timeline, tick) for tick in range(found.first, found.last + 1)}
        for each in found.things:
            ticks = [tick for tick, ids in seen.items() if each.id in ids]
            assert each.first == (ticks[0] if ticks else None), each
            for begun, last in each.lost:
                assert all(each.id not in seen[tick] for tick in range(begun, last + 1))
                assert each.first is not None
                assert begun > each.first
            never += not ticks
            later += bool(ticks) and ticks[0] > found.first
        order = [each.first for each in found.things if each.first is not None]
        assert order == sorted(order)
    assert (never + later > 0) is (sensor != "perfect")


def test_what_is_passed_was_ahead_and_is_behind() -> None:
    passed = 0
    for seed in range(6):
        timeline = driven(seed)
        for each in sightings(timeline).things:
            if each.passed is None:
                continue
            world = timeline.at(each.passed).world
            thing = world.find(each.id)
            assert thing is not None
            assert thing.cell[1] > world.road.cell(world.av)[1]
            passed += 1
    assert passed


def test_what_is_new_at_a_tick_is_the_difference_to_the_one_before() -> None:
    changed = 0
    for seed in range(6):
        timeline = driven(seed, *SENSORS[0])
        for tick in range(1, timeline.tick + 1):
            found = noticed(timeline, tick)
            now, before = detected_at(timeline, tick), detected_at(timeline, tick - 1)
            there = {thing.id for thing in timeline.at(tick).world.things()}
            assert set(found.new) == now - before
            assert set(found.gone) == (before - now) & there
            changed += bool(found.new or found.gone)
    assert changed


def test_ticks_that_cannot_be_compared_are_named() -> None:
    timeline = driven(1)
    with pytest.raises(QuestionError) as first:
        noticed(timeline, 0)
    assert first.value.code == "nothing_before"
    with pytest.raises(QuestionError) as later:
        noticed(timeline, 99)
    assert later.value.code == "no_such_tick"


def test_of_each_mover_the_closest_call_and_the_closest_of_all_first() -> None:
    several = 0
    for seed in range(8):
        timeline = driven(seed)
        states = list(timeline.between(0, timeline.tick + 1))
        calls = closest_calls(states)
        assert closest_call(states) == (calls[0] if calls else None)
        assert [call.gap_m for call in calls] == sorted(call.gap_m for call in calls)
        assert len({call.id for call in calls}) == len(calls)
        of_people = closest_calls(states, Kind.PEDESTRIAN)
        assert of_people == tuple(call for call in calls if call.id.startswith("pedestrian"))
        several += len(calls) > 1
    assert several


def test_stretches_without_a_stop_and_stops_make_up_the_drive() -> None:
    for seed in range(8):
        timeline = driven(seed)
        stops = occurrences(timeline, Query(event=Event.STOP))
        going = occurrences(timeline, Query(event=Event.GO))
        assert stops.ticks + going.ticks == going.driven
        moves = [timeline.decision(tick).move for tick in range(going.driven)]  # type: ignore[union-attr]
        longest = max((each.ticks for each in going.found), default=0)
        runs = "".join("s" if move is Move.STAY else "g" for move in moves).split("s")
        assert longest == max(map(len, runs))
