"""What can be taken back: one step for each utterance that changed the world.

A step remembers the tail of the log as it was and as it became, so that an utterance which itself
undoes something is still one step. Leaves out pausing alone: it changes no world and is no step,
though a step gives back the pause it came with.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from service.sessions.bookmarks import Bookmark
from service.sessions.rewind import TimeJump
from sim.session.persistent_list import PersistentList
from sim.session.timeline import Entry, Timeline

MAX_JUMPS = 100
"""How many moves in time can be taken back: each keeps a timeline. What is older than that stays."""


@dataclass(frozen=True, slots=True)
class UndoStep:
    """How one utterance changed the tail of the log, and the pause."""

    before: tuple[Entry, ...]
    after: tuple[Entry, ...]
    paused_before: bool
    paused_after: bool
    jump: TimeJump | None = None
    """where it moved time"""

    @property
    def since(self) -> int:
        """The earliest tick that it changed; it is not empty and has not jumped."""
        return min(entry.tick for entry in (*self.before, *self.after))

    @property
    def empty(self) -> bool:
        """Whether nothing changed."""
        moved = self.jump is not None and self.jump.before.tick != self.jump.after.tick
        return self.before == self.after and not moved

    @property
    def inverse(self) -> UndoStep:
        """The same step the other way."""
        jump = None if self.jump is None else self.jump.inverse
        return UndoStep(self.after, self.before, self.paused_after, self.paused_before, jump)

    def with_before(self, timeline: Timeline) -> UndoStep:
        """The step as it is done again, from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.with_before(timeline))

    def with_after(self, timeline: Timeline) -> UndoStep:
        """The step as it is taken back, from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.with_after(timeline))


@dataclass(slots=True)
class UndoStack:
    """Steps to undo, the latest last; those to redo, the next last; and moments that have a name.

    Before the steps there may be `ground`: so many entries of the log that the session began with. They
    become steps, one for each utterance, when there is nothing later to undo.
    """

    done: PersistentList[UndoStep] = field(default_factory=PersistentList)
    undone: PersistentList[UndoStep] = field(default_factory=PersistentList)
    bookmarks: Mapping[str, Bookmark] = field(default_factory=dict)
    base_entries: int = 0
    base_steps: int = 0
    base_paused: bool = True

    @property
    def steps(self) -> int:
        """How many steps can be undone."""
        return len(self.done) + self.base_steps

    def copy(self) -> UndoStack:
        """A history that goes its own way."""
        # By name: `replace` takes five times as long, for every change.
        return UndoStack(
            self.done, self.undone, self.bookmarks, self.base_entries, self.base_steps, self.base_paused
        )

    def add(self, step: UndoStep) -> None:
        """One more change; what was undone before it cannot be redone."""
        self.done = self.done.plus([step])
        self.undone = PersistentList()
        if step.jump is not None:
            jumps = [number for number, each in enumerate(self.done) if each.jump is not None]
            if len(jumps) > MAX_JUMPS:
                self.done = PersistentList(self.done.after(jumps[0] + 1))
                self.base_entries = self.base_steps = 0

    def undo(self, timeline: Timeline) -> UndoStep | None:
        """The latest step, put with what can be redone; None if there is none."""
        step = next(self.iter_undoable(timeline.entries), None)
        if step is None:
            return None
        if self.done:
            self.done = self.done.first(len(self.done) - 1)
        else:
            self.base_entries -= len(step.after)
            self.base_steps -= 1
        self.undone = self.undone.plus([step.with_after(timeline)])
        return step

    def redo(self, timeline: Timeline) -> UndoStep | None:
        """The step that was undone last, put with what can be undone; None if there is none."""
        if not self.undone:
            return None
        step = self.undone[-1]
        self.undone = self.undone.first(len(self.undone) - 1)
        self.done = self.done.plus([step.with_before(timeline)])
        return step

    def iter_undoable(self, entries: PersistentList[Entry]) -> Iterator[UndoStep]:
        """What could be undone of a log."""
        yield from reversed(self.done)
        stop = self.base_entries
        while stop > 0:
            start, last = stop - 1, entries[stop - 1]
            while start > 0 and _same_utterance(entries[start - 1], last):
                start -= 1
            yield UndoStep((), tuple(entries[start:stop]), self.base_paused, self.base_paused)
            stop = start


def _same_utterance(one: Entry, other: Entry) -> bool:
    return (one.sequence, one.tick) == (other.sequence, other.tick)
