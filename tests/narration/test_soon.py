"""Answers about the second best move, risk, the next ticks, waits and crashes, against the timeline."""

from __future__ import annotations

import random
from itertools import pairwise
from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.actions import Drive, SetMode
from sim.config import Config
from sim.plan import Measure
from sim.planner_names import BUILT_IN
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Mode, Move, Outcome

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}


def driven(ticks: int, **parts: object) -> Timeline:
    timeline = Timeline(Config(columns=6, rows=14, potholes=14, vehicles=12).with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def answer(timeline: Timeline, code: str = "en", supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))


@pytest.mark.parametrize("planner", BUILT_IN)
def test_the_second_best_is_the_cheapest_of_the_others_that_lead_on(planner: str) -> None:
    told_of = set()
    for seed in range(12):
        timeline = driven(5, seed=seed, planner=planner)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        decision = timeline.decision(3)
        assert decision is not None
        told = answer(timeline, about="history", what="runner_up", tick=3)
        others = [each for each in decision.options if each.cost is not None and each is not decision.chosen]
        if not others or decision.chosen.cost is None:
            assert (told["second"] is None) == (not others)
            continue
        least = min(each.cost for each in others if each.cost is not None)
        second = decision.option(told["second"])
        assert second.cost == least
        assert not second.reason.blocks
        if decision.measure in (Measure.COST, Measure.TICKS):
            assert told["gap"] == least - decision.chosen.cost >= 0
        else:
            assert "no score" in told["text"]
        told_of.add(told["gap"] is not None)
    assert told_of == {planner not in ("rules", "priority")}


@pytest.mark.parametrize("code", NARRATORS)
def test_every_move_has_its_score_in_short(code: str) -> None:
    for planner in BUILT_IN:
        timeline = driven(4, seed=6, planner=planner)
        told = answer(timeline, code, about="history", what="scores")
        assert len(told["options"]) == len(Move)
        assert len(told["text"].split()) <= MOST_WORDS
        names = [NARRATORS[code]._sayings.move(move, "name") for move in Move]
        assert all(f"{name} (" in told["text"] for name in names)


def test_waits_are_the_ticks_in_which_the_cell_was_kept() -> None:
    seen = set()
    for seed in range(30):
        timeline = driven(9, seed=seed, vehicles=20, attentive=0.5)
        decisions = [timeline.decision(tick) for tick in range(timeline.tick)]
        stays = [decision is not None and decision.move is Move.STAY for decision in decisions]
        latest = len(stays) if all(stays) else stays[::-1].index(False)
        told = answer(timeline, about="history", what="waited")["waited"]
        assert (told["total"], told["now"], told["driven"]) == (sum(stays), latest, len(stays))
        seen.add(latest > 0)
    assert seen == {True, False}


def test_moves_unlike_the_planners_are_those_of_the_same_road_left_to_itself() -> None:
    draw = random.Random(4)
    for seed in range(6):
        moves = [draw.choice(list(Move)) for _ in range(5)]
        timeline = Timeline(Config(seed=seed, columns=6, rows=14, potholes=6, vehicles=6))
        timeline.apply(1, [SetMode(mode=Mode.MANUAL), *(Drive(move=move) for move in moves)])
        for _ in moves:
            timeline.advance()
        told = answer(timeline, about="history", what="differed")
        expected = []
        for tick in range(min(5, timeline.state.world.ended or 5)):
            made, alone = timeline.decision(tick), timeline.at(tick).with_ego(None, mode=Mode.AUTO, queue=())
            other = step(alone).decision
            assert made is not None
            assert other is not None
            if other.move is not made.move:
                expected.append((tick, made.move, other.move))
        assert [(each["tick"], each["made"], each["would"]) for each in told["differing"]] == expected
    alone = answer(driven(4, seed=1), about="history", what="differed")
    assert alone["by_hand"] == 0
    assert "not driven" in alone["text"]


def test_before_a_crash_the_steps_are_those_of_what_was_hit() -> None:
    found = 0
    for seed in range(40):
        timeline = driven(40, seed=seed, planner="priority", attentive=0.0, vehicles=20)
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        told, end = answer(timeline, about="history", what="before_crash"), timeline.tick
        assert told["moment"] == end - 1
        assert f"at tick {end}" in told["text"]
        (name,) = told["shown"]["ids"]
        if not told["theirs"]:
            continue
        found += 1
        at = [timeline.at(tick).world.find(name) for tick in range(end - len(told["theirs"]), end + 1)]
        columns = [thing.cell[0] for thing in at if thing is not None]
        steps = [b - a for a, b in pairwise(columns)]
        offsets = {Move.LEFT: -1, Move.RIGHT: 1, Move.STAY: 0}
        assert [offsets[move] for move in told["theirs"]] == steps
    assert found
    assert "no crash" in answer(driven(1, seed=1), about="history", what="before_crash")["text"]


