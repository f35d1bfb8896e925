"""Answers about the past in comparison: short, in sentences, without ids, and about the tick spoken of."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from service.actions import Ask, load
from service.narration import Narrator
from service.narration.answer_length import FEW_WORDS, MOST_WORDS
from service.sessions.facts import Asked
from service.sessions.pending import Talk
from service.sessions.referred import explained
from sim.config import Config
from sim.session.timeline import Timeline
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATOR = Narrator.load()
CAR = {"kind": "vehicle", "nearest": True}
QUESTIONS: tuple[dict[str, Any], ...] = (
    {"about": "why", "instead": "right"},
    {"about": "why", "move": "left", "instead": "forward"},
    *({"about": "what_if", "move": move} for move in ("forward", "left", "right", "stay", "forward_left")),
    {"about": "what_if", "move": "stay", "ticks": 3},
    {"about": "why", "seconds": 2.5},
    {"about": "other", "what": "why", "which": CAR},
    {"about": "other", "what": "why", "which": CAR, "move": "stay"},
    {"about": "other", "what": "why", "which": CAR, "move": "forward"},
    {"about": "other", "what": "going", "which": CAR},
    {"about": "other", "what": "going", "which": {"kind": "pedestrian"}},
    {"about": "other", "what": "why", "which": {"id": "pothole-1"}},
    {"about": "other", "what": "why", "which": {"id": "vehicle-999"}},
    {"about": "other", "what": "going", "which": {"kind": "av"}},
    {"about": "pattern"},
    {"about": "pattern", "move": "left"},
    {"about": "history", "what": "riskiest"},
    {"about": "history", "what": "riskiest", "tick": 2, "until": 5},
    {"about": "history", "what": "similar"},
    {"about": "history", "what": "similar", "count": 5, "tick": 3},
    {"about": "why", "move": "left", "instead": "right", "tick": 999},
    {"about": "what_if", "move": "left", "ticks": 900},
    {"about": "detail", "how": "shorter"},
)


def drives() -> Iterator[Timeline]:
    for seed in range(6):
        config = Config(
            seed=seed,
            columns=8,
            rows=16,
            vehicles=20,
            potholes=8,
            pedestrians=4,
            courtesy=0.5 if seed == 5 else 0.0,
            planner=("priority", "rules", "astar")[seed % 3],
        )
        timeline = Timeline(config)
        for _ in range(3 + 2 * seed):
            timeline.advance()
        yield timeline


def ask(timeline: Timeline, question: dict[str, Any], language: str = "en", **parts: Any) -> dict[str, Any]:
    (asked,) = load([{"do": "ask", **question}])
    assert isinstance(asked, Ask)
    return NARRATOR.in_language(language).answer(replace(Asked(asked, timeline), **parts))


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_answer_is_short_and_in_sentences(language: str) -> None:
    for timeline in drives():
        for question in QUESTIONS:
            told = ask(timeline, question, language)
            assert json.dumps(told)
            text = told["text"].translate(str.maketrans("ÄÖÜ", "AOU", "„“"))
            assert looks_like_sentences(f"A{text}" if text[0].isdigit() else text), (question, text)
            assert len(text.split()) <= MOST_WORDS + 10 * (language == "de"), (question, text)
            assert not ids_in(text) or question.get("which", {}).get("id"), text


def talked(timeline: Timeline, *questions: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Questions one after the other, each with what was explained before it."""
    before: Ask | None = None
    for question in questions:
        (asked,) = load([{"do": "ask", **question}])
        told = ask(timeline, question, talk=Talk(explained=before))
        before = explained(told, (asked,))
        yield told


def test_the_answer_before_is_told_again_of_the_ticks_beside_it() -> None:
    timeline = [*drives()][3]
    hows = ("before", "before", "after", "longer", "shorter", "after")
    asked = ({"about": "why", "tick": 5}, *({"about": "detail", "how": how} for how in hows))
    told = [*talked(timeline, *asked)]
    assert [each["tick"] for each in told] == [5, 4, 3, 4, 4, 4, 5]
    assert told[0]["text"] == told[-1]["text"]
    assert told[1]["text"] == told[3]["text"]


def test_shorter_is_shorter_and_in_detail_is_not() -> None:
    shorter = 0
    for timeline in drives():
        for tick in range(timeline.tick):
            question = {"about": "why", "tick": tick}
            full, short = talked(timeline, question, {"about": "detail", "how": "shorter"})
            _, long = talked(timeline, question, {"about": "detail", "how": "longer"})
            assert len(short["text"].split()) <= max(FEW_WORDS, len(full["text"].split(". ")[0].split()))
            offer = " Say “look further”, and I go on."  # it is what the longer answer has done
            assert len(long["text"].split()) >= len(full["text"].removesuffix(offer).split())
            shorter += len(short["text"]) < len(full["text"])
    assert shorter > 5


def test_what_another_move_would_have_done_is_of_the_tick_spoken_of() -> None:
    timeline = [*drives()][4]
    made = timeline.decision(4)
    assert made is not None
    other = "stay" if made.move != "stay" else "forward"
    _, supposed, reason = talked(
        timeline,
        {"about": "why", "tick": 4},
        {"about": "what_if", "move": other},
        {"about": "detail", "how": "why"},
    )
    assert supposed["play"] == {"at_tick": 4, "move": other}
    assert (reason["tick"], reason["foil"]) == (4, other)


def test_are_you_sure_is_about_what_was_said_and_else_about_arriving() -> None:
    timeline = [*drives()][3]
    _, sure = [
        *(talked(timeline, {"about": "why", "tick": 4})),
        ask(
            timeline, {"about": "confidence"}, supposes="told", talk=Talk(explained=Ask(about="why", tick=4))
        ),
    ]
    assert sure["text"].startswith("Yes: I ran that decision again")
    alone = ask(timeline, {"about": "confidence"}, supposes="told")
    assert alone["text"] == ask(timeline, {"about": "confidence"})["text"]


def test_what_an_answer_shows_was_on_the_road() -> None:
    for timeline in drives():
        for question in QUESTIONS[:12]:
            told = ask(timeline, question)
            shown = told.get("shown")
            if shown is None:
                continue
            world = timeline.at(told["tick"]).world
            cells = {thing.cell for thing in world.things()} | {world.road.cell(av) for av in world.avs}
            assert {tuple(cell) for cell in shown["cells"]} <= cells
            assert {cause["id"] for cause in told["causes"] if cause["cell"]} <= {*shown["ids"]}


def test_back_further_than_there_are_ticks_is_said() -> None:
    timeline = next(drives())
    told = ask(timeline, {"about": "why", "ticks": 500})
    assert told["text"] == f"It is only tick {timeline.tick} so far."
