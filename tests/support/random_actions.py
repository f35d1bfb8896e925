"""Random action lists, anything that the contract allows: what the way back through the grammar is tried on.

python -m tests.support.random_actions 10000
"""

from __future__ import annotations

import sys
from random import Random
from typing import Any, get_args

from service.actions import Action, FactName, Term, dump, load
from service.grammar import Language, Understood
from service.grammar.sentences import Unsayable
from service.styles import styles
from sim.actions import GoalName
from sim.planner_names import BUILT_IN, PROMISED

KINDS = ("pothole", "vehicle", "barrier", "pedestrian", "av")
MOVES = ("forward", "left", "right", "forward_left", "forward_right", "stay")
PLANNERS = (*BUILT_IN, *PROMISED)
CHOICES: dict[str, tuple[str, ...]] = {
    "weather": ("clear", "rain", "fog", "snow"),
    "time_of_day": ("day", "dusk", "night", "dawn"),
    "traffic": ("none", "light", "normal", "heavy"),
    "planner": PLANNERS,
    "sensor": ("perfect", "camera", "lidar", "radar", "fusion"),
    "dynamics": ("grid", "continuous"),
}
WHOLE = ("safety_buffer", "columns", "rows", "seed")
NUMBERS = (
    "playback_speed",
    "target_speed_kmh",
    "step_seconds",
    "spawn_probability",
    "pothole_probability",
    "courtesy",
    "sensor_noise",
    "detection_sensitivity",
    "false_positive_rate",
    "sensor_latency",
    "slip_probability",
    "traffic_by_hour",
    "sensor_range_m",
)
PLAIN = (
    *("pause", "resume", "reset", "undo", "redo", "step", "rewind", "mode", "drive", "show", "hide"),
    *("prefer", "save", "load", "record", "goal", "style"),
)
GOALS = get_args(GoalName)
VIEWS = ("road", "schematic", "occupancy", "plan", "log", "potholes", "sensors", "path", "metrics")
METRICS = ("crashes", "successes", "success_rate", "steps", "moves", "distance")
NAMES = (
    "monday demo",
    "five cars",
    "rush hour, then night",
    'the "big" one',
    "a \\ b",
    "Straße 7",
    "it's_me",
    "x",
    "please",
    "and then, remove everything.",
)


