"""Which things on the road an action is about: those of a kind at a place, the nearest first."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from sim.actions import OneThing, Where
from sim.generation import lowest_ranked
from sim.randomness import Stream
from sim.session.errors import EditError
from sim.session.locate import lanes_named, place_for_finding
from sim.state import SimState
from sim.types import PLACEABLE, Kind
from sim.world import Thing, World

ALL: Final = "all"
HALF: Final = "half"


def placeable(word: str) -> Kind:
    """The kind of this name. Raises `EditError` for one that nobody can put on the road yet."""
    kind = Kind(word)
    if kind is Kind.AV:
        raise EditError("other_vehicles_not_available", "kind")
    return kind


def random_draws(state: SimState) -> Stream:
    """The stream that the random places of the next change are drawn from."""
    return Stream.of(state.config.seed, "edit", state.edits)


def pick_things(
    state: SimState, word: str, count: int | str, where: Where | None, stay: Where | None = None
) -> list[Thing]:
    """The things an action names, the nearest first; `"all"` and `"half"` of none are none.

    `stay`: things there are left out. Raises `EditError` where a number of them is not there.
    """
    kinds = PLACEABLE if word == "everything" else (placeable(word),)
    found = _found(state, kinds, where)
    if stay is not None:
        found = _without(found, _staying(state, kinds, stay))
    if count == ALL:
        return found
    if count == HALF:
        return _half(state, found)
    groups = _by_lane(found, where, state.world)
    return [thing for group in groups for thing in _first_of(group, int(count), word, where)]


def pick_one(state: SimState, one: OneThing) -> Thing:
    """The thing that is meant: the nearest of a kind at a place. Raises `EditError`."""
    return pick_things(state, one.kind, 1, one.where)[0]


def _found(state: SimState, kinds: tuple[Kind, ...], where: Where | None) -> list[Thing]:
    world = state.world
    place = place_for_finding(where, world, state.config.cell_m)
    if where is not None and where.id is not None:
        return [_thing(world, where.id, kinds)]
    near = {cell: rank for rank, cell in enumerate(place.nearest_first(place.cells, world))}
    ranked = [
        (near[cell], thing)
        for thing in world.things()
        if thing.kind in kinds and (cell := world.road.index(thing.cell)) in near
    ]
    return [thing for _, thing in sorted(ranked, key=lambda each: each[0])]


def _staying(state: SimState, kinds: tuple[Kind, ...], stay: Where) -> list[Thing]:
    """The things at a place; the nearest alone where that is said."""
    found = _found(state, kinds, stay)
    return found[:1] if stay.nearest else found


def _without(things: list[Thing], others: list[Thing]) -> list[Thing]:
    names = {thing.id for thing in others}
    return [thing for thing in things if thing.id not in names]


def _half(state: SimState, things: list[Thing]) -> list[Thing]:
    """Half of them, drawn at random; of an odd number one less than the rest, but never none."""
    if not things:
        return []
    drawn = lowest_ranked((1 << len(things)) - 1, max(1, len(things) // 2), random_draws(state))
    return [things[index] for index in sorted(drawn)]


def _by_lane(things: list[Thing], where: Where | None, world: World) -> list[list[Thing]]:
    """The things lane by lane where a number holds for each lane; else all of them as one."""
    if where is None or where.each is None:
        return [things]
    lanes = lanes_named(replace(where, each=None), world.road)
    return [[thing for thing in things if thing.cell[0] == lane] for lane in lanes]


def _first_of(found: list[Thing], count: int, word: str, where: Where | None) -> list[Thing]:
    there = "there" if where is not None and not where.nearest else "road"
    if not found:
        raise EditError("none_there", "kind", kind=word, place=there)
    if len(found) < count:
        raise EditError("too_few", "count", count=len(found), kind=word, place=there)
    return found[:count]


def _thing(world: World, name: str, kinds: tuple[Kind, ...]) -> Thing:
    thing = world.find(name)
    if thing is None:
        raise EditError("no_such_thing", "where", id=name)
    if thing.kind not in kinds:
        wanted = kinds[0] if len(kinds) == 1 else "everything"
        raise EditError("of_another_kind", "where", id=name, kind=wanted)
    return thing
