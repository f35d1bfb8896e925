"""Answers that judge a move or count over a drive, against what is there."""

from __future__ import annotations

import re
from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.narration.futures_told import CONTRARY
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.blame import foreseen
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def driven(ticks: int, **parts: object) -> Timeline:
    timeline = Timeline(
        Config(columns=6, rows=14, potholes=14, vehicles=12, pedestrians=4).with_parts(**parts)
    )
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def answer(timeline: Timeline, code: str = "en", supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))


@pytest.mark.parametrize("code", NARRATORS)
def test_whether_a_move_was_needed_is_told_first_and_turns_round(code: str) -> None:
    yes, no = YES_NO[code]
    needs = set()
    for seed in range(8):
        for planner in ("astar", "rules"):
            timeline = driven(30, seed=seed, planner=planner, attentive=0.0 if seed % 2 else 0.5)
            for tick in range(0, timeline.tick, 2):
                ask = {"about": "history", "what": "needed", "tick": tick}
                straight = answer(timeline, code, **ask)
                text = straight["text"]
                assert looks_like_sentences(text), text
                assert ids_in(text) == set(), text
                assert len(text.split()) <= MOST_WORDS, text
                needs.add(str(straight["need"]))
                if straight["need"] in ("chance", "later"):
                    assert not text.startswith((f"{yes}:", f"{no}:", f"{no},"))
                    continue
                assert text.startswith(yes if straight["needed"] else no)
                contrary = answer(timeline, code, CONTRARY, **ask)["text"]
                assert contrary.startswith(no if straight["needed"] else yes)
    assert {"shut", "not", "later"} <= needs


def test_the_stop_that_is_asked_about_is_judged() -> None:
    timeline = driven(30, seed=3, planner="rules", attentive=0.0)
    stop = answer(timeline, about="history", what="stopped")["stops"][0]
    assert stop["ticks"] > 1
    told = answer(timeline, about="history", what="needed", move=Move.STAY, tick=stop["tick"] + 1)
    assert told["at_tick"] == stop["tick"] + 1
    assert told["stood"] == stop["ticks"]
    assert "of the stop" in told["text"]
    other = answer(timeline, about="history", what="needed", move=Move.LEFT, tick=stop["tick"])
    assert "need" not in other
    assert "did not" in other["text"]


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("what", ["stopped", "lanes_used", "tight"])
def test_what_is_counted_is_short_and_before_a_drive_nothing(code: str, what: str) -> None:
    texts = set()
    for seed in range(8):
        told = answer(driven(30, seed=seed, planner="rules"), code, about="history", what=what)["text"]
        assert looks_like_sentences(told), told
        assert len(told.split()) <= MOST_WORDS, told
        texts.add(told)
    assert len(texts) > 2
    unborn = answer(driven(0, seed=1), code, about="history", what=what)["text"]
    assert unborn == {"en": "Nothing has been driven yet.", "de": "Noch wurde nichts gefahren."}[code]


def test_stops_are_counted_by_what_they_were_for() -> None:
    counted = 0
    for seed in range(8):
        timeline = driven(30, seed=seed, planner="rules", attentive=0.0)
        found = answer(timeline, about="history", what="stopped", kind="vehicle")
        cars = [each for each in found["stops"] if any(id.startswith("vehicle") for id in each["ids"])]
        if cars:
            assert re.match(rf"Of {len(found['stops'])} stops? so far {len(cars)} were", found["text"])
            assert f"tick {cars[-1]['tick']}" in found["text"]
        elif found["stops"]:
            assert re.match(rf"Of {len(found['stops'])} stops? so far none", found["text"])
        counted += len(cars)
    assert counted


def test_the_halves_of_a_drive_are_the_whole_of_it() -> None:
    timeline = driven(13, seed=3, planner="astar")
    first, second = (answer(timeline, about="history", what=what) for what in ("first_half", "second_half"))
    whole = answer(timeline, about="history", what="summary")
    assert (first["first"], second["last"]) == (whole["first"], whole["last"])
    assert first["last"] == second["first"] == (whole["first"] + whole["last"]) // 2
    moves = {kind: first["moves"][kind] + second["moves"][kind] for kind in whole["moves"]}
    assert moves == whole["moves"]
    assert f"From tick {second['first']} to tick {second['last']}" in second["text"]


def test_the_lane_of_most_ticks_comes_first() -> None:
    told = answer(driven(12, seed=3, planner="astar"), about="history", what="lanes_used")
    first = told["lanes"][0]
    assert first["ticks"] == max(each["ticks"] for each in told["lanes"])
    assert str(first["lane"]) in told["text"].split(":")[0]


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("what", ["next_stop", "next_change"])
def test_the_next_turn_is_told_with_its_tick(code: str, what: str) -> None:
    later = 0
    for seed in range(10):
        timeline = driven(2, seed=seed, planner="rules", attentive=0.5 if seed % 3 else 0.0)
        told = answer(timeline, code, about="outlook", what=what)
        assert looks_like_sentences(told["text"]), told["text"]
        if told["after"]:
            assert f"Tick {told['at_tick']}".casefold() in told["text"].casefold()
            later += 1
        assert told["left_to_chance"] == ({"en": "left to chance", "de": "Zufall"}[code] in told["text"])
    assert later
    ended = driven(60, seed=0, planner="rules")
    assert "after" not in answer(ended, code, about="outlook", what=what)


@pytest.mark.parametrize("code", NARRATORS)
def test_since_when_what_was_hit_was_seen(code: str) -> None:
    crashes = 0
    for seed in range(30):
        timeline = driven(60, seed=seed, planner="priority", vehicles=40, attentive=0.0)
        told = answer(timeline, code, about="blame", what="first_seen")["text"]
        assert looks_like_sentences(told), told
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        since = foreseen(timeline).seen_since
        assert since is None or f"Tick {since}".casefold() in told.casefold()
        crashes += 1
    assert crashes
