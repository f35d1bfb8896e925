"""Counts under conditions in words: every answer says its conditions, and the figures of its facts."""

from __future__ import annotations

from itertools import product
from typing import Any, get_args

import pytest

from service.actions import Ask
from service.actions.question_names import PartName, WantName
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
EVENTS: tuple[dict[str, Any], ...] = (
    {"what": "stopped"},
    {"what": "stopped", "kind": "vehicle"},
    {"what": "lane_changes", "move": "left"},
    {"what": "lane_changes", "kind": "pothole"},
    {"what": "made", "move": "forward_left"},
    {"what": "ended", "metric": "crashes", "kind": "vehicle"},
    {"what": "ended", "metric": "successes"},
)
SAID = {
    "en": {"lane": "n lane 3", "value": "n clear weather", "tick": "rom tick 4 ", "ticks": "last 9 ticks"},
    "de": {"lane": "uf Spur 3", "value": "ei klarem Wetter", "tick": "b Tick 4", "ticks": "letzten 9 Ticks"},
}


def driven(ticks: int, seed: int = 3) -> Timeline:
    timeline = Timeline(
        Config(columns=6, rows=14, potholes=14, vehicles=12, seed=seed, planner="rules", attentive=0.0)
    )
    for _ in range(ticks):
        timeline.advance()
    return timeline


def answer(timeline: Timeline, code: str = "en", **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(about="history", **ask), timeline))


@pytest.mark.parametrize("code", NARRATORS)
def test_every_answer_says_its_conditions_and_its_number(code: str) -> None:
    timelines = [driven(45), driven(30, 5)]
    conditions: tuple[dict[str, Any], ...] = (
        {"lane": 3},
        {"parameter": "weather", "value": "clear"},
        {"tick": 4, "lane": 3},
        {"ticks": 9},
    )
    counted = 0
    for timeline, event, given in product(timelines, EVENTS, conditions):
        told = answer(timeline, code, **event, **given)
        text = told["text"]
        assert looks_like_sentences(text), text
        assert len(text.split()) <= MOST_WORDS, text
        assert ids_in(text) == set(), text
        assert all(SAID[code][key] in text for key in given if key in SAID[code]), text
        (name,) = told.keys() & {"stops", "lane_changes", "moves", "ends"}
        ticks = [each["tick"] for each in told[name]]
        if told["driven"] and ticks:
            assert f" {len(ticks)} " in text, text
            assert str(ticks[0]) in text
            counted += 1
    assert counted


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("want", get_args(WantName))
def test_what_is_wanted_is_told(code: str, want: str) -> None:
    yes, no = {"en": ("Yes.", "No."), "de": ("Ja.", "Nein.")}[code]
    for seed, part in product(range(5), (None, *get_args(PartName))):
        told = answer(driven(40, seed), code, what="stopped", want=want, part=part)
        text, stops = told["text"], told["stops"]
        assert looks_like_sentences(text), text
        assert len(text.split()) <= MOST_WORDS, text
        if not told["driven"]:
            continue
        if want == "whether":
            assert text.startswith(yes if stops else no), text
        elif want == "share":
            assert f"{round(100 * sum(each['ticks'] for each in stops) / told['driven'])} %" in text
        elif stops and want != "list":
            one = {
                "first": stops[0],
                "last": stops[-1],
                "longest": max(stops, key=lambda each: each["ticks"]),
            }[want]
            assert f"Tick {one['tick']} ".casefold() in text.casefold()


def test_ticks_that_never_were_are_said_to_be_none() -> None:
    timeline = driven(6)
    assert "no tick 99" in answer(timeline, what="stopped", tick=99)["text"]
    assert "only tick 6" in answer(timeline, what="stopped", ticks=99)["text"]
    assert "too short" in answer(driven(1), what="stopped", part="second_half")["text"]


@pytest.mark.parametrize(
    "odd",
    [
        {"what": "made"},
        {"what": "made", "move": "stay"},
        {"what": "ended"},
        {"what": "ended", "metric": "moves"},
        {"what": "ended", "metric": "crashes", "part": "second_half"},
        {"what": "lane_changes", "want": "longest"},
        {"what": "lane_changes", "move": "forward"},
        {"what": "stopped", "parameter": "traffic", "value": "heavy"},
        {"what": "stopped", "parameter": "weather", "value": "hail"},
        {"what": "stopped", "part": "session", "tick": 3},
        {"what": "summary", "lane": 2},
    ],
)
def test_conditions_that_go_with_nothing_are_refused(odd: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        Ask(about="history", **odd)