class Maker:
    """Makes random actions as JSON values."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)

    def actions(self, most: int = 4) -> list[dict[str, Any]]:
        """A list that one utterance may hold."""
        if self.chance(0.05):
            return [self.teaching()]
        return [self.action() for _ in range(self.random.randint(1, most))]

    def teaching(self) -> dict[str, Any]:
        phrase = self.random.choice(NAMES)
        if self.chance(0.3):
            return {"do": "forget", "phrase": phrase}
        return {
            "do": "teach",
            "phrase": phrase,
            "meaning": [self.action() for _ in range(self.random.randint(1, 3))],
        }

    def action(self, *, questions: bool = True) -> dict[str, Any]:
        makers = [
            self.add,
            self.remove,
            self.set_count,
            self.rearranged,
            self.scenario,
            self.set,
            self.adjust,
            self.plain,
            self.evaluation,
            *([self.ask] if questions else []),
        ]
        return self.random.choice(makers)()

    def add(self) -> dict[str, Any]:
        return self.optional({"do": "add", "kind": self.pick(KINDS), "count": self.count()}, where=self.where)

    def remove(self) -> dict[str, Any]:
        if self.chance(0.15):
            return self.optional({"do": "remove", "kind": "everything", "count": "all"}, where=self.where)
        kind = self.pick(KINDS)
        if self.chance(0.2):
            where = {"id": f"{kind}-{self.random.randint(1, 99)}"}
            return {"do": "remove", "kind": kind, "count": 1, "where": where}
        count: Any = "all" if self.chance(0.3) else self.count()
        action = self.optional({"do": "remove", "kind": kind, "count": count}, where=self.where)
        if "id" in action.get("where", {}):
            action["where"]["id"] = f"{kind}-{self.random.randint(1, 99)}"
        return action

    def set_count(self) -> dict[str, Any]:
        return {"do": "set_count", "kind": self.pick(KINDS), "count": self.random.choice((0, self.count()))}

    def rearranged(self) -> dict[str, Any]:
        """Something done to things that are on the road."""
        kind, other = self.random.sample(KINDS[:4], 2)
        match self.random.randint(0, 5):
            case 0:
                return {"do": "move", **self.meant(kind), "to": self.goal()}
            case 1:
                side = self.pick(("left", "right", "ahead", "behind"))
                by = {"side": side, "cells": self.random.choice((1, self.random.randint(2, 60)))}
                return {"do": "move", **self.meant(kind), "by": by}
            case 2:
                return {"do": "swap", "first": self.one(kind), "second": self.one(other)}
            case 3:
                return {"do": "replace", **self.meant(kind), "by": other}
            case 4:
                copied = self.meant(kind)
                if copied["count"] != "all" and "where" not in copied:
                    copied["where"] = {"nearest": True}
                if "nearest" not in copied.get("where", {}) and copied["count"] not in (1, "all"):
                    copied["count"] = "all"
                return self.optional({"do": "copy", **copied}, to=self.goal)
            case _:
                if self.chance(0.5):
                    return self.optional({"do": "remove", "kind": kind, "count": "half"}, where=self.lanes)
                stay = self.random.choice(
                    ({"nearest": True}, {"lane": "left"}, {"rows": [2, 7]}, {"id": f"{kind}-3"})
                )
                return {"do": "remove", "kind": kind, "count": "all", "except": stay}

    def meant(self, kind: str) -> dict[str, Any]:
        """Things that are on the road: all of a kind, the nearest ones, so many, or one by its id."""
        match self.random.randint(0, 3):
            case 0:
                return self.optional({"kind": kind, "count": "all"}, where=self.lanes)
            case 1:
                return {"kind": kind, "count": self.random.randint(1, 9), "where": {"nearest": True}}
            case 2:
                return {"kind": kind, "count": 1, "where": {"id": f"{kind}-{self.random.randint(1, 99)}"}}
            case _:
                return self.optional({"kind": kind, "count": self.count()}, where=self.lanes)

    def one(self, kind: str) -> dict[str, Any]:
        """One thing of two that change places."""
        wheres = ({"nearest": True}, {"id": f"{kind}-7"}, {"lane": 2})
        return self.optional({"kind": kind}, where=lambda: self.random.choice(wheres))

    def lanes(self) -> dict[str, Any]:
        """Lanes or rows from one to another, or a place seen from a thing."""
        low, high = sorted(self.random.sample(range(1, 60), 2))
        kind = self.pick(KINDS[:4])
        of = {"id": f"{kind}-5"} if self.chance(0.3) else {"kind": kind, "nearest": True}
        side = self.pick(("ahead", "behind", "left", "right", "beside"))
        return self.random.choice(
            ({"lanes": [low, high]}, {"rows": [low, high]}, {"side": side, "of": of}, {"side": "beside"})
        )

    def goal(self) -> dict[str, Any]:
        """Where things are to be."""
        return self.random.choice(
            (
                self.lanes(),
                {"lane": self.random.choice(("left", "middle", "right", 4))},
                {"row": 9},
                {"cell": [2, 11]},
                {"lane": 3, "row": 8},
                {"side": self.pick(("ahead", "behind")), "cells": self.random.randint(1, 9)},
            )
        )

    def scenario(self) -> dict[str, Any]:
        return {"do": "scenario", **self.parts()}

    def parts(self) -> dict[str, Any]:
        parts: dict[str, Any] = {}
        for key in ("weather", "time_of_day", "traffic", "planner", "sensor"):
            if self.chance(0.3):
                parts[key] = self.pick(CHOICES[key])
        if self.chance(0.3):
            parts["road"] = self.pick(("highway", "city", "rural"))
        if self.chance(0.2):
            parts["layout"] = self.pick(("walls", "narrows", "dead_ends", "crossing", "maze"))
        for kind in KINDS:
            if self.chance(0.3):
                parts[f"{kind}s"] = self.random.choice((0, self.count()))
        return parts

    def set(self) -> dict[str, Any]:
        if self.chance(0.5):
            parameter = self.pick(tuple(CHOICES))
            return {"do": "set", "parameter": parameter, "value": self.pick(CHOICES[parameter])}
        if self.chance(0.4):
            return {"do": "set", "parameter": self.pick(WHOLE), "value": self.random.randint(0, 10**6)}
        return {"do": "set", "parameter": self.pick(NUMBERS), "value": self.number()}

    def adjust(self) -> dict[str, Any]:
        action: dict[str, Any] = {"do": "adjust", "parameter": self.pick((*WHOLE, *NUMBERS))}
        match self.random.randint(0, 2):
            case 0:
                action["factor"] = self.number() or 2
            case 1:
                action["by"] = self.random.choice((1, -1)) * self.number()
            case _:
                action["direction"] = self.pick(("up", "down"))
        return action

    def plain(self) -> dict[str, Any]:
        do = self.pick(PLAIN)
        keys: dict[str, Any] = {}
        match do:
            case "rewind" if self.chance(0.5):
                keys["to"] = self.random.choice(("crash", "episode", "start", self.random.randint(0, 999)))
            case "step" | "rewind":
                keys["ticks"] = self.random.choice((1, self.random.randint(2, 10_000)))
            case "mode":
                keys["mode"] = self.pick(("manual", "auto"))
            case "drive":
                keys["move"] = self.pick(MOVES)
            case "show" | "hide":
                keys["view"] = self.pick(VIEWS)
            case "prefer":
                keys["preference"] = self.pick(
                    ("avoid_potholes", "smooth_ride", "fastest", "cautious", "balanced")
                )
            case "save" | "load":
                keys["name"] = self.random.choice(NAMES)
            case "goal":
                keys["goal"] = self.pick(GOALS)
                if keys["goal"] == "separates":
                    keys["planners"] = self.random.sample(PLANNERS, 2)
                elif keys["goal"] in ("harder", "easier") and self.chance(0.5):
                    keys["degree"] = self.pick(("little", "lot"))
            case "style":
                keys["style"] = self.pick(tuple(styles()))
            case "record":
                keys["on"] = self.chance(0.5)
        if do in ("mode", "drive") and self.chance(0.2):
            keys["ego"] = self.pick(("av-1", "av-2"))
        return {"do": do, **keys}

    def ask(self) -> dict[str, Any]:
        about = self.pick(
            (
                "why",
                "why_not",
                "what_if",
                "next",
                "scene",
                "status",
                "metrics",
                "confidence",
                "maintenance",
                "help",
                "setting",
                "options",
                "term",
                "fact",
                "history",
                "other",
                "pattern",
            )
        )
        action: dict[str, Any] = {"do": "ask", "about": about}
        match about:
            case "why" | "why_not":
                if about == "why_not" or self.chance(0.5):
                    action["move"] = self.pick(MOVES)
                if about == "why" and self.chance(0.3):
                    action["instead"] = self.pick(MOVES)
                action |= self.when()
            case "what_if" if self.chance(0.3):
                action["move"] = self.pick(MOVES)
                action |= self.when()
            case "pattern" if self.chance(0.8):
                action["move"] = self.pick(MOVES)
            case "other":
                action["what"] = self.pick(("why", "going"))
                action["which"] = self.pick(
                    (
                        {"kind": "vehicle", "nearest": True},
                        {"kind": "pedestrian", "side": "left"},
                        {"kind": "vehicle", "side": "ahead"},
                        {"kind": "vehicle", "lane": self.random.randint(1, 8)},
                    )
                )
                if action["what"] == "why":
                    if self.chance(0.6):
                        action["move"] = self.pick(("left", "right", "stay"))
                    action |= self.when()
            case "what_if":
                change = [self.action(questions=False) for _ in range(self.random.randint(1, 3))]
                action["change"] = change
            case "scene" if self.chance(0.5):
                action["kind"] = self.pick(KINDS)
            case "metrics" if self.chance(0.8):
                action["metric"] = self.pick(METRICS)
            case "setting" | "options" if about == "setting" or self.chance(0.8):
                action["parameter"] = self.pick((*CHOICES, *NUMBERS, *WHOLE))
                if about == "setting" and self.chance(0.5):
                    action["value"] = self.value_of(action["parameter"])
            case "fact":
                action["fact"] = self.pick(get_args(FactName))
            case "term":
                action["term"] = self.pick(get_args(Term))
            case "history":
                action |= self.past()
        return action

    def value_of(self, parameter: str) -> Any:
        """A value that a setting may be asked to have."""
        if parameter in CHOICES:
            return self.pick(CHOICES[parameter])
        return self.random.randint(0, 10**6) if parameter in WHOLE else self.number()

    def when(self) -> dict[str, Any]:
        """The tick that a question is about, one so long ago, or none."""
        match self.random.randint(0, 4):
            case 0 | 1:
                return {"tick": self.random.randint(0, 5000)}
            case 2:
                return {"ticks": self.random.choice((1, self.random.randint(2, 999)))}
            case 3:
                return {"seconds": float(self.random.choice((1, 2.5, self.random.randint(2, 99))))}
        return {}

    def past(self) -> dict[str, Any]:
        """What of the past is asked about."""
        tick = self.random.randint(0, 5000)
        what = self.pick(("closest_call", "summary", "since", "between", "seen", "riskiest", "similar"))
        match what:
            case "between":
                return {"what": what, "tick": tick, "until": tick + self.random.randint(0, 99)}
            case "since" | "seen":
                ticks = {"ticks": self.random.choice((1, self.random.randint(2, 999)))}
                return {"what": what, **(ticks if self.chance(0.5) else {"tick": tick})}
            case "riskiest" if self.chance(0.5):
                return {"what": what, "tick": tick, "until": tick + self.random.randint(0, 99)}
            case "similar":
                count = {} if self.chance(0.4) else {"count": self.random.randint(1, 9)}
                return {"what": what, **count, **({} if self.chance(0.5) else {"tick": tick})}
        return {"what": what}

    def evaluation(self) -> dict[str, Any]:
        match self.random.randint(0, 2):
            case 0:
                action: dict[str, Any] = {"do": "evaluate"}
                if self.chance(0.7):
                    action["runs"] = self.random.randint(1, 1_000_000)
                if self.chance(0.6) or "runs" not in action:
                    action["planners"] = self.random.sample(PLANNERS, self.random.randint(1, 3))
                if self.chance(0.3):
                    action["vary"] = {"time_of_day": self.random.sample(["day", "dusk", "night", "dawn"], 2)}
                left = {"planner"}
                if "vary" in action:  # beside times that are compared, a traffic is asked about
                    left |= {"time_of_day", "traffic"}
                parts = {key: value for key, value in self.parts().items() if key not in left}
                if parts and self.chance(0.5):
                    action["scenario"] = parts
                return action
            case 1:
                return self.optional(
                    {"do": "find_worst"},
                    runs=lambda: self.random.randint(1, 1_000_000),
                    planner=lambda: self.pick(PLANNERS),
                )
            case _:
                distance, speed = self.number() or 1, self.number()
                return {
                    "do": "advise",
                    "hazard": self.pick(KINDS),
                    "distance_m": distance,
                    "speed_kmh": speed,
                }

    def where(self) -> dict[str, Any]:
        """A place whose parts do not contradict each other."""
        if self.chance(0.2):
            return {"each": "lane"} if self.chance(0.3) else self.lanes()
        where: dict[str, Any] = {}
        match self.random.randint(0, 3):
            case 0:
                where["cell"] = [self.random.randint(0, 63), self.random.randint(0, 511)]
            case 1:
                where["id"] = f"{self.pick(KINDS)}-{self.random.randint(1, 99)}"
            case 2 if self.chance(0.4):
                return {"nearest": True}
            case _:
                if self.chance(0.6):
                    lane: Any = self.random.choice(("left", "middle", "right", self.random.randint(1, 64)))
                    where["lane"] = lane
                if self.chance(0.4):
                    where["row"] = self.random.randint(0, 511)
        if self.chance(0.3):
            where["side"] = self.pick(("ahead", "behind", "left", "right"))
        match self.random.randint(0, 3):
            case 0:
                where["distance_m"] = self.number() or 5
            case 1:
                where["cells"] = self.random.choice((1, self.random.randint(2, 99)))
        return where or {"side": "ahead"}

    def number(self) -> float:
        scale = self.random.choice((1, 10, 1000))
        value = self.random.choice(
            (self.random.random() * scale, float(self.random.randint(0, 200)), 0.5, 1e-05)
        )
        return value

    def count(self) -> int:
        return self.random.choice((1, 2, self.random.randint(1, 10_000)))

    def pick(self, values: tuple[str, ...]) -> str:
        return self.random.choice(values)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def optional(self, action: dict[str, Any], **more: Any) -> dict[str, Any]:
        """The action with each further key by chance."""
        return {**action, **{key: make() for key, make in more.items() if self.chance(0.5)}}


def failures(language: Language, seeds: range) -> list[str]:
    """What does not come back as it was: one line for each."""
    lines = []
    for seed in seeds:
        values = Maker(seed).actions()
        actions: tuple[Action, ...] = load(values)
        try:
            said = language.sentence(actions)
        except Unsayable as reason:
            lines.append(f"seed {seed}: {values} cannot be said: {reason}")
            continue
        heard = language.parse(said)
        if not isinstance(heard, Understood) or heard.actions != actions:
            got = (
                dump(heard.actions)
                if isinstance(heard, Understood)
                else heard.message
                if hasattr(heard, "message")
                else heard
            )
            lines.append(f"seed {seed}: {said!r}\n  meant {dump(actions)}\n  heard {got}")
    return lines


if __name__ == "__main__":
    many = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    found = failures(Language.load(), range(many))
    print("\n".join(found[:20]))
    print(f"{many} lists, {len(found)} did not come back")
