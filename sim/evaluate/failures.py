"""Looks at the episodes behind the figures: what was hit, how it was stuck, and the tick to look at."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal

import numpy as np

from sim.evaluate.closeness import Closeness
from sim.evaluate.executor import CancelledError
from sim.evaluate.extremes import extremes
from sim.evaluate.part import with_rules
from sim.evaluate.rows import ARRIVED, NO_WAY, ROADS, Rows
from sim.evaluate.spec import Evaluation
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome, kind_of

MOST: Final = 30
"""Failed episodes of a planner that are looked at, the first ones."""
MOST_IN_A_CELL: Final = 3
"""The same for each cell of a success map."""
BEFORE: Final = 4
"""Ticks before the end of a crash or an arrival at which it is worth looking."""
_LAST: Final = 8
"""Moves at the end of a stuck episode that show how it is stuck."""

NEAR: Final = frozenset(("ttc", "gap", "exposed"))
"""Figures whose episodes are looked at where something came nearest."""

Pattern = Literal["swinging", "waiting", "hit"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """One episode to look at."""

    planner: str
    index: int
    seed: int
    outcome: Outcome
    ticks: int
    tick: int
    """the tick at which it is worth looking"""
    digest: str
    """that of the world at this tick"""
    solvable: bool
    """whether the road has a way to the goal, or may have"""
    pattern: Pattern | None = None
    """how it failed: moving left and right, or not at all, without getting on; or by hitting something"""
    thing: str | None = None
    """the kind of what was hit, or of what lay straight ahead where it was stuck"""
    shows: tuple[str, ...] = ()
    """the figures that it stands behind (`sim.evaluate.extremes`)"""

    def to_json(self) -> dict[str, Any]:
        """As JSON values."""
        return {**asdict(self), "shows": list(self.shows)}


def examples(spec: Evaluation, rows: Rows, cancelled: Callable[[], bool] = lambda: False) -> list[Example]:
    """Failures of each planner, those on solvable roads first, and the episodes behind its other figures."""
    solvable = rows[ROADS]["solvable"] != NO_WAY
    found = []
    for planner in spec.planners:
        shown = extremes(spec, planner, rows)
        failed = _failures(rows[planner]["outcome"], solvable, most_of(spec))
        for index in dict.fromkeys((*failed, *shown)):
            if cancelled():
                raise CancelledError
            found.append(_look(spec, planner, index, bool(solvable[index]), shown.get(index, ())))
    return found


def most_of(spec: Evaluation) -> int:
    """How many failed episodes of a planner are looked at, of each case."""
    return MOST if spec.axes is None else MOST_IN_A_CELL


def _failures(outcome: Any, solvable: Any, most: int) -> Iterator[int]:
    failed = outcome != ARRIVED
    chosen = [*np.flatnonzero(failed & solvable)[:most], *np.flatnonzero(failed & ~solvable)[:most]][:most]
    yield from map(int, chosen)


def _look(spec: Evaluation, planner: str, index: int, solvable: bool, shows: tuple[str, ...] = ()) -> Example:
    states, moves = [spec.start(index, planner)], []
    closeness = Closeness() if NEAR.intersection(shows) else None
    nearest = 0
    while states[-1].world.outcome is Outcome.RUNNING:
        done = step(states[-1])
        states.append(with_rules(states[-1], done.state))
        moves.append(None if done.decision is None else done.decision.move)
        if closeness is None:
            continue
        before = closeness.ttc_s, closeness.gap_m
        closeness.add(states[-2], done.state, moves[-1])
        if (closeness.ttc_s, closeness.gap_m) != before:
            nearest = len(moves)
    last = states[-1].world
    ends = len(states) - 1
    if last.outcome is Outcome.SUCCESS and closeness is not None:
        ends = nearest
    back = min(ends, _LAST if last.outcome is Outcome.STUCK else BEFORE)
    shown = states[ends - back].world
    pattern, thing = failure_pattern(states[-1], moves)
    return Example(
        planner=planner,
        index=index,
        seed=spec.seed + index,
        outcome=last.outcome,
        ticks=len(moves),
        tick=shown.tick,
        digest=shown.digest(),
        solvable=solvable,
        pattern=pattern,
        thing=thing,
        shows=shows,
    )


def failure_pattern(end: SimState, moves: list[Move | None]) -> tuple[Pattern | None, str | None]:
    """How an episode failed that ended so after these moves, and the kind of thing (`Example`)."""
    world = end.world
    if world.outcome is Outcome.CRASH and world.cause is not None:
        return "hit", str(kind_of(world.cause.ids[0])) if world.cause.ids else None
    if world.outcome is not Outcome.STUCK:
        return None, None
    ahead = world.hazards.get(world.av - world.road.columns)
    thing = None if ahead is None else str(kind_of(ahead))
    latest = moves[-_LAST:]
    if Move.LEFT in latest and Move.RIGHT in latest:
        return "swinging", thing
    return ("waiting" if latest.count(Move.STAY) * 2 >= len(latest) else None), thing
