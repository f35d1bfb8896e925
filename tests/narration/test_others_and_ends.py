"""What is told of all others, of what was hit and of how a drive ended says its facts, in both languages."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def answer(timeline: Timeline, code: str, **ask: Any) -> dict[str, Any]:
    told = NARRATORS[code].answer(Asked(Ask(**ask), timeline))
    assert looks_like_sentences(told["text"]), told["text"]
    assert len(told["text"].split()) <= MOST_WORDS, told["text"]
    assert ids_in(told["text"]) == set(), told["text"]
    return told


def driven(seed: int, ticks: int) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=14, pedestrians=3, potholes=3, barriers=4, seed=seed)
    timeline = Timeline(config.with_parts(sensor="radar", weather="rain"))
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < ticks:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("code", NARRATORS)
def test_others_are_counted_and_a_crossing_is_yes_or_no_first(code: str) -> None:
    yes, no = YES_NO[code]
    for seed in range(6):
        timeline = driven(seed, 3)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        told = answer(timeline, code, about="outlook", what="others", kind="vehicle")
        assert f"{len(told['others'])} " in told["text"]
        crossed = answer(timeline, code, about="outlook", what="crossing")
        assert crossed["text"].startswith(yes if crossed["coming"] else no)
        answer(timeline, code, about="outlook", what="crossing", kind="pothole")
        answer(timeline, code, about="outlook", what="others")
        answer(timeline, code, about="world", what="heed")


@pytest.mark.parametrize("code", NARRATORS)
def test_an_end_is_told_with_its_tick_lane_and_rows(code: str) -> None:
    ended = set()
    for seed in range(16):
        timeline = driven(seed, 60)
        world = timeline.state.world
        text = answer(timeline, code, about="history", what="end")["text"]
        assert f"Tick {world.ended}".casefold() in text.casefold()
        column, row = world.road.cell(world.av)
        assert f" {column + 1}" in text
        assert str(row) in text
        if world.outcome is Outcome.CRASH:
            came = answer(timeline, code, about="blame", what="the_other")
            could = answer(timeline, code, about="blame", what="other_could")
            assert came["hit"] == could["hit"]
            for each in came["hit"]:
                assert (each["speed_kmh"] == 0) == (each["clear_if_stayed"] is None)
        ended.add(world.outcome)
    assert Outcome.CRASH in ended
    assert len(ended) > 1


@pytest.mark.parametrize("code", NARRATORS)
def test_moves_are_listed_in_their_order_and_those_for_a_kind_are_counted(code: str) -> None:
    yes, no = YES_NO[code]
    for seed in range(6):
        timeline = driven(seed, 12)
        listed = answer(timeline, code, about="history", what="listed")
        assert len(listed["moves"]) == timeline.tick
        assert f" {timeline.tick} " in listed["text"]
        part = answer(timeline, code, about="history", what="listed", ticks=1)
        assert len(part["moves"]) == 1
        found = answer(timeline, code, about="history", what="in_the_way", want="whether", kind="vehicle")
        moves = {each["tick"]: each["move"] for each in found["moves"]}
        assert found["text"].startswith(yes if moves else no)
        assert "forward" not in moves.values()
        assert all(any(id.startswith("vehicle") for id in each["ids"]) for each in found["moves"])
        answer(timeline, code, about="history", what="advanced")


def test_while_it_drives_the_end_of_the_drive_before_is_told() -> None:
    timeline = driven(3, 60)
    ended = timeline.state.world.ended
    while timeline.state.world.episode == 1 or timeline.state.world.episode_tick < 1:
        timeline.advance()
    assert f"at tick {ended}" in answer(timeline, "en", about="history", what="end")["text"]


def test_of_a_drive_that_goes_on_the_tick_and_the_place_are_told() -> None:
    text = answer(driven(0, 2), "en", about="history", what="end")["text"]
    assert text.startswith("This drive has not ended: now is tick 2")