def test_the_next_ticks_come_as_they_were_told() -> None:
    ends = set()
    for seed in range(30):
        timeline = driven(6, seed=seed, attentive=0.0)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        told = answer(timeline, about="outlook", what="coming", ticks=5)
        made = []
        while len(made) < 5 and timeline.state.world.outcome is Outcome.RUNNING:
            decision = timeline.decided(timeline.state)
            assert decision is not None
            made.append(decision.move)
            timeline.advance()
        assert list(told["moves"]) == made
        assert told["crashes"] == float(timeline.state.world.outcome is Outcome.CRASH)
        ends.add(timeline.state.world.outcome)
    assert {Outcome.RUNNING, Outcome.CRASH} <= ends


def test_the_chance_within_some_ticks_grows_to_that_of_the_drive() -> None:
    grown = 0
    for seed in range(25):
        timeline = driven(3, seed=seed, courtesy=0.5, attentive=0.5, vehicles=20)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        near, far = (
            answer(timeline, about="outlook", what="coming", ticks=ticks)["crashes"] for ticks in (3, 400)
        )
        risk = answer(timeline, about="outlook", what="risk")
        if risk["futures"] is None:
            assert near <= far + 1e-9
            assert far == pytest.approx(risk["crashes"])
            grown += far > near
    assert grown


def test_how_safe_it_is_begins_with_the_chance_of_a_crash() -> None:
    beginnings = set()
    for seed in range(40):
        timeline = driven(3, seed=seed, planner="priority", attentive=0.0, vehicles=20)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        told = answer(timeline, about="outlook", what="risk")
        start = "Safe" if not told["crashes"] else "Not safe"
        assert told["text"].startswith(start)
        beginnings.add(start)
        end = driven(400, seed=seed, planner="priority", attentive=0.0, vehicles=20)
        assert told["crashes"] == float(end.state.world.outcome is Outcome.CRASH)
    assert beginnings == {"Safe", "Not safe"}


def test_standing_for_some_ticks_is_as_many_moves() -> None:
    timeline = driven(2, seed=2)
    one = Ask(about="what_if", change=(Drive(move=Move.STAY),), count=4)
    four = Ask(about="what_if", change=(Drive(move=Move.STAY),) * 4)
    said, spelt = (NARRATORS["en"].answer(Asked(ask, timeline)) for ask in (one, four))
    assert said["text"] == spelt["text"]
    assert "4 times" in said["text"]


def test_seconds_back_are_ticks_back() -> None:
    timeline = driven(8, seed=2)
    by_seconds = answer(timeline, about="history", what="since", seconds=1.5)
    by_ticks = answer(timeline, about="history", what="since", ticks=3)
    assert by_seconds["text"] == by_ticks["text"]


def test_how_often_it_fails_counts_this_session_and_many_roads() -> None:
    timeline = driven(40, seed=3, planner="priority", attentive=0.0, vehicles=20)
    metrics = timeline.state.metrics
    told = answer(timeline, about="planners", what="often")
    assert told["session"]["episodes"] == metrics.episodes == 1
    assert told["session"]["crashes"] == metrics.crashes
    assert f"{told['character']['roads']:,d} roads" in told["text"]
    assert "No drive" in answer(driven(2, seed=3), about="planners", what="often")["text"]


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("en", {"whatever_they_do": "whatever the others do", "likely": "likely", "possible": "possible"}),
        ("de", {"whatever_they_do": "was die anderen", "likely": "wahrscheinlich", "possible": "möglich"}),
    ],
)
def test_how_sure_it_is_that_it_keeps_clear_is_told(code: str, words: dict[str, str]) -> None:
    """Of a move and of now: which of the three it is, unless longer sentences have taken the room."""
    told_of = set()
    for seed in range(24):
        timeline = driven(seed % 8, seed=seed, pedestrians=3, attentive=0.5, planner="priority")
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        asked: list[dict[str, Any]] = [{"what": "risk"}]
        asked += [{"what": "safe", "move": move} for move in (Move.LEFT, Move.FORWARD, Move.STAY)]
        for ask in asked:
            told = answer(timeline, code, about="outlook", **ask)
            sure = told["assurance"]
            if sure is None or sure["level"] == "none":
                continue
            if words[sure["level"]] in told["text"]:
                told_of.add(sure["level"])
            else:
                assert len(told["text"].split()) > 20
    assert {"whatever_they_do", "likely"} <= told_of
