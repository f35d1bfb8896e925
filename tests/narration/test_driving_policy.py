"""Answers about ways of driving, sooner moves, the next thing of a kind and where others will be."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from service.actions import Ask
from service.actions.action import Which
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.narration.supposed_ends import ARRIVES, FAILS
from service.sessions.facts import Asked
from sim.actions import Drive, SetMode
from sim.config import Config
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Kind, Mode, Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
POLICIES = ("straight", "stand", "in_lane", "nonstop")
SOONER = ("sooner_stop", "sooner_change", "longer_wait")


def driven(ticks: int, **parts: object) -> Timeline:
    timeline = Timeline(Config(columns=6, rows=14, potholes=10, vehicles=12).with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def by_hand(moves: list[Move], **parts: object) -> Timeline:
    timeline = driven(0, **parts)
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    for sequence, move in enumerate(moves, 2):
        timeline.apply(sequence, [Drive(move=move)])
        timeline.advance()
    return timeline


def answer(timeline: Timeline, code: str = "en", supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))


@pytest.mark.parametrize("code", NARRATORS)
def test_every_answer_is_short_and_in_sentences(code: str) -> None:
    for seed in range(12):
        timeline = driven(
            (3, 60)[seed % 4 == 3],
            seed=seed,
            attentive=(0.0, 0.6)[seed % 2],
            planner=("priority", "astar")[seed % 2],
        )
        asks: list[dict[str, Any]] = [{"about": "what_if", "what": what} for what in (*POLICIES, *SOONER)]
        asks += [{"about": "next", "kind": kind} for kind in ("pothole", "vehicle", "barrier")]
        car = next(each for each in timeline.state.world.things() if each.kind is Kind.VEHICLE)
        asks.append({"about": "other", "what": "going", "which": Which(id=car.id), "count": 5})
        for ask in asks:
            for supposes in (None, FAILS, ARRIVES):
                told = answer(timeline, code, supposes, **ask)
                assert looks_like_sentences(told["text"]), told["text"]
                assert ids_in(told["text"]) == set()
                assert told["question"]
                assert len(told["text"].split()) <= MOST_WORDS, told["text"]


def test_yes_and_no_are_those_of_the_run() -> None:
    words = set()
    for seed in range(20):
        timeline = driven(2, seed=seed)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        for what in POLICIES:
            crashes, arrives = (
                answer(timeline, "en", supposes, about="what_if", what=what) for supposes in (FAILS, ARRIVES)
            )
            found = crashes["policy"]
            if found["by_hand"] is not None:
                assert not crashes["text"].startswith(("Yes", "No"))
                continue
            assert crashes["text"].startswith("Yes" if found["outcome"] == "crash" else "No")
            assert arrives["text"].startswith("Yes" if found["outcome"] == "success" else "No")
            words.add(found["outcome"])
    assert len(words) > 1


def test_a_sooner_or_longer_stop_is_that_tick_by_its_number() -> None:
    moves = [Move.FORWARD, Move.STAY, Move.STAY, Move.FORWARD]
    timeline = by_hand(moves, potholes=0, vehicles=0)
    for what, tick in (("sooner_stop", 0), ("longer_wait", 3)):
        told = answer(timeline, about="what_if", what=what)
        plain = answer(timeline, about="what_if", move=Move.STAY, tick=tick)
        assert told["text"] == plain["text"]
    still = by_hand(moves[:3], potholes=0, vehicles=0)
    assert (
        answer(still, about="what_if", what="longer_wait")["text"]
        == (answer(still, about="what_if", change=(Drive(move=Move.STAY),))["text"])
    )
    never = answer(by_hand(moves[:1], potholes=0, vehicles=0), about="what_if", what="sooner_stop")
    assert "not stopped" in never["text"]
    first = answer(by_hand(moves[1:2], potholes=0, vehicles=0), about="what_if", what="sooner_stop")
    assert "first move" in first["text"]


def test_a_sooner_lane_change_is_that_tick_by_its_number() -> None:
    timeline = by_hand([Move.FORWARD, Move.FORWARD, Move.LEFT, Move.FORWARD], potholes=0, vehicles=0)
    told = answer(timeline, about="what_if", what="sooner_change")
    assert told["text"] == answer(timeline, about="what_if", move=Move.LEFT, tick=1)["text"]


def test_what_is_done_at_the_next_thing_is_not_done_without_it() -> None:
    found = set()
    for seed in range(20):
        timeline = driven(2, seed=seed)
        state = timeline.state
        if state.world.outcome is not Outcome.RUNNING:
            continue
        told = answer(timeline, about="next", kind="pothole")["next_of_kind"]
        if told["id"] is None:
            continue
        row = state.world.find(told["id"]).cell[1]  # type: ignore[union-attr]
        ahead = [
            each.cell[1]
            for each in state.world.things()
            if each.kind is Kind.POTHOLE and each.cell[1] < state.world.road.cell(state.world.av)[1]
        ]
        assert row == max(ahead)
        real, without = state, replace(state, world=state.world.without(frozenset((told["id"],))))
        moves: list[tuple[Move, Move]] = []
        last = told["after"] if told["differs_after"] is None else told["differs_after"] + 1
        for _ in range(last or 0):
            both = step(real), step(without)
            moves.append((both[0].decision.move, both[1].decision.move))  # type: ignore[union-attr]
            real, without = (each.state for each in both)
        if told["differs_after"] is None:
            assert all(one is other for one, other in moves)
        else:
            assert moves[-1] == (told["move"], told["otherwise"])
            assert all(one is other for one, other in moves[:-1])
        found.add(told["differs_after"] is None)
    assert found == {True, False}


def test_where_another_one_will_be_is_where_it_is_then() -> None:
    compared = 0
    for seed in range(6):
        timeline = driven(1, seed=seed, attentive=0.0, courtesy=0.0)
        for car in list(timeline.state.world.things()):
            if car.kind is not Kind.VEHICLE:
                continue
            told = answer(timeline, about="other", what="going", which=Which(id=car.id), count=4)
            fork = timeline.copy()
            for _ in range(4):
                if fork.state.world.outcome is Outcome.RUNNING:
                    fork.advance()
            then = fork.state.world.find(car.id)
            if then is not None and fork.state.world.outcome is Outcome.RUNNING:
                assert told["cell"] == list(then.cell)
                compared += 1
    assert compared > 10


def test_a_drive_by_hand_is_not_told_to_be_as_the_planner_would_drive_it() -> None:
    timeline = by_hand([Move.STAY, Move.STAY, Move.FORWARD], potholes=0, vehicles=0)
    for what in ("straight", "stand", "in_lane", "nonstop"):
        text = NARRATORS["en"].answer(Asked(Ask(about="what_if", what=what), timeline))["text"]
        assert "As it is" not in text
        assert "so I drive anyway" not in text
    alone = driven(3, potholes=0, vehicles=0)
    text = NARRATORS["en"].answer(Asked(Ask(about="what_if", what="stand"), alone))["text"]
    assert "As it is, I arrive" in text
