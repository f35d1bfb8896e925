"""What can be taken back: one step for each utterance that changed the world.

A step remembers the tail of the log as it was and as it became, so that an utterance which itself
undoes something is still one step. Leaves out pausing alone: it changes no world and is no step,
though a step gives back the pause it came with.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from sim.timeline import Entry


@dataclass(frozen=True, slots=True)
class Step:
    """How one utterance changed the tail of the log, and the pause."""

    before: tuple[Entry, ...]
    after: tuple[Entry, ...]
    paused_before: bool
    paused_after: bool

    @property
    def since(self) -> int:
        """The earliest tick that it changed; it is not empty."""
        return min(entry.tick for entry in (*self.before, *self.after))

    @property
    def empty(self) -> bool:
        """Whether nothing changed."""
        return not self.before and not self.after

    @property
    def reversed(self) -> Step:
        """The same step the other way."""
        return Step(self.after, self.before, self.paused_after, self.paused_before)


@dataclass(slots=True)
class History:
    """Steps that can be undone, the latest last, and those that can be redone, the next last."""

    done: list[Step] = field(default_factory=list)
    undone: list[Step] = field(default_factory=list)

    def copy(self) -> History:
        """A history that goes its own way."""
        return History(list(self.done), list(self.undone))

    def add(self, step: Step) -> None:
        """One more change; what was undone before it cannot be redone."""
        self.done.append(step)
        self.undone.clear()
