"""Availability: what this version does of all that can be said. The rest is understood and refused in words.

The check stands here and not in the grammar, so that typed calls, recordings and speech get the same
refusals. What a scenario may name is decided by `sim.session.scenario`.
"""

from __future__ import annotations

from service.actions import Action, Ask, Evaluate, FindWorst, Goal, Hide, Show
from service.actions.table import WhatIf, sets_playback_speed, traits_of
from service.evaluations.request import unavailable_part
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    MoveThings,
    OneThing,
    Remove,
    Replace,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
    Trigger,
)
from sim.session.scenario import find_unavailable
from sim.session.settings import is_available
from sim.types import Kind

_WITH_UNITS = {"target_speed_kmh": ("target speed", " km/h"), "sensor_range_m": ("sensor range", " m")}
"""The words for parameters whose name ends in a unit."""


def refusal_of(action: Action, language: str = DEFAULT_LANGUAGE) -> str | None:
    """Why an action is not offered by this version, as a sentence; None if it is."""
    words = refusals(language)
    if isinstance(action, Ask):
        return next(
            (said for each in action.change or () if (said := _refuse_imagined(each, language))), None
        )
    if isinstance(action, Trigger):
        return next((said for each in action.then if (said := refusal_of(each, language))), None)
    if not traits_of(action).offered:
        return words.session(action.do)
    match action:
        case Add(kind=Kind.AV) | Remove(kind=Kind.AV) | SetCount(kind=Kind.AV):
            return words.session("more_vehicles")
        case MoveThings(kind=Kind.AV) | Copy(kind=Kind.AV) | Replace(kind=Kind.AV) | Replace(by=Kind.AV):
            return words.session("more_vehicles")
        case Swap(first=OneThing(kind=Kind.AV)) | Swap(second=OneThing(kind=Kind.AV)):
            return words.session("more_vehicles")
        case Show(view="sensors") | Hide(view="sensors"):
            return words.session("view_of_sensors")
        case Scenario():
            missing = find_unavailable(action)
            return None if missing is None else words.problem(missing)
        case Evaluate() | FindWorst():
            missing = unavailable_part(action)
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
    """Why an action cannot be part of a what-if question, as a sentence; None if it can."""
    match traits_of(action).what_if:
        case WhatIf.REFUSED:
            code = "what_if_goal" if isinstance(action, Goal) else "what_if_back"
            return refusals(language).session(code)
        case WhatIf.NO_EFFECT:
            return None
    return refusal_of(action, language)
