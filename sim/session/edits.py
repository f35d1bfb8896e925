"""Actions on a session: what a person may change, one function an action. All or nothing.

States are values: `apply` returns a new one, or raises `EditError` and nothing is done. While the result of
an episode stands, a change begins the next episode first, since the road it would touch is about to go;
actions that point at a thing on the old road are refused.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from sim.actions import (
    Add,
    Adjust,
    Cancel,
    Copy,
    Drive,
    MoveThings,
    Prefer,
    Remove,
    Replace,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
    Trigger,
    Where,
    WorldAction,
)
from sim.config import Config, ConfigError
from sim.ego import Ego
from sim.events import Event
from sim.generation import GenerationError, assign_ids, lowest_ranked
from sim.repetition import NOTHING_KEPT
from sim.session.applied import Applied, Change, Moved, differences, moves_told
from sim.session.errors import EditError
from sim.session.pick import pick_things, placeable, random_draws
from sim.session.put import cells_for, held_now, no_room, with_world
from sim.session.rearrange import rearrange
from sim.session.resize import keeps_things, resize
from sim.session.rules_made import cancel, make
from sim.session.scenario import config_of_scenario, find_unavailable
from sim.session.settings import NEEDS_A_NEW_ROAD, add_preference, change_setting, vehicles_for
from sim.state import SimState, next_episode, reconfigure, restart_episode
from sim.types import Kind, Outcome
from sim.world import Thing
from sim.world.placing import with_things

__all__ = ["MAX_QUEUE", "ON_THE_NEXT_ROAD", "Applied", "Change", "Moved", "apply", "differences"]

ON_THE_NEXT_ROAD: Final = (Add, Remove, SetCount, MoveThings, Swap, Replace, Copy, Drive)
"""Actions that begin the next episode first where the result of one stands."""
MAX_QUEUE = 100
"""How many moves of a person may wait."""


def apply(state: SimState, action: WorldAction) -> Applied:
    """Applies an action at the present tick. Raises `EditError`."""
    begun = state
    events: tuple[Event, ...] = ()
    if state.world.outcome is not Outcome.RUNNING and isinstance(action, ON_THE_NEXT_ROAD):
        _refuse_what_is_gone(action)
        begun, event = next_episode(state)
        events = (event,)
    done = _apply(begun, action)
    changes = () if done.state is state else differences(state, done.state)
    changes += moves_told(done.moved)
    after = done.state
    if after.watch is not NOTHING_KEPT:
        after = after.with_ego(watch=NOTHING_KEPT)
    return Applied(done.action, after, changes, done.added, done.removed, (*events, *done.events), done.moved)


def _apply(state: SimState, action: WorldAction) -> Applied:
    match action:
        case Add():
            return _add(state, action)
        case Remove():
            return _remove(state, action)
        case SetCount():
            return _set_count(state, action)
        case MoveThings() | Swap() | Replace() | Copy():
            return rearrange(state, action)
        case Scenario():
            return _scenario(state, action)
        case Reset():
            begun, event = restart_episode(state)
            return Applied(action, begun, events=(event,))
        case SetMode():
            ego = _ego(state, action)
            return Applied(action, state.with_ego(ego.id, mode=action.mode, queue=()))
        case Drive():
            ego = _ego(state, action)
            if len(ego.queue) >= MAX_QUEUE:
                raise EditError("too_many_moves", "move", most=MAX_QUEUE)
            return Applied(action, state.with_ego(ego.id, queue=(*ego.queue, action.move)))
        case Prefer():
            return Applied(action, replace(state, config=add_preference(state.config, action.preference)))
        case Set() | Adjust():
            return _set(state, action)
        case Trigger():
            return make(state, action, apply)
        case Cancel():
            return cancel(state, action)


def _ego(state: SimState, action: SetMode | Drive) -> Ego:
    """The ego that is meant, the first by default."""
    if action.ego is not None and action.ego not in state.egos:
        raise EditError("no_such_ego", "ego", id=action.ego)
    return state.ego(action.ego)


def _set(state: SimState, action: Set | Adjust) -> Applied:
    """Gives a setting a value. Settings that a road is made from show from the next road on, or begin one."""
    config = change_setting(state.config, action)
    if isinstance(action, Adjust) and keeps_things(state, action) and config != state.config:
        return resize(state, action, config)
    if action.parameter in NEEDS_A_NEW_ROAD and config != state.config:
        return _begin_road(state, action, config)
    after = replace(state, config=config)
    if action.parameter == "traffic" and state.world.outcome is Outcome.RUNNING:
        # Who says "heavy traffic" means what is on the road now as well.
        wanted = SetCount(kind="vehicle", count=min(vehicles_for(config), _room(after, Kind.VEHICLE)))
        counted = _set_count(after, wanted)
        return replace(counted, action=action)
    return Applied(action, after)


def _room(state: SimState, kind: Kind) -> int:
    """The largest number of a kind that the road can hold now."""
    free = state.world.road.between & ~state.world.occupied
    return state.world.count(kind) + free.bit_count()


def _add(state: SimState, action: Add) -> Applied:
    kind = placeable(action.kind)
    if action.where is not None and action.where.id is not None:
        raise EditError("id_is_no_place", "where")
    return _place_things(state, action, kind, cells_for(state, kind, action.count, action.where))


def _place_things(state: SimState, action: Add | SetCount, kind: Kind, cells: list[int]) -> Applied:
    """Places new things in these cells; movers face a random way."""
    world = state.world
    last = dict(world.numbered)
    heading = random_draws(state).narrow(1)
    new = []
    for cell, name in assign_ids(kind, cells, last).items():
        way = ("right" if heading.below(2, cell) else "left") if kind.moves else None
        new.append(Thing(name, kind, world.road.cell(cell), way))
    after = replace(with_things(world, new), numbered=last)
    added = tuple(thing for each in new if (thing := after.find(each.id)))
    return Applied(action, with_world(state, after), added=added, events=held_now(world, after))


def _remove(state: SimState, action: Remove) -> Applied:
    found = pick_things(state, action.kind, action.count, action.where, action.except_)
    return _remove_things(state, action, found) if found else Applied(action, state)


def _remove_things(state: SimState, action: Remove | SetCount, things: list[Thing]) -> Applied:
    after = state.world.without({thing.id for thing in things})
    return Applied(action, with_world(state, after), removed=tuple(things))


def _set_count(state: SimState, action: SetCount) -> Applied:
    kind = placeable(action.kind)
    more = action.count - state.world.count(kind)
    if more > 0:
        free = state.world.road.between & ~state.world.occupied
        if free.bit_count() < more:
            raise no_room(action.count, kind, free, "between_start_and_goal")
        return _place_things(state, action, kind, lowest_ranked(free, more, random_draws(state)))
    if more == 0:
        return Applied(action, state)
    going = lowest_ranked(state.world.board(kind), -more, random_draws(state))
    names = [state.world.id_at(cell, kind) for cell in going]
    return _remove_things(state, action, [thing for name in names if (thing := state.world.find(name))])


def _scenario(state: SimState, action: Scenario) -> Applied:
    missing = find_unavailable(action)
    if missing is not None:
        raise EditError("scenario_not_available", missing.field, problem=missing)
    try:
        config = config_of_scenario(state.config, action)
    except ConfigError as error:
        field = error.problems[0].field
        amount = getattr(action, field, None)
        raise EditError(
            "too_many_for_scenario", field, amount=amount, setting=field, problem=error.problems[0]
        ) from None
    return _begin_road(state, action, config)


def _begin_road(state: SimState, action: WorldAction, config: Config) -> Applied:
    """Begins a new road of this configuration."""
    try:
        begun, event = reconfigure(state, config)
    except GenerationError as error:
        raise EditError("no_new_road", "solvable", problem=error.problems[0]) from None
    return Applied(action, begun, events=(event,))


def _refuse_what_is_gone(action: WorldAction) -> None:
    """Refuses a place that points at a thing: its road goes with the episode that has ended."""
    places: list[Where | None] = []
    match action:
        case Add():
            places = [action.where]
        case Remove():
            places = [action.where, action.except_]
        case MoveThings() | Copy():
            places = [action.where, action.to]
        case Replace():
            places = [action.where]
        case Swap():
            raise EditError("road_is_gone", "first")
    if any(place is not None and (place.nearest or place.id or place.of) for place in places):
        raise EditError("road_is_gone", "where")
