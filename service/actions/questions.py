"""The kinds of question, what each may name, and what each costs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal, get_args

MetricName = Literal["crashes", "successes", "success_rate", "steps", "moves", "distance"]
QuestionName = Literal[
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
    "history",
    "styles",
    "changes",
    "pending",
    "detail",
    "other",
    "pattern",
    "outlook",
    "blame",
    "planners",
    "quiz",
    "rules",
]
OutlookName = Literal[
    "safe", "arrival", "crash", "arrive_how", "stuck", "avoid_how", "way", "wait", "free", "matters"
]
"""What of the time ahead is asked about.

`way`: whether any way leads to the goal; `wait`: how long the vehicle stays where it is;
`free`: which moves meet nothing now; `matters`: what the coming move hangs on.
"""
BlameName = Literal["fault", "too_late", "foreseen", "avoidable"]
"""What about a crash is asked."""
PlannersName = Literal["here", "compare", "character", "own", "method"]
"""What about planners is asked.

`own`: what this session's would have done where a person drove; `method`: by what it chooses.
"""
HistoryName = Literal[
    "closest_call", "summary", "since", "between", "seen", "riskiest", "similar", "choices", "losses"
]
"""What of the past is asked about: of this episode, of the ticks since one, between two, or of one tick.

`choices`: the moves of a decision, and what each would have met; `losses`: what the decisions of this episode
have cost against the quickest way.
"""
OtherName = Literal["why", "going"]
"""What of another road user is asked about: why it did what it did, or where it goes."""
MomentName = Literal["detour"]
"""What moment is asked about, in place of a tick: the latest move to the side or diagonally."""
DetailName = Literal["shorter", "longer", "why", "before", "after"]
"""How the last explanation is wanted again; before and after are the decisions next to it."""
Choosable = Literal["view", "preference", "road", "layout"]
"""What has options beside the parameters."""
Term = Literal[
    "arrived",
    "astar",
    "attentive",
    "av",
    "barrier",
    "bfs",
    "camera",
    "cautious",
    "certificate",
    "closest_call",
    "columns",
    "confidence",
    "continuous",
    "cooperative",
    "courtesy",
    "crash",
    "detection_sensitivity",
    "dijkstra",
    "digest",
    "dwa",
    "dynamics",
    "ego",
    "episode",
    "false_positive_rate",
    "fastest",
    "forecast",
    "fusion",
    "grid",
    "layout",
    "lidar",
    "occupancy",
    "pedestrian",
    "percept",
    "perfect",
    "planner",
    "playback_speed",
    "pothole",
    "pothole_probability",
    "preference",
    "priority",
    "radar",
    "regret",
    "rl",
    "rows",
    "rss",
    "rules",
    "safety_buffer",
    "seed",
    "sensor",
    "sensor_noise",
    "sensor_range_m",
    "smooth_ride",
    "avoid_potholes",
    "spawn_probability",
    "step_seconds",
    "stuck",
    "success_rate",
    "target_speed_kmh",
    "tick",
    "time_of_day",
    "traffic",
    "ttc",
    "vehicle",
    "weather",
    "what_if",
]
"""What the glossary explains (`glossary.yaml` of the sayings)."""


@dataclass(frozen=True, slots=True)
class QuestionTraits:
    """What a kind of question takes, and what it costs; `service.narration.answers` says who answers it."""

    may: tuple[str, ...] = ()
    """keys that it may name"""
    must: tuple[str, ...] = ()
    """those of them that it must name"""
    runs_episodes: bool = False
    """whether whole episodes are run or read again to answer it, so that it is answered in a thread"""


QUESTIONS: Mapping[QuestionName, QuestionTraits] = {
    "why": QuestionTraits(("move", "instead", "what", "tick", "ticks", "seconds"), runs_episodes=True),
    "why_not": QuestionTraits(("move", "what", "tick", "ticks", "seconds"), ("move",), runs_episodes=True),
    "what_if": QuestionTraits(("change", "move", "what", "tick", "ticks", "seconds"), runs_episodes=True),
    "next": QuestionTraits(),
    "scene": QuestionTraits(("kind", "count")),
    "status": QuestionTraits(),
    "metrics": QuestionTraits(("metric",)),
    "confidence": QuestionTraits(runs_episodes=True),
    "maintenance": QuestionTraits(),
    "help": QuestionTraits(),
    "setting": QuestionTraits(("parameter", "value"), ("parameter",)),
    "options": QuestionTraits(("parameter",)),
    "term": QuestionTraits(("term",), ("term",)),
    "history": QuestionTraits(("what", "tick", "until", "ticks", "count"), ("what",), runs_episodes=True),
    "styles": QuestionTraits(),
    "changes": QuestionTraits(("count", "tick")),
    "pending": QuestionTraits(),
    "detail": QuestionTraits(("how",), ("how",), runs_episodes=True),
    "other": QuestionTraits(
        ("what", "which", "move", "tick", "ticks", "seconds"), ("what", "which"), runs_episodes=True
    ),
    "pattern": QuestionTraits(("move", "tick", "until"), runs_episodes=True),
    "outlook": QuestionTraits(("what", "move"), ("what",), runs_episodes=True),
    "blame": QuestionTraits(("what", "tick"), ("what",), runs_episodes=True),
    "planners": QuestionTraits(
        ("what", "planners", "planner", "tick", "ticks"), ("what",), runs_episodes=True
    ),
    "quiz": QuestionTraits(runs_episodes=True),
    "rules": QuestionTraits(),
}

WHATS: Final[Mapping[QuestionName, tuple[str, ...]]] = {
    **dict.fromkeys(("why", "why_not", "what_if"), get_args(MomentName)),
    "history": get_args(HistoryName),
    "other": get_args(OtherName),
    "outlook": get_args(OutlookName),
    "blame": get_args(BlameName),
    "planners": get_args(PlannersName),
}
"""The values of `what` that a kind of question may have."""

WHAT_KEYS: Final[Mapping[str, tuple[frozenset[str], ...]]] = {
    "safe": (frozenset(("move",)),),
    "arrival": (frozenset(),),
    "crash": (frozenset(),),
    "arrive_how": (frozenset(),),
    "stuck": (frozenset(),),
    "avoid_how": (frozenset(),),
    "way": (frozenset(),),
    "wait": (frozenset(),),
    "free": (frozenset(),),
    "matters": (frozenset(),),
    "detour": (frozenset(), frozenset(("move",))),
    **dict.fromkeys(get_args(BlameName), (frozenset(), frozenset(("tick",)))),
    **dict.fromkeys(
        ("here", "compare"),
        tuple(
            frozenset(named + when) for named in ((), ("planners",)) for when in ((), ("tick",), ("ticks",))
        ),
    ),
    "character": (frozenset(), frozenset(("planner",))),
    "own": (frozenset(), frozenset(("tick",))),
    "method": (frozenset(), frozenset(("planner",))),
}
"""What else a question names beside each `what`, in each of the ways it can be said; those of the past have
`HISTORY_KEYS`."""

HISTORY_KEYS: Final[Mapping[HistoryName, tuple[frozenset[str], ...]]] = {
    "closest_call": (frozenset(),),
    "summary": (frozenset(),),
    "since": (frozenset(("tick",)), frozenset(("ticks",))),
    "between": (frozenset(("tick", "until")),),
    "seen": (frozenset(("tick",)), frozenset(("ticks",))),
    "riskiest": (frozenset(), frozenset(("tick", "until"))),
    "similar": (frozenset(), frozenset(("tick",))),
    "choices": (frozenset(), frozenset(("tick",)), frozenset(("ticks",))),
    "losses": (frozenset(),),
}
"""The ticks that a question about the past names, in each of the ways it can be said."""
