"""Dear requests, each with the largest legal values: the rows of `tools.dear_requests`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

ROADS: Final[Mapping[str, dict[str, Any]]] = {
    "plain": {"planner": "rules"},
    "search": {"planner": "astar"},
    "large": {"planner": "rules", "columns": 64, "rows": 156, "pedestrians": 300},
    "star": {"planner": "astar", "columns": 64, "rows": 156, "pedestrians": 300},
    "exact": {"planner": "bfs", "columns": 64, "rows": 156, "pedestrians": 300},
    "long": {"planner": "astar", "columns": 19, "rows": 512, "pedestrians": 300},
}
"""The roads of the sessions that are asked, by name."""

STEPS_BEFORE: Final[Mapping[str, int]] = {
    "plain": 1_000,
    "search": 300,
    "large": 300,
    "exact": 100,
    "star": 20,
}
"""Ticks that each session has run; those that are left out none."""

LONG_QUESTION: Final = ("what if you had gone left and the car in lane 2 had braked and you had stayed " * 6)[
    :490
]


@dataclass(frozen=True, slots=True)
class Case:
    """One request, of ten clients at once."""

    name: str
    method: str
    path: str
    """below `/api/v1`; `{plain}` and so on are the ids of sessions"""
    body: Any = None
    hang_up_s: float | None = None
    """the clients go after so long, and ask again"""


def _session(road: str, call: str, body: Any = None, **more: Any) -> Case:
    shown = "" if body is None else " " + json.dumps(body)[:60]
    method = "GET" if body is None else "POST"
    return Case(f"{road}: {call}{shown}", method, f"/sessions/{{{road}}}/{call}", body, **more)


def _recording(road: str, tick: int, entries: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    config = {**ROADS[road], "seed": 1}
    form = {"format": "roadtalk-recording", "version": 1, "config": config, "entries": entries or []}
    return {"recording": {**form, "tick": tick, "digest": "0" * 32}}


def _entry(number: int, tick: int, action: dict[str, Any]) -> dict[str, Any]:
    return {"sequence": number, "tick": tick, "text": None, "actions": [action]}


def _undos(count: int) -> list[dict[str, Any]]:
    first = _entry(1, 0, {"do": "add", "kind": "pothole", "count": 1})
    back = ({"do": "undo", "steps": 1}, {"do": "redo", "steps": 1})
    return [first, *(_entry(number, 900, back[number % 2]) for number in range(2, count + 2))]


STEP: Final = {"ticks": 1_000}
EMPTY: Final = {"do": "remove", "kind": "everything", "count": "all"}

CASES: Final[tuple[Case, ...]] = (
    *(_session(road, "step", STEP) for road in ROADS),
    _session("search", "commands", {"text": "step 1000"}),
    _session("exact", "commands", {"text": "step 1000"}),
    _session("star", "step", STEP, hang_up_s=0.3),
    _session("search", "actions", {"actions": [{"do": "step", "ticks": 500}] * 2}),
    _session("exact", "actions", {"actions": [{"do": "set", "parameter": "pedestrians", "value": 300}] * 8}),
    _session("exact", "actions", {"actions": [EMPTY, {"do": "undo"}, {"do": "redo"}, {"do": "undo"}]}),
    _session("search", "actions", {"actions": [{"do": "undo", "steps": "all"}]}),
    _session("search", "actions", {"actions": [{"do": "redo", "steps": "all"}]}),
    _session("large", "rewind", {"tick": 0}),
    _session("exact", "forks", {"at_tick": 50, "actions": [{"do": "step", "ticks": 1_000}]}),
    *(
        _session(road, "ask", {"question": question})
        for road in ("star", "exact")
        for question in (
            "why?",
            "what if you had gone left?",
            "will you arrive?",
            "compare the planners",
            "what would make you arrive?",
            LONG_QUESTION,
        )
    ),
    _session("large", "ask", {"question": "how often will you crash?"}),
    _session("star", "commands", {"text": "make the road impossible"}),
    *(
        _session(road, call)
        for road in ("star", "exact", "plain")
        for call in (
            "decisions?limit=200",
            "moments?limit=64",
            "regret?limit=200",
            "film?fps=10&side=1080&from=0&to=20",
        )
    ),
    _session("star", "decisions/0"),
    _session("star", "frame"),
    _session("star", "forecast?ticks=16&tick=0"),
    _session("exact", "timeline?limit=1000"),
    _session("plain", "timeline?limit=1000"),
    _session("exact", "state?tick=1"),
    _session("exact", "link"),
    _session("plain", "recording"),
    _session("star", "counterfactual", {"at_tick": 3, "move": "stay", "ticks": 500}),
    _session("exact", "counterfactual", {"actions": [EMPTY], "ticks": 500}),
    Case("recording, 200,000 ticks", "POST", "/sessions", _recording("plain", 200_000)),
    Case("recording, 200,000 ticks, astar", "POST", "/sessions", _recording("search", 200_000)),
    Case("the same, senders hang up", "POST", "/sessions", _recording("search", 200_000), hang_up_s=0.1),
    Case("recording, 200,000 ticks, large, astar", "POST", "/sessions", _recording("star", 200_000)),
    Case("recording, 400 undos, astar", "POST", "/sessions", _recording("search", 900, _undos(400))),
    Case("recording, 5,000 undos, astar", "POST", "/sessions", _recording("search", 900, _undos(5_000))),
    Case("a large road", "POST", "/sessions", {"config": {**ROADS["star"], "seed": 3}, "paused": True}),
    Case(
        "a large road that can be driven",
        "POST",
        "/sessions",
        {"config": {**ROADS["exact"], "solvable": True, "layout": "maze", "seed": 3}, "paused": True},
    ),
    Case("parse 490 characters", "POST", "/parse", {"text": LONG_QUESTION}),
    Case("parse rubbish", "POST", "/parse", {"text": "zxc vbn asd qwe " * 30}),
    Case("complete 210 characters", "GET", f"/language?prefix={LONG_QUESTION[:210].replace(' ', '+')}"),
    Case("complete in a session", "GET", "/language?prefix=add+three+&session={star}"),
    Case("the language", "GET", "/language"),
)
