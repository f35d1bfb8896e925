"""Walks: what is done to a service, drawn from a seed, as plain values that can be printed and left out.

Nothing in a walk refers to what came of what went before: sessions are counted round, ticks are shares of the
time there is. So any part of a walk is a walk.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

Op: TypeAlias = tuple[Any, ...]
Json: TypeAlias = dict[str, Any]

DEV = Path(__file__).parents[1] / "grammar" / "data" / "dev.jsonl"
KINDS = ("pothole", "vehicle", "barrier", "pedestrian")
MOVES = ("forward", "left", "right", "forward_left", "forward_right", "stay")
PLANNERS = ("rules", "rules", "priority", "astar", "dijkstra", "bfs")
NAMES = ("a", "rush hour", "the third")
PHRASES = ("zanzibar", "make it quibble", "brillig morning")
SETTINGS: dict[str, tuple[Any, ...]] = {
    "planner": ("rules", "priority", "astar", "dijkstra", "bfs"),
    "courtesy": (0.0, 0.4, 1.0),
    "attentive": (0.0, 0.5, 1.0),
    "safety_buffer": (0, 1, 2),
    "step_seconds": (0.2, 0.5, 1.0),
    "spawn_probability": (0.0, 0.5, 1.0),
    "pothole_probability": (0.0, 0.3),
    "traffic": ("none", "light", "normal", "heavy"),
    "columns": (4, 6),
    "rows": (8, 12),
    "seed": (3, 12345),
    "playback_speed": (0.25, 1, 2, 4, 32),
}
LAYOUTS = ("walls", "narrows", "dead_ends", "crossing", "maze")
WISHES = ("avoid_potholes", "smooth_ride", "fastest", "cautious", "balanced")
JOBS = frozenset(("evaluate", "evaluation", "find_worst"))
"""What works in the background, in processes of its own."""
STAYING = frozenset(("resume",))
"""What lets time pass by itself, and is left out where the clock is a real one."""


class Planned:
    """One walk being drawn."""

    def __init__(self, seed: int, *, by_hand: bool) -> None:
        """`by_hand`: whether the clock is moved by the walk, so that sessions may run."""
        self.dice = Random(seed)
        self.by_hand = by_hand

    def ops(self, count: int) -> list[Op]:
        """Two sessions, and what is done to them."""
        dice = self.dice
        ops: list[Op] = [("make", self.config(), self.by_hand and dice.random() < 0.4) for _ in range(2)]
        many: list[tuple[float, Callable[[], Op]]] = [
            (30, self.act),
            (10, lambda: ("act", self.which(), [self.step()], "typed")),
            (4, lambda: ("both", self.which(), self.actions(3), self.actions(3))),
            (6, lambda: ("text", self.which(), self.dice.choice(sentences()))),
            (4, lambda: ("patch", self.which(), self.patch())),
            (4, lambda: ("rewind", self.which(), self.share())),
            (7, lambda: ("fork", self.which(), self.share(), self.actions(2) if self.rarely() else [])),
            (2, lambda: ("record", self.which())),
            (2, lambda: ("link", self.which(), self.share())),
            (1, lambda: ("delete", self.which())),
            (2, lambda: ("make", self.config(), False)),
            (4, lambda: ("look", self.which(), self.share())),
            (4, lambda: ("why", self.which(), self.share(), dice.choice((None, *MOVES)))),
            (3, lambda: ("otherwise", self.which(), self.share(), self.actions(2))),
            (2, lambda: ("teach", dice.choice(PHRASES), self.actions(2))),
            (1, lambda: ("forget", dice.choice(PHRASES))),
            (2, lambda: ("text", self.which(), dice.choice(PHRASES))),
            (4, lambda: ("kill",)),
            (2, lambda: ("stop",)),
            (7, lambda: ("watch", self.which())),
        ]
        if self.by_hand:
            many += [
                (14, lambda: ("tick", dice.choice((1, 1, 2, 3, 7, 15)))),
                (4, lambda: ("sleep", self.which())),
                (5, lambda: ("snapshot", self.which())),
                (1, lambda: ("drop",)),
            ]
        weights = [weight for weight, _ in many]
        makers = [maker for _, maker in many]
        return ops + [dice.choices(makers, weights)[0]() for _ in range(count)]

    def which(self) -> int:
        return self.dice.randrange(12)

    def share(self) -> float:
        return self.dice.choice((0.0, 1.0, *(round(self.dice.random(), 3) for _ in range(4))))

    def rarely(self) -> bool:
        return self.dice.random() < 0.3

    def config(self) -> Json:
        dice = self.dice
        parts: Json = {
            "columns": dice.randint(3, 8),
            "rows": dice.choice((5, 8, 11, 14)),
            "seed": dice.randrange(1000),
            "courtesy": dice.choice((0.0, 0.0, 0.5)),
            "reset_delay_s": dice.choice((0.0, 1.0, 2.0)),
            "pothole_probability": dice.choice((0.1, 0.4)),
        }
        if self.rarely():
            parts["pedestrians"] = dice.randint(0, 3)
        if self.rarely():
            parts["preferences"] = dice.sample(("avoid_potholes", "smooth_ride", "cautious"), 2)
        if self.rarely():
            parts |= {"potholes": dice.randint(0, 3), "vehicles": dice.randint(0, 3)}
        if self.rarely() and self.rarely():
            parts["solvable"] = True
        if self.rarely():
            parts["safety_buffer"] = dice.randint(0, 3)
        if not self.rarely():
            parts["planner"] = dice.choice(PLANNERS)
        return parts | self.rules()

    def rules(self) -> Json:
        """By which rules it goes: mostly those of today, rarely those of before, or some of them."""
        dice = self.dice
        if dice.random() < 0.15:
            return {"rules": 1}
        parts: Json = {}
        if self.rarely():
            parts["attentive"] = dice.choice((0.0, 0.5))
        if dice.random() < 0.15:
            parts["collision"] = "cell"
        if dice.random() < 0.15:
            parts["repetition"] = False
        if dice.random() < 0.15:
            parts["layout"] = dice.choice(LAYOUTS)
        return parts

    def act(self) -> Op:
        how = self.dice.choice(
            ("typed", "typed", "said", "said", "said", "dry", "keyed", "socket", "stale", "matched")
        )
        return ("act", self.which(), self.actions(4), how)

    def actions(self, most: int) -> list[Json]:
        found = [self.action() for _ in range(self.dice.choice((1, 1, 1, 2, 2, 3, most)))]
        if self.by_hand:
            return found
        return [action for action in found if action["do"] not in STAYING] or [{"do": "step", "ticks": 2}]

    def action(self) -> Json:
        dice = self.dice
        kind = dice.choice(KINDS)
        match dice.choices(
            ("add", "remove", "set_count", "step", "undo", "redo", "back", "drive", "mode", "set", "adjust",
             "prefer", "pause", "scenario", "reset", "name", "nothing", "never"),
            (14, 8, 4, 16, 12, 8, 5, 4, 3, 8, 4, 3, 6, 2, 3, 7, 3, 1),
        )[0]:  # fmt: skip
            case "add":
                return self.placed({"do": "add", "kind": kind, "count": dice.choice((1, 1, 1, 2, 3, 5))})
            case "remove":
                if self.rarely():
                    what, count = dice.choice((("everything", "all"), (kind, "all")))
                    return self.placed({"do": "remove", "kind": what, "count": count})
                return self.placed({"do": "remove", "kind": kind, "count": dice.choice((1, 1, 2))})
            case "set_count":
                return {"do": "set_count", "kind": kind, "count": dice.choice((0, 1, 3, 5, 8, 60))}
            case "step":
                return self.step()
            case "undo" | "redo" as do:
                return {"do": do}
            case "back":
                return {"do": "rewind", "ticks": dice.choice((1, 2, 5, 12))}
            case "drive":
                return {"do": "drive", "move": dice.choice(MOVES)}
            case "mode":
                return {"do": "mode", "mode": dice.choice(("manual", "auto", "auto"))}
            case "set":
                name = dice.choice(tuple(SETTINGS))
                return {"do": "set", "parameter": name, "value": dice.choice(SETTINGS[name])}
            case "adjust":
                name = dice.choice(tuple(SETTINGS))
                how = dice.choice(({"direction": "up"}, {"direction": "down"}, {"factor": 2.0}, {"by": 1.0}))
                return {"do": "adjust", "parameter": name, **how}
            case "prefer":
                return {"do": "prefer", "preference": dice.choice(WISHES)}
            case "pause":
                return {"do": dice.choice(("pause", "resume"))}
            case "scenario":
                return {"do": "scenario", **self.scenario()}
            case "reset":
                return {"do": "reset"}
            case "name":
                return {"do": dice.choice(("save", "load")), "name": dice.choice(NAMES)}
            case "nothing":
                about = dice.choice(("why", "status", "metrics", "scene", "next", "confidence"))
                return dice.choice(({"do": "ask", "about": about}, {"do": "show", "view": "plan"}))
            case _:
                return dice.choice(
                    (
                        {"do": "record", "on": True},
                        {"do": "set", "parameter": "weather", "value": "rain"},
                        {"do": "add", "kind": "av", "count": 1},
                        {"do": "step", "ticks": 1_500},
                        {"do": "load", "name": "never saved"},
                    )
                )

    def step(self) -> Json:
        return {"do": "step", "ticks": self.dice.choice((1, 1, 2, 3, 5, 9, 20))}

    def placed(self, action: Json) -> Json:
        dice = self.dice
        if dice.random() < 0.5:
            return action
        where: Json = dice.choice(
            (
                {"lane": dice.choice(("left", "middle", "right", 2))},
                {"side": dice.choice(("ahead", "left", "right", "behind"))},
                {"side": "ahead", "cells": dice.choice((1, 1, 2, 3))},
                {"cell": [dice.randrange(4), dice.randrange(1, 7)]},
                {"row": dice.randrange(1, 6)},
                {"side": "ahead", "distance_m": 15.0},
            )
        )
        if action["do"] == "remove" and action["count"] == 1 and self.rarely():
            name = f"{action['kind']}-{dice.randint(1, 12)}"
            where = dice.choice(({"nearest": True}, {"id": name}))
        return {**action, "where": where}

    def scenario(self) -> Json:
        dice = self.dice
        parts: Json = {
            "road": dice.choice(("highway", "city", "rural")),
            "potholes": dice.randrange(5),
            "vehicles": dice.randrange(5),
            "traffic": dice.choice(("light", "heavy")),
            "planner": dice.choice(("rules", "priority", "astar")),
            "pedestrians": dice.randrange(3),
        }
        return {name: value for name, value in parts.items() if self.rarely()}

    def patch(self) -> Json:
        names = self.dice.sample([name for name in SETTINGS if name != "playback_speed"], 2)
        parts: Json = {name: self.dice.choice(SETTINGS[name]) for name in names}
        if self.rarely():
            parts["preferences"] = self.dice.choice(([], ["cautious"], ["smooth_ride", "fastest"]))
        return parts


@cache
def sentences() -> tuple[str, ...]:
    """The labelled sentences of the language's own tests, but for those that start or end jobs."""
    labelled = [json.loads(line) for line in DEV.read_text().splitlines()]
    return tuple(each["text"] for each in labelled if JOBS.isdisjoint(_verbs(each)))


def _verbs(labelled: Json) -> set[str]:
    return {action["do"] for action in labelled.get("actions", ())}


def walk(seed: int, length: int, *, by_hand: bool = True) -> list[Op]:
    """The walk of a seed."""
    return Planned(seed, by_hand=by_hand).ops(length)
