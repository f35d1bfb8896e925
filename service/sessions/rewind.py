"""Rewinding: an earlier tick becomes the present; one undo brings back what came after it.

A step that moved time keeps both timelines whole (states are shared values), so that undoing it needs no
replay. The store has the action with the tick it was said at, as for any other; a replay rewinds at the same
place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from service.actions import Rewind
from service.problems import FieldProblem, Invalid
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.utterance import Utterance
from sim.explain.past import latest_crash
from sim.session.timeline import Timeline

MAX_TICKS = 10_000
"""Largest number of ticks of one action; a longer way is several of them."""


@dataclass(frozen=True, slots=True)
class TimeJump:
    """The timelines on both sides of a step that moved time."""

    before: Timeline = field(compare=False)
    after: Timeline = field(compare=False)

    @property
    def inverse(self) -> TimeJump:
        """The same jump the other way."""
        return TimeJump(self.after, self.before)

    def with_before(self, timeline: Timeline) -> TimeJump:
        """The jump when it is redone from this timeline."""
        return replace(self, before=timeline.copy())

    def with_after(self, timeline: Timeline) -> TimeJump:
        """The jump when it is undone from this timeline."""
        return replace(self, after=timeline.copy())


def rewind_timeline(timeline: Timeline, action: Rewind, where: str, language: str) -> None:
    """Make an earlier tick the present. Raises `Invalid`, naming the field in `where`, if there is none."""
    now = timeline.tick
    words = refusals(language)
    if action.ticks is not None:
        if action.ticks > now:
            sentence = words.session("too_far_back", tick=now, ticks=action.ticks)
            raise Invalid(sentence, errors=[FieldProblem(f"{where}.ticks", sentence)])
        timeline.rewind(now - action.ticks)
        return
    tick = tick_meant(timeline, action)
    if tick is None:
        sentence = words.session("no_crash")
    elif tick >= now:
        sentence = words.session("no_earlier" if tick == now else "no_such_tick", tick=tick, now=now)
    else:
        timeline.rewind(tick)
        return
    raise Invalid(sentence, errors=[FieldProblem(f"{where}.to", sentence)])


def tick_meant(timeline: Timeline, action: Rewind) -> int | None:
    """The tick that an action goes back to, which may not exist; None for a crash that never was."""
    match action.to:
        case None:
            return timeline.tick - (action.ticks or 0)
        case "start":
            return 0
        case "episode":
            return timeline.state.world.episode_start
        case "crash":
            return latest_crash(timeline)
        case tick:
            return tick


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
