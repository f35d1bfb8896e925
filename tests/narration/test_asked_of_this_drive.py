"""Answers about several moves, about which sensor would have helped, and about where planners part."""

from __future__ import annotations

from itertools import count
from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Drive
from sim.config import Config
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome
from tests.support.narration_checks import looks_like_sentences
from tests.support.roads import road, run_on

NARRATOR = Narrator.load()
HOLE = run_on(road("........", "........", "........", "...o....", "...A...."))


def at(run: SimState) -> Timeline:
    timeline = Timeline(run.config)
    timeline.state = run
    return timeline


def driven_on(*moves: Move, supposes: str | None = None) -> str:
    ask = Ask(about="what_if", change=tuple(Drive(move=move) for move in moves))
    return str(NARRATOR.answer(Asked(ask, at(HOLE), supposes))["text"])


def test_of_several_moves_the_first_that_fails_is_told() -> None:
    assert driven_on(Move.STAY, Move.FORWARD, supposes="arrives") == (
        "No. Staying, forward: move 2, forward, hits the pothole right ahead, 1 s from there."
    )
    assert driven_on(Move.STAY, Move.FORWARD, supposes="fails").startswith("Yes. Staying, forward:")
    off = (Move.LEFT, Move.LEFT, Move.LEFT, Move.LEFT, Move.FORWARD)
    assert "move 4, left, leads off the road" in driven_on(*off, supposes="arrives")


def test_where_none_fails_the_end_of_driving_on_is_told() -> None:
    told = driven_on(Move.LEFT, Move.FORWARD, supposes="arrives")
    assert told.startswith("Yes. Left, forward: none of these moves hits anything, and driving on")
    assert "I arrive in" in told
    assert driven_on(Move.LEFT, Move.FORWARD).startswith("Left, forward:")


def failed() -> Timeline:
    for seed in count():
        timeline = Timeline(
            Config(seed=seed, sensor="camera", weather="fog", time_of_day="night", potholes=15)
        )
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH and timeline.tick > 4:
            return timeline
    raise AssertionError


@pytest.mark.parametrize("code", ["en", "de"])
def test_which_sensor_would_have_prevented_it_is_driven_again_with_each(code: str) -> None:
    timeline = failed()
    answer: dict[str, Any] = Narrator.load(code).answer(Asked(Ask(about="sight", what="prevents"), timeline))
    looks_like_sentences(answer["text"])
    assert [each["sensor"] for each in answer["driven_again"]] == ["perfect", "lidar", "radar", "fusion"]
    for each in answer["driven_again"]:
        state = SimState.start(timeline.config.with_parts(sensor=each["sensor"]))
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        assert (each["outcome"], each["ticks"]) == (state.world.outcome, state.world.tick)
    running = Narrator.load(code).answer(Asked(Ask(about="sight", what="prevents"), at(HOLE)))
    assert "driven_again" not in running


@pytest.mark.parametrize("code", ["en", "de"])
def test_two_planners_part_where_their_sessions_first_move_otherwise(code: str) -> None:
    timeline = failed()
    answer: dict[str, Any] = Narrator.load(code).answer(
        Asked(Ask(about="planners", what="parting", planners=("bfs", "astar")), timeline)
    )
    looks_like_sentences(answer["text"])
    one, other = (SimState.start(timeline.config.with_parts(planner=name)) for name in ("bfs", "astar"))
    while True:
        first, second = step(one), step(other)
        assert first.decision is not None
        assert second.decision is not None
        if first.decision.move is not second.decision.move:
            break
        one, other = first.state, second.state
    assert f"tick {one.world.tick}" in answer["text"].lower()
    alone = NARRATOR.answer(Asked(Ask(about="planners", what="parting", planners=("sonar",)), timeline))
    assert alone["text"] == "I can only say that of two different planners that are here."


def test_whether_all_planners_crash_is_said_first() -> None:
    timeline = failed()
    ask = Ask(about="planners", what="compare")
    answer: dict[str, Any] = NARRATOR.answer(Asked(ask, timeline, "all_crash"))
    ends = []
    for name in ("rules", "priority", "astar", "dijkstra", "bfs"):
        state = SimState.start(timeline.config.with_parts(planner=name))
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        ends.append(state.world.outcome)
    word = "Yes." if all(each is Outcome.CRASH for each in ends) else "No."
    assert answer["text"].startswith(word)
