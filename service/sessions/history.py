"""What can be taken back: one step for each utterance that changed the world.

A step remembers the tail of the log as it was and as it became, so that an utterance which itself
undoes something is still one step. Leaves out pausing alone: it changes no world and is no step,
though a step gives back the pause it came with.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from service.sessions.rewinding import Jump
from service.sessions.saved import Moment
from sim.timeline import Entry, Timeline

MOST_JUMPS = 100
"""How many moves in time can be taken back: each keeps a timeline. What is older than that stays."""


@dataclass(frozen=True, slots=True)
class Step:
    """How one utterance changed the tail of the log, and the pause."""

    before: tuple[Entry, ...]
    after: tuple[Entry, ...]
    paused_before: bool
    paused_after: bool
    jump: Jump | None = None
    """where it moved time"""

    @property
    def since(self) -> int:
        """The earliest tick that it changed; it is not empty and has not jumped."""
        return min(entry.tick for entry in (*self.before, *self.after))

    @property
    def empty(self) -> bool:
        """Whether nothing changed."""
        moved = self.jump is not None and self.jump.before.tick != self.jump.after.tick
        return not self.before and not self.after and not moved

    @property
    def reversed(self) -> Step:
        """The same step the other way."""
        jump = None if self.jump is None else self.jump.reversed
        return Step(self.after, self.before, self.paused_after, self.paused_before, jump)

    def left_before(self, timeline: Timeline) -> Step:
        """The step as it is done again, from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.left_before(timeline))

    def left_after(self, timeline: Timeline) -> Step:
        """The step as it is taken back, from this timeline."""
        return self if self.jump is None else replace(self, jump=self.jump.left_after(timeline))


@dataclass(slots=True)
class History:
    """Steps to undo, the latest last; those to redo, the next last; and moments that have a name."""

    done: list[Step] = field(default_factory=list)
    undone: list[Step] = field(default_factory=list)
    saved: dict[str, Moment] = field(default_factory=dict)

    def copy(self) -> History:
        """A history that goes its own way."""
        return History(list(self.done), list(self.undone), dict(self.saved))

    def add(self, step: Step) -> None:
        """One more change; what was undone before it cannot be redone."""
        self.done.append(step)
        self.undone.clear()
        if step.jump is not None:
            jumps = [number for number, each in enumerate(self.done) if each.jump is not None]
            if len(jumps) > MOST_JUMPS:
                del self.done[: jumps[0] + 1]
