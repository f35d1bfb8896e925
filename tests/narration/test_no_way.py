"""Words for what the rules of crossings, of braking and of repetition bring about."""

from __future__ import annotations

from dataclasses import replace

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.decide import decide
from sim.episode_record import EpisodeRecord
from sim.events import Event, EventType
from sim.explain.summary import summary
from sim.oracle.lower_bounds import can_arrive
from sim.render.hud import _outcome_details
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step
from sim.types import Mode, Move, Outcome
from tests.support.narration_checks import looks_like_sentences
from tests.support.roads import road, run_on

NARRATOR = Narrator.load()
SAYINGS = Sayings.load()
CLOSED = road("........", "########", "........", "........", "...A....")


def said(run: SimState) -> str:
    decision = decide(run)
    assert decision is not None
    return NARRATOR.decision(decision, run)


def driven(run: SimState) -> list[SimState]:
    runs = [run]
    while runs[-1].world.outcome is Outcome.RUNNING:
        runs.append(step(runs[-1]).state)
    return runs


@pytest.mark.parametrize("planner", ["bfs", "astar", "dijkstra"])
@pytest.mark.parametrize(
    ("attentive", "reason"),
    [(0.0, "no way leads to the goal any more"), (1.0, "I know no way to the goal from here")],
)
def test_a_planner_that_knows_no_way_says_no_more_than_it_knows(
    planner: str, attentive: float, reason: str
) -> None:
    run = run_on(CLOSED, planner=planner, attentive=attentive)
    texts = {said(each) for each in driven(run)[:6]}
    assert all(reason in text for text in texts), texts
    for text in texts:
        if text.startswith("Waiting"):
            assert text == f"Waiting: {reason}."
        else:
            assert text.endswith(f": {reason}, and this keeps me clear longest.")


def test_one_who_waits_without_a_way_says_so() -> None:
    run = run_on(road("....", "####", "#A#.", "###."), planner="bfs")
    assert said(run) == "Waiting: no way leads to the goal any more."


def test_what_cannot_be_escaped_is_not_said_to_keep_clear() -> None:
    run = run_on(road("....", "###.", "#A<.", "###."), planner="bfs")
    assert "keeps me clear" not in said(run)
    assert said(run).startswith("Staying, though ")


@pytest.mark.parametrize(
    ("reason", "move", "ids", "text"),
    [
        (
            "mover_enters",
            Move.LEFT,
            ("vehicle-1", "vehicle-2"),
            "the car on my left was about to enter the cell to my left and the car 5 m ahead on my left "
            "was coming out of it towards me",
        ),
        (
            "mover_enters",
            Move.FORWARD_LEFT,
            ("vehicle-2", "vehicle-1"),
            "the car 5 m ahead on my left was about to enter the cell ahead to the left "
            "and the car on my left was about to cut across my way there",
        ),
        (
            "mover_crosses",
            Move.FORWARD_LEFT,
            ("vehicle-1", "vehicle-2"),
            "the car on my left and the car 5 m ahead on my left were both about to cut across my way to "
            "the cell ahead to the left",
        ),
        (
            "mover_crosses",
            Move.FORWARD_LEFT,
            ("vehicle-1",),
            "the car on my left was about to cut across my way to the cell ahead to the left",
        ),
    ],
)
def test_two_movers_are_told_of_for_what_each_does(
    reason: str, move: Move, ids: tuple[str, ...], text: str
) -> None:
    run = run_on(road("....", "....", "..>.", "..>A"))
    nearest = sorted(run.world.movers, reverse=True)
    world = replace(run.world, movers={nearest[0]: "vehicle-1", nearest[1]: "vehicle-2"})
    naming = Naming(SAYINGS, replace(run, world=world))
    assert SAYINGS.in_the_way(reason, move, ids, "then", naming) == text


def test_a_mover_that_cuts_across_is_told_in_the_decision_and_in_the_crash() -> None:
    run = run_on(road("....", "....", ".>..", "..A.", "...."))
    timeline = _timeline(run.with_ego(queue=(Move.FORWARD_LEFT,), mode=Mode.MANUAL))
    held = timeline.advance()
    assert NARRATOR.decision(held.decision, run) == (  # type: ignore[arg-type]
        "Not diagonally left: the car 5 m ahead on my left is about to cut across my way "
        "to the cell ahead to the left."
    )
    assert NARRATOR.event(held.events[0], run).startswith("You asked for diagonally left, but the car")
    crossed = next_world(run.world, (Move.FORWARD_LEFT,), run.config)
    course = EpisodeRecord().after(
        run.world,
        crossed,
        Move.FORWARD_LEFT,
        edits=0,
        certain=True,
        by_person=False,
        faulty=False,
        ended=True,
    )
    assert NARRATOR.event(
        Event(crossed.tick, EventType.CRASHED, 1), replace(run.with_ego(record=course), world=crossed)
    ) == (
        "Crash after 1 tick: a car going to lane 3, row 2 cut across my diagonal; "
        "until the last move a way to the goal was open."
    )
    assert _outcome_details(replace(run, world=crossed)) == "cut off by vehicle-1"


def test_every_end_by_repetition_says_so_and_until_when_a_way_was_open() -> None:
    told = set()
    for seed in range(60):
        config = Config(seed=seed, rows=10, columns=5, potholes=16, vehicles=5, planner="priority")
        runs = driven(SimState.start(config))
        end = runs[-1]
        found = summary(end)
        if end.world.outcome is not Outcome.STUCK:
            assert not found.repeated
            continue
        text = NARRATOR.event(Event(end.world.tick, EventType.STUCK, 1, how="repetition"), end)
        assert found.repeated
        assert text.startswith(f"Stuck: after {found.ticks} ticks the same situation came again, ")
        assert looks_like_sentences(text)
        open_at = [number for number, run in enumerate(runs[:-1]) if can_arrive(run)]
        assert found.open_known
        assert found.open_until == (open_at[-1] if open_at else None)
        told.add(found.open_until is None)
    assert told == {True, False}


def test_the_end_of_a_repetition_is_told_before_it_comes() -> None:
    closed = run_on(road("....", "####", "....", ".A.."))
    ahead = NARRATOR.answer(Asked(Ask(about="next"), _timeline(closed)))["text"]
    assert ahead.endswith("and then I am stuck, for the same situation comes again and would for ever.")
    (*_, end) = driven(closed)
    assert _outcome_details(end).startswith("the same again after ")
    late = run_on(road("....", "####", "....", ".A.."), repetition=False)
    (*_, last) = driven(late)
    assert _outcome_details(last) == "41 ticks, 20.5 s"


def _timeline(run: SimState) -> Timeline:
    timeline = Timeline(run.config)
    timeline.state = run
    return timeline


def test_every_event_has_words() -> None:
    run = run_on(CLOSED)
    for how, ids, text in (
        (None, (), "There is no way through."),
        (None, ("pothole-7",), "There is no way through: remove pothole-7 and there is one."),
        (
            None,
            ("barrier-1", "pothole-7"),
            "There is no way through: remove the barrier 15 m ahead in the third lane to my left and "
            "pothole-7, and there is one.",
        ),
        ("late", (), "There is no way through any more: too little time is left."),
    ):
        assert NARRATOR.event(Event(0, EventType.NO_WAY, 1, ids, how=how), run) == text
    assert NARRATOR.event(Event(0, EventType.WAY_OPEN, 1), run) == "There is a way through again."
