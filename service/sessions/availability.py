"""What this version does of all that can be said. The rest is understood and refused in words.

The gate stands here and not in the language, so that typed calls, recordings and speech are told
the same. What a scenario may name is the world's rule.
"""

from __future__ import annotations

from service.actions import Action, Ask, Hide, Show
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.scheduler.playback_speed import sets_playback_speed
from sim.actions import Add, Adjust, Drive, Remove, Reset, Scenario, Set, SetCount, SetMode
from sim.session.scenario import find_unavailable
from sim.session.settings import is_available
from sim.types import Kind

_OFFERED = frozenset(
    (
        "add",
        "remove",
        "set_count",
        "scenario",
        "reset",
        "mode",
        "drive",
        "set",
        "adjust",
        "prefer",
        "show",
        "hide",
        "pause",
        "resume",
        "step",
        "undo",
        "redo",
        "rewind",
        "save",
        "load",
        "teach",
        "forget",
        "advise",
    )
)
_NO_WORLD = frozenset(("show", "hide", "evaluate", "find_worst", "advise", "save", "record"))
"""Actions that leave the road as it is, whether this version has them or not."""

_WITH_UNITS = {"target_speed_kmh": ("target speed", " km/h"), "sensor_range_m": ("sensor range", " m")}
"""Parameters whose spelling ends in their unit, in words."""


def refusal_of(action: Action, language: str = DEFAULT_LANGUAGE) -> str | None:
    """Why an action is not offered by this version, as a sentence; None if it is."""
    words = refusals(language)
    if isinstance(action, Ask):
        return next(
            (said for each in action.change or () if (said := _refuse_imagined(each, language))), None
        )
    if action.do not in _OFFERED:
        return words.session(action.do)
    match action:
        case Add(kind=Kind.AV) | Remove(kind=Kind.AV) | SetCount(kind=Kind.AV):
            return words.session("more_vehicles")
        case Show(view="sensors") | Hide(view="sensors"):
            return words.session("view_of_sensors")
        case Scenario():
            missing = find_unavailable(action)
            return None if missing is None else words.problem(missing)
        case Set() | Adjust() if sets_playback_speed(action):
            return None
        case Set() | Adjust() if not is_available(action):
            name, unit = _WITH_UNITS.get(action.parameter, (action.parameter.replace("_", " "), ""))
            if isinstance(action, Set):
                return words.session("changing_to", setting=name, value=f"{action.value}{unit}")
            return words.session("changing", setting=name)
        case Drive() | Reset() | SetMode() | _:
            return None


def _refuse_imagined(action: Action, language: str) -> str | None:
    """Why nobody can be asked what if to an action; what touches no world may be, and makes no difference."""
    if action.do in ("undo", "redo", "rewind", "load"):
        return refusals(language).session("what_if_back")
    return None if action.do in _NO_WORLD else refusal_of(action, language)
