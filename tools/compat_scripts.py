"""What is done in the sessions that are kept as fixtures: how each begins, and what is said and done in it.

A step of a script is a sentence, typed actions (one, or several together), a number of ticks to run, a patch
of the configuration, a tick to go back to, or a fork to go on in.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

Json = dict[str, Any]


@dataclass(frozen=True)
class Patch:
    """Settings changed in figures."""

    parts: Json


@dataclass(frozen=True)
class Back:
    """Time moved back to a tick."""

    tick: int


@dataclass(frozen=True)
class Fork:
    """What follows is done in a fork, taken at a tick."""

    tick: int
    actions: Sequence[Json] = ()


Deed = str | int | Json | Sequence[Json] | Patch | Back | Fork


@dataclass(frozen=True)
class Script:
    """A session: the body that makes it, and what follows."""

    begin: Json
    deeds: Sequence[Deed]
    trimmed: bool = False
    """keep only what a recording has to hold: of the configuration the seed, of entries no digests"""


def _set(parameter: str, value: object) -> Json:
    return {"do": "set", "parameter": parameter, "value": value}


def _prefer(preference: str) -> Json:
    return {"do": "prefer", "preference": preference}


def _drive(*moves: str) -> list[Json]:
    return [{"do": "drive", "move": move} for move in moves]


MANUAL: Final = {"do": "mode", "mode": "manual"}
AUTO: Final = {"do": "mode", "mode": "auto"}
UNDO: Final = {"do": "undo"}
REDO: Final = {"do": "redo"}
RESET: Final = {"do": "reset"}

RECORDINGS: Final[Mapping[str, Script]] = {
    "plain": Script({"seed": 3}, [400, "add five potholes", 300, "add 3 cars in the left lane", 300]),
    "astar": Script(
        {"seed": 4, "planner": "astar", "config": {"courtesy": 0.5, "pedestrians": 6, "potholes": 20}},
        [200, _prefer("avoid_potholes"), 150, _prefer("cautious"), 150, _prefer("balanced"), 150],
    ),
    "dijkstra": Script(
        {"seed": 5, "planner": "dijkstra", "scenario": "a city road with heavy traffic"},
        [200, _set("safety_buffer", 2), 200, _set("courtesy", 0.3), 150],
    ),
    "exact": Script(
        {"seed": 6, "planner": "exact", "config": {"vehicles": 45, "potholes": 25, "barriers": 4}},
        [150, "add 10 cars", 150, {"do": "set_count", "kind": "pedestrian", "count": 8}, 150],
    ),
    "scenarios": Script(
        {"seed": 7, "planner": "astar"},
        [
            120,
            "simulate a highway with 10 potholes",
            150,
            "use A*",
            120,
            {"do": "scenario", "road": "city", "planner": "dijkstra", "vehicles": 30},
            120,
            {"do": "scenario", "road": "rural", "traffic": "heavy"},
            150,
            UNDO,
            80,
        ],
    ),
    "undone": Script(
        {"seed": 8, "config": {"vehicles": 40}},
        [
            60,
            "add five potholes",
            90,
            "add three barriers",
            60,
            UNDO,
            UNDO,
            50,
            REDO,
            90,
            RESET,
            70,
            "save this as here",
            120,
            Back(250),
            "add a pedestrian",
            90,
            UNDO,
            UNDO,
            40,
            "load here",
            {"do": "rewind", "ticks": 33},
            150,
        ],
    ),
    "by_hand": Script(
        {"seed": 9, "config": {"vehicles": 30, "pedestrians": 5}},
        [
            [MANUAL, *_drive("forward_left", "forward_right", "forward", "left", "right", "stay")],
            30,
            _drive(*["forward"] * 30),
            60,
            _drive(*["forward_right", "forward_left", "forward"] * 10),
            40,
            AUTO,
            200,
            [MANUAL, *_drive("right", "forward_right", "forward_right", "stay", "forward_left")],
            25,
            AUTO,
            200,
        ],
    ),
    "crowded": Script(
        {"seed": 10, "config": {"columns": 5, "rows": 12, "vehicles": 22, "potholes": 4, "barriers": 8}},
        [600, {"do": "add", "kind": "pedestrian", "count": 2}, 600, _set("planner", "exact"), 300],
    ),
    "solvable": Script(
        {
            "seed": 11,
            "planner": "exact",
            "config": {"solvable": True, "potholes": 70, "barriers": 12, "vehicles": 30},
        },
        [250, "add four potholes", 150, "simulate a city road with 30 potholes", 200],
    ),
    "sizes": Script(
        {
            "seed": 12,
            "config": {"step_seconds": 0.25, "reset_delay_s": 1.0, "cell_m": 4.0, "visible_rows": 12},
        },
        [
            150,
            _set("columns", 5),
            120,
            _set("rows", 60),
            200,
            _set("seed", 99),
            150,
            Patch({"columns": 12, "rows": 20, "planner": "dijkstra"}),
            150,
        ],
    ),
    "settings": Script(
        {"seed": 13, "config": {"traffic": "light", "spawn_probability": 0.34}},
        [
            120,
            "heavy traffic",
            150,
            {"do": "adjust", "parameter": "pothole_probability", "direction": "up"},
            120,
            Patch({"spawn_probability": 0.8, "preferences": ["smooth_ride"], "courtesy": 0.2}),
            150,
            Patch({"planner": None}),
            100,
            {"do": "adjust", "parameter": "courtesy", "by": 0.3},
            150,
        ],
    ),
    "planners": Script(
        {"seed": 14, "config": {"vehicles": 50, "potholes": 15}},
        [
            *(
                deed
                for name in ("astar", "exact", "priority", "dijkstra")
                for deed in (120, _set("planner", name))
            ),
            120,
            {"do": "scenario", "vehicles": 50},
            120,
        ],
    ),
    "fork": Script(
        {"seed": 15, "config": {"vehicles": 45}},
        [
            90,
            "add five potholes",
            120,
            "simulate a highway with 12 potholes and 20 cars",
            90,
            Fork(170, [{"do": "add", "kind": "barrier", "count": 3}]),
            150,
            {"do": "scenario", "potholes": 20},
            150,
        ],
    ),
    "trimmed": Script(
        {"seed": 16},
        [200, {"do": "add", "kind": "vehicle", "count": 9}, 150, {"do": "scenario", "potholes": 9}, 250],
        trimmed=True,
    ),
    "rules": Script(
        {"seed": 17, "planner": "rules", "config": {"potholes": 30, "vehicles": 40, "barriers": 4}},
        [200, "add five potholes", 150, _set("attentive", 0.5), 150, "use the priority planner", 150],
    ),
    "attentive": Script(
        {
            "seed": 18,
            "planner": "priority",
            "config": {"attentive": 0.5, "courtesy": 0.5, "vehicles": 60, "potholes": 20, "pedestrians": 6},
        },
        [250, _set("attentive", 0.0), 250, _set("attentive", 1.0), _set("courtesy", 0.0), 250],
    ),
    "cells": Script(
        {
            "seed": 19,
            "planner": "priority",
            "config": {"collision": "cell", "repetition": False, "attentive": 0.0, "vehicles": 45},
        },
        [400, [MANUAL, *_drive("forward_left", "forward_right", "forward_left")], 10, AUTO, 300],
    ),
    "layouts": Script(
        {"seed": 20, "config": {"layout": "maze", "columns": 10}},
        [
            150,
            *(
                deed
                for layout, planner in (
                    ("walls", "exact"),
                    ("narrows", "astar"),
                    ("dead_ends", "rules"),
                    ("crossing", "priority"),
                )
                for deed in ({"do": "scenario", "layout": layout, "planner": planner, "potholes": 5}, 120)
            ),
            UNDO,
            60,
        ],
    ),
    "hit": Script(
        {
            "seed": 42,
            "planner": "priority",
            "config": {"columns": 5, "rows": 12, "vehicles": 14, "attentive": 0.0, "pedestrians": 2},
        },
        [400, _set("planner", "rules"), 300],
    ),
    "older": Script(
        {"seed": 41, "config": {"rules": 1, "vehicles": 40, "potholes": 20}},
        [250, "add five potholes", 150, {"do": "scenario", "vehicles": 45}, 200],
    ),
}

KEPT: Final[Mapping[str, Script]] = {
    "kept plain": Script({"seed": 21}, [300, "add five potholes", 500, "add ten cars", 200]),
    "kept astar": Script(
        {"seed": 22, "planner": "astar", "config": {"courtesy": 0.4, "vehicles": 45, "pedestrians": 4}},
        [
            150,
            "save this as the hill",
            _prefer("fastest"),
            200,
            "simulate a highway with 10 potholes",
            150,
            "add five potholes",
            60,
            UNDO,
            30,
        ],
    ),
    "kept fork": Script(
        {"seed": 23, "config": {"vehicles": 40}},
        [100, "add five potholes", 150, Fork(180), 120, "add three cars", 100],
    ),
    "kept fork of a fork": Script(
        {"seed": 24, "config": {"vehicles": 40, "potholes": 12}},
        [
            120,
            [{"do": "add", "kind": "pothole", "count": 2}, {"do": "step", "ticks": 5}],
            60,
            Fork(150),
            90,
            RESET,
            60,
            Fork(200, [_set("planner", "exact")]),
            {"do": "rewind", "ticks": 40},
            120,
            "save this as the end",
        ],
    ),
    "kept by hand": Script(
        {"seed": 25, "scenario": "a city road with 25 cars"},
        [80, [MANUAL, *_drive("forward_left", "forward", "forward_right")], 40, AUTO, 100, "rush hour", 120],
    ),
    "kept crowded": Script(
        {"seed": 26, "config": {"columns": 5, "rows": 12, "vehicles": 22, "potholes": 4, "barriers": 8}},
        [700, "add a pedestrian", 300],
    ),
    "kept layout": Script(
        {"seed": 27, "planner": "exact", "config": {"layout": "crossing", "attentive": 0.5}},
        [200, "add two potholes", 100, {"do": "scenario", "layout": "walls"}, 150],
    ),
}
"""Sessions of the database, each under its name; those it is forked from stay without one."""

TAUGHT: Final = ("when I say rush hour, I mean heavy traffic and ten more cars",)

LINKS: Final[Mapping[str, Script]] = {
    "plain": Script({"seed": 31}, [240]),
    "changed": Script(
        {"seed": 32, "planner": "dijkstra", "config": {"vehicles": 45, "courtesy": 0.2}},
        [80, "add five potholes", 80, "simulate a highway with 10 potholes", 200],
    ),
    "scenario": Script(
        {"seed": 33, "scenario": "a rural road with heavy traffic", "planner": "exact"},
        [100, [MANUAL, *_drive("forward_left", "forward_left", "forward")], 8, AUTO, 150],
    ),
    "layout": Script(
        {"seed": 34, "config": {"layout": "narrows", "attentive": 0.5, "collision": "cell"}},
        [150, "add three potholes", 150],
    ),
}
