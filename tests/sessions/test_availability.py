"""Every action of the language contract is either done or refused in words; none falls through."""

from __future__ import annotations

from typing import Any, get_args

import pytest

from service import actions as contract
from service.grammar import Language
from service.grammar.parse_types import Refused, Understood
from service.problems import NotAvailable
from service.sessions.availability import refusal_of
from service.sessions.transaction import Transaction
from service.sessions.undo_stack import UndoStack
from sim.config import Config
from sim.session.timeline import Timeline

OFFERED: list[dict[str, Any]] = [
    {"do": "trigger", "when": {"fact": "crash"}, "then": [{"do": "pause"}]},
    {"do": "cancel", "which": "all"},
    {"do": "add", "kind": "pothole", "count": 1},
    {"do": "remove", "kind": "everything", "count": "all"},
    {"do": "set_count", "kind": "vehicle", "count": 3},
    {
        "do": "scenario",
        "road": "city",
        "weather": "clear",
        "time_of_day": "day",
        "planner": "priority",
        "avs": 0,
    },
    {"do": "reset"},
    {"do": "mode", "mode": "manual"},
    {"do": "drive", "move": "left"},
    {"do": "show", "view": "log"},
    {"do": "hide", "view": "path"},
    {"do": "pause"},
    {"do": "resume"},
    {"do": "step", "ticks": 2},
    {"do": "undo"},
    {"do": "redo"},
    {"do": "rewind", "ticks": 2},
    {"do": "save", "name": "monday"},
    {"do": "load", "name": "monday"},
    {"do": "ask", "about": "why"},
    {"do": "ask", "about": "why_not", "move": "left"},
    {"do": "ask", "about": "status"},
    {"do": "ask", "about": "what_if", "change": [{"do": "remove", "kind": "pothole", "count": 1}]},
    {"do": "ask", "about": "what_if", "change": [{"do": "show", "view": "log"}]},
    {"do": "ask", "about": "next"},
    {"do": "ask", "about": "metrics", "metric": "crashes"},
    {"do": "set", "parameter": "planner", "value": "astar"},
    {"do": "adjust", "parameter": "safety_buffer", "by": 1},
    {"do": "set", "parameter": "playback_speed", "value": "max"},
    {"do": "adjust", "parameter": "playback_speed", "factor": 2},
    {"do": "prefer", "preference": "cautious"},
    {"do": "ask", "about": "help"},
    {"do": "ask", "about": "scene", "kind": "pothole"},
    {"do": "ask", "about": "confidence"},
    {"do": "ask", "about": "maintenance"},
    {"do": "ask", "about": "what_if", "change": [{"do": "drive", "move": "stay"}], "count": 3},
    {"do": "ask", "about": "outlook", "what": "risk"},
    {"do": "ask", "about": "outlook", "what": "coming", "ticks": 3},
    {"do": "ask", "about": "history", "what": "waited"},
    {"do": "ask", "about": "history", "what": "passed", "kind": "pedestrian"},
    {"do": "ask", "about": "history", "what": "ended", "metric": "crashes", "want": "list"},
    {"do": "ask", "about": "history", "what": "stopped", "kind": "vehicle", "part": "second_half"},
    {"do": "ask", "about": "planners", "what": "often"},
    {"do": "ask", "about": "sight", "what": "range"},
    {"do": "ask", "about": "world", "what": "chance"},
    {"do": "drop"},
    {"do": "chat", "kind": "thanks"},
    {"do": "goal", "goal": "surprise"},
    {"do": "style", "style": "gentle"},
    {"do": "move", "kind": "barrier", "count": 1, "to": {"lane": 3}},
    {"do": "swap", "first": {"kind": "barrier"}, "second": {"kind": "vehicle"}},
    {"do": "replace", "kind": "barrier", "count": 1, "by": "vehicle"},
    {"do": "copy", "kind": "barrier", "count": 1},
    {"do": "evaluate", "runs": 5},
    {"do": "evaluation", "want": "progress"},
    {"do": "evaluation", "want": "cancel"},
    {"do": "evaluation", "want": "better", "planners": ["astar", "priority"]},
    {"do": "find_worst"},
    {"do": "advise", "hazard": "pothole", "distance_m": 2, "speed_kmh": 40},
    {"do": "set", "parameter": "weather", "value": "rain"},
    {"do": "set", "parameter": "time_of_day", "value": "night"},
    {"do": "set", "parameter": "sensor", "value": "camera"},
    {"do": "set", "parameter": "detection_sensitivity", "value": 0.7},
    {"do": "set", "parameter": "sensor_range_m", "value": 40},
    {"do": "set", "parameter": "sensor_noise", "value": 0.1},
    {"do": "adjust", "parameter": "false_positive_rate", "direction": "up"},
    {"do": "ask", "about": "what_if", "change": [{"do": "set", "parameter": "sensor_noise", "value": 0.2}]},
    {"do": "scenario", "weather": "fog", "time_of_day": "dusk", "sensor": "fusion"},
    {"do": "ask", "about": "what_if", "change": [{"do": "set", "parameter": "weather", "value": "rain"}]},
]
BESIDE_SESSIONS = {"teach", "forget"}
"""Offered, but done to a phrasebook and to no session (test_teaching)."""
REFUSED: list[dict[str, Any]] = [
    {"do": "set", "parameter": "target_speed_kmh", "value": 40},
    {"do": "show", "view": "sensors"},
    {"do": "hide", "view": "sensors"},
    {"do": "evaluate", "planners": ["astar", "dwa"]},
    {"do": "evaluate", "scenario": {"planner": "rl"}},
    {"do": "find_worst", "planner": "dwa"},
    {"do": "record", "on": True},
    {"do": "add", "kind": "av", "count": 1},
    {"do": "remove", "kind": "av", "count": "all"},
    {"do": "set_count", "kind": "av", "count": 2},
    {"do": "move", "kind": "av", "count": 1, "to": {"lane": 3}},
    {"do": "swap", "first": {"kind": "av"}, "second": {"kind": "vehicle"}},
    {"do": "replace", "kind": "vehicle", "count": 1, "by": "av"},
    {"do": "copy", "kind": "av", "count": 1},
    *({"do": "scenario", key: value} for key, value in (
        ("planner", "rl"), ("avs", 1),
    )),
    {"do": "ask", "about": "what_if", "change": [{"do": "set", "parameter": "target_speed_kmh", "value": 9}]},
    {"do": "ask", "about": "what_if", "change": [{"do": "pause"}, {"do": "undo"}]},
    {"do": "ask", "about": "what_if", "change": [{"do": "rewind", "ticks": 2}]},
]  # fmt: skip


