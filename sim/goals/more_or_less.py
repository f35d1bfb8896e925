"""Makes the present road harder or easier, thing by thing, until the room to manoeuvre has changed enough.

Harder: the fewest ticks to the goal do not go down, the room (`sim.goals.measure`) goes down by a share, and
the present planner does not arrive sooner. Easier: the fewest ticks do not go up, a share of the room that
things take is regained, and the present planner arrives if it did. Both roads can be driven, which is proved.
At each step some things are drawn, and the one is kept that comes nearest to what is wanted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final, NamedTuple

from sim.actions import Add, Degree, GoalName, PlaceableKind, Remove, Where, WorldAction
from sim.goals.budget import Budget
from sim.goals.finding import Finding
from sim.goals.measure import Difficulty, Drive, drive, measure, room
from sim.oracle.outlook import outlook
from sim.plan.safe_planning import is_foreign
from sim.randomness import Stream
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.types import Kind, Outcome
from sim.world import Thing
from sim.world.grid import cells_of

HARDER_BY: Final[dict[Degree | None, float]] = {"little": 0.05, None: 0.12, "lot": 0.25}
"""The share of the room that a harder road lacks at least."""

EASIER_BY: Final[dict[Degree | None, float]] = {"little": 0.1, None: 0.25, "lot": 0.5}
"""The share of the room taken by things that an easier road has again at least."""

CELLS_A_THING: Final[dict[Degree | None, int]] = {"little": 15, None: 8, "lot": 5}
"""One thing is added or removed at most for every so many cells of the road."""

DRAWS: Final = 10
"""Changes that are tried for each thing."""

CLEAR_ROWS: Final = 3
"""Rows before the vehicle that are left as they are."""

ATTEMPTS: Final = 8
"""Searches before it is given up."""

_KINDS: Final[tuple[PlaceableKind, ...]] = ("barrier", "pothole", "vehicle", "vehicle")
"""What is added, each as likely as the others."""

Draw = Callable[[SimState, Stream], WorldAction | None]
"""Draws a change of a road."""

Distance = Callable[[Difficulty], float | None]
"""How much room there is between a road and what is wanted; None for one that is out of the question."""


class _Tried(NamedTuple):
    action: WorldAction
    state: SimState
    level: Difficulty


def find_harder(state: SimState, degree: Degree | None, budget: Budget) -> Finding | None:
    """Things to add that make the road harder; None where none are found. Raises `EditError`."""
    before = measure_present(state, budget)
    if before is None:
        raise EditError("goal_no_way", "goal")
    wanted = before.room * (1 - HARDER_BY[degree])

    def distance(level: Difficulty) -> float | None:
        return level.room - wanted if level.ticks >= before.ticks else None

    return _search("harder", state, before, _placing, distance, _most_things(state, degree), budget)


def find_easier(state: SimState, degree: Degree | None, budget: Budget) -> Finding | None:
    """Things to remove that make the road easier, or that open it; None where none are found."""
    before = measure_present(state, budget)
    if before is None:
        return _opened(state, budget)
    names = {thing.id for thing in state.world.things() if thing.kind is not Kind.AV}
    empty = room(replace(state, world=state.world.without(names)), before.horizon)
    wanted = before.room + (empty - before.room) * EASIER_BY[degree]
    if not names or wanted <= before.room:
        return None

    def distance(level: Difficulty) -> float | None:
        return wanted - level.room if level.ticks <= before.ticks else None

    return _search("easier", state, before, _removing, distance, _most_things(state, degree), budget)


def _search(
    goal: GoalName,
    state: SimState,
    before: Difficulty,
    draw: Draw,
    distance: Distance,
    most: int,
    budget: Budget,
) -> Finding | None:
    """The first series of changes that goes far enough, and that the present planner's drives agree with."""
    drives = present_drives(state, budget)
    for attempt in range(ATTEMPTS):
        found = _change(state, _stream(state, goal).narrow(attempt), draw, before, distance, most, budget)
        if found is None:
            continue
        last = found[-1]
        after = present_drives(last.state, budget)
        if all(_agrees(goal, was, now) for was, now in zip(drives, after, strict=True)):
            actions = tuple(each.action for each in found)
            return Finding(goal, actions, last.state, last.level, before, after, drives)
    return None


