"""What this version does of all that can be said. The rest is understood and refused in words.

The gate stands here and not in the language, so that typed calls, recordings and speech are told
the same. What a scenario may name is the world's rule.
"""

from __future__ import annotations

from service.actions import Action, Ask, Hide, Show
from service.sessions.pace import sets_pace
from sim.actions import Add, Adjust, Drive, Remove, Reset, Scenario, Set, SetCount, SetMode
from sim.session.scenario import unavailable
from sim.session.settings import offered
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

_NAMES = {
    "evaluate": "Running many episodes to compare planners",
    "find_worst": "Searching for the hardest road",
    "record": "Recording pictures",
}
_WITH_UNITS = {"target_speed_kmh": ("target speed", " km/h"), "sensor_range_m": ("sensor range", " m")}
"""Parameters whose spelling ends in their unit, in words."""


def refusal(action: Action) -> str | None:
    """Why an action is not offered by this version, as a sentence; None if it is."""
    if isinstance(action, Ask):
        return next((sentence for each in action.change or () if (sentence := _imagined(each))), None)
    if action.do not in _OFFERED:
        return _sentence(_NAMES[action.do])
    match action:
        case Add(kind=Kind.AV) | Remove(kind=Kind.AV) | SetCount(kind=Kind.AV):
            return "More or fewer autonomous vehicles are not available yet; there is always one."
        case Show(view="sensors") | Hide(view="sensors"):
            return "A view of the sensors is not available yet: there are none, the vehicle sees everything."
        case Scenario():
            missing = unavailable(action)
            return None if missing is None else _sentence(missing.message)
        case Set() | Adjust() if sets_pace(action):
            return None
        case Set() | Adjust() if not offered(action):
            name, unit = _WITH_UNITS.get(action.parameter, (action.parameter.replace("_", " "), ""))
            value = f" ({action.value}{unit})" if isinstance(action, Set) else ""
            return _sentence(f"Changing the {name}{value}")
        case Drive() | Reset() | SetMode() | _:
            return None


def _imagined(action: Action) -> str | None:
    """Why nobody can be asked what if to an action; what touches no world may be, and makes no difference."""
    if action.do in ("undo", "redo", "rewind", "load"):
        return _sentence("Asking what if something were taken back")
    return None if action.do in _NO_WORLD else refusal(action)


def _sentence(what: str) -> str:
    return f"{what} is not available yet."
