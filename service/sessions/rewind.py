"""Going back: an earlier tick becomes the present, and what came after it can be had back by one undo.

A step that jumped in time keeps both timelines whole (states are values and shared), so that taking it
back is no replay, and time stands where it stood on the other side. What is stored is the action with
the tick it was said at, as for any other: whoever replays the log goes back at the same place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from service.actions import Rewind
from service.problems import FieldProblem, Invalid
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.utterance import Utterance
from sim.session.timeline import Timeline

MAX_TICKS = 10_000
"""How far one action goes back; a longer way is several of them."""


@dataclass(frozen=True, slots=True)
class TimeJump:
    """The two sides of a step that moved time."""

    before: Timeline = field(compare=False)
    after: Timeline = field(compare=False)

    @property
    def inverse(self) -> TimeJump:
        """The same jump the other way."""
        return TimeJump(self.after, self.before)

    def with_before(self, timeline: Timeline) -> TimeJump:
        """The jump, when it is made anew from where its near side has come to."""
        return replace(self, before=timeline.copy())

    def with_after(self, timeline: Timeline) -> TimeJump:
        """The jump, when it is taken back from where its far side has come to."""
        return replace(self, after=timeline.copy())


def rewind_timeline(timeline: Timeline, ticks: int, where: str, language: str) -> None:
    """Make an earlier tick the present. Raises `Invalid`, naming `where`, if there are not so many."""
    if ticks > timeline.tick:
        sentence = refusals(language).session("too_far_back", tick=timeline.tick, ticks=ticks)
        raise Invalid(sentence, errors=[FieldProblem(where, sentence)])
    timeline.rewind(timeline.tick - ticks)


def rewind_to(tick: int, language: str = DEFAULT_LANGUAGE) -> Callable[[Timeline], Utterance]:
    """What goes back to a tick, once it is known where the session stands. It raises `Invalid`."""

    def utterance(timeline: Timeline) -> Utterance:
        ticks = timeline.tick - tick
        if ticks <= 0:
            now = timeline.tick
            message = refusals(language).session("tick_not_come" if ticks else "tick_is_now", now=now)
            raise Invalid(f"tick: {message}.", errors=[FieldProblem("tick", message)])
        whole, rest = divmod(ticks, MAX_TICKS)
        ways = [MAX_TICKS] * whole + ([rest] if rest else [])
        return Utterance(actions=tuple(Rewind(ticks=each) for each in ways))

    return utterance
