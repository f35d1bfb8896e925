"""What an outcome gives later sentences to refer to: the things it named, its tick, the options it listed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, cast, get_args

from service import actions as contract
from service.actions import Action, Ask, Which
from service.actions.goals import Style
from service.styles import styles
from sim.actions import Adjust, Parameter, Set


def named(actions: tuple[Action, ...]) -> tuple[str, ...]:
    """The ids of the things that actions name."""
    wheres = [getattr(action, "where", None) for action in actions]
    return tuple(where.id for where in wheres if where is not None and where.id)


def tick_told(answer: Mapping[str, Any], actions: tuple[Action, ...]) -> int | None:
    """The one tick that a question or its answer names."""
    asked = {action.tick for action in actions if isinstance(action, Ask) and action.tick is not None}
    call = (answer.get("history") or answer).get("closest_call")
    told = asked or ({call["tick"]} if isinstance(call, Mapping) else set())
    if not told and (about := explained(answer, actions)) is not None and about.tick is not None:
        return about.tick
    return told.pop() if len(told) == 1 else None


_EXPLAIN = ("why", "why_not", "what_if", "other")


def explained(answer: Mapping[str, Any], actions: tuple[Action, ...]) -> Ask | None:
    """The question that was answered, with the tick that its answer turned out to be about."""
    if isinstance(again := answer.get("asked"), Mapping):
        (loaded,) = contract.load([again])
        asks = [loaded] if isinstance(loaded, Ask) else []
    else:
        asks = [action for action in actions if isinstance(action, Ask)]
    if len(asks) != 1 or asks[0].about in ("detail", "pending", "help"):
        return None
    (ask,) = asks
    if ask.about in _EXPLAIN and ask.change is None and answer.get("evidence") is not None:
        which = answer.get("mover", {}).get("id")
        named = ask if which is None else replace(ask, which=Which(id=which))
        what = None if named.what == "detour" else named.what  # the tick stands for the moment
        return replace(named, what=what, tick=answer["tick"], ticks=None)
    if ask.about == "history" and ask.what in ("riskiest", "similar", "closest_call"):
        tick = answer.get("moment")
        call = answer.get("closest_call")
        tick = call["tick"] if tick is None and isinstance(call, Mapping) else tick
        return ask if tick is None else Ask(about="why", tick=tick)
    return ask


def options_told(answer: Mapping[str, Any], actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """What choosing each of the styles, or of the values of a setting, that an answer listed would do."""
    if len(actions) != 1 or not isinstance(actions[0], Ask):
        return ()
    if actions[0].about == "styles":
        return tuple(Style(style=name) for name in styles())
    values, name = answer.get("options", ()), answer.get("parameter")
    if name not in get_args(Parameter) or not all(isinstance(value, str) for value in values):
        return ()
    return tuple(Set(parameter=cast(Parameter, name), value=value) for value in values)


def changes_number(action: object) -> bool:
    """Whether an action sets or changes a setting that is a number."""
    return isinstance(action, Adjust) or (isinstance(action, Set) and not isinstance(action.value, str))
