"""A*: the cheapest way from a state to a goal, one state at a time.

Structure: a heap ordered by cost so far + lower bound; a state is settled when it is taken out for the
first time. Guarantee: the least cost, and among ways of that cost always the same one; with a bound
of 0 this is Dijkstra's algorithm. Sources: Hart, Nilsson & Raphael, "A formal basis for the heuristic
determination of minimum cost paths" (1968); Dijkstra, "A note on two problems in connexion with graphs"
(1959); what settled states teach about the rest (`AdaptiveHeuristic`): Koenig & Likhachev, "Adaptive A*"
(2005).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from heapq import heappop, heappush

from sim.search.graph import SearchGraph, State


@dataclass(frozen=True, slots=True)
class Path:
    """A cheapest way. It ends at a goal, or with `AdaptiveHeuristic` where the rest was known already."""

    cost: int
    """to the goal"""
    moves: tuple[int, ...]
    """indices of the move set"""
    states: tuple[State, ...]
    """the first and the last included"""
    expanded: int
    """states whose steps were looked at"""


@dataclass(slots=True)
class AdaptiveHeuristic:
    """What searches on one terrain have shown: sharper bounds, and exact costs along the ways found."""

    bounds: dict[State, int] = field(default_factory=dict)
    exact: dict[State, int] = field(default_factory=dict)
    dead_ends: set[State] = field(default_factory=set)
    """states from which no way leads to a goal"""


def no_heuristic(state: State) -> int:  # noqa: ARG001 - the same for every state
    """The bound that makes a search Dijkstra's."""
    return 0


def cheapest(
    terrain: SearchGraph,
    start: State,
    *,
    heuristic: Callable[[State], int] | None = None,
    lessons: AdaptiveHeuristic | None = None,
) -> Path | None:
    """A cheapest way from `start` to a goal; None if there is none.

    `heuristic` replaces the terrain's own bound. `lessons` are used and added to; they must come from the
    same terrain.
    """
    bound = heuristic or terrain.heuristic
    known = AdaptiveHeuristic() if lessons is None else lessons
    bounds, exact, dead_ends = known.bounds, known.exact, known.dead_ends
    cost_to: dict[State, int] = {start: 0}
    came_by: dict[State, tuple[State, int]] = {}
    settled: set[State] = set()
    number = 0
    heap: list[tuple[int, int, int]] = [(bounds.get(start) or bound(start), 0, start)]
    while heap:
        _, _, state = heappop(heap)
        if state in settled:
            continue
        so_far = cost_to[state]
        if state in exact or terrain.at_goal(state):
            total = so_far + exact.get(state, 0)
            way = _way(state, came_by, total, len(settled))
            _learn(known, settled, cost_to, total, way)
            return way
        settled.add(state)
        for move, there, cost in terrain.steps(state):
            total = so_far + cost
            before = cost_to.get(there)
            if (before is None or total < before) and there not in dead_ends:
                cost_to[there] = total
                came_by[there] = (state, move)
                number -= 1
                rest = exact.get(there)
                if rest is None:
                    rest = bounds.get(there)
                    if rest is None:
                        rest = bound(there)
                # Of equal estimates the latest found first: that goes straight on.
                heappush(heap, (total + rest, number, there))
    known.dead_ends |= settled
    return None


def _way(state: State, came_by: dict[State, tuple[State, int]], cost: int, expanded: int) -> Path:
    states, moves = [state], []
    while state in came_by:
        state, move = came_by[state]
        states.append(state)
        moves.append(move)
    return Path(cost, tuple(reversed(moves)), tuple(reversed(states)), expanded)


def _learn(
    known: AdaptiveHeuristic, settled: set[State], cost_to: dict[State, int], total: int, way: Path
) -> None:
    bounds = known.bounds
    for state in settled:
        rest = total - cost_to[state]
        if rest > bounds.get(state, 0):
            bounds[state] = rest
    for state in way.states:
        known.exact[state] = total - cost_to[state]
