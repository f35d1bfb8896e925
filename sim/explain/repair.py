"""The smallest change after which the ego arrives, or does not crash: each change is made and run to the end.

Looked for are things taken away (one, then two, then three at once, the most telling first), and beside them
another planner and, for a planner that weighs costs, another wish. `Repair.searched` says up to how many
things all were tried, and `Repair.outlook` certifies that the way is shut where it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Final, Literal, get_args

from sim.actions import Prefer, Wish
from sim.explain.factors import removal
from sim.explain.foresight import Foresight, driving, foresee, running_state
from sim.explain.planners import PlannerDrive, drive_each, others_than, planner_of
from sim.oracle.outlook import Outlook, outlook
from sim.plan import traits_of
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import is_ego

MOST_REMOVED: Final = 3
"""Things of the largest change that is looked for."""
TRIES_QUICK: Final = 150
"""Changes that are run where a planner decides quickly: some 5 ms each."""
TRIES_SEARCHING: Final = 12
"""The same where a planner searches to the goal, or futures are drawn."""
NEAR: Final = 12
"""Things of which two and three at once are tried."""

Aim = Literal["arrive", "avoid"]


@dataclass(frozen=True, slots=True)
class Repair:
    """What would make the ego arrive, or keep it from crashing."""

    state: SimState
    aim: Aim
    now: Foresight
    """how it goes as it is"""
    removed: tuple[str, ...]
    """a smallest set of things without which the aim is reached; empty where none was found"""
    then: Foresight | None
    """how it goes without them"""
    searched: int
    """things up to which every set was tried and found not to be enough"""
    planner: PlannerDrive | None
    """the best of the other planners with which it is reached"""
    wish: Wish | None
    """a wish with which the same planner reaches it"""
    outlook: Outlook | None
    """whether any way leads to the goal at all; None where that was not found out"""
    tried: int

    @property
    def reached(self) -> bool:
        """Whether it is so already."""
        return reaches(self.now, self.aim)


def reaches(seen: Foresight, aim: Aim) -> bool:
    """Whether the aim is reached in every future that was found."""
    if aim == "arrive":
        return seen.arrives == 1.0
    return seen.crashes == 0.0 and seen.told


def repair(timeline: Timeline, aim: Aim, *, ego: str | None = None) -> Repair:
    """Looks for the smallest change that reaches the aim from now on. Raises `QuestionError`."""
    state = driving(running_state(timeline, ego), ego)
    now = foresee(state, ego)
    found = outlook(state, ego=ego)
    if reaches(now, aim):
        return Repair(state, aim, now, (), None, 0, None, None, found, 0)
    search = _Removals(state, aim, ego)
    removed, then, searched = search.smallest(_telling(state, now, found, ego))
    others = [
        each for each in drive_each(state, others_than(state, ego), ego) if reaches(each.foresight, aim)
    ]
    best = min(others, key=lambda each: each.foresight.story.driven, default=None)
    return Repair(state, aim, now, removed, then, searched, best, _wish(state, aim, ego), found, search.tried)


def _telling(state: SimState, now: Foresight, found: Outlook | None, ego: str | None) -> list[str]:
    """All things ahead or level with the ego: what it hits, what shuts the way, then the nearest first."""
    world, road = state.world, state.world.road
    lane, row = road.cell(world.avs[state.number(ego)])
    cause = now.story.cause
    first = [] if cause is None else list(cause.ids)
    first += () if found is None else found.ids
    first += [name for detour in now.story.detours for name in detour.ids]
    cells = {name: road.cell(index) for index, name in (*world.movers.items(), *world.hazards.items())}
    ahead = [name for name, cell in cells.items() if cell[1] <= row]
    near = sorted(ahead, key=lambda name: (_far(cells[name], lane, row), name))
    return [name for name in dict.fromkeys((*first, *near)) if name in cells and not is_ego(name)]


def _far(cell: tuple[int, int], lane: int, row: int) -> int:
    return abs(cell[0] - lane) + abs(cell[1] - row)


def _wish(state: SimState, aim: Aim, ego: str | None) -> Wish | None:
    """A wish with which the planner reaches the aim, where it weighs wishes."""
    if not traits_of(planner_of(state, ego)).weighs_costs:
        return None
    for wish in get_args(Wish):
        if reaches(foresee(apply(state, Prefer(preference=wish)).state, ego), aim):
            found: Wish = wish
            return found
    return None


class _Removals:
    """Drives without some things, each set of them once."""

    def __init__(self, state: SimState, aim: Aim, ego: str | None) -> None:
        self._state, self._aim, self._ego = state, aim, ego
        quick = traits_of(planner_of(state, ego)).quick and state.config.certain
        self._most = TRIES_QUICK if quick else TRIES_SEARCHING
        self.tried = 0

    def smallest(self, names: list[str]) -> tuple[tuple[str, ...], Foresight | None, int]:
        """A smallest set that reaches the aim, how it goes without it, and the size up to which none does."""
        searched = 0
        for size in range(1, MOST_REMOVED + 1):
            pool = names if size == 1 else names[:NEAR]
            for gone in combinations(pool, size):
                if self.tried >= self._most:
                    return (), None, searched
                self.tried += 1
                then = foresee(without(self._state, gone), self._ego)
                if reaches(then, self._aim):
                    return gone, then, searched
            searched = size if len(pool) == len(names) else searched
        return (), None, searched


def without(state: SimState, names: tuple[str, ...]) -> SimState:
    """The state after a person has taken these things away."""
    for action in removal(names, state.config):
        state = apply(state, action).state
    return state
