"""Puts things into cells that are free for them, and says which cells these are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from sim.actions import Where
from sim.events import Event, EventType
from sim.generation import lowest_ranked
from sim.session.errors import EditError
from sim.session.locate import Place, lanes_named, place_for_adding
from sim.session.pick import random_draws
from sim.state import SimState
from sim.types import KINDS, Cell, Kind, kind_of
from sim.world import World
from sim.world.grid import Board, Road, bits, union


def with_world(state: SimState, world: World) -> SimState:
    """The state with a changed road: one more edit."""
    return replace(state, world=world, edits=state.edits + 1)


def held_now(before: World, after: World) -> tuple[Event, ...]:
    """An event for each mover that a pothole holds since the change."""
    return tuple(
        Event(after.tick, EventType.DISABLED, after.episode, (after.movers[cell],), after.road.cell(cell))
        for cell in bits(after.disabled)
        if before.movers.get(cell) != after.movers[cell] or not before.disabled >> cell & 1
    )


def refuse_occupied(world: World, kind: Kind, cell: int) -> None:
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


def cells_for(state: SimState, kind: Kind, count: int, where: Where | None) -> list[int]:
    """The cells that `count` new things are put in; for each lane so many where that is said.

    Raises `EditError` where they do not fit.
    """
    if where is None or where.each is None:
        return _chosen(state, kind, count, where)
    columns = lanes_named(where, state.world.road)
    cells: list[int] = []
    taken: EditError | None = None
    for column in columns:
        lane = replace(where, each=None, lanes=None, lane=column + 1)
        try:
            cells += _chosen(state, kind, count, lane)
        except EditError as error:
            if error.code != "occupied":
                raise
            taken = error
            if not _stands_there(error, kind):
                if len(columns) < state.world.road.columns:
                    raise
                raise _with_a_free_row(error, state.world, kind, columns) from error
    if taken is not None and not cells:
        raise taken
    return cells


def _stands_there(error: EditError, kind: Kind) -> bool:
    """Whether a cell is taken by just what is to be put there, and stays so."""
    return kind.fixed and kind_of(error.facts["id"]) is kind


def _with_a_free_row(error: EditError, world: World, kind: Kind, columns: Sequence[int]) -> EditError:
    """The refusal of a row in which a lane is taken, with the nearest row on that side in which none is."""
    road, (column, row) = world.road, (error.facts["column"], error.facts["row"])
    lanes = union(road.column(each) for each in columns)
    own = road.cell(world.av)[1]
    side = range(1, own) if row < own else range(own + 1, road.rows - 1)
    free = [each for each in side if not road.row(each) & lanes & world.occupied]
    if not free:
        return error
    nearest = min(free, key=lambda each: (abs(each - row), each))
    lane, who = column + 1, error.facts["id"]
    return EditError("row_is_taken", error.field, lane=lane, row=row, id=who, kind=kind, free_row=nearest)


def _chosen(state: SimState, kind: Kind, count: int, where: Where | None) -> list[int]:
    world = state.world
    place = place_for_adding(where, count, world, state.config.cell_m)
    if place.cells.bit_count() == 1 and count == 1:
        (cell,) = bits(place.cells)
        refuse_occupied(world, kind, cell)
        return [cell]
    free = room_for(world, kind, count, place, where)
    if place.ordered:
        return place.nearest_first(free, world)[:count]
    return lowest_ranked(free, count, random_draws(state))


def room_for(world: World, kind: Kind, count: int, place: Place, where: Where | None) -> Board:
    """The free cells of a place. Raises `EditError` where there are too few."""
    free = place.cells & ~world.occupied
    if free.bit_count() < count:
        raise no_room(count, kind, free, "there" if where else "between_start_and_goal")
    return free


def no_room(count: int, kind: Kind, free: Board, place: str) -> EditError:
    """The refusal of more than fits."""
    return EditError("no_room", "count", count=count, kind=kind, free=free.bit_count(), place=place)


def nearest_free(road: Road, free: Board, cells: Iterable[Cell]) -> Sequence[Cell]:
    """A free cell for each of these: in its own row if there is one, else in the nearest row; none twice."""
    whole = (1 << road.columns) - 1
    rows = [free >> row * road.columns & whole for row in range(road.rows)]
    found = []
    for column, row in cells:
        at = min((r for r in range(road.rows) if rows[r]), key=lambda r: (abs(r - row), r))
        nearest = min(bits(rows[at]), key=lambda c: (abs(c - column), c))
        rows[at] &= ~(1 << nearest)
        found.append((nearest, at))
    return found
