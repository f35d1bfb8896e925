"""Whether the condition of a rule holds: read off the states before and after a tick, and nothing else.

Distances are those of the scene: the larger of the lanes and the rows between two cells.
"""

from __future__ import annotations

from collections.abc import Iterable

from sim.actions import Condition
from sim.session.locate import lane_columns
from sim.state import SimState
from sim.types import Cell, Kind, Outcome
from sim.world import World

ENDS = {"crash": Outcome.CRASH, "arrival": Outcome.SUCCESS, "stuck": Outcome.STUCK}
"""Facts that end an episode."""

MOMENTS = frozenset((*ENDS, "episode", "move", "every", "after", "tick"))
"""Facts that hold in single ticks; the others hold for as long as they are so."""

SETTINGS = frozenset(("weather", "time_of_day"))
"""Facts about the configuration: they outlast episodes."""


def holds(condition: Condition, before: SimState, after: SimState, since: int) -> bool:
    """Whether a condition holds after a tick; `since`: the tick at which its rule was made."""
    was, world = before.world, after.world
    match condition.fact:
        case "crash" | "arrival" | "stuck" as end:
            return has_just_ended(after, end)
        case "episode":
            return (world.episode, world.episode_start) != (was.episode, was.episode_start)
        case "every":
            passed = world.tick - since
            return passed > 0 and passed % _ticks(condition, after) == 0
        case "after":
            return world.tick - since >= _ticks(condition, after)
        case "tick":
            return condition.tick is not None and world.tick >= condition.tick
        case "move":
            lanes = _lanes_moved(before, after)
            return lanes != 0 and condition.move in ("lane_change", "left" if lanes < 0 else "right")
        case "standing":
            return has_stood(before, after)
        case _:
            return is_so(condition, after)


def has_just_ended(state: SimState, end: str) -> bool:
    """Whether an episode has ended so in the latest tick of a state."""
    world = state.world
    return world.outcome is ENDS[end] and world.ended == world.tick


def has_stood(before: SimState, after: SimState) -> bool:
    """Whether the first ego was on its way in a tick, and stayed in its cell."""
    return _is_driven(before, after) and before.world.avs[0] == after.world.avs[0]


def _lanes_moved(before: SimState, after: SimState) -> int:
    """By how many lanes the first ego came to the right in a tick; negative to the left."""
    if not _is_driven(before, after):
        return 0
    road = after.world.road
    return road.cell(after.world.avs[0])[0] - road.cell(before.world.avs[0])[0]


def _is_driven(before: SimState, after: SimState) -> bool:
    """Whether a tick is one of driving, and not of a road that begins or of a result that stands."""
    was, world = before.world, after.world
    same_road = (was.episode, was.episode_start) == (world.episode, world.episode_start)
    return same_road and was.tick < world.tick and was.outcome is Outcome.RUNNING


def is_so(condition: Condition, state: SimState) -> bool:
    """Whether a condition about the road holds in a state; events, times and `standing` hold in none.

    Whether it stands is only seen from one state to the next: see `has_stood`.
    """
    if condition.fact in SETTINGS:
        said = getattr(state.config, condition.fact) == getattr(condition, condition.fact)
        return said is not bool(condition.no_longer)
    if condition.fact in (*MOMENTS, "standing") or state.world.outcome is not Outcome.RUNNING:
        return False
    world = state.world
    column, row = world.road.cell(world.avs[0])
    match condition.fact:
        case "row":
            return condition.row is not None and row <= condition.row
        case "lane":
            there = condition.lane is not None and column in lane_columns(world.road, condition.lane)
            return there is not bool(condition.no_longer)
        case "goal":
            return _is_close(condition, row * state.config.cell_m)
        case "count":
            count = world.count(Kind(condition.kind)) if condition.kind is not None else 0
            low, high = condition.at_least, condition.at_most
            return (low is None or count >= low) and (high is None or count <= high)
        case _:
            return _is_near(condition, world, state.config.cell_m)


def _ticks(condition: Condition, state: SimState) -> int:
    """The ticks that a time is at the present length of a tick, at least one."""
    if condition.ticks is not None:
        return condition.ticks
    return max(1, round((condition.seconds or 0.0) / state.config.step_seconds))


def _is_near(condition: Condition, world: World, cell_m: float) -> bool:
    kind = None if condition.kind is None else Kind(condition.kind)
    away_m = nearest_m(world, kind, cell_m, condition.side)
    if condition.farther_than_m is not None:
        return away_m is None or away_m > condition.farther_than_m
    return away_m is not None and _is_close(condition, away_m)


def _is_close(condition: Condition, away_m: float) -> bool:
    if condition.within_m is not None:
        return away_m <= condition.within_m
    return condition.closer_than_m is not None and away_m < condition.closer_than_m


def nearest_m(world: World, kind: Kind | None, cell_m: float, side: str | None = None) -> float | None:
    """Metres from the first ego to the nearest thing of a kind, or of any; None where there is none.

    `side`: "ahead" or "behind", where only things in its column and on that side of it count.
    """
    road = world.road
    column, row = road.cell(world.avs[0])
    cells = [*world.movers, *world.hazards] if kind is None else []
    if kind is not None and kind is not Kind.AV:
        cells = [cell for cell in (*world.movers, *world.hazards) if world.board(kind) >> cell & 1]
    if kind in (None, Kind.AV):
        cells += world.avs[1:]
    places: Iterable[Cell] = map(road.cell, cells)
    if side is not None:
        places = [(c, r) for c, r in places if c == column and (r < row if side == "ahead" else r > row)]
    away = min((max(abs(c - column), abs(r - row)) for c, r in places), default=None)
    return None if away is None else away * cell_m