def test_the_lists_here_hold_every_action_there_is() -> None:
    verbs = {kind.__dataclass_fields__["do"].default for kind in get_args(get_args(contract.Action)[0])}
    assert {action["do"] for action in OFFERED + REFUSED} | BESIDE_SESSIONS == verbs


@pytest.mark.parametrize("action", OFFERED, ids=str)
def test_what_is_offered_is_done(action: dict[str, Any]) -> None:
    (loaded,) = contract.load([action])
    assert refusal_of(loaded) is None
    transaction = Transaction(Timeline(Config(seed=2)), False, UndoStack())
    transaction.perform(1, contract.load([{"do": "add", "kind": "barrier", "count": 1}]))
    if action["do"] == "redo":
        transaction.perform(2, contract.load([{"do": "undo"}]))
    if action["do"] == "rewind":
        transaction.perform(2, contract.load([{"do": "step", "ticks": 2}]))
    if action["do"] == "cancel":
        transaction.perform(2, contract.load([OFFERED[0]]))
    if action["do"] == "load":
        transaction.perform(2, contract.load([{"do": "save", "name": "monday"}]))
    (fact,) = transaction.perform(3, (loaded,))
    assert fact is not None


def test_units_are_said_as_people_say_them() -> None:
    said = {"do": "set", "parameter": "target_speed_kmh", "value": 50}
    assert refusal_of(contract.load([said])[0]) == "Changing the target speed (50 km/h) is not available yet."


@pytest.mark.parametrize("action", REFUSED, ids=str)
def test_what_is_not_offered_says_so(action: dict[str, Any]) -> None:
    transaction = Transaction(Timeline(Config(seed=2)), False, UndoStack())
    before = transaction.timeline.state
    with pytest.raises(NotAvailable, match=r"^([A-Z].* not available yet|I cannot ).*\.$") as raised:
        transaction.perform(1, contract.load([action]))
    assert raised.value.errors[0].field.startswith("actions.0")
    assert transaction.timeline.state == before


def test_nothing_is_suggested_that_is_not_offered() -> None:
    language = Language.load(offered=lambda action: refusal_of(action) is None)
    for said in ("add five potholes and order pizza", "make it rain cats", "avoid potholes or else", "zebra"):
        parse = language.parse(said)
        assert isinstance(parse, Refused), said
        for suggestion in parse.suggestions:
            meant = language.parse(suggestion)
            assert isinstance(meant, Understood)
            assert all(refusal_of(action) is None for action in meant.actions), suggestion
    assert language.parse("add five potholes and order pizza").suggestions  # type: ignore[union-attr]
