"""What is seen, said: yes or no first, few things told, all of them in the data."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from service.actions import Ask
from service.narration.sayings import Sayings
from service.narration.scene import Scenes
from service.sessions.facts import Asked
from sim.explain.scene import describe_percept
from sim.perceive import perceive_truth
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import PLACEABLE, Kind, Outcome
from tests.support.moments import moments
from tests.support.narration_checks import ID, looks_like_sentences
from tests.support.roads import road, run_on

SCENES = Scenes(Sayings.load())


def answer(run: SimState, kind: Any = None) -> dict[str, Any]:
    timeline = Timeline(run.config)
    timeline.state = run
    return SCENES.answer(Asked(Ask(about="scene", kind=kind), timeline))


EMPTY = run_on(road(*["........"] * 11, "...A...."))


@pytest.mark.parametrize(
    ("rows", "kind", "text"),
    [
        (
            ("........", "........", "...A...."),
            None,
            "I see nothing on the road. Straight on, the 10 m to the goal are clear.",
        ),
        (("........", "........", "...A...."), "pothole", "No, I see no potholes."),
        (
            ("........", "...o....", "...A...."),
            "pothole",
            "Yes, one right ahead. Straight on, I would meet it in 0.5 s.",
        ),
        (
            ("..o.....", "........", "........", "...o....", "...A...."),
            "pothole",
            "Yes, two: one right ahead and one 20 m ahead on my left. "
            "Straight on, in 0.5 s, I would meet the one right ahead.",
        ),
        (
            ("........", "o.......", "..oA....", "...oo..."),
            "pothole",
            "Yes, one 5 m ahead in the third lane to my left. Beside or behind me are three more.",
        ),
        (("........", "........", "..>A...."), "vehicle", "No cars ahead, but one beside or behind me."),
        (
            ("........", "........", ".>......", "........", "...A...."),
            None,
            "I see one thing: a car 10 m ahead in the second lane to my left. "
            "Straight on, I would meet a car in 1 s (now 10 m ahead in the second lane to my left).",
        ),
        (
            ("ooooo.oo", "o..o..oo", "........", "...o....", "...A...."),
            None,
            "I see 12 potholes, all ahead of me. Straight on, I would meet a pothole in 0.5 s "
            "(right ahead) "
            "and a pothole in 1.5 s (15 m ahead). Nearest otherwise: a pothole 15 m ahead in "
            "the third lane to my left.",
        ),
        (
            ("oooooooo", "o..o....", "........", "...o....", "...A...."),
            "pothole",
            "Yes, 11: one right ahead, one 15 m ahead, one 15 m ahead in the third lane to my "
            "left and eight more. "
            "Straight on, in 0.5 s, I would meet the one right ahead.",
        ),
        (
            ("........", ".....}..", "........", "...A...."),
            "vehicle",
            "Yes, one stuck in a pothole 10 m ahead in the second lane to my right.",
        ),
    ],
)
def test_a_scene_is_told(rows: tuple[str, ...], kind: str | None, text: str) -> None:
    padded = (*rows, *["........"] * max(0, 4 - len(rows)))
    assert answer(run_on(road(*padded)), kind)["text"] == text


def test_the_data_have_all_that_words_leave_out() -> None:
    for timeline in moments(80, seed=8):
        run = timeline.state
        for kind in (None, *PLACEABLE):
            told = answer(run, kind)
            assert looks_like_sentences(told["text"]), told["text"]
            assert not ID.search(told["text"])
            things = [thing for thing in run.world.things() if kind is None or thing.kind is kind]
            assert {thing["id"] for thing in told["seen"]} == {thing.id for thing in things}
            assert len(told["text"]) < 420
            assert told["text"].startswith(("Yes, ", "No")) == (kind is not None)
            assert told["text"].startswith("Yes") == (
                kind is not None and any(thing["rows"] > 0 for thing in told["seen"])
            )
            met = [thing["ticks_to_collision"] for thing in told["seen"] if thing["id"] in told["threats"]]
            assert met == sorted(met)
            assert None not in met


def test_seconds_and_metres_are_those_of_the_session() -> None:
    run = run_on(road("........", "...o....", "........", "...A...."), cell_m=2.0, step_seconds=0.1)
    told = answer(run, "pothole")
    assert told["text"] == "Yes, one 4 m ahead. Straight on, I would meet it in 0.2 s."
    (thing,) = told["seen"]
    assert (thing["metres"], thing["ticks_to_collision"], thing["seconds_to_collision"]) == (4.0, 2, 0.2)


def test_what_sensors_are_not_sure_of_is_said_with_how_sure_they_are() -> None:
    run = run_on(road("........", "...o....", "...#....", "...A...."))
    scene = describe_percept(
        perceive_truth(run.world, run.config), run.config, {"pothole-1": 0.7, "barrier-1": 0.9999}
    )
    assert SCENES.text(scene, run, Kind.POTHOLE).startswith("Yes, one 10 m ahead (70 % sure).")
    assert "a barrier in 0.5 s (right ahead, 99 % sure)" in SCENES.text(scene, run, None)


def test_after_the_end_what_is_seen_is_told_without_a_way_on() -> None:
    run = run_on(road("........", "o.......", "........", "...A...."))
    while run.world.outcome is Outcome.RUNNING:
        run = step(run).state
    told = answer(run)["text"]
    assert (
        told == "The episode has ended (arrived). I see one thing: a pothole 5 m behind in the "
        "third lane to my left."
    )
    assert "meet" not in answer(replace(run), "pothole")["text"]
