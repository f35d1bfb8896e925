"""`rules`: forward where a way leads on; else by a diagonal or aside to the nearest way on; else wait.

Structure: every move is ranked by where it leads, as if its cell were free; the first that is free is made.
Where it leads is looked up in the ways past all that never moves (`sim.search.passages`): potholes,
barriers, and movers that are locked in between them. The ranking:

1. forward, then a diagonal, into a cell that leads on;
2. where neither of them leads on: left or right, toward the nearest way on;
3. stay: what is in the way moves on, or nothing leads on;
4. left or right although the way on is straight ahead, then what a mover closes.

A way on is closed while a mover comes toward the ego in between: the two would meet before the ego is
there, and it would be pinned against the mover. So a row is entered only where its way on is open.
Guarantees: never a step into a cell that will be taken while any is free; never into a dead end that fixed
hazards make while staying is free; local (`sim.plan.protocol.Traits`): besides what never moves, the movers
of the ego's row and of the one ahead decide.
Simplifications: no memory, one tick of forecast. Beyond it a mover is taken to drive on, and to turn at the
next thing that never moves, as if it were alone. A way that a mover keeps closed is waited for, which ends as
STUCK. Left comes before right only among equals.
Source: the order of the pygame study this project grew from (`priority`), changed where that runs into
livelocks and dead ends. A diagonal that leads on comes before a step aside because it gains a row: fewer
vehicles get stuck (measured, see `bench/PLANNERS.md`).
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from functools import lru_cache
from typing import Final, NamedTuple

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.forecast import Forecast, StepVerdict
from sim.plan.decision import Decision, Option
from sim.plan.priority import met_option
from sim.plan.protocol import SIMPLEST, Traits
from sim.rules.dynamics import Dynamics
from sim.search.passages import Ways, locked_in, ways_past
from sim.types import MOVES, Move


class Leads(StrEnum):
    """Where a move leads, whether or not its cell will be free."""

    ON = "on"
    """to a way on"""
    CLOSED = "closed"
    """to a way on that a mover closes: it comes toward the ego in between"""
    BACK = "back"
    """aside, away from the way on: the ego would have to turn back"""
    NOWHERE = "nowhere"
    """into a dead end, or into something that never moves"""


class Prospect(NamedTuple):
    """What a move has to offer."""

    leads: Leads
    columns: int | None
    """columns to go aside from its cell to the way on; None where there is none that way"""
    closer: int | None = None
    """the cell in which the mover that closes the way is after the tick"""


class Standing(NamedTuple):
    """What the rules go by in a moment."""

    columns: int | None
    """columns to go aside from the ego's cell to a way on; None where none leads on"""
    prospects: tuple[Prospect | None, ...]
    """of every move, in the order of `MOVES`; None off the road"""

    def of(self, move: Move) -> Prospect | None:
        """What a move has to offer; None off the road."""
        return self.prospects[MOVES.index(move)]


_STRAIGHT: Final = Prospect(Leads.ON, 0)
_BACK: Final = Prospect(Leads.BACK, None)
_NOWHERE: Final = Prospect(Leads.NOWHERE, None)

_CLASS: Final = 1 << 8
"""Between the ranks of two classes; within a class the fewer columns come first."""
_FIRST, _FORWARD, _DIAGONAL, _ASIDE, _STAY, _DODGE, _CLOSED, _LAST = range(-_CLASS, 7 * _CLASS, _CLASS)
"""Ranks, the lowest first. `_FIRST` and those from `_LAST` on are dead ends: straight on, which is what would
be done if there were a way; then staying; then all others."""

_decided = fast_constructor(Decision, "tick", "av", "planner", "move", "options")


class RulesPlanner:
    """The first move of the ranking whose cell will be free; staying when there is none."""

    name = "rules"
    traits = Traits(
        local=True,
        forward_only=True,
        plans_to_goal=False,
        by_passages=True,
        work=SIMPLEST,
        decisions_per_answer=450,
    )

    def horizon(self, config: Config) -> int:  # noqa: ARG002 - the same for every road
        """One tick."""
        return 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:  # noqa: ARG002 - no preferences
        """The move and the six verdicts."""
        ego = forecast.ego
        places, options = _ranked(forecast.dynamics, ego, _ranks(standing(forecast)))
        steps = forecast.own_steps()
        if not all(steps):
            told = zip(places, options, strict=True)
            options = tuple([free if steps[place] else met_option(forecast, free) for place, free in told])
        return _decided(forecast.tick, forecast.ego_id, self.name, _first(options), options)


