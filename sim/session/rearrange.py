"""Changes to things that are on the road already: moved, swapped, replaced, copied. All or nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sim.actions import Copy, MoveThings, Rearranging, Replace, Shift, Swap, Where
from sim.generation import assign_ids, lowest_ranked
from sim.session.applied import Applied, Moved
from sim.session.errors import EditError
from sim.session.locate import Place, cell_away, place_for_adding
from sim.session.pick import pick_one, pick_things, placeable, random_draws
from sim.session.put import cells_for, held_now, nearest_free, refuse_occupied, room_for, with_world
from sim.state import SimState
from sim.types import Cell, Kind
from sim.world import Thing, World
from sim.world.grid import board_of
from sim.world.placing import with_things


def rearrange(state: SimState, action: Rearranging) -> Applied:
    """Applies an action to things that are on the road. Raises `EditError`."""
    match action:
        case MoveThings():
            return _move(state, action)
        case Swap():
            return _swap(state, action)
        case Replace():
            return _replace(state, action)
        case Copy():
            return _copy(state, action)


def _named(state: SimState, action: MoveThings | Replace | Copy) -> list[Thing]:
    """The things that are meant, at least one. Raises `EditError`."""
    things = pick_things(state, action.kind, action.count, action.where)
    if not things:
        place = "road" if action.where is None else "there"
        raise EditError("none_there", "kind", kind=action.kind, place=place)
    return things


def _move(state: SimState, action: MoveThings) -> Applied:
    things = _named(state, action)
    lifted = state.world.without({thing.id for thing in things})
    if action.by is not None:
        cells = [_shifted(state.world, thing, action.by) for thing in things]
    else:
        cells = _new_cells(replace(state, world=lifted), things, action.to or Where())
    return _moved(state, action, lifted, list(zip(things, cells, strict=True)))


def _shifted(world: World, thing: Thing, by: Shift) -> Cell:
    """The cell so far to one side of a thing. Raises `EditError`."""
    return cell_away(world.road, thing.cell, by.side, by.cells)


def _new_cells(state: SimState, things: Sequence[Thing], to: Where) -> list[Cell]:
    """Where each of these things is put, in this order; `state` is without them where they leave their cells.

    What is seen from the ego or a thing is filled nearest first; lanes, rows and cells with what is nearest.
    """
    world = state.world
    if to.id is not None:
        raise EditError("id_is_no_place", "to")
    kind, count = things[0].kind, len(things)
    if to.each is not None:
        raise EditError("each_is_for_new_things", "to")
    if to == Where():
        elsewhere = world.road.between & ~board_of(world.road.index(thing.cell) for thing in things)
        free = room_for(world, kind, count, Place(elsewhere, ordered=False), None)
        return [world.road.cell(cell) for cell in lowest_ranked(free, count, random_draws(state))]
    place = place_for_adding(to, count, world, state.config.cell_m)
    if place.ordered or place.cells.bit_count() == 1:
        return [world.road.cell(cell) for cell in cells_for(state, kind, count, to)]
    free = room_for(world, kind, count, place, to)
    return list(nearest_free(world.road, free, [thing.cell for thing in things]))


def _moved(
    state: SimState,
    action: MoveThings | Swap,
    lifted: World,
    places: Sequence[tuple[Thing, Cell]],
) -> Applied:
    """Puts things that were lifted off the road into other cells. Raises `EditError`."""
    for thing, cell in places:
        refuse_occupied(lifted, thing.kind, lifted.road.index(cell))
    after = with_things(lifted, [replace(thing, cell=cell) for thing, cell in places])
    moved = tuple(
        Moved(now, thing.cell)
        for thing, cell in places
        if cell != thing.cell and (now := after.find(thing.id)) is not None
    )
    if not moved:
        return Applied(action, state)
    return Applied(action, with_world(state, after), events=held_now(state.world, after), moved=moved)


def _swap(state: SimState, action: Swap) -> Applied:
    one, other = pick_one(state, action.first), pick_one(state, action.second)
    if one.id == other.id:
        raise EditError("same_thing", "second", id=one.id)
    lifted = state.world.without({one.id, other.id})
    return _moved(state, action, lifted, [(one, other.cell), (other, one.cell)])


def _replace(state: SimState, action: Replace) -> Applied:
    kind = placeable(action.by)
    if kind == action.kind:
        raise EditError("same_kind", "by", kind=kind)
    things = _named(state, action)
    lifted = state.world.without({thing.id for thing in things})
    cells = [lifted.road.index(thing.cell) for thing in things]
    return _with_new(state, action, kind, lifted, cells, [thing.heading for thing in things], things)


def _copy(state: SimState, action: Copy) -> Applied:
    things = _named(state, action)
    world, kind = state.world, placeable(action.kind)
    if action.to is not None:
        places = _new_cells(state, things, action.to)
    else:
        free = room_for(world, kind, len(things), Place(world.road.between, ordered=False), None)
        places = list(nearest_free(world.road, free, [thing.cell for thing in things]))
    cells = [world.road.index(cell) for cell in places]
    return _with_new(state, action, kind, world, cells, [thing.heading for thing in things], ())


def _with_new(
    state: SimState,
    action: Replace | Copy,
    kind: Kind,
    world: World,
    cells: Sequence[int],
    headings: Sequence[str | None],
    gone: Sequence[Thing],
) -> Applied:
    """Puts new things into these cells, heading as they are told to or a random way. Raises `EditError`."""
    draws = random_draws(state).narrow(1)
    last = dict(world.numbered)
    for cell in cells:
        refuse_occupied(world, kind, cell)
    names = assign_ids(kind, cells, last)
    new = []
    for cell, heading in zip(cells, headings, strict=True):
        way = heading or ("right" if draws.below(2, cell) else "left")
        new.append(Thing(names[cell], kind, world.road.cell(cell), way if kind.moves else None))
    after = replace(with_things(world, new), numbered=last)
    added = tuple(thing for name in names.values() if (thing := after.find(name)))
    events = held_now(state.world, after)
    return Applied(action, with_world(state, after), added=added, removed=tuple(gone), events=events)
