"""No reply, refusal or log line holds a name of the code: a parameter, a planner's key, the id of a thing."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from typing import Any, get_args

import pytest

from service.narration import Narrator
from service.refusals import refusals
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    Layout,
    MoveThings,
    Prefer,
    Remove,
    Replace,
    RoadType,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Shift,
    Traffic,
    Where,
    Wish,
    WorldAction,
)
from sim.config import Config
from sim.planner_names import BUILT_IN
from sim.session.errors import EditError
from sim.session.settings import STEPS
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Mode, Move

LANGUAGES = ("en", "de")
CODE = re.compile(
    r"[a-z]_[a-z]|\b(?:astar|bfs|rules|priority|priority_rules|dijkstra|none|auto|manual|forward_left)\b"
    r"|\b(?:vehicle|pothole|barrier|pedestrian)-\d"
)
"""Names that only the code has; "the rules" and "no traffic" are words."""
ALLOWED = re.compile(r"\b(?:the |priority ){1,2}rules\b|there were none", re.IGNORECASE)
KINDS = [kind for kind in PLACEABLE if kind != "av"]


def leaks(text: str) -> list[str]:
    return CODE.findall(ALLOWED.sub("", text))


def actions(draw: random.Random) -> Iterator[WorldAction]:
    """One action of every sort, over all values."""
    yield from (Set(parameter="planner", value=name) for name in BUILT_IN)
    yield from (Set(parameter="traffic", value=level) for level in get_args(Traffic))
    for name in STEPS:
        yield from (Adjust(parameter=name, direction=way) for way in ("up", "down"))  # type: ignore[arg-type]
        yield Adjust(parameter=name, factor=draw.choice((0.5, 50)))  # type: ignore[arg-type]
    yield from (Prefer(preference=wish) for wish in get_args(Wish))
    yield from (Scenario(layout=layout, potholes=2) for layout in get_args(Layout))
    yield from (Scenario(road=road, vehicles=500) for road in get_args(RoadType))
    yield from (SetMode(mode=mode) for mode in (Mode.MANUAL, Mode.AUTO))
    yield from (Drive(move=move) for move in Move)
    for kind in KINDS:
        for where in (
            None,
            Where(lane=2),
            Where(side="ahead", cells=2),
            Where(cell=(3, 3)),
            Where(nearest=True),
        ):
            yield Add(kind=kind, count=draw.choice((1, 2, 400)), where=where)
            yield Remove(kind=kind, count=draw.choice((1, 2, "all")), where=where)
        yield SetCount(kind=kind, count=draw.choice((0, 1, 7)))
        yield MoveThings(kind=kind, count=draw.choice((1, 2)), by=Shift(side="left", cells=1))
        yield Copy(kind=kind, count=1)
        yield Replace(kind=kind, count="all", by=draw.choice(KINDS))
        yield Remove(kind=kind, count=1, where=Where(cell=(3, 3)))
    yield Remove(kind="everything", count="all")


@pytest.mark.parametrize("code", LANGUAGES)
def test_no_reply_or_refusal_holds_a_name_of_the_code(code: str) -> None:
    narrator, words, told = Narrator.load(code), refusals(code), 0
    for seed in range(4):
        draw = random.Random(seed)
        timeline = Timeline(Config(seed=seed, barriers=6, pedestrians=3))
        for action in actions(draw):
            try:
                text = narrator.reply(tuple(timeline.apply(1, [action])))
            except EditError as refused:
                text = words.edit(refused)
            assert leaks(text) == [], (action, text)
            assert text == text.strip()
            assert ".." not in text
            told += 1
    assert told > 300


@pytest.mark.parametrize("code", LANGUAGES)
def test_no_log_line_holds_a_name_of_the_code(code: str) -> None:
    narrator = Narrator.load(code)
    for seed, planner in enumerate(BUILT_IN):
        timeline = Timeline(Config(seed=seed, planner=planner, potholes=30, vehicles=30, barriers=20))
        for _ in range(80):
            before = timeline.state
            done = timeline.advance()
            lines: list[Any] = [narrator.event(event, done.state) for event in done.events]
            if done.decision is not None:
                lines.append(narrator.decision(done.decision, before))
            assert [line for line in lines if leaks(line)] == []


@pytest.mark.parametrize("code", LANGUAGES)
@pytest.mark.parametrize(
    "name", ["safety_buffer", "spawn_probability", "step_seconds", "pothole_probability"]
)
def test_refused_values_are_of_settings_as_people_call_them(code: str, name: str) -> None:
    timeline = Timeline(Config(seed=1))
    with pytest.raises(EditError) as refused:
        timeline.apply(1, [Set(parameter=name, value=5_000)])  # type: ignore[arg-type]
    assert leaks(refusals(code).edit(refused.value)) == []
