"""Actions on a session: what a person may change, one function an action. All or nothing.

States are values: `apply` returns a new one, or raises `EditError` and nothing is done. While the result of
an episode stands, a change begins the next episode first, since the road it would touch is about to go;
actions that point at a thing on the old road are refused.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

from sim.actions import (
    Add,
    Adjust,
    Drive,
    Prefer,
    Remove,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    WorldAction,
)
from sim.config import Config, ConfigError
from sim.ego import Ego
from sim.events import Event, EventType
from sim.generation import GenerationError, assign_ids, lowest_ranked
from sim.randomness import Stream
from sim.repetition import NOTHING_KEPT
from sim.session.errors import EditError
from sim.session.locate import nearest_first, place_for_adding, place_for_finding
from sim.session.scenario import config_of_scenario, find_unavailable
from sim.session.settings import NEEDS_A_NEW_ROAD, add_preference, change_setting, vehicles_for
from sim.state import FIRST, SimState, next_episode, reconfigure, restart_episode
from sim.types import KINDS, PLACEABLE, Kind, Outcome
from sim.world import Thing, World
from sim.world.boards import BOARDED
from sim.world.grid import Board, bits, board_of

MAX_QUEUE = 100
"""How many moves of a person may wait."""


@dataclass(frozen=True, slots=True)
class Change:
    """One figure that differs: a count (`potholes`), a setting (`config.road`), `mode`, `queue`.

    Those of egos beside the first have its id before them (`av-2.mode`).
    """

    path: str
    before: Any
    after: Any


@dataclass(frozen=True, slots=True)
class Applied:
    """What an action has done."""

    action: WorldAction
    state: SimState
    changes: tuple[Change, ...] = ()
    added: tuple[Thing, ...] = ()
    removed: tuple[Thing, ...] = ()
    events: tuple[Event, ...] = ()


def apply(state: SimState, action: WorldAction) -> Applied:
    """Applies an action at the present tick. Raises `EditError`."""
    begun = state
    events: tuple[Event, ...] = ()
    if state.world.outcome is not Outcome.RUNNING and isinstance(action, Add | Remove | SetCount | Drive):
        _refuse_what_is_gone(action)
        begun, event = next_episode(state)
        events = (event,)
    done = _apply(begun, action)
    changes = () if done.state is state else differences(state, done.state)
    after = done.state
    if after.watch is not NOTHING_KEPT:
        after = after.with_ego(watch=NOTHING_KEPT)
    return Applied(done.action, after, changes, done.added, done.removed, (*events, *done.events))


def _apply(state: SimState, action: WorldAction) -> Applied:
    match action:
        case Add():
            return _add(state, action)
        case Remove():
            return _remove(state, action)
        case SetCount():
            return _set_count(state, action)
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


def _ego(state: SimState, action: SetMode | Drive) -> Ego:
    """The ego that is meant, the first by default."""
    if action.ego is not None and action.ego not in state.egos:
        raise EditError("no_such_ego", "ego", id=action.ego)
    return state.ego(action.ego)


def _set(state: SimState, action: Set | Adjust) -> Applied:
    """Gives a setting a value. Settings that a road is made from show from the next road on, or begin one."""
    config = change_setting(state.config, action)
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
    kind = _placeable(action.kind)
    where, world = action.where, state.world
    if where is not None and where.id is not None:
        raise EditError("id_is_no_place", "where")
    place = place_for_adding(where, action.count, world, state.config.cell_m)
    if place.cells.bit_count() == 1 and action.count == 1:
        (cell,) = bits(place.cells)
        _refuse_occupied(world, kind, cell)
        return _place_things(state, action, kind, [cell])
    free = place.cells & ~world.occupied
    if free.bit_count() < action.count:
        raise _no_room(action.count, kind, free, "there" if where else "between_start_and_goal")
    if place.ordered:
        cells = nearest_first(bits(free), world)[: action.count]
    else:
        cells = lowest_ranked(free, action.count, _draws(state))
    return _place_things(state, action, kind, cells)


def _place_things(state: SimState, action: Add | SetCount, kind: Kind, cells: list[int]) -> Applied:
    """Places new things in these cells; movers face a random way."""
    world = state.world
    board = board_of(cells)
    last = dict(world.numbered)
    table = assign_ids(kind, cells, last)
    heading = _draws(state).narrow(1)
    right = board_of([cell for cell in cells if heading.below(2, cell)]) if kind.moves else 0
    after = replace(
        world,
        right=world.right | right,
        left=world.left | (board & ~right if kind.moves else 0),
        boards=world.boards.with_kind(kind, world.boards[kind] | board) if kind in BOARDED else world.boards,
        movers={**world.movers, **table} if kind.moves else world.movers,
        hazards=world.hazards if kind.moves else {**world.hazards, **table},
        numbered=last,
    )
    events = tuple(
        Event(after.tick, EventType.DISABLED, after.episode, (after.movers[cell],), after.road.cell(cell))
        for cell in bits(after.disabled & ~world.disabled)
    )
    added = tuple(thing for name in table.values() if (thing := after.find(name)))
    return Applied(action, _with_world(state, after), added=added, events=events)


def _remove(state: SimState, action: Remove) -> Applied:
    world, where = state.world, action.where
    kinds = PLACEABLE if action.kind == "everything" else (_placeable(action.kind),)
    place = place_for_finding(where, world, state.config.cell_m)
    if where is not None and where.id is not None:
        found = [_thing(world, where.id, kinds)]
    else:
        near = {cell: rank for rank, cell in enumerate(nearest_first(bits(place.cells), world))}
        found = sorted(
            (
                thing
                for thing in world.things()
                if thing.kind in kinds and world.road.index(thing.cell) in near
            ),
            key=lambda thing: near[world.road.index(thing.cell)],
        )
    if action.count == "all":
        return _remove_things(state, action, found) if found else Applied(action, state)
    there = "there" if where is not None and not where.nearest else "road"
    if not found:
        raise EditError("none_there", "kind", kind=action.kind, place=there)
    if len(found) < action.count:
        raise EditError("too_few", "count", count=len(found), kind=action.kind, place=there)
    return _remove_things(state, action, found[: action.count])


def _remove_things(state: SimState, action: Remove | SetCount, things: list[Thing]) -> Applied:
    after = state.world.without({thing.id for thing in things})
    return Applied(action, _with_world(state, after), removed=tuple(things))


def _set_count(state: SimState, action: SetCount) -> Applied:
    kind = _placeable(action.kind)
    more = action.count - state.world.count(kind)
    if more > 0:
        free = state.world.road.between & ~state.world.occupied
        if free.bit_count() < more:
            raise _no_room(action.count, kind, free, "between_start_and_goal")
        return _place_things(state, action, kind, lowest_ranked(free, more, _draws(state)))
    if more == 0:
        return Applied(action, state)
    going = lowest_ranked(state.world.board(kind), -more, _draws(state))
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


def _no_room(count: int, kind: Kind, free: Board, place: str) -> EditError:
    return EditError("no_room", "count", count=count, kind=kind, free=free.bit_count(), place=place)


def _placeable(word: str) -> Kind:
    kind = Kind(word)
    if kind is Kind.AV:
        raise EditError("other_vehicles_not_available", "kind")
    return kind


def _thing(world: World, name: str, kinds: tuple[Kind, ...]) -> Thing:
    thing = world.find(name)
    if thing is None:
        raise EditError("no_such_thing", "where", id=name)
    if thing.kind not in kinds:
        wanted = kinds[0] if len(kinds) == 1 else "everything"
        raise EditError("of_another_kind", "where", id=name, kind=wanted)
    return thing


def _refuse_what_is_gone(action: Add | Remove | SetCount | Drive) -> None:
    """Refuses a place that points at a thing: its road goes with the episode that has ended."""
    if isinstance(action, Remove) and action.where is not None and (action.where.nearest or action.where.id):
        raise EditError("road_is_gone", "where")


def _refuse_occupied(world: World, kind: Kind, cell: int) -> None:
    """Refuses a named cell that is taken; only a pothole under a mover may share one."""
    holds = KINDS[kind].holds_movers
    blocked = world.occupied & ~world.moving if holds else world.occupied
    bit = 1 << cell
    if not bit & blocked and not (holds and bit & world.disabled):
        return
    column, row = world.road.cell(cell)
    if bit & world.board(Kind.AV):
        who = world.id_at(cell, Kind.AV)
    else:
        who = world.movers.get(cell) or world.hazards[cell]
    raise EditError("occupied", "where", column=column, row=row, id=who)


def _draws(state: SimState) -> Stream:
    return Stream.of(state.config.seed, "edit", state.edits)


def _with_world(state: SimState, world: World) -> SimState:
    return replace(state, world=world, edits=state.edits + 1)


def differences(before: SimState, after: SimState) -> tuple[Change, ...]:
    """Lists every figure that differs between two states."""
    changes = []
    if before.world.episode != after.world.episode:
        changes.append(Change("episode", before.world.episode, after.world.episode))
    counts = after.world.counts()
    for kind, count in before.world.counts().items():
        if count != counts[kind]:
            changes.append(Change(KINDS[kind].plural, count, counts[kind]))
    if before.config is not after.config:
        for field in fields(Config):
            was, now = getattr(before.config, field.name), getattr(after.config, field.name)
            if was != now:
                changes.append(Change(f"config.{field.name}", was, now))
    for was, ego in zip(before.egos.values(), after.egos.values(), strict=True):
        path = "" if ego.id == FIRST else f"{ego.id}."
        if was.mode is not ego.mode:
            changes.append(Change(f"{path}mode", was.mode, ego.mode))
        if was.queue != ego.queue:
            changes.append(Change(f"{path}queue", was.queue, ego.queue))
    return tuple(changes)
