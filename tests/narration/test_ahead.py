"""Answers about what lies ahead, blame and planners: short, true to their facts, yes or no first."""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

import pytest

from service.actions import WHATS, Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.narration.futures_told import CONTRARY
from service.narration.planners import JUDGED
from service.sessions.facts import Asked
from sim.actions import Drive, SetMode
from sim.config import Config
from sim.explain.planner_character import characters, command
from sim.planner_names import BUILT_IN
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
ABOUTS = ("outlook", "blame", "planners", "sight", "world")
LOOKING_BACK = ("runner_up", "scores", "waited", "differed", "before_crash")
NAMING_MORE = ("safe", "coming", "difference", "detection", "parting", "lane", "stays_free", "place_then")
"""What is asked with something named beside it."""
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def sessions(count: int) -> Iterator[Timeline]:
    """Sessions at any moment, some of them ended, with any planner, and now and then a person who drives."""
    draw = random.Random(3)
    for number in range(count):
        config = Config(
            seed=draw.randrange(10**6),
            columns=6,
            rows=14,
            planner=draw.choice(BUILT_IN),
            potholes=draw.choice([8, 18]),
            vehicles=draw.choice([6, 14]),
            attentive=draw.choice([0.0, 0.9, 1.0]),
            courtesy=draw.choice([0.0, 0.0, 0.5]),
        )
        timeline = Timeline(config)
        if number % 4 == 0:
            timeline.apply(1, [SetMode(mode=Mode.MANUAL), Drive(move=draw.choice(list(Move)))])
        for _ in range(draw.choice([1, 4, 40])):
            if timeline.state.world.outcome is not Outcome.RUNNING:
                break
            timeline.advance()
        yield timeline


def asks() -> list[Ask]:
    """Every question that these answer."""
    found = [Ask(about="outlook", what="safe", move=move) for move in (Move.LEFT, Move.FORWARD, Move.STAY)]
    for about in ABOUTS:
        found += [
            Ask(about=about, what=what)  # type: ignore[arg-type]
            for what in WHATS[about]
            if what not in NAMING_MORE
        ]
    found += [Ask(about="planners", what="difference", planners=("astar", "bfs"))]
    found += [Ask(about="planners", what="parting", planners=("astar", "bfs"))]
    found += [Ask(about="sight", what="detection", kind="pedestrian")]
    found += [Ask(about="outlook", what="lane", lane=2)]
    found += [Ask(about="outlook", what="coming", ticks=ticks) for ticks in (1, 7)]
    found += [Ask(about="outlook", what="stays_free", move=move) for move in (Move.LEFT, Move.FORWARD)]
    found += [Ask(about="outlook", what="place_then", ticks=4)]
    found += [Ask(about="history", what=what) for what in LOOKING_BACK]  # type: ignore[arg-type]
    return [*found, Ask(about="planners", what="here", planners=("astar", "dwa"))]


def answer(timeline: Timeline, code: str = "en", supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))


@pytest.mark.parametrize("code", NARRATORS)
def test_every_answer_is_short_and_in_sentences(code: str) -> None:
    for timeline in sessions(16):
        for ask in asks():
            told = NARRATORS[code].answer(Asked(ask, timeline))
            text = told["text"]
            assert looks_like_sentences(text), text
            assert ids_in(text) == set(), text
            assert told["question"]
            assert len(text.split()) <= MOST_WORDS, text


@pytest.mark.parametrize("code", NARRATORS)
def test_yes_or_no_comes_first_and_turns_round_with_the_question(code: str) -> None:
    yes, no = YES_NO[code]
    found = set()
    for timeline in sessions(24):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        for move in Move:
            ask = {"about": "outlook", "what": "safe", "move": move}
            straight, contrary = (answer(timeline, code, supposes, **ask) for supposes in (None, CONTRARY))
            assert straight["text"].startswith(yes if straight["safe"] else no)
            assert contrary["text"].startswith(no if straight["safe"] else yes)
            found.add(straight["safe"])
    assert found == {True, False}


def test_could_it_have_been_avoided_is_answered_both_ways_round() -> None:
    known = 0
    for timeline in sessions(60):
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        ask = {"about": "blame", "what": "avoidable"}
        straight, contrary = (answer(timeline, "en", supposes, **ask) for supposes in (None, CONTRARY))
        if not straight["avoidable"]["proved"]:
            assert straight["text"].startswith("I cannot say")
            continue
        known += 1
        could = straight["avoidable"]["last"] is not None
        assert straight["text"].startswith("Yes" if could else "No")
        assert contrary["text"].startswith("No" if could else "Yes")
    assert known > 0


def test_whether_a_move_was_good_is_said_first_where_that_is_asked() -> None:
    for timeline in sessions(12):
        if not timeline.tick:
            continue
        ask = {"about": "planners", "what": "own"}
        plain, judged = (answer(timeline, "en", supposes, **ask) for supposes in (None, JUDGED))
        assert judged["text"].startswith("Yes." if judged["good"] else "No.")
        assert not plain["text"].startswith(("Yes", "No."))


def test_a_crash_that_will_not_be_is_denied() -> None:
    for timeline in sessions(20):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        told = answer(timeline, about="outlook", what="crash")
        ahead = told["ahead"]
        text = told["text"].rpartition("You are driving; suppose I take over now. ")[2]
        start = "Yes" if ahead["crashes"] == 1.0 else "No" if ahead["crashes"] == 0.0 else "Perhaps"
        assert text.startswith(start), text


def test_every_planner_of_the_project_was_counted_on_as_many_roads() -> None:
    found = characters()
    assert set(found) == set(BUILT_IN)
    assert "tools.planner_character" in command()
    for each in found.values():
        assert each.roads >= 2_000
        assert each.arrived + each.crashed + each.stuck == each.roads
        assert sum(each.moves.values()) == pytest.approx(1.0, abs=0.001)


def test_the_figures_of_a_planner_are_those_of_the_file() -> None:
    timeline = next(sessions(1))
    for planner in BUILT_IN:
        told = answer(timeline, about="planners", what="character", planner=planner)
        figures = characters()[planner]
        assert f"{figures.roads:,d} roads" in told["text"]
        assert told["character"]["arrived"] == figures.arrived
    missing = answer(timeline, about="planners", what="character", planner="dwa")
    assert missing["character"] is None
    assert "no figures" in missing["text"]


def test_what_each_question_may_ask_is_answered() -> None:
    told = {ask.what for ask in asks() if ask.about in ABOUTS}
    assert told == {what for about in ABOUTS for what in WHATS[about]}


def test_who_steers_is_told_of_the_way_straight_on() -> None:
    timeline = Timeline(Config(seed=3, columns=4, rows=20, potholes=0, vehicles=0))
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    told = answer(timeline, about="outlook", what="crash")["text"]
    assert told.startswith("Straight on, the next 40 m are clear. You are driving; suppose I take over now.")
