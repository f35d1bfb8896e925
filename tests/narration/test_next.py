"""What comes next, and how it is going, in words."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.metrics import Metrics
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences
from tests.support.roads import road, run_on
from tools.check_what_if import sessions

NARRATOR = Narrator.load()
HOLE = run_on(road(*["........"] * 7, "...o....", "........", "...A...."))


def told(run: SimState, about: Any, metric: Any = None) -> str:
    timeline = Timeline(run.config)
    timeline.state = run
    return str(NARRATOR.answer(Asked(Ask(about=about, metric=metric), timeline))["text"])


def test_the_way_from_here() -> None:
    way = "go forward, then move left round the pothole 10 m ahead, then go forward 15 m."
    assert told(HOLE, "next") == f"Next I {way}"
    by_hand = HOLE.with_ego(mode=Mode.MANUAL)
    assert told(by_hand, "next") == (
        f"You are driving; without a word from you I stay. In your place I would {way}"
    )
    queued = by_hand.with_ego(queue=(Move.RIGHT,))
    assert told(queued, "next") == "Next I move right, as you asked, then wait for your word."
    short = run_on(road("........", "........", "........", "...A...."))
    assert told(short, "next") == "Next I go forward 15 m, and then I am there."


def test_help_advises_who_drives() -> None:
    assert told(HOLE, "help").startswith("You can say, for instance: ")
    by_hand = HOLE.with_ego(mode=Mode.MANUAL)
    assert told(by_hand, "help").startswith("You are driving: in your place I would go forward. Say a move")
    beside = run_on(road("........", "........", "...o....", "...A....")).with_ego(mode=Mode.MANUAL)
    assert "I would move left round the pothole right ahead. Say" in told(beside, "help")
    queued = by_hand.with_ego(queue=(Move.RIGHT,))
    assert told(queued, "help") == told(HOLE, "help")


def test_the_way_from_anywhere_reads_like_a_sentence() -> None:
    for number, (_, timeline) in enumerate(sessions(5)):
        if number == 200:
            break
        for about in ("next", "metrics"):
            answer = NARRATOR.answer(Asked(Ask(about=about), timeline))
            text = answer.pop("text")
            assert looks_like_sentences(f"So: {text}"), text
            assert ids_in(text) <= ids_in(answer), text


COUNTED = Metrics(successes=8, crashes=3, stuck=1, forward=300, lateral=90, stay=10, distance_m=1950.0)


@pytest.mark.parametrize(
    ("metric", "words"),
    [
        ("crashes", "3 crashes in 12 episodes."),
        ("successes", "8 arrivals in 12 episodes."),
        (
            "success_rate",
            "I arrived in 8 of 12 episodes, 67 %; with 95 % confidence the true rate lies between "
            "39 and 87 %.",
        ),
        ("steps", "I have driven for 400 ticks (200 s)."),
        ("moves", "400 moves, 75 % forward, 22 % sideways and 2 % standing still."),
        ("distance", "I have driven 1.9 km."),
        (
            None,
            "8 arrivals, 3 crashes and stuck once in 12 episodes. I arrived in 67 % of them; with 95 % "
            "confidence the true rate lies between 39 and 87 %. 400 moves, 75 % forward, 22 % sideways "
            "and 2 % standing still. I have driven 1.9 km.",
        ),
    ],
)
def test_how_it_is_going(metric: str | None, words: str) -> None:
    assert told(HOLE.with_ego(metrics=COUNTED), "metrics", metric) == words


def test_with_little_to_go_by() -> None:
    assert told(HOLE, "metrics") == "Nothing to count yet: I have not moved so far."
    one = HOLE.with_ego(metrics=Metrics(forward=1, distance_m=5.0))
    assert told(one, "metrics", "crashes") == "No episode has ended yet, so there is nothing to count."
    few = HOLE.with_ego(metrics=Metrics(successes=2, stuck=1, forward=40, distance_m=200.0))
    assert told(few, "metrics", "success_rate") == (
        "I arrived in 2 of 3 episodes; that is too few to speak of a rate."
    )


ENDS = (
    "Reached the goal in ",
    "Crash with a ",
    "Crash after ",
    "Stuck: not arrived after ",
    "Stuck: after ",
)


def test_every_end_is_summed_up() -> None:
    said = set()
    for seed in range(40):
        config = Config(seed=seed, rows=10, potholes=(None, 14, 25)[seed % 3], planner="priority")
        run = SimState.start(config.with_parts(attentive=float(seed % 2), repetition=seed % 4 < 2))
        while run.world.outcome is Outcome.RUNNING:
            moved = step(run)
            run = moved.state
        text = NARRATOR.event(moved.events[-1], run)
        assert looks_like_sentences(text), text
        assert text.startswith(ENDS)
        how = moved.events[-1].how
        assert text.startswith("Stuck: after ") is (how == "repetition")
        said.add((run.world.outcome, how))
    assert {Outcome.SUCCESS, Outcome.CRASH} <= {outcome for outcome, _ in said}
    assert {(Outcome.STUCK, "limit"), (Outcome.STUCK, "repetition")} <= said


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (["...."] * 3 + ["..A."], "Reached the goal in 3 ticks; straight all the way; as quick as can be."),
        (
            ["....", "..o.", "..o.", "..A."],
            "Reached the goal in 4 ticks; one detour, for a pothole; 1 tick above the best possible.",
        ),
    ],
)
def test_an_arrival_read_aloud(rows: list[str], words: str) -> None:
    run = run_on(road(*rows))
    while run.world.outcome is Outcome.RUNNING:
        moved = step(run)
        run = moved.state
    assert NARRATOR.event(moved.events[-1], run) == words
