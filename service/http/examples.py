"""Examples for the documentation. Those of requests are run as tests."""

from __future__ import annotations

from typing import Any

from service.problems import Ambiguous, DoesNotFit, Invalid, NotAvailable, NotUnderstood, ProblemError

Examples = dict[str, Any]

NEW_SESSION: Examples = {
    "default": {"summary": "A default road", "value": {}},
    "scenario": {
        "summary": "A road in words",
        "value": {"scenario": "simulate a highway with 10 potholes and 2 obstacles", "seed": 7},
    },
    "config": {
        "summary": "A road in figures",
        "value": {"name": "narrow", "config": {"columns": 6, "rows": 20, "potholes": 5}, "paused": True},
    },
    "layout": {
        "summary": "A road of a family",
        "value": {"config": {"layout": "maze", "pedestrians": 3}, "seed": 7},
    },
}
FORK: Examples = {
    "now": {"summary": "From here", "value": {}},
    "past": {
        "summary": "From a tick on, and changed",
        "value": {"at_tick": 2, "actions": [{"do": "add", "kind": "barrier", "count": 1}], "name": "blocked"},
    },
}
EVALUATION: Examples = {
    "sentence": {
        "summary": "In words",
        "value": {"text": "run 20 episodes with A* and compare with the rule planner"},
    },
    "figures": {
        "summary": "In figures",
        "value": {"runs": 20, "planners": ["rules", "bfs"], "config": {"potholes": 20}, "seed": 5},
    },
    "worst": {
        "summary": "Search for worlds that a planner fails",
        "value": {"find": "worst", "runs": 20, "planners": ["priority"]},
    },
}
REWIND: Examples = {"tick": {"summary": "Back to tick 2", "value": {"tick": 2}}}
SAID: Examples = {
    "add": {"summary": "Change the road", "value": {"text": "add five potholes"}},
    "several": {"summary": "Several at once", "value": {"text": "pause and add two cars"}},
    "try": {"summary": "Only try", "value": {"text": "add five potholes", "dry_run": True}},
    "ask": {"summary": "Ask", "value": {"text": "where are you?"}},
}
ACTIONS: Examples = {
    "add": {
        "summary": "Typed, no language involved",
        "value": {"actions": [{"do": "add", "kind": "pothole", "count": 2}]},
    },
    "several": {
        "summary": "All or nothing",
        "value": {"actions": [{"do": "pause"}, {"do": "set_count", "kind": "vehicle", "count": 12}]},
    },
}
CONFIG_PATCH: Examples = {
    "one": {"summary": "One setting", "value": {"courtesy": 0.5}},
    "several": {
        "summary": "Several, done together",
        "value": {"planner": "astar", "preferences": ["avoid_potholes"], "traffic": "heavy"},
    },
}
STEP: Examples = {"three": {"summary": "Three ticks", "value": {"ticks": 3}}}
QUESTION: Examples = {
    "status": {"summary": "Where it is", "value": {"question": "where are you?"}},
    "help": {"summary": "What can be said", "value": {"question": "what can I say?"}},
}
ADVICE: Examples = {
    "figures": {
        "summary": "In figures",
        "value": {"hazard": "pothole", "distance_m": 30, "speed_kmh": 40, "weather": "rain"},
    },
    "sentence": {"summary": "As a sentence", "value": {"text": "pothole 2m ahead, speed 40 km/h"}},
}
TEXT: Examples = {
    "parse": {"summary": "Understand only", "value": {"text": "add five potholes and two cars"}}
}

_DETAILS: dict[type[ProblemError], tuple[str, dict[str, Any]]] = {
    Invalid: (
        "ticks: input should be greater than or equal to 1.",
        {"errors": [{"field": "ticks", "message": "input should be greater than or equal to 1"}]},
    ),
    DoesNotFit: (
        "300 potholes do not fit: 198 cells are free between start and goal.",
        {
            "errors": [
                {
                    "field": "actions.0.count",
                    "message": "300 potholes do not fit: 198 cells are free between start and goal.",
                }
            ]
        },
    ),
    NotAvailable: (
        "Asking what if is not available yet.",
        {"errors": [{"field": "actions.0", "message": "Asking what if is not available yet."}]},
    ),
    NotUnderstood: (
        "I do not understand: order, pizza.",
        {
            "unparsed": ["order", "pizza"],
            "understood": ["add five potholes"],
            "suggestions": ["add five potholes", "add five vehicles"],
        },
    ),
    Ambiguous: (
        "Do you mean the playback or the vehicle?",
        {
            "choices": [
                {
                    "text": "slow the simulation down",
                    "actions": [{"do": "adjust", "parameter": "playback_speed", "direction": "down"}],
                },
                {
                    "text": "drive slower",
                    "actions": [{"do": "adjust", "parameter": "target_speed_kmh", "direction": "down"}],
                },
            ]
        },
    ),
}


def problem_example(kind: type[ProblemError]) -> dict[str, Any]:
    """A problem of a kind as it may be answered."""
    detail, more = _DETAILS.get(kind, (f"{kind.title}.", {}))
    document = {
        "type": f"/problems/{kind.slug}",
        "title": kind.title,
        "status": kind.status,
        "detail": detail,
    }
    return document | {"errors": []} | more
