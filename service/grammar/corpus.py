"""Generates sentences from a language: one for every action with every word it can hold.

Completion searches them, and the guide to the language lists them.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Any, get_args

from pydantic import ValidationError

from service.actions import QUESTIONS, WHATS, ChatKind, Choosable, FactName, MetricName, Term, ViewName, load
from service.actions.question_names import (
    DetailName,
    PartName,
    PolicyName,
    ScaleName,
    SeedsName,
    SideName,
    SoonerName,
    WantName,
)
from service.grammar.sentences import Sentences, Unsayable
from service.styles import styles
from sim.actions import (
    Direction,
    GoalName,
    Layout,
    Parameter,
    RoadType,
    TimeOfDay,
    Traffic,
    Weather,
    Wish,
)
from sim.planner_names import BUILT_IN, PROMISED
from sim.sensor_names import SensorName
from sim.types import PLACEABLE, Move

CHOICES: dict[str, tuple[str, ...]] = {
    "weather": get_args(Weather),
    "time_of_day": get_args(TimeOfDay),
    "traffic": get_args(Traffic),
    "planner": (*BUILT_IN, *PROMISED),
    "sensor": get_args(SensorName),
    "dynamics": ("grid", "continuous"),
}
"""The parameters that take a word, and which."""

TYPICAL: dict[str, float] = {
    "playback_speed": 2,
    "target_speed_kmh": 50,
    "step_seconds": 0.25,
    "spawn_probability": 0.4,
    "pothole_probability": 0.2,
    "courtesy": 0.5,
    "attentive": 0.5,
    "sensor_noise": 0.1,
    "detection_sensitivity": 0.8,
    "false_positive_rate": 0.05,
    "sensor_latency": 1,
    "slip_probability": 0.1,
    "traffic_by_hour": 0.5,
    "sensor_range_m": 40,
    "safety_buffer": 2,
    "columns": 12,
    "rows": 40,
    "seed": 7,
}
"""The parameters that take a number, each with a sensible one."""

_PLACES: tuple[dict[str, Any] | None, ...] = (
    None,
    {"side": "ahead", "distance_m": 15},
    {"lane": "left"},
    {"lane": "right"},
    {"lane": "middle"},
    {"lane": 3},
    {"row": 12},
    {"cell": [3, 12]},
    {"side": "ahead"},
    {"side": "behind"},
)


def sentences(language: Sentences) -> Iterator[str]:
    """All of them, the most useful first."""
    for values in (*_things(), *_clock(), *_settings(), *_questions(), *_rest()):
        try:
            yield language.sentence(load([values]))
        except (Unsayable, ValidationError):  # the question is none without one of its keys
            continue


def _things() -> Iterator[dict[str, Any]]:
    for where in _PLACES:
        for kind in PLACEABLE:
            for count in (5, 1):
                yield _placed({"do": "add", "kind": kind, "count": count}, where)
    for where in _PLACES:
        for kind in PLACEABLE:
            for amount in ("all", 2, 1):
                yield _placed({"do": "remove", "kind": kind, "count": amount}, where)
    for kind in PLACEABLE:
        yield {"do": "remove", "kind": kind, "count": 1, "where": {"nearest": True}}
        yield {"do": "set_count", "kind": kind, "count": 10}
    yield {"do": "remove", "kind": "everything", "count": "all"}
    yield from _rearranged()


def _rearranged() -> Iterator[dict[str, Any]]:
    for kind in PLACEABLE:
        nearest = {"kind": kind, "count": 1, "where": {"nearest": True}}
        for side in get_args(Direction):
            yield {"do": "move", **nearest, "by": {"side": side, "cells": 1}}
        for to in ({"lane": "left"}, {"lane": 3}, {"row": 12}, {"side": "beside"}):
            yield {"do": "move", **nearest, "to": to}
        yield {"do": "move", "kind": kind, "count": "all", "to": {"lane": "right"}}
        yield {"do": "copy", **nearest}
        yield {"do": "remove", "kind": kind, "count": "half"}
        yield {"do": "remove", "kind": kind, "count": "all", "except": {"nearest": True}}
        yield {"do": "add", "kind": kind, "count": 1, "where": {"each": "lane"}}
        for other in PLACEABLE:
            if other is not kind:
                yield {"do": "replace", "kind": kind, "count": "all", "by": other}
                two = [{"kind": each, "where": {"nearest": True}} for each in (kind, other)]
                yield {"do": "swap", "first": two[0], "second": two[1]}


def _placed(action: dict[str, Any], where: dict[str, Any] | None) -> dict[str, Any]:
    return action if where is None else {**action, "where": where}


def _clock() -> Iterator[dict[str, Any]]:
    for do in ("pause", "resume", "reset", "undo", "redo"):
        yield {"do": do}
    for do in ("step", "rewind"):
        yield {"do": do, "ticks": 5}
        yield {"do": do, "ticks": 1}
    for moment in (5, "crash", "episode", "start"):
        yield {"do": "rewind", "to": moment}
    for mode in ("manual", "auto"):
        yield {"do": "mode", "mode": mode}
    for move in Move:
        yield {"do": "drive", "move": move}


def _settings() -> Iterator[dict[str, Any]]:
    for parameter in get_args(Parameter):
        for value in CHOICES.get(parameter, ()):
            yield {"do": "set", "parameter": parameter, "value": value}
        if parameter in TYPICAL:
            yield {"do": "set", "parameter": parameter, "value": TYPICAL[parameter]}
            for change in ({"direction": "up"}, {"direction": "down"}, {"by": 1}, {"by": -1}, {"factor": 2}):
                yield {"do": "adjust", "parameter": parameter, **change}
    for wish in get_args(Wish):
        yield {"do": "prefer", "preference": wish}
    for road in get_args(RoadType):
        yield {"do": "scenario", "road": road, "potholes": 10, "vehicles": 2}
        yield {"do": "scenario", "road": road, "weather": "rain"}
    for layout in get_args(Layout):
        yield {"do": "scenario", "layout": layout}
        yield {"do": "scenario", "layout": layout, "pedestrians": 3}
    yield {"do": "scenario", "potholes": 10}
    yield {"do": "scenario", "traffic": "heavy", "potholes": 5}


def _questions() -> Iterator[dict[str, Any]]:
    for about in (about for about, traits in QUESTIONS.items() if not traits.must and about != "what_if"):
        yield {"do": "ask", "about": about}
    for move in Move:
        yield {"do": "ask", "about": "why_not", "move": move}
        yield {"do": "ask", "about": "why", "move": move}
        yield {"do": "ask", "about": "what_if", "move": move}
        yield {"do": "ask", "about": "why_not", "what": "detour", "move": move}
        yield {"do": "ask", "about": "what_if", "what": "detour", "move": move}
        yield {"do": "ask", "about": "pattern", "move": move}
        yield {"do": "ask", "about": "why", "instead": move}
    for kind in PLACEABLE:
        yield {"do": "ask", "about": "scene", "kind": kind}
        yield {"do": "ask", "about": "scene", "kind": kind, "count": 1}
    for metric in get_args(MetricName):
        yield {"do": "ask", "about": "metrics", "metric": metric}
    yield {"do": "ask", "about": "what_if", "change": [{"do": "add", "kind": "pothole", "count": 5}]}
    yield {"do": "ask", "about": "what_if", "change": [{"do": "drive", "move": "stay"}], "count": 5}
    for names in (PolicyName, SoonerName, SideName, SeedsName):
        whats = (what for what in get_args(names) if what != "to_lane")
        yield from ({"do": "ask", "about": "what_if", "what": what} for what in whats)
    yield {"do": "ask", "about": "what_if", "what": "to_lane", "lane": 3}
    for what, kind in product(get_args(ScaleName), PLACEABLE):
        yield {"do": "ask", "about": "what_if", "what": what, "kind": kind}
    for parameter in ("planner", "sensor", "weather", "time_of_day"):
        for value in CHOICES[parameter]:
            change = [{"do": "set", "parameter": parameter, "value": value}]
            yield {"do": "ask", "about": "what_if", "what": "so_far", "change": change}
    for parameter in ("courtesy", "sensor_noise"):
        without = {"do": "set", "parameter": parameter, "value": 0}
        yield {"do": "ask", "about": "what_if", "what": "so_far", "change": [without]}
    for move in Move:
        yield {"do": "ask", "about": "what_if", "what": "own_last", "move": move}
    yield {"do": "ask", "about": "why", "what": "other_side"}
    for parameter in get_args(Parameter):
        yield {"do": "ask", "about": "setting", "parameter": parameter}
        for value in CHOICES.get(parameter, ()):
            yield {"do": "ask", "about": "setting", "parameter": parameter, "value": value}
    for name in (*get_args(Parameter), *get_args(Choosable)):
        yield {"do": "ask", "about": "options", "parameter": name}
    for fact in get_args(FactName):
        yield {"do": "ask", "about": "fact", "fact": fact}
    for term in get_args(Term):
        yield {"do": "ask", "about": "term", "term": term}
    yield {"do": "ask", "about": "why", "what": "detour"}
    yield from _ahead_and_back()
    yield {"do": "ask", "about": "history", "what": "closest_call"}
    yield {"do": "ask", "about": "history", "what": "summary"}
    yield {"do": "ask", "about": "history", "what": "since", "tick": 5}
    yield {"do": "ask", "about": "history", "what": "since", "ticks": 10}
    yield {"do": "ask", "about": "history", "what": "between", "tick": 5, "until": 20}
    yield {"do": "ask", "about": "history", "what": "seen", "tick": 5}
    yield {"do": "ask", "about": "history", "what": "riskiest"}
    yield {"do": "ask", "about": "history", "what": "similar", "count": 3}
    yield {"do": "ask", "about": "history", "what": "choices"}
    yield {"do": "ask", "about": "history", "what": "choices", "tick": 5}
    yield {"do": "ask", "about": "history", "what": "choices", "ticks": 3}
    yield {"do": "ask", "about": "history", "what": "losses"}
    for moved in ({}, {"move": "stay"}, {"move": "left"}, {"move": "forward"}):
        yield {"do": "ask", "about": "history", "what": "needed", **moved}
        yield {"do": "ask", "about": "history", "what": "needed", "tick": 5, **moved}
        yield {"do": "ask", "about": "history", "what": "needed", "ticks": 3, **moved}
    for what in ("runner_up", "scores"):
        yield {"do": "ask", "about": "history", "what": what}
        yield {"do": "ask", "about": "history", "what": what, "tick": 5}
        yield {"do": "ask", "about": "history", "what": what, "ticks": 3}
    for what in ("waited", "differed", "before_crash", "lane_changes", "passed", "verdict"):
        yield {"do": "ask", "about": "history", "what": what}
    for what in ("stopped", "lanes_used", "tight", "first_half", "second_half"):
        yield {"do": "ask", "about": "history", "what": what}
    for what in ("passed", "stopped", "closest_call", "trouble"):
        yield {"do": "ask", "about": "history", "what": what, "kind": "pedestrian"}
    for what in ("sighted", "overlooked", "lost_sight", "noticed", "shares", "listed", "advanced", "end"):
        yield {"do": "ask", "about": "history", "what": what}
    yield {"do": "ask", "about": "history", "what": "explained", "ticks": 5}
    for what in ("stuck_cause", "knowable", "influence", "trouble", "explained", "unsafe_moves"):
        yield {"do": "ask", "about": "history", "what": what}
    for what in ("last_detected", "places_before", "least_ttc", "smoothness", "reversals", "nearest_goal"):
        yield {"do": "ask", "about": "history", "what": what}
    for what in ("typical", "late", "best_way"):
        yield {"do": "ask", "about": "history", "what": what}
    yield {"do": "ask", "about": "history", "what": "late", "kind": "pothole"}
    for when in ({}, {"tick": 5}, {"ticks": 3}, {"ticks": 1}):
        yield {"do": "ask", "about": "history", "what": "chosen_safest", **when}
    for what in ("here_since", "not_advanced", "story", "mishaps"):
        yield {"do": "ask", "about": "history", "what": what}
    for ticks in (1, 3):
        yield {"do": "ask", "about": "history", "what": "places_before", "ticks": ticks}
    for want in ("first", "last", "share"):
        yield {"do": "ask", "about": "history", "what": "sighted", "want": want}
    for want in ("first", "whether"):
        yield {"do": "ask", "about": "history", "what": "sighted", "want": want, "kind": "barrier"}
    yield {"do": "ask", "about": "history", "what": "in_the_way", "want": "whether", "kind": "vehicle"}
    yield {"do": "ask", "about": "history", "what": "advanced", "ticks": 10}
    yield {"do": "ask", "about": "history", "what": "noticed", "tick": 5}
    yield {"do": "ask", "about": "history", "what": "closest_call", "count": 2}
    yield {"do": "ask", "about": "history", "what": "since", "seconds": 2.5}
    yield from _counted()
    yield {"do": "ask", "about": "why", "move": "left", "instead": "right"}
    for how in get_args(DetailName):
        yield {"do": "ask", "about": "detail", "how": how}
    for which in ({"kind": "vehicle", "nearest": True}, {"kind": "vehicle", "side": "ahead"}):
        yield {"do": "ask", "about": "other", "what": "going", "which": which}
        for moved in ({}, {"move": "left"}, {"move": "right"}, {"move": "stay"}):
            yield {"do": "ask", "about": "other", "what": "why", "which": which, **moved}


def _counted() -> Iterator[dict[str, Any]]:
    """What is counted over a drive: each event with each wish, and each condition."""
    asked = {"do": "ask", "about": "history"}
    conditions: list[dict[str, Any]] = [
        {"tick": 5},
        {"tick": 5, "until": 20},
        {"ticks": 10},
        {"ticks": 1},
        {"seconds": 2.5},
        *({"part": part} for part in get_args(PartName)),
        *({"parameter": "weather", "value": weather} for weather in get_args(Weather)),
        *({"parameter": "time_of_day", "value": time} for time in get_args(TimeOfDay)),
    ]
    crashes = {"what": "ended", "metric": "crashes"}
    for want in get_args(WantName):
        yield asked | {"what": "stopped", "want": want}
        yield asked | {"what": "moving", "want": want}
        yield asked | {"what": "stopped", "want": want, "kind": "vehicle", "lane": 2, "tick": 5}
        if want not in ("longest", "share"):
            yield asked | {"what": "lane_changes", "want": want, "move": "left"}
            yield asked | crashes | {"want": want, "kind": "pothole"}
    for each in conditions:
        yield asked | {"what": "stopped"} | each
        yield asked | {"what": "lanes_used"} | each
    for move in ("left", "right", "forward", "forward_left", "forward_right"):
        yield asked | {"what": "made", "move": move}
    yield asked | crashes | {"part": "session", "lane": 2}
    yield asked | {"what": "ended", "metric": "successes", "ticks": 100}
    yield asked | {"what": "lanes_used", "lane": 2}
    yield asked | {"what": "lanes_used", "lane": 2, "want": "whether"}
    yield asked | {"what": "shares", "part": "second_half"}
    yield asked | {"what": "closest_call", "tick": 5, "until": 20}


_NAMING_MORE = ("lane", "stays_free", "place_then")
"""What of the time ahead is not asked without a lane, a move or a tick."""


def _ahead_and_back() -> Iterator[dict[str, Any]]:
    for move in Move:
        yield {"do": "ask", "about": "outlook", "what": "safe", "move": move}
    for about in ("outlook", "blame", "planners", "sight", "world"):
        for what in WHATS[about]:
            if what not in ("safe", "coming", "difference", "detection", "parting", *_NAMING_MORE):
                yield {"do": "ask", "about": about, "what": what}
    yield {"do": "ask", "about": "sight", "what": "detection", "kind": "pedestrian"}
    yield {"do": "ask", "about": "sight", "what": "missed", "kind": "vehicle"}
    yield {"do": "ask", "about": "sight", "what": "belief", "kind": "pothole"}
    yield {"do": "ask", "about": "sight", "what": "sensor_fault", "value": "radar"}
    yield {"do": "ask", "about": "outlook", "what": "others", "kind": "vehicle"}
    yield {"do": "ask", "about": "outlook", "what": "crossing", "kind": "pedestrian"}
    yield {"do": "ask", "about": "outlook", "what": "danger", "kind": "vehicle"}
    yield {"do": "ask", "about": "outlook", "what": "lane", "lane": 3}
    yield {"do": "ask", "about": "outlook", "what": "others_next", "kind": "pedestrian"}
    spans: tuple[dict[str, Any], ...] = ({}, {"ticks": 3}, {"seconds": 2.5})
    for side, then in product((Move.LEFT, Move.RIGHT, Move.FORWARD), spans):
        yield {"do": "ask", "about": "outlook", "what": "stays_free", "move": side, **then}
    for then in (*spans[1:], {"tick": 15}):
        yield {"do": "ask", "about": "outlook", "what": "place_then", **then}
    yield {"do": "ask", "about": "outlook", "what": "worst", "ticks": 3}
    yield {"do": "ask", "about": "outlook", "what": "worst", "seconds": 2.5}
    yield {"do": "ask", "about": "outlook", "what": "coming", "ticks": 3}
    yield {"do": "ask", "about": "outlook", "what": "coming", "seconds": 2.5}
    for what in (*(what for what in WHATS["blame"] if what != "factor"), "own"):
        about = "planners" if what == "own" else "blame"
        yield {"do": "ask", "about": about, "what": what, "tick": 12}
    for what in ("here", "compare"):
        yield {"do": "ask", "about": "planners", "what": what, "planners": ["astar", "dijkstra"]}
        yield {"do": "ask", "about": "planners", "what": what, "tick": 12}
        yield {"do": "ask", "about": "planners", "what": what, "planners": ["astar", "dijkstra"], "tick": 12}
    yield {"do": "ask", "about": "planners", "what": "here", "ticks": 3}
    yield {"do": "ask", "about": "planners", "what": "difference", "planners": ["astar", "bfs"]}
    yield {"do": "ask", "about": "planners", "what": "parting", "planners": ["astar", "bfs"]}
    yield {"do": "ask", "about": "planners", "what": "method", "planner": "astar"}
    yield {"do": "ask", "about": "planners", "what": "character", "planner": "astar"}


def _rest() -> Iterator[dict[str, Any]]:
    for view in get_args(ViewName):
        yield {"do": "show", "view": view}
        yield {"do": "hide", "view": view}
    for kind in get_args(ChatKind):
        yield {"do": "chat", "kind": kind}
    yield {"do": "evaluate", "runs": 500, "planners": ["astar", "priority"]}
    yield {"do": "evaluate", "runs": 100, "planners": ["astar"], "road": "this"}
    yield {"do": "evaluate", "runs": 100, "vary": {"weather": ["fog", "clear"]}}
    yield {"do": "evaluate", "runs": 100, "scenario_name": "rush-hour"}
    yield {"do": "evaluate", "planners": ["astar", "dwa"], "scenario_name": "monday demo"}
    yield {"do": "evaluate", "planners": ["astar"], "map": ["potholes", "vehicles"]}
    yield {"do": "evaluate", "runs": 50, "map": ["vehicles", "barriers"]}
    yield {"do": "evaluation", "want": "better", "planners": ["astar", "priority"]}
    for want in ("progress", "cancel", "better"):
        yield {"do": "evaluation", "want": want}
    yield {"do": "find_worst", "runs": 200, "planner": "astar"}
    for goal in get_args(GoalName):
        if goal != "separates":
            yield {"do": "goal", "goal": goal}
    for goal in ("harder", "easier"):
        yield {"do": "goal", "goal": goal, "degree": "little"}
        yield {"do": "goal", "goal": goal, "degree": "lot"}
    yield {"do": "goal", "goal": "separates", "planners": ["astar", "priority"]}
    for style in styles():
        yield {"do": "style", "style": style}
    yield {"do": "ask", "about": "styles"}
    yield {"do": "ask", "about": "quiz"}
    yield from _rules()
    yield {"do": "advise", "hazard": "pothole", "distance_m": 20, "speed_kmh": 50}
    yield {"do": "save", "name": "monday demo"}
    yield {"do": "load", "name": "monday demo"}
    yield {"do": "record", "on": True}
    yield {"do": "record", "on": False}
    meaning = [{"do": "set", "parameter": "traffic", "value": "heavy"}]
    yield {"do": "teach", "phrase": "rush hour", "meaning": meaning}
    yield {"do": "forget", "phrase": "rush hour"}


def _rules() -> Iterator[dict[str, Any]]:
    """Rules with each kind of condition, and what switches them off."""
    car = [{"do": "add", "kind": "vehicle", "count": 1}]
    conditions: list[dict[str, Any]] = [
        *({"fact": fact} for fact in ("crash", "arrival", "stuck", "episode", "standing")),
        *({"fact": "move", "move": move} for move in ("left", "right", "lane_change")),
        {"fact": "after", "ticks": 20},
        {"fact": "after", "seconds": 2.5},
        {"fact": "tick", "tick": 50},
        {"fact": "row", "row": 10},
        {"fact": "lane", "lane": 3},
        {"fact": "lane", "lane": "left"},
        *({"fact": "near", bound: 10.0} for bound in ("closer_than_m", "within_m", "farther_than_m")),
        {"fact": "near", "kind": "pedestrian", "closer_than_m": 12.5},
        {"fact": "near", "kind": "vehicle", "within_m": 10.0},
        {"fact": "near", "kind": "barrier", "farther_than_m": 30.0},
        {"fact": "count", "kind": "vehicle", "at_least": 20},
        {"fact": "count", "kind": "pothole", "at_most": 3},
        {"fact": "count", "kind": "barrier", "at_least": 4, "at_most": 4},
        {"fact": "lane", "lane": "right", "no_longer": True},
        {"fact": "goal", "closer_than_m": 20.0},
        {"fact": "goal", "within_m": 20.0},
        {"fact": "near", "kind": "pothole", "side": "ahead", "within_m": 10.0},
        {"fact": "near", "side": "behind", "closer_than_m": 10.0},
        {"fact": "near", "side": "ahead", "farther_than_m": 10.0},
        *({"fact": "weather", "weather": weather} for weather in get_args(Weather)),
        *({"fact": "time_of_day", "time_of_day": time} for time in get_args(TimeOfDay)),
        {"fact": "weather", "weather": "rain", "no_longer": True},
        {"fact": "time_of_day", "time_of_day": "night", "no_longer": True},
    ]
    for condition in conditions:
        yield {"do": "trigger", "when": condition, "then": [{"do": "pause"}]}
        yield {"do": "trigger", "when": {"fact": "every", "ticks": 5}, "then": car, "until": condition}
    yield {"do": "trigger", "when": {"fact": "every", "seconds": 2.0}, "then": car, "times": 3}
    yield {"do": "trigger", "when": {"fact": "crash"}, "then": [{"do": "reset"}, *car], "times": 1}
    yield {"do": "ask", "about": "rules"}
    for which in ("all", "last", 2):
        yield {"do": "cancel", "which": which}
    yield {"do": "cancel", "place": 1}
    for doing in ("add", "pause", "reset"):
        yield {"do": "cancel", "doing": doing}
    for kind in ("pothole", "vehicle", "barrier", "pedestrian"):
        yield {"do": "cancel", "doing": "add", "kind": kind}
