"""What sensors got wrong is said with hindsight, and only there."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Add, Where
from sim.config import Config
from sim.explain.attribution import attribute
from sim.session.timeline import Timeline
from sim.types import Kind, Move, Outcome, kind_of
from tests.support.narration_checks import looks_like_sentences
from tests.support.rides import SENSORS, rides
from tests.support.sensors import NAMES, Missing, Phantom, registered

NARRATOR = Narrator.load()
AHEAD = (4, 3)
"""The cell before that in which the vehicle begins."""


@pytest.fixture(autouse=True, scope="module")
def sensors() -> Iterator[None]:
    """All of them can be named in a configuration."""
    with registered(*SENSORS, Phantom(AHEAD, name="ghost"), Missing(frozenset({"pothole-1"}), "blind")):
        yield


def beginning(sensor: str, *, pothole: bool = False, planner: str = "rules") -> Timeline:
    """A timeline on a road with nothing, or with nothing but a pothole right ahead."""
    timeline = Timeline(Config(columns=8, rows=5, vehicles=0, potholes=0, planner=planner, sensor=sensor))
    if pothole:
        timeline.apply(1, [Add(kind="pothole", count=1, where=Where(cell=AHEAD))])
    return timeline


def driven(sensor: str, *, pothole: bool = False, planner: str = "rules") -> Timeline:
    """The same with one decision taken."""
    timeline = beginning(sensor, pothole=pothole, planner=planner)
    timeline.advance()
    return timeline


def answer(timeline: Timeline, **ask: object) -> dict[str, object]:
    return NARRATOR.answer(Asked(Ask(**ask), timeline))  # type: ignore[arg-type]


def test_what_was_imagined_is_said_not_to_have_been_there() -> None:
    timeline = driven("ghost")
    told = answer(timeline, about="why")
    assert told["text"] == (
        "Just now I moved diagonally left rather than going forward, "
        "because I saw a pothole right ahead, which was not there. Without seeing it I would go forward."
    )
    (cause,) = told["causes"]  # type: ignore[misc]
    assert (cause["id"], cause["real"]) == ("pothole-p1", False)
    assert told["verified"] == {"necessary": True, "sufficient": True, "minimal": True}
    assert told["counterfactual"] == {
        "at_tick": 0,
        "change": [],
        "decision": "forward",
        "undetected": ("pothole-p1",),
    }
    told = answer(timeline, about="why_not", move=Move.FORWARD)
    assert told["text"] == (
        "Just now I did not go forward, because I saw a pothole right ahead, which was not there. "
        "That way I arrive after 2 s, just as it is. "
        "Without seeing the pothole right ahead I would go forward."
    )


def test_a_planner_that_weighs_costs_says_so_too() -> None:
    told = answer(driven("ghost", planner="dijkstra"), about="why")
    assert "I saw a pothole right ahead, which was not there." in str(told["text"])


def test_a_crash_with_what_was_not_detected_is_told_so() -> None:
    timeline = driven("blind", pothole=True)
    assert timeline.state.world.outcome is Outcome.CRASH
    told = answer(timeline, about="why")
    assert str(told["text"]).startswith(
        "I crashed at tick 1: I went forward, into the pothole right ahead. "
        "It was there, but I did not detect it. "
    )
    assert told["evidence"]["crash"]["missed"] == ("pothole-1",)  # type: ignore[index]
    assert told["evidence"]["crash"]["ids"] == ("pothole-1",)  # type: ignore[index]


def test_what_is_seen_is_told_with_what_is_not_there_and_what_is_missed() -> None:
    told = answer(beginning("ghost"), about="scene")
    assert str(told["text"]).endswith("In truth the pothole right ahead is not there.")
    assert told["phantoms"] == ["pothole-p1"]
    assert "missed" not in told
    told = answer(beginning("blind", pothole=True), about="scene")
    assert told["text"] == (
        "I see nothing on the road. Straight on, the 20 m to the goal are clear. "
        "I do not detect the pothole right ahead."
    )
    assert told["missed"] == ["pothole-1"]


def test_nothing_is_called_clear_that_is_farther_than_the_sensor_reaches() -> None:
    """Fog and night leave the camera 33 m, which is six cells."""
    empty = Config(vehicles=0, potholes=0, sensor="camera", weather="fog", time_of_day="night")
    told = answer(Timeline(empty), about="scene")
    assert (
        told["text"] == "I see nothing on the road. Straight on, the next 30 m look clear; I see no farther."
    )
    told = answer(Timeline(empty.with_parts(weather="clear", time_of_day="day")), about="scene")
    assert told["text"] == "I see nothing on the road. Straight on, the next 40 m are clear."
    told = answer(Timeline(empty.with_parts(sensor_range_m=5.0, cell_m=10.0)), about="scene")
    assert told["text"] == "I see nothing on the road."


def test_of_what_is_missed_the_nearest_is_told_first() -> None:
    config = Config(seed=4, vehicles=0, potholes=12, sensor="camera", weather="fog", time_of_day="night")
    timeline = Timeline(config)
    told = answer(timeline, about="scene")
    missed = str(told["text"]).partition("I do not detect ")[2]
    metres = [int(each) for each in re.findall(r"(\d+) m ahead", missed)]
    assert 1 <= len(metres) <= 3
    assert metres == sorted(metres)
    world = timeline.state.world
    rows = [world.road.cell(world.av)[1] - thing.cell[1] for thing in world.things()]
    assert metres[0] == 5 * min(rows)


@pytest.mark.parametrize("sensor", NAMES)
def test_whatever_the_sensor_answers_are_sentences(sensor: str) -> None:
    """And each cause that was not there is told, or is one of more than are told."""
    imagined = 0
    for timeline in rides(sensor, 25, seed=7):
        asked = [{"about": "why"}, *({"about": "why_not", "move": move} for move in Move)]
        for ask in [*asked, *({"about": about} for about in ("scene", "next", "confidence"))]:
            told = answer(timeline, **ask)
            text = str(told["text"])
            assert looks_like_sentences(text), text
            for cause in told.get("causes", ()):  # type: ignore[attr-defined]
                if cause.get("real", True) is False:
                    imagined += 1
                    assert f"I saw {_a(cause['id'])} " in text
                    assert "which was not there" in text
        for tick in range(timeline.tick):
            decision = timeline.decision(tick)
            if decision is not None:
                assert looks_like_sentences(NARRATOR.decision(decision, timeline.at(tick)))
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            assert looks_like_sentences(str(answer(timeline, about="why")["text"]))
    assert imagined or sensor in ("missing", "dropping")


def _a(name: str) -> str:
    return {Kind.VEHICLE: "a car"}.get(kind_of(name), f"a {kind_of(name)}")


@pytest.mark.parametrize("about", ["why", "why_not", "scene"])
def test_with_perfect_sight_nothing_is_said_of_it(about: str) -> None:
    for timeline in rides("perfect", 25, seed=8):
        ask = {"about": about, **({"move": Move.STAY} if about == "why_not" else {})}
        told = repr(answer(timeline, **ask))
        assert not any(
            word in told for word in ("'real': False", "undetected", "missed", "phantom", "was not there")
        )


def test_of_a_crash_that_is_the_sensors_fault_it_is_said_what_would_have_avoided_it() -> None:
    told = 0
    for seed in range(40):
        timeline = Timeline(Config(seed=seed, sensor="radar", potholes=12))
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        for language, words in (("en", "would have"), ("de", "Noch einmal vom Start an gefahren")):
            answer = Narrator.load(language).answer(Asked(Ask(about="blame", what="fault"), timeline))
            if answer["fault"] == "sensor":
                assert words in answer["text"]
                found = attribute(timeline)
                assert found is not None
                assert answer["avoided_by"] == [[each.setting, each.value] for each in found.avoided_by]
                told += 1
        if told >= 6:
            return
    raise AssertionError("too few crashes")
