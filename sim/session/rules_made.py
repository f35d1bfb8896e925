"""Rules made and switched off (`sim.session.triggers` does them)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final, TypeAlias

from sim.actions import Cancel, Condition, Pause, RuleAction, Trigger, WorldAction
from sim.session.applied import Applied
from sim.session.conditions import is_so
from sim.session.errors import EditError
from sim.session.locate import lane_columns
from sim.state import SimState
from sim.triggers import MAX_TRIGGERS, StandingTrigger, Triggers

Apply: TypeAlias = Callable[[SimState, WorldAction], Applied]

_NEVER_POSSIBLE: Final = frozenset(("not-available", "outside-road", "bad-place", "out-of-range"))
"""Categories of refusals that say that a rule cannot be done whatever is on the road."""


def make(state: SimState, action: Trigger, apply: Apply) -> Applied:
    """Lets a rule stand from now on; `apply` tries what it does.

    Raises `EditError` where it could never be done on this road.
    """
    triggers = state.triggers
    if len(triggers.standing) >= MAX_TRIGGERS:
        raise EditError("too_many_triggers", "do", most=MAX_TRIGGERS)
    for name, condition in (("when", action.when), ("until", action.until)):
        if condition is not None:
            _check(state, condition, name)
    _try(state, action, apply)
    rule = StandingTrigger(triggers.made + 1, action, state.world.tick, is_so(action.when, state))
    return _with(state, action, Triggers(rule.number, (*triggers.standing, rule)))


def cancel(state: SimState, action: Cancel) -> Applied:
    """Switches rules off. Raises `EditError` where there is none such."""
    standing = state.triggers.standing
    if not standing:
        raise EditError("no_triggers", "which" if action.doing is None else "doing")
    match action.which:
        case "all":
            left: tuple[StandingTrigger, ...] = ()
        case "last":
            left = standing[:-1]
        case None if action.place is not None:
            at = action.place
            if at > len(standing):
                raise EditError("no_such_trigger", "place", number=at)
            left = (*standing[: at - 1], *standing[at:])
        case None:
            left = tuple(rule for rule in standing if not _does(rule.trigger, action))
            if left == standing:
                raise EditError("no_trigger_does", "doing")
        case number:
            left = tuple(rule for rule in standing if rule.number != number)
            if left == standing:
                raise EditError("no_such_trigger", "which", number=number)
    return _with(state, action, Triggers(state.triggers.made, left))


def _check(state: SimState, condition: Condition, name: str) -> None:
    """Refuses a condition about a place that the road does not have."""
    road = state.world.road
    if condition.row is not None and condition.row >= road.rows:
        raise EditError("no_such_row", name, row=condition.row, last_row=road.rows - 1)
    if condition.lane is not None:
        lane_columns(road, condition.lane)


def _try(state: SimState, action: Trigger, apply: Apply) -> None:
    """Refuses what could never be done; what only does not fit at present may fit when it is due."""
    for position, each in enumerate(action.then):
        if isinstance(each, Pause):
            continue
        try:
            state = apply(state, each).state
        except EditError as error:
            if error.category in _NEVER_POSSIBLE and error.code != "at_its_limit":
                raise EditError(error.code, f"then.{position}.{error.field}", **error.facts) from error


def _does(trigger: Trigger, action: Cancel) -> bool:
    return any(each.do == action.doing and action.kind in (None, _kind(each)) for each in trigger.then)


def _kind(action: RuleAction) -> str | None:
    return getattr(action, "kind", None)


def _with(state: SimState, action: Trigger | Cancel, triggers: Triggers) -> Applied:
    return Applied(action, replace(state, triggers=triggers))