def _most_things(state: SimState, degree: Degree | None) -> int:
    """The largest number of things that are added or removed."""
    road = state.world.road
    return road.columns * road.rows // CELLS_A_THING[degree]


def _agrees(goal: GoalName, was: Drive, now: Drive) -> bool:
    """Whether a planner's drives before and after do not speak against the goal."""
    if goal == "harder":
        return not now.arrives or (was.arrives and now.ticks >= was.ticks)
    return now.arrives or not was.arrives


def measure_present(state: SimState, budget: Budget) -> Difficulty | None:
    """The difficulty of the present road. Raises `EditError` after the end of its episode."""
    if state.world.outcome is not Outcome.RUNNING:
        raise EditError("goal_after_end", "goal")
    return measure(state, budget)


def _stream(state: SimState, goal: GoalName) -> Stream:
    world = state.world
    return Stream.of(state.config.seed, f"goal {goal}", world.episode, world.tick, state.edits)


def _change(
    state: SimState,
    stream: Stream,
    draw: Draw,
    before: Difficulty,
    distance: Distance,
    most: int,
    budget: Budget,
) -> list[_Tried] | None:
    """Changes one by one, each bringing the room nearer, until it is near enough; None where it never is."""
    kept: list[_Tried] = []
    now, away = state, distance(before)
    for step in range(most):
        best: _Tried | None = None
        for number in range(DRAWS):
            action = draw(now, stream.narrow(step, number))
            if action is None:
                continue
            after = apply(now, action).state
            level = measure(after, budget, before.horizon)
            gap = None if level is None else distance(level)
            if level is not None and gap is not None and (away is None or gap < away):
                best, away = _Tried(action, after, level), gap
        if best is None:
            continue
        kept.append(best)
        now = best.state
        if away is not None and away <= 0:
            return kept
    return None


def _placing(state: SimState, stream: Stream) -> Add | None:
    """A thing to put in a free cell some rows ahead."""
    road = state.world.road
    row = state.world.av // road.columns - CLEAR_ROWS
    ahead = (1 << max(0, row) * road.columns) - 1
    free = cells_of(road.between & ahead & ~state.world.occupied)
    if not free:
        return None
    cell = road.cell(free[stream.below(len(free), 0)])
    return Add(kind=_KINDS[stream.below(len(_KINDS), 1)], count=1, where=Where(cell=cell))


def _removing(state: SimState, stream: Stream) -> Remove | None:
    """A thing ahead of the vehicle, or beside it, to take away."""
    _, row = state.world.road.cell(state.world.av)
    things = [thing for thing in state.world.things() if thing.cell[1] <= row and thing.kind is not Kind.AV]
    if not things:
        return None
    thing = things[stream.below(len(things), 0)]
    return _taking(thing)


def _taking(thing: Thing) -> Remove:
    return Remove(kind=thing.kind.value, count=1, where=Where(id=thing.id))


def _opened(state: SimState, budget: Budget) -> Finding | None:
    """Things to remove where there is no way, without which there is one."""
    budget.spend(state.config, state.world.road.rows, 16)
    seen = outlook(state)
    if seen is None or not seen.ids:
        return None
    after, actions = state, []
    for name in seen.ids:
        thing = after.world.find(name)
        if thing is None or thing.kind is Kind.AV:
            return None
        action = _taking(thing)
        actions.append(action)
        after = apply(after, action).state
    level = measure(after, budget)
    if level is None:
        return None
    drives = present_drives(after, budget)
    return Finding(
        "easier", tuple(actions), after, level, drives=drives, drives_before=present_drives(state, budget)
    )


def present_drives(state: SimState, budget: Budget) -> tuple[Drive, ...]:
    """The drive of the present planner; none where it is of another package, which may be slow."""
    planner = state.config_of().planner
    return () if is_foreign(planner) else (drive(state, planner, budget),)
