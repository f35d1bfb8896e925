"""Which moment a question is about that is asked while a past tick is looked at.

Questions of one decision are about that tick; most others about the road as it was then; those of a whole
drive about the drive that the tick belongs to. Some are about no moment, some only about the present, and
some name a tick of their own.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal, get_args

from service.actions.action import Ask
from service.actions.question_names import (
    DeviceFactName,
    HandFactName,
    PlannersName,
    SessionFactName,
    WorldFactName,
    WorldRuleName,
    WorldTruthName,
)
from service.actions.questions import WHATS

Moment = Literal["decision", "state", "drive", "present", "none"]
"""`decision`: the one taken at the tick; `state`: how it stood then; `drive`: the whole episode of the tick;
`present`: now, whatever is looked at; `none`: no moment at all, or one that the question brings along."""

_OF_A_DECISION: Final = ("here", "compare", "own", "plan")
"""What of planners is asked of one decision; nearly all else is asked of planners in general."""

_OF_THE_WORLD: Final = tuple(
    what
    for names in (WorldRuleName, WorldFactName, SessionFactName, HandFactName, WorldTruthName)
    for what in get_args(names)
)
"""What holds whatever is looked at; `traffic_rules` tells of the drive as well."""

_OF: Final[Mapping[str, Moment]] = {
    **dict.fromkeys(("why", "why_not", "what_if", "other"), "decision"),
    **dict.fromkeys(("history", "blame", "pattern"), "drive"),
    **dict.fromkeys(("changes",), "present"),
    **dict.fromkeys(("help", "options", "term", "fact", "styles", "pending", "detail", "quiz"), "none"),
}
"""By kind of question; the state for those that are not listed."""

_OF_WHAT: Final[Mapping[tuple[str, str], Moment]] = {
    **{
        ("history", what): "decision"
        for what in (
            "seen",
            "similar",
            "choices",
            "runner_up",
            "scores",
            "needed",
            "move_risk",
            "chosen_safest",
        )
    },
    **{(about, what): "state" for about in ("why", "why_not", "what_if") for what in WHATS[about]},
    **{
        ("history", what): "state"
        for what in (
            *("waited", "passed", "stopped", "lanes_used", "sighted", "noticed", "shares", "moving"),
            *(
                "listed",
                "in_the_way",
                "advanced",
                "near_misses",
                "average_speed",
                "way_share",
                "straight_line",
                "started",
                "hand_since",
                "unsafe_moves",
                "last_detected",
                "least_ttc",
                "smoothness",
                "reversals",
                "nearest_goal",
                "here_since",
                "not_advanced",
                "typical",
                "late",
            ),
        )
    },
    **{("planners", what): "decision" for what in _OF_A_DECISION},
    **{("planners", what): "none" for what in get_args(PlannersName) if what not in _OF_A_DECISION},
    **{("sight", what): "none" for what in ("detection", "combining", "memory", "unseen", "model")},
    **{("sight", what): "none" for what in get_args(DeviceFactName)},
    **{("world", what): "none" for what in ("chance", "colours", *_OF_THE_WORLD)},
    ("world", "harm"): "drive",
    ("world", "log_line"): "state",
    ("world", "path_view"): "present",
    ("sight", "prevents"): "drive",
    ("sight", "sensor_fault"): "drive",
    ("world", "traffic_rules"): "drive",
    ("planners", "parting"): "drive",
    ("planners", "plan_changes"): "drive",
    ("planners", "effort"): "state",
    ("planners", "hand_beside"): "state",
    ("sight", "errors"): "drive",
    ("sight", "alarm_moves"): "drive",
    ("sight", "cell_entered"): "decision",
    ("sight", "look_rate"): "state",
    ("sight", "own_place"): "state",
}
"""By kind and `what`, where that is another one."""


def moment_of(ask: Ask, supposes: str | None = None) -> Moment:
    """The moment of a question; `supposes`: what it takes for granted.

    Why it crashed is asked of the drive, as the tick that is looked at is seldom that of the crash.
    """
    if ask.tick is not None:
        return "none"
    if ask.ticks is not None or ask.seconds is not None:
        return "state"  # so long before the tick that is looked at
    if ask.about == "why" and supposes == "crash":
        return "drive"
    return _OF_WHAT.get((ask.about, str(ask.what)), _OF.get(ask.about, "state"))
