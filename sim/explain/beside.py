"""A counterfactual to be watched: a run in which something is otherwise, tick by tick, and the real one.

The same two futures as are told in words: those of a move that was not made (`stakes`, where after that
move the planner goes on), and those of a change (`whatif`). Leaves out the words.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from sim.actions import WorldAction
from sim.edit import apply
from sim.explain.facts import QuestionError
from sim.explain.future import Story, followed, told
from sim.explain.stakes import after_move
from sim.kinds import Mode, Move, Outcome
from sim.plan import Decision
from sim.run import Run, Tick
from sim.timeline import Timeline

Ticks = tuple[tuple[Run, Tick], ...]
"""Each tick, with the run before it."""


@dataclass(frozen=True, slots=True)
class Side:
    """One of the two: how it begins, its ticks to the end of the episode, and how that is told."""

    start: Run
    ticks: Ticks
    story: Story


@dataclass(frozen=True, slots=True)
class Beside:
    """Both sides of a moment."""

    tick: int
    real: Side
    changed: Side
    instead_of: Move | None
    """the move that was made, where another one is asked about"""
    said_since: int
    """how many actions said after the moment are left out of both"""


def beside_move(timeline: Timeline, tick: int, move: Move) -> Beside:
    """What comes of another move than the one decided at a tick, whatever it meets.

    After the move the planner goes on, in both. Raises `QuestionError`: `no_such_tick`, `no_decision`
    while a result stood, `off_road`, and `same_move` for the one that was made.
    """
    run = _moment(timeline, tick)
    decision = timeline.decided(run)
    if decision is None:
        raise QuestionError("no_decision", tick=tick)
    if decision.option(move).cell is None:
        raise QuestionError("off_road", move=move)
    if decision.move is move:
        raise QuestionError("same_move", move=move)
    real, changed = (_side(run, tuple(_driven(run, decision, each))) for each in (decision.move, move))
    return Beside(tick, real, changed, decision.move, _said_since(timeline, tick))


def beside_change(timeline: Timeline, tick: int, change: Sequence[WorldAction]) -> Beside:
    """What comes of a change made at a tick. Raises `QuestionError` and `EditError`."""
    run = changed = _moment(timeline, tick)
    for action in change:
        changed = apply(changed, action).run
    sides = [Side(each, ticks, told(each, list(ticks))) for each in (run, changed) for ticks in [_all(each)]]
    return Beside(tick, sides[0], sides[1], None, _said_since(timeline, tick))


def _all(run: Run) -> Ticks:
    return tuple(followed(run))


def _side(run: Run, ticks: Ticks) -> Side:
    return Side(run, ticks, told(replace(run, mode=Mode.AUTO), list(ticks)))


def _driven(run: Run, decision: Decision, move: Move) -> Iterator[tuple[Run, Tick]]:
    """A move made, and what comes of it."""
    after = replace(after_move(run, move), mode=Mode.AUTO)
    yield run, Tick(after, replace(decision, move=move), ())
    if after.world.outcome is Outcome.RUNNING:
        yield from followed(after)


def _moment(timeline: Timeline, tick: int) -> Run:
    try:
        return timeline.at(tick)
    except IndexError:
        raise QuestionError("no_such_tick", tick=tick, now=timeline.tick) from None


def _said_since(timeline: Timeline, tick: int) -> int:
    return sum(entry.tick > tick for entry in timeline.entries)
