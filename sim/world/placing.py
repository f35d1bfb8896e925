"""Puts things on a road: in boards and tables at once. What may stand where is the caller's concern."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from sim.types import Kind
from sim.world.boards import BOARDED, NO_BOARDS, Boards
from sim.world.grid import Road
from sim.world.world import Thing, World


def with_things(world: World, things: Iterable[Thing]) -> World:
    """The world with these things on it as well; movers keep their headings."""
    right, left = world.right, world.left
    boards = {kind: world.boards[kind] for kind in BOARDED}
    movers, hazards = dict(world.movers), dict(world.hazards)
    for thing in things:
        index = world.road.index(thing.cell)
        bit = 1 << index
        if thing.kind in boards:
            boards[thing.kind] |= bit
        if thing.kind.fixed:
            hazards[index] = thing.id
            continue
        movers[index] = thing.id
        if thing.heading == "right":
            right |= bit
        else:
            left |= bit
    return replace(world, right=right, left=left, boards=Boards.of(boards), movers=movers, hazards=hazards)


def on_road(world: World, columns: int, rows: int) -> World:
    """The world on a road of another size: rows come and go beyond the destination, lanes on the right.

    Everything keeps its lane, and its distance to the start. Nothing may stand on what goes.
    """
    farther = rows - world.road.rows
    road = Road.of(columns, rows)
    things = [replace(thing, cell=(thing.cell[0], thing.cell[1] + farther)) for thing in world.things()]
    avs = [(column, row + farther) for column, row in map(world.road.cell, world.avs)]
    bare = replace(
        world,
        road=road,
        avs=tuple(map(road.index, avs)),
        right=0,
        left=0,
        boards=NO_BOARDS,
        movers={},
        hazards={},
    )
    return with_things(bare, things)


def off_road(world: World, columns: int, rows: int) -> Collection[Thing]:
    """The things that a road of this size would have no place for; egos among them."""
    gone = world.road.rows - rows
    egos = [Thing(world.id_at(index, Kind.AV), Kind.AV, world.road.cell(index)) for index in world.avs]
    return [thing for thing in (*egos, *world.things()) if thing.cell[0] >= columns or thing.cell[1] < gone]
