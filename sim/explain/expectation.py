"""Where what was hit was believed to go at the last move, where it went, and why its cell was entered.

The belief is that of the forecast which the decision was made with (`sim.forecast`).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from sim.explain.crash import Crash, is_detected, why_crashed
from sim.explain.question_error import QuestionError
from sim.forecast import predict
from sim.session.timeline import Timeline
from sim.types import Cell, Kind, Move


class Entry(StrEnum):
    """Why the cell was entered."""

    STAYED = "stayed"
    """it was not: the ego stayed, and was met in its own cell"""
    PERSON = "person"
    """a person had asked for the move"""
    SILENT = "silent"
    """the planner gave no answer"""
    SLIPPED = "slipped"
    """the step to the side was lost on snow"""
    KNEW = "knew"
    """it was expected to be met"""
    UNSEEN = "unseen"
    """it was not detected where it was, so the cell counted as free"""
    ELSEWHERE = "elsewhere"
    """it was expected in another cell, so the cell counted as free"""


@dataclass(frozen=True, slots=True)
class Expected:
    """One thing that was hit: what was believed of it, and what it did."""

    id: str
    kind: Kind
    moves: bool
    """whether its kind moves at all"""
    detected: bool
    """whether it was seen in the cell that it was in"""
    was: Cell
    expected: Cell | None
    """the cell it was expected in after the tick; None where it was not seen there"""
    went: Cell

    @property
    def step(self) -> Move | None:
        """What it was expected to do; None where nothing was expected of it."""
        return None if self.expected is None else _step(self.was, self.expected)

    @property
    def did(self) -> Move:
        """What it did."""
        return _step(self.was, self.went)


@dataclass(frozen=True, slots=True)
class Expectation:
    """A crash, what was expected of each thing that was hit, and why the move was made all the same."""

    crash: Crash
    tick: int
    """that of the last move"""
    free: tuple[Move, ...]
    """other moves that were seen to be free"""
    entry: Entry
    found: tuple[Expected, ...]


def expectation(timeline: Timeline, tick: int | None = None) -> Expectation:
    """Of the latest crash, or that of a tick. Raises `QuestionError` as `why_crashed` does.

    `no_crash_then` also where nothing but another ego was hit.
    """
    return expectation_of(why_crashed(timeline, tick), timeline)


def expectation_of(crash: Crash, timeline: Timeline) -> Expectation:
    """Of a crash of a timeline. Raises `QuestionError` (`no_crash_then`) where only another ego was hit."""
    decision, before = crash.explanation.decision, crash.explanation.moment
    taken = timeline.taken(before, decision.av)
    if taken is None:
        raise QuestionError("no_crash_then", tick=crash.end)
    road, percept = before.world.road, taken.percept
    movers = predict(percept, 1).slices.movers(0)
    after = timeline.led_to(before).state.world
    found = []
    for id in crash.cause.ids:
        was, then = before.world.find(id), after.find(id)
        if id == decision.av or was is None or was.kind is Kind.AV:
            continue
        detected = is_detected(percept, before.world, id)
        moves = was.heading is not None
        cells = [road.cell(cell) for cell, name in movers.items() if name == id]
        expected = cells[0] if cells else was.cell if detected and not moves else None
        went = was.cell if then is None else then.cell
        found.append(Expected(id, was.kind, moves, detected, was.cell, expected if detected else None, went))
    if not found:
        raise QuestionError("no_crash_then", tick=crash.end)
    free = tuple(
        option.move
        for option in decision.options
        if option.verdict == "free" and option.move is not decision.move
    )
    return Expectation(crash, decision.tick, free, _entry(crash, found), tuple(found))


def _entry(crash: Crash, found: list[Expected]) -> Entry:
    decision = crash.explanation.decision
    if decision.fault is not None:
        return Entry.SILENT
    if crash.made is Move.STAY and not crash.slipped:
        return Entry.STAYED
    if decision.asked is not None and not decision.held_back:
        return Entry.PERSON
    if decision.chosen.reason.blocks:
        return Entry.KNEW
    if crash.slipped:
        return Entry.SLIPPED
    return Entry.ELSEWHERE if all(each.detected for each in found) else Entry.UNSEEN


def _step(start: Cell, end: Cell) -> Move:
    across = end[0] - start[0]
    return Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT
