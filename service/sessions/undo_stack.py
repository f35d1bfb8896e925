"""The undo stack: one step for each utterance that changed the world.

A step stores the end of the log as it was before and after the utterance, so an utterance that itself undoes
something is also one step. Pausing alone changes no world and is no step, but undoing a step restores the
pause that came with it. The playback speed is no part of the world and is undone all the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from service.sessions.bookmarks import Bookmark
from service.sessions.rewind import TimeJump
from service.sessions.scheduler.playback_speed import PlaybackSpeed
from sim.session.persistent_list import PersistentList
from sim.session.timeline import Entry, Timeline
from sim.state import SimState

MAX_JUMPS = 100
"""Largest number of time jumps that can be undone, each of which holds a timeline."""


@dataclass(frozen=True, slots=True)
class UndoStep:
    """How one utterance changed the tail of the log, and the pause."""

    before: tuple[Entry, ...]
    after: tuple[Entry, ...]
    paused_before: bool
    paused_after: bool
    jump: TimeJump | None = None
    """the timelines on both sides, if the step moved time"""
    speed: tuple[PlaybackSpeed, PlaybackSpeed] | None = None
    """the playback speed on both sides, if the step changed it"""

    @property
    def since(self) -> int:
        """The earliest tick that the step changed; for steps that are not empty and moved no time."""
        return min(entry.tick for entry in (*self.before, *self.after))

    @property
    def empty(self) -> bool:
        """Whether the step changed nothing."""
        moved = self.jump is not None and self.jump.before.tick != self.jump.after.tick
        return self.before == self.after and not moved and self.speed is None

    @property
    def only_speed(self) -> bool:
        """Whether the step changed the playback speed and nothing of the world."""
        return self.speed is not None and self.before == self.after and self.jump is None

    @property
    def inverse(self) -> UndoStep:
        """The same step the other way."""
        jump = None if self.jump is None else self.jump.inverse
        speed = None if self.speed is None else (self.speed[1], self.speed[0])
        return UndoStep(self.after, self.before, self.paused_after, self.paused_before, jump, speed)

    def with_before(self, timeline: Timeline) -> UndoStep:
        """The step when it is redone from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.with_before(timeline))

    def with_after(self, timeline: Timeline) -> UndoStep:
        """The step when it is undone from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.with_after(timeline))


@dataclass(slots=True)
class UndoStack:
    """Steps that can be undone (latest last) and redone (next last), and the bookmarks.

    `base_entries` is the number of log entries that the session began with; they become steps, one for each
    utterance, when there is nothing later to undo.
    """

    done: PersistentList[UndoStep] = field(default_factory=PersistentList)
    undone: PersistentList[UndoStep] = field(default_factory=PersistentList)
    bookmarks: Mapping[str, Bookmark] = field(default_factory=dict)
    base_entries: int = 0
    base_steps: int = 0
    base_paused: bool = True
    fork_sequence: int = 0
    """sequence of the entry in which a fork takes over its parent's playback speed, which is no step; or 0"""

    @property
    def steps(self) -> int:
        """The number of steps that can be undone."""
        return len(self.done) + self.base_steps

    def saved_states(self) -> dict[str, SimState]:
        """The moments that were saved, by name, in the order in which the names were given."""
        return {name: moment.timeline.state for name, moment in self.bookmarks.items()}

    def is_step_after(self, before: UndoStack) -> bool:
        """Whether the latest step is a new one, compared with the stack as it was before."""
        return bool(self.done) and (not before.done or self.done[-1] is not before.done[-1])

    def copy(self) -> UndoStack:
        """An independent copy."""
        # By name: `replace` takes five times as long, for every change.
        return UndoStack(
            self.done,
            self.undone,
            self.bookmarks,
            self.base_entries,
            self.base_steps,
            self.base_paused,
            self.fork_sequence,
        )

    def add(self, step: UndoStep) -> None:
        """Push a step; nothing can be redone then, unless the step left the world as it is."""
        self.done = self.done.plus([step])
        if not step.only_speed:
            self.undone = PersistentList()
        if step.jump is not None:
            jumps = [number for number, each in enumerate(self.done) if each.jump is not None]
            if len(jumps) > MAX_JUMPS:
                self.done = PersistentList(self.done.after(jumps[0] + 1))
                self.base_entries = self.base_steps = 0

    def undo(self, timeline: Timeline, *, world_only: bool = False) -> UndoStep | None:
        """Move the latest step to those that can be redone, and return it; None if there is none.

        `world_only`: the latest that changed more than the playback speed.
        """
        steps = self.iter_undoable(timeline.entries)
        passed, step = _first(steps, world_only=world_only)
        if step is None:
            return None
        if passed < len(self.done):
            place = len(self.done) - passed - 1
            self.done = self.done.first(place).plus(self.done.after(place + 1))
        else:
            self.base_entries -= len(step.after)
            self.base_steps -= 1
        self.undone = self.undone.plus([step.with_after(timeline)])
        return step

    def redo(self, timeline: Timeline, *, world_only: bool = False) -> UndoStep | None:
        """Move the step that was undone last back to those that can be undone, and return it; or None."""
        passed, step = _first(reversed(self.undone), world_only=world_only)
        if step is None:
            return None
        place = len(self.undone) - passed - 1
        self.undone = self.undone.first(place).plus(self.undone.after(place + 1))
        self.done = self.done.plus([step.with_before(timeline)])
        return step

    def iter_undoable(self, entries: PersistentList[Entry]) -> Iterator[UndoStep]:
        """The steps of a log that can be undone, latest first."""
        yield from reversed(self.done)
        stop = self.base_entries
        while stop > 0:
            start, last = stop - 1, entries[stop - 1]
            while start > 0 and _same_utterance(entries[start - 1], last):
                start -= 1
            yield UndoStep((), tuple(entries[start:stop]), self.base_paused, self.base_paused)
            stop = start


def _first(steps: Iterator[UndoStep], *, world_only: bool) -> tuple[int, UndoStep | None]:
    """The first step, or the first that changed the world, and how many come before it."""
    for passed, step in enumerate(steps):
        if not (world_only and step.only_speed):
            return passed, step
    return 0, None


def _same_utterance(one: Entry, other: Entry) -> bool:
    return (one.sequence, one.tick) == (other.sequence, other.tick)
