"""What each kind of question may name, and what it costs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, get_args

from service.actions.question_names import (
    BlameName,
    HistoryName,
    MomentName,
    OtherName,
    OutlookName,
    PastMoveName,
    PlannerFactName,
    PlannersName,
    PolicyName,
    QuestionName,
    ScaleName,
    SeedsName,
    SideName,
    SightName,
    SoFarName,
    SoonerName,
    WorldName,
)


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
    "what_if": QuestionTraits(
        ("change", "move", "what", "kind", "tick", "ticks", "seconds", "count", "lane"), runs_episodes=True
    ),
    "next": QuestionTraits(("kind",), runs_episodes=True),
    "scene": QuestionTraits(("kind", "count")),
    "status": QuestionTraits(),
    "metrics": QuestionTraits(("metric",)),
    "confidence": QuestionTraits(runs_episodes=True),
    "maintenance": QuestionTraits(),
    "help": QuestionTraits(),
    "setting": QuestionTraits(("parameter", "value"), ("parameter",)),
    "options": QuestionTraits(("parameter",)),
    "term": QuestionTraits(("term",), ("term",)),
    "fact": QuestionTraits(("fact",), ("fact",)),
    "history": QuestionTraits(
        (
            *("what", "move", "tick", "until", "ticks", "seconds", "count", "kind"),
            *("want", "part", "lane", "metric", "parameter", "value", "which"),
        ),
        ("what",),
        runs_episodes=True,
    ),
    "styles": QuestionTraits(),
    "changes": QuestionTraits(("count", "tick")),
    "pending": QuestionTraits(),
    "detail": QuestionTraits(("how",), ("how",), runs_episodes=True),
    "other": QuestionTraits(
        ("what", "which", "move", "tick", "ticks", "seconds", "count"), ("what", "which"), runs_episodes=True
    ),
    "pattern": QuestionTraits(("move", "tick", "until"), runs_episodes=True),
    "outlook": QuestionTraits(
        ("what", "move", "tick", "ticks", "seconds", "kind", "lane"), ("what",), runs_episodes=True
    ),
    "blame": QuestionTraits(("what", "tick"), ("what",), runs_episodes=True),
    "planners": QuestionTraits(
        ("what", "planners", "planner", "tick", "ticks"), ("what",), runs_episodes=True
    ),
    "quiz": QuestionTraits(runs_episodes=True),
    "rules": QuestionTraits(),
    "sight": QuestionTraits(
        ("what", "kind", "value", "move", "tick", "ticks"), ("what",), runs_episodes=True
    ),
    "world": QuestionTraits(("what",), ("what",), runs_episodes=True),
}

OF_OTHERS: Final = ("others", "crossing", "others_next")
"""What of the time ahead may be asked of other road users of one kind."""
OF_A_KIND: Final = (*OF_OTHERS, "danger")
"""What of the time ahead may be asked of things of one kind."""

WHATS: Final[Mapping[QuestionName, tuple[str, ...]]] = {
    "why": (*get_args(MomentName), *get_args(SideName)),
    "why_not": get_args(MomentName),
    "what_if": tuple(
        what
        for names in (
            *(MomentName, PolicyName, SoonerName, SideName, ScaleName, SeedsName),
            *(PastMoveName, SoFarName),
        )
        for what in get_args(names)
    ),
    "history": get_args(HistoryName),
    "other": get_args(OtherName),
    "outlook": get_args(OutlookName),
    "blame": get_args(BlameName),
    "planners": get_args(PlannersName),
    "sight": get_args(SightName),
    "world": get_args(WorldName),
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
    "risk": (frozenset(),),
    "safest": (frozenset(),),
    "next_stop": (frozenset(),),
    "next_change": (frozenset(),),
    **dict.fromkeys(("gaps", "danger", "lane", "liable", "best_way_here"), (frozenset(),)),
    "worst": (frozenset(), frozenset(("ticks",)), frozenset(("seconds",))),
    **dict.fromkeys(OF_OTHERS, (frozenset(),)),
    "stays_free": (frozenset(("move",)), frozenset(("move", "ticks")), frozenset(("move", "seconds"))),
    "place_then": (frozenset(("tick",)), frozenset(("ticks",)), frozenset(("seconds",))),
    "coming": (frozenset(("ticks",)), frozenset(("seconds",))),
    "detour": (frozenset(), frozenset(("move",))),
    **dict.fromkeys(get_args(PolicyName), (frozenset(), frozenset(("tick",)))),
    **dict.fromkeys(
        (*get_args(SoonerName), *get_args(SideName), *get_args(ScaleName), *get_args(SeedsName)),
        (frozenset(),),
    ),
    **dict.fromkeys(get_args(BlameName), (frozenset(), frozenset(("tick",)))),
    "factor": (frozenset(),),
    "so_far": (frozenset(),),
    "own_last": (frozenset(("move",)),),
    **dict.fromkeys(
        ("here", "compare"),
        tuple(
            frozenset(named + when) for named in ((), ("planners",)) for when in ((), ("tick",), ("ticks",))
        ),
    ),
    "character": (frozenset(), frozenset(("planner",))),
    "own": (frozenset(), frozenset(("tick",))),
    "method": (frozenset(), frozenset(("planner",))),
    **dict.fromkeys(("often", "ranked"), (frozenset(),)),
    "difference": (frozenset(("planners",)),),
    **dict.fromkeys(
        (*get_args(PlannerFactName), "effort", "hand_beside"), (frozenset(), frozenset(("planner",)))
    ),
    "parting": (frozenset(("planners",)),),
    "plan": (frozenset(), frozenset(("tick",)), frozenset(("ticks",))),
    "plan_changes": (frozenset(),),
    **dict.fromkeys((*get_args(SightName), *get_args(WorldName)), (frozenset(),)),
    "cell": (frozenset(), frozenset(("move",))),
    "cell_entered": (frozenset(), frozenset(("tick",)), frozenset(("ticks",))),
}
"""What else a question names beside each `what`, in each of the ways it can be said; those of the past have
`HISTORY_KEYS`."""

_STRETCHES: Final = tuple(
    frozenset(keys) for keys in ((), ("tick",), ("tick", "until"), ("ticks",), ("seconds",))
)
"""The ways to name the ticks in which something is counted; none is the present episode, or `part`."""

COUNTED: Final[Mapping[str, frozenset[str]]] = {
    "stopped": frozenset(("kind", "want", "part", "lane", "parameter", "value")),
    "lane_changes": frozenset(("kind", "want", "part", "lane", "parameter", "value")),
    "made": frozenset(("kind", "want", "part", "lane", "parameter", "value")),
    "ended": frozenset(("kind", "want", "part", "lane", "parameter", "value", "metric")),
    "moving": frozenset(("want", "part", "lane", "parameter", "value")),
    "lanes_used": frozenset(("want", "part", "lane", "parameter", "value")),
    "passed": frozenset(("kind",)),
    "trouble": frozenset(("kind",)),
    "sighted": frozenset(("kind", "want")),
    "overlooked": frozenset(("kind",)),
    "closest_call": frozenset(("kind",)),
    "shares": frozenset(("part", "lane", "parameter", "value")),
    "listed": frozenset(("part", "lane", "parameter", "value")),
    "in_the_way": frozenset(("kind", "want", "part", "lane", "parameter", "value")),
    "advanced": frozenset(("part",)),
    "near_misses": frozenset(("kind",)),
    "late": frozenset(("kind",)),
}
"""What is counted over a drive, and the conditions that each takes beside ticks."""

HISTORY_KEYS: Final[Mapping[HistoryName, tuple[frozenset[str], ...]]] = {
    "closest_call": _STRETCHES,
    "summary": (frozenset(),),
    "since": (frozenset(("tick",)), frozenset(("ticks",)), frozenset(("seconds",))),
    "between": (frozenset(("tick", "until")),),
    "seen": (frozenset(("tick",)), frozenset(("ticks",))),
    "riskiest": (frozenset(), frozenset(("tick", "until"))),
    "similar": (frozenset(), frozenset(("tick",))),
    "choices": (frozenset(), frozenset(("tick",)), frozenset(("ticks",))),
    "losses": (frozenset(),),
    **dict.fromkeys(("runner_up", "scores"), (frozenset(), frozenset(("tick",)), frozenset(("ticks",)))),
    "waited": (frozenset(),),
    "differed": (frozenset(),),
    "before_crash": (frozenset(),),
    **dict.fromkeys(("passed", "verdict", "tight"), (frozenset(),)),
    **dict.fromkeys(("stopped", "lanes_used", "ended"), _STRETCHES),
    "lane_changes": (*_STRETCHES, *(each | {"move"} for each in _STRETCHES)),
    "made": tuple(each | {"move"} for each in _STRETCHES),
    **dict.fromkeys(("first_half", "second_half", "sighted", "overlooked", "lost_sight"), (frozenset(),)),
    "noticed": (frozenset(), frozenset(("tick",))),
    **dict.fromkeys(("shares", "moving", "listed", "in_the_way", "advanced"), _STRETCHES),
    "near_misses": _STRETCHES,
    **dict.fromkeys(
        ("move_risk", "chosen_safest"), (frozenset(), frozenset(("tick",)), frozenset(("ticks",)))
    ),
    **dict.fromkeys(
        ("average_speed", "way_share", "best_time", "straight_line", "luck", "started", "hand_since"),
        (frozenset(),),
    ),
    "explained": (frozenset(), frozenset(("ticks",))),
    "places_before": (frozenset(), frozenset(("ticks",))),
    **dict.fromkeys(("last_detected", "least_ttc", "smoothness", "reversals"), (frozenset(),)),
    **dict.fromkeys(
        ("nearest_goal", "here_since", "not_advanced", "story", "mishaps", "typical", "late", "best_way"),
        (frozenset(),),
    ),
    **dict.fromkeys(("end", "stuck_cause", "knowable", "influence", "trouble"), (frozenset(),)),
    "unsafe_moves": (frozenset(),),
    "needed": tuple(
        frozenset(named + when) for named in ((), ("move",)) for when in ((), ("tick",), ("ticks",))
    ),
}
"""The ticks that a question about the past names, in each of the ways it can be said."""
