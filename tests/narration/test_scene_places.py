"""What is seen at a place: yes or no first, only what is there, and which lanes are free."""

from __future__ import annotations

import json
from typing import Any

import pytest

from service.actions import Ask
from service.narration.sayings import Sayings
from service.narration.scene import Scenes
from service.sessions.facts import Asked
from sim.session.timeline import Timeline
from sim.state import SimState
from tests.support.moments import moments
from tests.support.roads import road, run_on

SCENES = Scenes(Sayings.load())
ROAD = run_on(road("........", "........", "o.......", "...>....", "..oA...."))
"""Potholes: lane 3 level with the ego, lane 1 two rows ahead; a car right ahead. The ego is in lane 4."""


def answer(run: SimState, supposes: str, kind: Any = None) -> dict[str, Any]:
    timeline = Timeline(run.config)
    timeline.state = run
    return SCENES.answer(Asked(Ask(about="scene", kind=kind), timeline, supposes))


@pytest.mark.parametrize(
    ("supposes", "kind", "begins"),
    [
        ("lane left free", None, "No: level with me in lane 3"),
        ("lane left taken", None, "Yes: level with me in lane 3"),
        ("lane right free", None, "Yes: in lane 5"),
        ("lane right taken", None, "No: in lane 5"),
        ("lane own free", None, "No: ahead in my lane"),
        ('free {"lane": 1}', None, "Level with me, yes; ahead in lane 1"),
        ('taken {"lane": 1}', None, "Level with me, no; ahead in lane 1"),
        ('any {"lane": 8}', None, "No, I see no things in lane 8"),
        ('number {"lane": 1}', "pothole", "1 in lane 1"),
        ('number {"lane": 3}', "vehicle", "0: I see no cars in lane 3"),
        ('free {"lane": 9}', None, "There is no lane 9"),
        ('{"distance_m": 5}', "pothole", "Yes, within 5 m"),
        ("number within 2", "pothole", "1 in the next 2 rows"),
        ('{"sides": ["ahead", "left"]}', "pothole", "Yes, ahead to the left"),
        ('{"sides": ["ahead", "right"]}', "pothole", "No, I see no potholes"),
        ('what {"side": "left", "cells": 3}', None, "I see in lane 1"),
        ('{"nearest": true}', "pothole", "The nearest: a pothole"),
        ("lanes free", None, "With nothing level with me or ahead: lanes 2, 5, 6, 7 and 8."),
        ("lanes taken", None, "Taken level with me: lane 3. Something is ahead in lanes 1 and 4."),
        ("lanes with", "pothole", "In lanes 1 and 3: I see two potholes there."),
        ("lanes with", "barrier", "In none"),
        ("lanes beside", None, "Yes, level with me: lane 5 on my right (nothing seen ahead in it)."),
        ("lanes sides left", "pothole", "Yes. Of potholes I see 2 on my left, 0 on my right and 0 in my own"),
        ("lanes sides right", "pothole", "No. Of potholes I see 2 on my left"),
        ("lanes sides both", "vehicle", "Of cars I see 0 on my left, 0 on my right and 1 in my own lane."),
        ("clear", None, "Yes."),
        ("anything", None, "Yes."),
    ],
)
def test_of_a_place_what_is_there(supposes: str, kind: str | None, begins: str) -> None:
    assert answer(ROAD, supposes, kind)["text"].startswith(begins)


def test_an_answer_about_a_place_holds_what_is_there_alone() -> None:
    for run in (each.state for each in moments(12, seed=5)):
        columns = run.world.road.columns
        own = run.world.road.cell(run.world.av)[0] + 1
        whole = answer(run, "")["seen"]
        told = 0
        for lane in range(1, columns + 1):
            found = answer(run, "what " + json.dumps({"lane": lane}))
            lanes = {own + thing["lanes"] for thing in found["seen"]}
            assert lanes <= {lane}
            told += len(found["seen"])
        assert told == len(whole)


def test_yes_and_no_change_places_with_what_is_asked() -> None:
    for run in (each.state for each in moments(12, seed=6)):
        for lane in range(1, run.world.road.columns + 1):
            place = json.dumps({"lane": lane})
            free, taken = (answer(run, f"{word} {place}")["text"] for word in ("free", "taken"))
            first = {text.split(":")[0] for text in (free, taken)}
            assert first == {"Yes", "No"} or free.replace("yes", "no", 1) == taken


def test_a_free_lane_holds_nothing_ahead() -> None:
    for run in (each.state for each in moments(12, seed=7)):
        text = answer(run, "lanes free")["text"]
        own = run.world.road.cell(run.world.av)[0] + 1
        if not text.startswith("With nothing"):
            continue
        named = {int(word.strip(".,:")) for word in text.split(".")[0].split() if word.strip(".,:").isdigit()}
        seen = answer(run, "")["seen"]
        taken = {own + thing["lanes"] for thing in seen if thing["rows"] >= 0}
        assert not named & taken
        assert named | taken == set(range(1, run.world.road.columns + 1))


@pytest.mark.parametrize("kind", ["vehicle", "pothole", "pedestrian"])
def test_sides_are_compared_by_what_is_really_in_their_lanes(kind: str) -> None:
    agreed = set()
    for run in (timeline.state for timeline in moments(40)):
        column, _ = run.world.road.cell(run.world.av)
        lanes = [each.cell[0] for each in run.world.things() if each.kind == kind]
        left, right = sum(each < column for each in lanes), sum(each > column for each in lanes)
        own = len(lanes) - left - right
        for side, more in (("left", left > right), ("right", right > left)):
            told = answer(run, f"lanes sides {side}", kind)["text"]
            assert told.startswith("Yes." if more else "No."), told
            assert f"{left} on my left, {right} on my right and {own} in my own lane" in told
            agreed.add(more)
    assert agreed == {True, False}


def test_a_lane_beside_is_free_where_nothing_is_level_with_the_ego() -> None:
    for run in (timeline.state for timeline in moments(40)):
        column, row = run.world.road.cell(run.world.av)
        taken = {each.cell for each in run.world.things()}
        told = answer(run, "lanes beside")["text"]
        for lane in (column - 1, column + 1):
            free = 0 <= lane < run.world.road.columns and (lane, row) not in taken
            assert (f"lane {lane + 1} on my" in told) is free, told
