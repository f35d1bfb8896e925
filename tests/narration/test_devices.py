"""Devices beside each other, the belief beside the truth, facts of sensors: each against its own look."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from service.actions import Ask
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.decide import decide, sense
from sim.explain.alarm_moves import alarm_moves
from sim.explain.by_device import by_device, first_by_device
from sim.explain.cell_entered import cell_entered
from sim.explain.misperception import misperception
from sim.explain.placing import placing
from sim.perceive import perceive_truth
from sim.perceive.grid_sensor import looks
from sim.perceive.parameters import CAMERA, LIDAR, RADAR, SUITES
from sim.session.timeline import Timeline
from sim.types import Kind, Outcome
from tests.narration.test_course import NARRATORS, driven
from tests.support.narration_checks import ids_in, looks_like_sentences

FOG = {"sensor": "fusion", "weather": "fog", "time_of_day": "night"}
RAIN = {"sensor": "radar", "weather": "rain", "planner": "priority", "vehicles": 40}
ALARMS = {
    **{"sensor": "camera", "weather": "fog", "planner": "astar", "vehicles": 10},
    **{"false_positive_rate": 0.5, "detection_sensitivity": 0.8},
}
WHATS = (
    *("by_device", "first_device", "cell_entered", "placing", "grid_doubt", "alarm_moves"),
    *("failure", "look_rate", "speeds", "all_round", "own_place", "evenness", "kinds_apart", "standing"),
)


def asked(timeline: Timeline, code: str, supposes: str | None = None, **parts: Any) -> dict[str, Any]:
    told: dict[str, Any] = NARRATORS[code].answer(Asked(Ask(about="sight", **parts), timeline, supposes))
    assert looks_like_sentences(told["text"]), told["text"]
    assert len(told["text"].split()) <= MOST_WORDS, told["text"]
    assert ids_in(told["text"]) == set(), told["text"]
    return told


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("what", WHATS)
def test_each_is_told_in_short_sentences_with_every_sensor(code: str, what: Any) -> None:
    for values in (FOG, RAIN, {}, {"sensor": "camera", "sensor_latency": 1}):
        for ticks in (0, 9, 200):
            asked(driven(ticks, seed=3, **values), code, what=what)


def test_what_a_device_reports_is_what_it_reports_as_the_only_sensor() -> None:
    for seed in range(5):
        state = driven(6, seed=seed, **FOG).state
        found = by_device(state)
        for name, ids in found.seen.items():
            alone = replace(state.config, sensor=name)
            (look,) = looks(state.world, alone, 0, SUITES[name])
            row = state.world.road.cell(state.world.av)[1]
            there = {each.id for each in state.world.things() if each.cell[1] <= row}
            assert ids == {each.id for each in look.reports if each.id in there}
            for each in found.only(name):
                assert found.seen_by(each.id) == (name,)
        assert sum(found.by_count(count) for count in range(4)) == len(found.things)


@pytest.mark.parametrize("code", NARRATORS)
def test_counts_of_devices_and_what_one_alone_sees_are_told(code: str) -> None:
    timeline = driven(6, seed=2, **FOG)
    found = by_device(timeline.state)
    told = asked(timeline, code, what="by_device")["text"]
    for ids in found.seen.values():
        assert f" {len(ids)}" in told
    lone = asked(timeline, code, what="by_device", value="camera")["text"]
    assert f" {len(found.things)} " in lone
    differ = asked(timeline, code, "disagree", what="by_device")["text"]
    assert differ.startswith(("Yes", "Ja") if found.by_count(1) + found.by_count(2) else ("No", "Nein"))
    asked(timeline, code, "only", what="by_device")


def test_the_first_device_is_the_one_of_the_earliest_report() -> None:
    for seed in range(4):
        timeline = driven(8, seed=seed, **FOG)
        found = first_by_device(timeline, Kind.VEHICLE)
        if found is None:
            continue
        for name, at in found.first.items():
            ticks = [
                state.world.tick
                for state in timeline.between(0, timeline.tick + 1)
                if found.thing.id
                in {r.id for r in looks(state.world, state.config, 0, SUITES[name])[0].reports}
                and (there := state.world.find(found.thing.id)) is not None
                and there.cell[1] <= state.world.road.cell(state.world.av)[1]
            ]
            assert (at and at[0]) == (min(ticks) if ticks else None)
        told = asked(timeline, "en", what="first_device", kind="vehicle")
        assert told["thing"] == found.thing.id
        if found.order:
            assert f"at tick {min(at[0] for at in found.first.values() if at)}" in told["text"]


@pytest.mark.parametrize("code", NARRATORS)
def test_a_cell_that_was_entered_is_told_with_the_truth(code: str) -> None:
    hit = 0
    for seed in range(8):
        timeline = driven(60, seed=seed, **RAIN)
        found = cell_entered(timeline)
        assert found.taken is not None
        assert 0.0 <= found.taken <= 1.0
        told = asked(timeline, code, what="cell_entered")
        assert told["at"] == timeline.tick - 1
        hit += found.truth is not None
        if timeline.state.world.outcome is Outcome.SUCCESS:
            assert found.truth is None
        earlier = asked(timeline, code, what="cell_entered", tick=0)
        assert earlier["at"] == 0
    assert hit  # a crash into a mover is one into the cell that was entered
    asked(driven(0), code, what="cell_entered")
    assert "at" not in NARRATORS[code].answer(
        Asked(Ask(about="sight", what="cell_entered", tick=5), driven(5))
    )


def test_places_are_compared_with_the_truth() -> None:
    for seed in range(4):
        timeline = driven(9, seed=seed, **RAIN)
        found = placing(timeline)
        assert 0 < found.exact <= found.reports
        there = {each.id: each.cell for each in timeline.state.world.things()}
        seen = [each for each in sense(timeline.state)[0].things() if each.id in there]
        assert found.believed == len(seen)
        assert {id for id, _ in found.misplaced} == {each.id for each in seen if each.cell != there[each.id]}


def test_moves_for_false_alarms_are_those_that_change_without_them() -> None:
    changed = 0
    for seed in range(10):
        timeline = driven(20, seed=seed, **ALARMS)
        found = alarm_moves(timeline)
        assert len(found.changed) <= found.alarmed <= found.wrong <= found.decisions
        for tick, move, other in found.changed:
            made = timeline.decided(timeline.at(tick))
            assert made is not None
            assert made.move is move is not other
            there = {each.id for each in timeline.at(tick).world.things()}
            assert any(each.id not in there for each in misperception(timeline.at(tick)).phantoms)
        told = asked(timeline, "en", what="alarm_moves")
        assert told["text"].startswith("Yes" if found.changed else "No")
        changed += len(found.changed)
    assert changed


def test_a_cell_is_told_as_taken_where_that_is_asked() -> None:
    timeline = driven(6, seed=2, **FOG)
    free = asked(timeline, "en", what="cell", move="forward")
    taken = asked(timeline, "en", "taken", what="cell", move="forward")
    assert free["taken"] == taken["taken"]
    assert "is empty now" in free["text"]
    assert taken["text"].startswith(("Something is in the cell", "I count"))


def test_facts_of_devices_are_those_of_their_tables() -> None:
    timeline = driven(6, seed=2, **FOG)
    speeds = asked(timeline, "en", what="speeds")
    assert speeds["wrong_heading"] == {each.name: each.wrong_heading for each in (CAMERA, LIDAR, RADAR)}
    assert LIDAR.view_deg == 360.0 > CAMERA.view_deg == RADAR.view_deg == 120.0
    state = timeline.state
    road, here = state.world.road, state.world.av
    column, row = road.cell(here)
    beside = [road.index((at, row)) for at in (column - 1, column + 1) if 0 <= at < road.columns]
    for look in looks(state.world, state.config, 0, SUITES["fusion"]):
        lidar = look.model.spec is LIDAR
        assert all(bool(look.visible >> cell & 1) is lidar for cell in beside)
        assert look.visible >> (row + 1) * road.columns == 0  # no row behind is looked at
        kinds = {each.id: each.kind for each in state.world.things()}
        assert all(each.kind is kinds[each.id] for each in look.reports if each.id is not None)
    assert asked(timeline, "en", what="look_rate")["looks"] == timeline.tick + 1
    truth, seen = perceive_truth(state.world, state.config, 0), sense(state)[0]
    assert truth.ego == seen.ego == here
    assert decide(state) is not None