def standing(forecast: Forecast) -> Standing:
    """Where every move leads, by what is known of the coming tick."""
    road, ego = forecast.road, forecast.ego
    columns = road.columns
    right, left, _, _ = forecast.slices[0]
    fixed = forecast.fixed
    if forecast.egos and (parked := forecast.parked):
        # A mover that brakes for a parked ego stays and keeps facing it.
        fixed |= parked | right & parked >> 1 | left & parked << 1
    ways = ways_past(
        columns, road.rows, fixed | locked_in(right | left, fixed, road.left_edge, road.right_edge)
    )
    straight, on = ways.levels[0], ways.open
    prospects: list[Prospect | None] = []
    for end, sides in _ends(forecast.dynamics, ego):
        if end is None:
            prospects.append(None)
        elif straight >> end & 1:
            prospects.append(_STRAIGHT)
        elif not on >> end & 1:
            prospects.append(_NOWHERE)
        elif end == ego:
            prospects.append(Prospect(Leads.ON, ways.columns_aside(ego)))
        else:
            found = [_toward(forecast, ways, end, side) for side in sides]
            prospects.append(min((each for each in found if each is not None), key=_nearness, default=_BACK))
    return Standing(ways.columns_aside(ego), tuple(prospects))


def _toward(forecast: Forecast, ways: Ways, end: int, side: int) -> Prospect | None:
    """From a cell to the nearest way on to one side of it; None where there is none.

    The ego gets there by steps aside and one diagonal. A mover that comes toward it is met before that if
    it is nearer than twice the way. One that drives away is taken for its mirror image behind where it turns.
    """
    columns = forecast.road.columns
    column = end % columns
    row = end - column
    ahead, still = ways.open >> row - columns, ways.still >> row
    room = columns - 1 - column if side > 0 else column
    away = next((far for far in range(1, room + 1) if ahead >> column + side * far & 1), None)
    last = next((far - 1 for far in range(1, room + 1) if still >> column + side * far & 1), room)
    if away is None or last < away - 1:
        return None
    right, left, _, _ = forecast.slices[0]
    coming, leaving = (left >> row, right >> row) if side > 0 else (right >> row, left >> row)
    for far in range(1, last + 1):
        there = column + side * far
        if (coming >> there & 1 and far < 2 * away) or (leaving >> there & 1 and 2 * last - far < 2 * away):
            return Prospect(Leads.CLOSED, away, row + there)
    return Prospect(Leads.ON, away)


def _nearness(prospect: Prospect) -> tuple[bool, int]:
    """What is open before what is closed; then the nearest."""
    return prospect.leads is Leads.CLOSED, prospect.columns or 0


def _ranks(standing: Standing) -> tuple[int, ...]:
    """The rank of every move, in the order of `MOVES`: the lowest comes first, among equals the earlier."""
    forward, left, right, forward_left, forward_right, _ = standing.prospects
    below = standing.columns == 0
    return (
        _rank_forward(forward),
        _rank_aside(left, below),
        _rank_aside(right, below),
        _rank_diagonal(forward_left),
        _rank_diagonal(forward_right),
        _LAST if standing.columns is None else _STAY,
    )


def _rank_forward(prospect: Prospect | None) -> int:
    if prospect is None or prospect.leads is Leads.NOWHERE:
        return _FIRST
    return _CLOSED if prospect.leads is Leads.CLOSED else _FORWARD


def _rank_diagonal(prospect: Prospect | None) -> int:
    if prospect is None or prospect.columns is None:
        return _LAST + 1
    return (_DIAGONAL if prospect.leads is Leads.ON else _CLOSED) + prospect.columns


def _rank_aside(prospect: Prospect | None, below: bool) -> int:
    """`below`: whether the way on is straight ahead of the ego."""
    if prospect is None or prospect.leads is Leads.NOWHERE:
        return _LAST + 1
    if prospect.leads is Leads.ON:
        return (_DODGE if below else _ASIDE) + (prospect.columns or 0)
    return _CLOSED + 1


def _first(options: Sequence[Option]) -> Move:
    """The first that is free and leads on; else to stay, if that is free; else whatever is."""
    for option in options:
        if option.cost is not None:
            return option.move
    free = [option.move for option in options if not option.reason.blocks]
    return free[0] if free and Move.STAY not in free else Move.STAY


@lru_cache(maxsize=4_096)
def _ends(dynamics: Dynamics, index: int) -> tuple[tuple[int | None, tuple[int, ...]], ...]:
    """Where every move leads, in the order of `MOVES`, and on which sides of it to look for a way on."""
    sides = {Move.LEFT: (-1,), Move.RIGHT: (1,)}
    return tuple((dynamics.target(index, move), sides.get(move, (-1, 1))) for move in MOVES)


@lru_cache(maxsize=16_384)
def _ranked(
    dynamics: Dynamics, index: int, ranks: tuple[int, ...]
) -> tuple[tuple[int, ...], tuple[Option, ...]]:
    """The moves by their ranks, as places in `MOVES` and as they are where nothing would be met."""
    places = sorted(range(len(MOVES)), key=ranks.__getitem__)
    options = []
    for cost, place in enumerate(places):
        end = dynamics.target(index, MOVES[place])
        cell = None if end is None else dynamics.road.cell(end)
        on = _FIRST < ranks[place] < _LAST
        options.append(Option(MOVES[place], cell, StepVerdict.FREE, float(cost) if on else None, ()))
    return tuple(places), tuple(options)
