"""Rules done: at the end of each tick in which their conditions come to hold.

All of it is a pure function of the states before and after a tick, so that a replay, an undo or a rewind
leads to the same firings; none of them is an entry of the log. Every condition is looked at before any rule
is done: what one rule does is seen by the others a tick later, so a tick does each rule at most once. A rule
is done wholly or not at all.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from sim.actions import MAX_FIRINGS, Pause
from sim.events import Event, EventType
from sim.session.applied import Applied
from sim.session.conditions import ENDS, MOMENTS, SETTINGS, has_just_ended, has_stood, holds, is_so
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.triggers import MAX_CROWDING, MAX_FAILURES, StandingTrigger, Triggers
from sim.types import Outcome

_ONCE: Final = frozenset(("after", "tick"))
"""Facts that come to hold once."""


def fire(before: SimState, after: SimState) -> tuple[SimState, tuple[Event, ...]]:
    """The state after a tick once every rule that is due was done, and what there is to tell of them."""
    due = {rule.number: _due(rule, before, after) for rule in after.triggers.standing}
    state, events, standing = after, list[Event](), list[StandingTrigger]()
    for rule in after.triggers.standing:
        number, held = rule.number, _held(rule, before, after)
        if _has_ended(rule, before, after):
            events.append(_event(state, EventType.TRIGGER_ENDED, number, how="done"))
            continue
        kept = rule if rule.held is held else replace(rule, held=held)
        if due[number]:
            state, kept, event = _do(state, kept)
            events.append(event)
        if (why := _ends(kept)) is None:
            standing.append(kept)
        elif why != "once":
            events.append(_event(state, EventType.TRIGGER_ENDED, number, how=why))
    triggers = tuple(standing)
    if triggers != after.triggers.standing:
        state = replace(state, triggers=Triggers(after.triggers.made, triggers))
    return state, tuple(events)


def pauses(events: tuple[Event, ...]) -> bool:
    """Whether a rule that was done stops the clock."""
    return any(isinstance(done, Pause) for event in events for done in event.done)


def _due(rule: StandingTrigger, before: SimState, after: SimState) -> bool:
    """Whether a rule is to be done now: its condition has come to hold in this tick.

    The end of an episode is to be seen for a tick: what changes the road after it is done a tick later, and
    what does not wait for an end is not done while a result stands.
    """
    when = rule.trigger.when
    if when.fact in ENDS:
        only_pauses = all(isinstance(action, Pause) for action in rule.trigger.then)
        return has_just_ended(after if only_pauses else before, when.fact)
    if after.world.outcome is not Outcome.RUNNING:
        return False
    return holds(when, before, after, rule.since) and (when.fact in MOMENTS or not rule.held)


def _held(rule: StandingTrigger, before: SimState, after: SimState) -> bool:
    """Whether the condition counts as having held; one that comes to hold under a result is due after it."""
    when = rule.trigger.when
    if when.fact == "standing":
        return has_stood(before, after)
    lasts = when.fact in SETTINGS or when.no_longer
    return rule.held if lasts and after.world.outcome is not Outcome.RUNNING else is_so(when, after)


def _has_ended(rule: StandingTrigger, before: SimState, after: SimState) -> bool:
    until = rule.trigger.until
    return until is not None and holds(until, before, after, rule.since)


def _ends(rule: StandingTrigger) -> str | None:
    """Why a rule stands no longer; None while it does."""
    if rule.failed >= MAX_FAILURES:
        return "failed"
    if rule.fired >= MAX_FIRINGS and rule.trigger.times != MAX_FIRINGS:
        return "limit"
    if rule.fired and rule.fired == rule.trigger.times:
        return "done"
    return "once" if rule.trigger.when.fact in _ONCE and rule.fired + rule.failed else None


def _do(state: SimState, rule: StandingTrigger) -> tuple[SimState, StandingTrigger, Event]:
    """A rule done in a state, or refused with the state as it was."""
    made, done = state, list[Applied | Pause]()
    try:
        for action in rule.trigger.then:
            if isinstance(action, Pause):
                done.append(action)
                continue
            applied = apply(made, action)
            _refuse_crowds(applied)
            made = applied.state
            done.append(applied)
    except EditError as error:
        failed = _event(state, EventType.TRIGGER_FAILED, rule.number, error=error)
        return state, replace(rule, failed=rule.failed + 1), failed
    event = _event(made, EventType.TRIGGERED, rule.number, done=tuple(done))
    return made, replace(rule, fired=rule.fired + 1, failed=0), event


def _refuse_crowds(applied: Applied) -> None:
    """Refuses to put more things on a road than leave half of it free."""
    world = applied.state.world
    between = world.road.between
    taken = (world.occupied & between).bit_count()
    if len(applied.added) > len(applied.removed) and taken > MAX_CROWDING * between.bit_count():
        raise EditError("crowded", "count", percent=round(100 * MAX_CROWDING))


def _event(
    state: SimState,
    type: EventType,
    rule: int,
    how: str | None = None,
    done: tuple[Applied | Pause, ...] = (),
    error: EditError | None = None,
) -> Event:
    world = state.world
    return Event(world.tick, type, world.episode, how=how, rule=rule, done=done, error=error)
