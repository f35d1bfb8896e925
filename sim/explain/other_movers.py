"""Why another road user moved as it did in a tick, and where it goes next: from the rules of movers, re-run.

What held a mover back is found by experiment: the same tick is run again without each thing beside it, and
without its reaction to the ego. What changes where it goes, or where it heads, is a cause. A pair of things
is tried where none alone changes anything. The edge of the road and the rhythm of steps cannot be taken away.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations
from typing import Final

from sim.config import Config
from sim.explain.question_error import QuestionError
from sim.rules.mover_boards import PERIODS
from sim.rules.traffic import steps_in_tick
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step
from sim.types import HAZARDS, Cell, Move, Outcome
from sim.world import Thing, World

REACH: Final = 3
"""Columns on either side in which something may decide where a mover goes within a tick."""
LOOK_BACK: Final = 20
"""Ticks in which something that is said of a mover is looked for."""
LOOK_AHEAD: Final = 12
"""Ticks that the way of a mover is followed."""
REACTIONS: Final = ("courtesy", "attentive")
"""The settings by which movers react to the ego: giving way, and braking."""


class MoverReason(StrEnum):
    """What decided where a mover went."""

    FREE = "free"
    """the next cell in its heading was free"""
    EDGE = "edge"
    """the road ends there"""
    BLOCKED = "blocked"
    """something stands, or wants to go, where it heads"""
    GIVES_WAY = "gives_way"
    BRAKES = "brakes"
    HELD = "held"
    """it stands in a pothole"""
    RESTS = "rests"
    """its kind needs several ticks for a step"""


@dataclass(frozen=True, slots=True)
class MoverMove:
    """What a mover did in a tick, and why."""

    before: SimState
    """the state at the tick"""
    id: str
    was: Thing
    now: Thing
    reason: MoverReason
    ids: tuple[str, ...]
    """what it would have gone on but for: each alone, or both together (`together`)"""
    together: bool
    otherwise: Thing | None
    """where it is a tick later without them; None where nothing could be taken away"""
    reruns: int

    @property
    def tick(self) -> int:
        """The tick in which it was."""
        return self.before.world.tick

    @property
    def move(self) -> Move:
        """Its step: left, right, or none."""
        return _step(self.was.cell, self.now.cell)

    @property
    def turned(self) -> bool:
        """Whether it heads the other way afterwards."""
        return self.was.heading != self.now.heading


@dataclass(frozen=True, slots=True)
class MoverWay:
    """Where a mover goes in the next ticks, if the ego drives on as it does."""

    state: SimState
    id: str
    steps: tuple[Move, ...]
    """one for each tick"""
    turn: MoverMove | None
    """the first tick in which it turns round, with its reason"""
    ended: bool
    """whether the episode ends within these ticks"""
    by_chance: bool
    """whether some tick of them hangs on who gives way or brakes, which is drawn then"""
    cell: Cell
    """where it is after them"""


def mover_move(state: SimState, made: tuple[Move, ...], id: str) -> MoverMove:
    """What a mover did in the tick that begins in a state, in which the egos made these moves.

    Raises `QuestionError`: `not_there`, `never_moves`.
    """
    was = _mover(state.world, id)
    tried = _Tried(state, made, id)
    now = tried.run()
    if now is None:
        raise QuestionError("not_there", id=id)
    if was.disabled:
        holding = tuple(each for each in _near(state.world, was, 0) if each != id)
        return _told(state, was, now, MoverReason.HELD, *tried.but_for([holding], now))
    if not steps_in_tick(PERIODS[was.kind], state.world.episode_tick):
        return MoverMove(state, id, was, now, MoverReason.RESTS, (), False, None, tried.count)
    if _step(was.cell, now.cell) is Move(str(was.heading)):
        return MoverMove(state, id, was, now, MoverReason.FREE, (), False, None, tried.count)
    for setting, reason in zip(REACTIONS, (MoverReason.GIVES_WAY, MoverReason.BRAKES), strict=True):
        without = tried.run(config=state.config.with_parts(**{setting: 0.0}))
        if without is not None and (without.cell, without.heading) != (now.cell, now.heading):
            return MoverMove(state, id, was, now, reason, (), False, without, tried.count)
    near = [each for each in _near(state.world, was, REACH) if each != id]
    single = [(each,) for each in near]
    ids, together, otherwise, count = tried.but_for(single, now)
    if not ids:
        ids, together, otherwise, count = tried.but_for(list(combinations(near, 2)), now)
    onwards = was.cell[0] + (1 if was.heading == "right" else -1)
    edge = not 0 <= onwards < state.world.road.columns
    reason = MoverReason.EDGE if edge else MoverReason.BLOCKED
    return _told(state, was, now, reason, ids, together, otherwise, count)


def latest_move(timeline: Timeline, id: str, move: Move | None, tick: int | None = None) -> MoverMove:
    """What a mover did in the last tick, in a tick, or when it last made a move.

    Raises `QuestionError`: `not_there`, `never_moves`, `no_such_tick`, `nothing_yet`, `never_did`.
    """
    now = timeline.tick
    if tick is not None and not 0 <= tick < now:
        raise QuestionError("no_such_tick" if tick > now else "not_yet", tick=tick, now=now)
    last = now - 1 if tick is None else tick
    start = timeline.at(max(0, last)).world.episode_start
    oldest = max(0, start, last - LOOK_BACK) if tick is None and move is not None else last
    if last < 0:
        raise QuestionError("nothing_yet", tick=now)
    for state in reversed(list(timeline.between(oldest, last + 1))):
        if state.world.outcome is not Outcome.RUNNING or state.world.index_of(id) is None:
            continue
        after = timeline.led_to(state).state.world
        was, then = _mover(state.world, id), after.find(id)
        if then is not None and move in (None, _step(was.cell, then.cell)):
            return mover_move(state, _made(state, after), id)
    if timeline.at(last).world.index_of(id) is None or move is None:
        raise QuestionError("not_there", id=id)
    raise QuestionError("never_did", id=id, move=move, ticks=last - oldest + 1)


def mover_way(timeline: Timeline, id: str, ticks: int = LOOK_AHEAD) -> MoverWay:
    """Where a mover goes in so many ticks from now on.

    Raises `QuestionError`: `not_there`, `never_moves`, `result_stood`.
    """
    state = timeline.state
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("result_stood", tick=state.world.tick, outcome=state.world.outcome)
    cell = _mover(state.world, id).cell
    steps: list[Move] = []
    turn: MoverMove | None = None
    by_chance, here = False, state
    for _ in range(ticks):
        told = step(here)
        if any(each.decision.timed_out for each in told.steps.values()):
            break
        found = mover_move(here, _made(here, told.state.world), id)
        by_chance = by_chance or _hangs_on_chance(here, found)
        steps.append(found.move)
        cell = found.now.cell
        turn = turn or (found if found.turned else None)
        here = told.state
        if here.world.outcome is not Outcome.RUNNING:
            return MoverWay(state, id, tuple(steps), turn, True, by_chance, cell)
    return MoverWay(state, id, tuple(steps), turn, False, by_chance, cell)


def _hangs_on_chance(state: SimState, found: MoverMove) -> bool:
    """Whether the mover stands beside an ego in this tick, and how it reacts is drawn."""
    if state.config.certain:
        return False
    road = state.world.road
    cells = [road.cell(av) for av in state.world.avs]
    column, row = found.was.cell
    return any(abs(cell[0] - column) == 1 and cell[1] == row for cell in cells)


class _Tried:
    """One tick, run again with something otherwise; `count` counts the runs."""

    def __init__(self, state: SimState, made: tuple[Move, ...], id: str) -> None:
        self._state, self._made, self._id = state, made, id
        self.count = 0

    def run(self, gone: Iterable[str] = (), config: Config | None = None) -> Thing | None:
        """The mover a tick later, without these things."""
        self.count += 1
        gone = frozenset(gone)
        world = self._state.world.without(gone) if gone else self._state.world
        return next_world(world, self._made, config or self._state.config).find(self._id)

    def but_for(
        self, sets: Iterable[tuple[str, ...]], now: Thing
    ) -> tuple[tuple[str, ...], bool, Thing | None, int]:
        """Of sets of things those but for which it would be elsewhere or head elsewhere.

        Of single things all of them, of several the first set; and where it is without the first.
        """
        ids: tuple[str, ...] = ()
        otherwise: Thing | None = None
        for gone in sets:
            then = self.run(gone)
            if then is not None and (then.cell, then.heading) != (now.cell, now.heading):
                ids, otherwise = (*ids, *gone), otherwise or then
                if len(gone) > 1:
                    return ids, True, otherwise, self.count
        return ids, False, otherwise, self.count


def _told(
    state: SimState,
    was: Thing,
    now: Thing,
    reason: MoverReason,
    ids: tuple[str, ...],
    together: bool,
    otherwise: Thing | None,
    reruns: int,
) -> MoverMove:
    return MoverMove(state, was.id, was, now, reason, ids, together, otherwise, reruns)


def _mover(world: World, id: str) -> Thing:
    """The mover with this id. Raises `QuestionError`: `not_there`, `never_moves`."""
    found = world.find(id)
    if found is None:
        raise QuestionError("not_there", id=id)
    if found.heading is None:
        raise QuestionError("never_moves", id=id, kind=found.kind)
    return found


def _near(world: World, mover: Thing, reach: int) -> list[str]:
    """Ids of what lies in the mover's row within so many columns, its own cell first, then the nearest."""
    column, row = mover.cell
    found: list[tuple[int, str]] = []
    for across in range(-reach, reach + 1):
        if not 0 <= column + across < world.road.columns:
            continue
        index = world.road.index((column + across, row))
        if index in world.movers:
            found.append((abs(across), world.movers[index]))
        found += [
            (abs(across), world.id_at(index, kind)) for kind in HAZARDS if world.board(kind) >> index & 1
        ]
    return [name for _, name in sorted(found)]


def _made(state: SimState, after: World) -> tuple[Move, ...]:
    """The moves of the egos in the order of `World.avs`."""
    dynamics = state.config.ego_dynamics(state.world.road)
    return tuple(
        next((move for move in Move if dynamics.target(was, move) == now), Move.STAY)
        for was, now in zip(state.world.avs, after.avs, strict=True)
    )


def _step(start: Cell, end: Cell) -> Move:
    across = end[0] - start[0]
    return Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT
