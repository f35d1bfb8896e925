"""The nearest thing that is seen: likelihood, devices and truth against percept, looks and world."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.decide import sense
from sim.perceive.grid_sensor import looks
from sim.perceive.parameters import SUITES
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Kind
from tests.narration.test_course import NARRATORS, driven
from tests.support.narration_checks import looks_like_sentences

SENSORS = ("camera", "lidar", "radar", "fusion")


def asked(timeline: Timeline, kind: str | None = None, supposes: str | None = None, code: str = "en") -> Any:
    ask = Ask(about="sight", what="belief", kind=kind)  # type: ignore[arg-type]
    return NARRATORS[code].answer(Asked(ask, timeline, supposes))


def drives() -> list[Timeline]:
    return [
        driven(ticks, seed=seed, sensor=sensor, weather=weather, potholes=14, vehicles=16, pedestrians=4)
        for sensor in SENSORS
        for weather, ticks in (("fog", 5), ("snow", 9))
        for seed in range(3)
    ]


@pytest.mark.parametrize("code", NARRATORS)
def test_the_nearest_is_told_with_its_likelihood_and_the_truth(code: str) -> None:
    kinds: tuple[str | None, ...] = (None, "pothole", "vehicle")
    there = set()
    for timeline in drives():
        state = timeline.state
        percept, world = sense(state)[0], state.world
        column, row = world.road.cell(world.av)
        for kind in kinds:
            told = asked(timeline, kind, code=code)
            looks_like_sentences(told["text"])
            shown = [
                each
                for each in percept.things()
                if each.kind in PLACEABLE and kind in (None, each.kind.value)
            ]
            if not shown:
                assert told["seen"] == []
                continue
            (seen,) = told["seen"]
            away = [max(abs(each.cell[0] - column), abs(each.cell[1] - row)) for each in shown]
            assert max(abs(seen["cell"][0] - column), abs(seen["cell"][1] - row)) == min(away)
            assert seen["likelihood"] == percept.likelihoods.get(seen["id"], 1.0)
            assert f"{min(99, max(1, round(100 * seen['likelihood'])))} %" in told["text"]
            really = any(
                each.kind.value == seen["kind"] and list(each.cell) == seen["cell"] for each in world.things()
            )
            assert told["is_there"] is really
            there.add(really)
    assert there == {True, False}


def test_devices_that_are_named_reported_it_and_no_later_look_did() -> None:
    known = set()
    for timeline in drives():
        for kind in ("pothole", "vehicle"):
            told = asked(timeline, kind, "device")
            if not told["seen"]:
                continue
            (seen,) = told["seen"]
            now = timeline.tick
            ticks = [now] if told["reported"] is None else range(told["reported"], now + 1)
            for tick in ticks:
                state = timeline.at(tick)
                index = state.world.road.index(tuple(seen["cell"]))
                reporting = [
                    each.model.spec.name
                    for each in looks(state.world, state.config, 0, SUITES[state.config.sensor])
                    if any(
                        report.kind is Kind(kind) and (report.id == seen["id"] or report.cell == index)
                        for report in each.reports
                    )
                ]
                assert reporting == (told["devices"] if tick == told["reported"] else [])
            known.update(told["devices"])
    assert known == {"camera", "lidar", "radar"}


def test_yes_or_no_comes_first_where_the_truth_is_asked() -> None:
    for timeline in drives():
        told = asked(timeline, "pothole", "really")
        if told["seen"]:
            assert told["text"].startswith("Yes." if told["is_there"] else "No.")
        assert "Shadows are not simulated" in asked(timeline, "pothole", "really shadow")["text"]


def test_a_perfect_sensor_is_sure() -> None:
    told = asked(driven(3, seed=1, potholes=9), "pothole")
    assert told["text"].startswith("I am sure, since my sensor is perfect")
    assert told["is_there"]
    assert told["devices"] == []


def test_only_what_is_ahead_is_told_where_that_is_asked() -> None:
    for timeline in drives():
        row = timeline.state.world.road.cell(timeline.state.world.av)[1]
        told = asked(timeline, "vehicle", "ahead")
        assert all(each["cell"][1] < row for each in told["seen"])


def test_whoever_is_ahead_is_a_car_or_a_person() -> None:
    for timeline in drives():
        told = Narrator.load().answer(Asked(Ask(about="scene"), timeline, "anybody"))
        percept, world = sense(timeline.state)[0], timeline.state.world
        row = world.road.cell(world.av)[1]
        anybody = any(each.kind.moves and each.cell[1] < row for each in percept.things())
        assert told["text"].startswith("Yes: I see" if anybody else "No: I see neither")
        assert "pothole" not in told["text"]
