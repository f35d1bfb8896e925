"""Answers about past detection name the ticks and numbers of their facts, briefly, in both languages."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.actions.action import Which
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.session.timeline import Timeline
from tests.sim.explain.test_sightings import SENSORS, driven
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def answer(timeline: Timeline, code: str = "en", **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(about="history", **ask), timeline))


def checked(text: str) -> str:
    assert looks_like_sentences(text), text
    assert len(text.split()) <= MOST_WORDS, text
    assert ids_in(text) == set(), text
    return text


@pytest.mark.parametrize("code", NARRATORS)
def test_every_question_has_a_short_answer_with_the_ticks_of_its_facts(code: str) -> None:
    yes, no = YES_NO[code]
    for sensor, seed in [(sensor, seed) for sensor in SENSORS for seed in range(3)]:
        timeline = driven(seed, *sensor)
        things = answer(timeline, code, what="sighted")["sightings"]
        seen = [each for each in things if each["first_seen"] is not None]
        first = answer(timeline, code, what="sighted", want="first")
        assert f"Tick {seen[0]['first_seen']}".casefold() in checked(first["text"]).casefold()
        whole = checked(answer(timeline, code, what="sighted")["text"])
        assert f" {len(things)} " in whole
        assert f" {len(seen)} " in whole
        checked(answer(timeline, code, what="sighted", want="last")["text"])
        checked(answer(timeline, code, what="sighted", kind="barrier", want="whether")["text"])
        overlooked = checked(answer(timeline, code, what="overlooked")["text"])
        never = [each for each in things if each["passed"] is not None and each["first_seen"] is None]
        assert overlooked.startswith(yes if never else no)
        lost = checked(answer(timeline, code, what="lost_sight")["text"])
        assert lost.startswith(yes if any(each["lost"] for each in things) else no)
        checked(answer(timeline, code, what="noticed", tick=2)["text"])
        checked(answer(timeline, code, what="noticed", tick=0)["text"])
        checked(answer(timeline, code, what="noticed", tick=999)["text"])


@pytest.mark.parametrize("code", NARRATORS)
def test_of_one_thing_it_is_told_since_when(code: str) -> None:
    yes, no = YES_NO[code]
    told = 0
    for seed in range(4):
        timeline = driven(seed, *SENSORS[0])
        facts = answer(timeline, code, what="sighted")["sightings"]
        there = {thing.id for thing in timeline.state.world.things()}
        for each in facts:
            if each["id"] not in there:
                continue
            which = Which(id=each["id"])
            text = checked(answer(timeline, code, what="sighted", which=which)["text"])
            if each["first_seen"] not in (None, 0):
                assert f"Tick {each['first_seen']}".casefold() in text.casefold()
                told += 1
            asked = checked(answer(timeline, code, what="sighted", which=which, want="whether")["text"])
            assert asked.startswith(no if each["first_seen"] is None else yes)
    assert told


@pytest.mark.parametrize("code", NARRATORS)
def test_counts_of_moves_and_stretches(code: str) -> None:
    for seed in range(4):
        timeline = driven(seed)
        shares = answer(timeline, code, what="shares")
        assert f" {len(shares['moves'])} " in checked(shares["text"])
        longest = answer(timeline, code, what="moving", want="longest")
        if longest["stretches"]:
            most = max(longest["stretches"], key=lambda each: each["ticks"])
            assert str(most["tick"]) in checked(longest["text"])
        lane = timeline.state.world.road.cell(timeline.at(0).world.av)[0] + 1
        used = checked(answer(timeline, code, what="lanes_used", lane=lane, want="whether")["text"])
        assert used.startswith(YES_NO[code][0])


@pytest.mark.parametrize("code", NARRATORS)
def test_the_closest_calls_of_a_kind_and_the_next_ones(code: str) -> None:
    timeline = driven(2)
    first = answer(timeline, code, what="closest_call", count=1)["closest_call"]
    second = answer(timeline, code, what="closest_call", count=2)
    checked(second["text"])
    if second["closest_call"] is not None:
        assert second["closest_call"]["gap_m"] >= first["gap_m"]
        assert second["closest_call"]["id"] != first["id"]
    for kind in ("vehicle", "pedestrian", "pothole"):
        checked(answer(timeline, code, what="closest_call", kind=kind)["text"])


def test_the_mean_distance_says_of_how_many_it_is() -> None:
    left_out = 0
    for sensor, seed in [(sensor, seed) for sensor in SENSORS for seed in range(3)]:
        told = answer(driven(seed, *sensor), what="sighted")
        seen = [each for each in told["sightings"] if each["first_seen"] is not None]
        ahead = [each for each in seen if each["rows_ahead"] > 0]
        if len(ahead) < len(seen) and ahead:
            assert f"counting the {len(ahead)} of {len(seen)}" in told["text"]
            left_out += 1
    assert left_out
