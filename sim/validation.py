"""Lists what is wrong with a world; for worlds written by hand, tools and tests. Nothing is repaired."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from sim.types import HAZARDS, KINDS, MARKED, MOVERS, Cell, Outcome, kind_of
from sim.world import World
from sim.world.grid import Board, bits, board_of


@dataclass(frozen=True, slots=True)
class Defect:
    """One thing that is wrong. `code` is for programs."""

    code: str
    tick: int
    ids: tuple[str, ...] = ()
    cell: Cell | None = None


def validate_world(world: World) -> tuple[Defect, ...]:
    """Lists every inconsistency: cells off the road, duplicates, boards that differ from the id tables."""
    return tuple(_of_state(world))


def _of_state(world: World) -> Iterator[Defect]:
    road, tick = world.road, world.tick

    def at(code: str, board: Board) -> Iterator[Defect]:
        for index in bits(board):
            yield Defect(code, tick, _names(world, index), road.cell(index))

    boards = {
        **{KINDS[kind].plural: world.board(kind) for kind in HAZARDS},
        "movers": world.moving,
        **{KINDS[kind].plural: world.board(kind) for kind in MARKED},
    }
    for name, board in boards.items():
        if board & ~road.all:
            yield Defect(f"{name}_off_road", tick)
    yield from at("two_headings", world.right & world.left)
    for one, other in combinations(HAZARDS, 2):
        yield from at(f"{one}_and_{other}", world.board(one) & world.board(other) & road.all)
    for kind in HAZARDS:
        if not KINDS[kind].holds_movers:
            yield from at(f"mover_in_{kind}", world.moving & world.board(kind) & road.all)
    for kind in MARKED:
        yield from at(f"{kind}_without_heading", world.board(kind) & ~world.moving & road.all)
    for one, other in combinations(MARKED, 2):
        yield from at(f"{one}_and_{other}", world.board(one) & world.board(other) & road.all)
    yield from at("no_mover_here", board_of(world.movers) & ~world.moving)
    yield from at("mover_without_id", world.moving & ~board_of(world.movers) & road.all)
    yield from at("no_hazard_here", board_of(world.hazards) & ~world.fixed)
    yield from at("hazard_without_id", world.fixed & ~board_of(world.hazards) & road.all)
    for table, kinds in ((world.movers, MOVERS), (world.hazards, HAZARDS)):
        for index, name in table.items():
            wanted = next((kind for kind in kinds if world.board(kind) >> index & 1), kinds[-1])
            if not name.startswith(f"{wanted}-"):
                yield Defect("wrong_kind", tick, (name,), road.cell(index))
            elif int(name.rpartition("-")[2]) > world.numbered.get(kind_of(name), 0):
                yield Defect("number_not_given", tick, (name,), road.cell(index))
    for name, count in Counter([*world.movers.values(), *world.hazards.values()]).items():
        if count > 1:
            yield Defect("same_id", tick, (name,))
    if not world.avs:
        yield Defect("no_vehicle", tick)
    for number, index in enumerate(world.avs, 1):
        if not 0 <= index < road.columns * road.rows:
            yield Defect("vehicle_off_road", tick, (f"av-{number}",))
        elif world.outcome is not Outcome.CRASH and (world.fixed | world.moving) >> index & 1:
            yield Defect(
                "vehicle_in_something", tick, (f"av-{number}", *_names(world, index)), road.cell(index)
            )
    if len(set(world.avs)) < len(world.avs) and world.outcome is not Outcome.CRASH:
        yield Defect("two_vehicles", tick)
    if (world.outcome is Outcome.RUNNING) is not (world.ended is None):
        yield Defect("end_without_outcome" if world.ended is not None else "outcome_without_end", tick)
    if (world.outcome is Outcome.CRASH) is not (world.cause is not None):
        yield Defect("crash_without_cause" if world.cause is None else "cause_without_crash", tick)
    # Egos that are parked do not hold a success up, and a world does not know them.
    if world.outcome is Outcome.SUCCESS and all(index >= road.columns for index in world.avs):
        yield Defect("not_at_goal", tick)
    if not 0 <= world.episode_start <= tick:
        yield Defect("began_later", tick)


def _names(world: World, index: int) -> tuple[str, ...]:
    return tuple(table[index] for table in (world.hazards, world.movers) if index in table)
