"""What happened in the present drive, in order: its main events, and what went wrong; read off the timeline.

What is found wrong is what can be measured: decisions that cost ticks against the quickest way, or gave away
the last one (`sim.explain.losses`), near misses, planners that did not answer, and a bad end.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

from sim.actions import Drive, SetMode
from sim.episode_record import Sake, detour_reason
from sim.explain.closest_call import near_misses
from sim.explain.losses import Losses, losses
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Mode, Move, Outcome, kind_of


class Happened(StrEnum):
    """A kind of event."""

    LEFT = "left"
    RIGHT = "right"
    STOP = "stop"
    NEAR_MISS = "near_miss"
    CHANGED = "changed"
    LOSS = "loss"
    GAVE_AWAY = "gave_away"
    SILENT = "silent"
    SUCCESS = "success"
    CRASH = "crash"
    STUCK = "stuck"


_ENDS = {
    Outcome.SUCCESS: Happened.SUCCESS,
    Outcome.CRASH: Happened.CRASH,
    Outcome.STUCK: Happened.STUCK,
}


@dataclass(frozen=True, slots=True)
class StoryEvent:
    """One event."""

    tick: int
    """the tick in which it began"""
    what: Happened
    ticks: int = 1
    """how many ticks a stop lasted, lanes that were changed in a row, or ticks that a decision lost"""
    kind: Kind | None = None
    """of the thing that it was for, or that was met or nearly met"""
    gap_m: float | None = None
    """of a near miss"""
    move: Move | None = None
    """of a loss"""

    @property
    def last(self) -> int:
        """The last tick of it."""
        return self.tick + self.ticks - 1


@dataclass(frozen=True, slots=True)
class DriveStory:
    """The events of a drive in their order."""

    first: int
    last: int
    start: SimState
    end: SimState
    events: tuple[StoryEvent, ...]
    losses_known: bool = False
    """of what went wrong: whether what decisions cost is known"""


def drive_story(timeline: Timeline) -> DriveStory:
    """The present drive. Raises `QuestionError`: `nothing_yet`, `too_long`."""
    states = _states(timeline)
    first, last = states[0].world.tick, states[-1].world.tick
    events: list[StoryEvent] = []
    for before, after in pairwise(states):
        _add_move(events, timeline, before, after)
    said = {
        entry.tick
        for entry in timeline.entries
        if first < entry.tick <= last and not isinstance(entry.action, (SetMode, Drive))
    }
    events += [StoryEvent(tick, Happened.CHANGED) for tick in said]
    events += _near(states)
    events.sort(key=lambda each: each.tick)
    return DriveStory(first, last, states[0], states[-1], (*events, *_end(states[-1])))


def what_went_wrong(timeline: Timeline) -> DriveStory:
    """What went wrong in the present drive. Raises `QuestionError`: `nothing_yet`, `too_long`."""
    states = _states(timeline)
    events = _near(states)
    lost: Losses | None = None
    with suppress(QuestionError):
        lost = losses(timeline)
    for each in () if lost is None else lost.found:
        what = Happened.GAVE_AWAY if each.ticks is None else Happened.LOSS
        events.append(StoryEvent(each.tick, what, each.ticks or 1, move=each.move))
    for before in states[:-1]:
        decision = timeline.decided(before)
        if decision is not None and (decision.timed_out or decision.fault is not None):
            events.append(StoryEvent(before.world.tick, Happened.SILENT))
    events.sort(key=lambda each: each.tick)
    end = [each for each in _end(states[-1]) if each.what is not Happened.SUCCESS]
    known = lost is not None and not lost.unknown and lost.first == states[0].world.tick
    first, last = states[0].world.tick, states[-1].world.tick
    return DriveStory(first, last, states[0], states[-1], (*events, *end), known)


def _states(timeline: Timeline) -> list[SimState]:
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if first >= last:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    return list(timeline.between(first, last + 1))


def _near(states: list[SimState]) -> list[StoryEvent]:
    return [
        StoryEvent(call.tick, Happened.NEAR_MISS, kind=kind_of(call.id), gap_m=call.gap_m)
        for call in near_misses(states)
    ]


def _add_move(events: list[StoryEvent], timeline: Timeline, before: SimState, after: SimState) -> None:
    """Add a change of lanes or a stop, or lengthen the one that it goes on with."""
    road = before.world.road
    was, now = road.cell(before.world.av), road.cell(after.world.av)
    across = now[0] - was[0]
    if not across and now != was:
        return
    what = Happened.STOP if not across else Happened.LEFT if across < 0 else Happened.RIGHT
    kind = _for(timeline, before, after)
    tick = before.world.tick
    if events and events[-1].what is what and events[-1].last == tick - 1 and events[-1].kind is kind:
        earlier = events.pop()
        events.append(StoryEvent(earlier.tick, what, earlier.ticks + 1, kind))
    else:
        events.append(StoryEvent(tick, what, 1, kind))


def _for(timeline: Timeline, before: SimState, after: SimState) -> Kind | None:
    """The kind of what would have been met straight ahead; None where nothing would."""
    decision = timeline.decided(before)
    faulty = decision is not None and (decision.timed_out or decision.fault is not None)
    by_person = before.mode is Mode.MANUAL
    sake: Sake = detour_reason(before.world, after.world, by_person=by_person, faulty=faulty)[0]
    return sake if isinstance(sake, Kind) else None


def _end(state: SimState) -> tuple[StoryEvent, ...]:
    world = state.world
    what = _ENDS.get(world.outcome)
    if what is None:
        return ()
    ids = () if world.cause is None else world.cause.ids
    kinds = [kind_of(id) for id in ids]
    kind = next((each for each in kinds if each is not Kind.AV), None)
    return (StoryEvent(world.tick, what, kind=kind),)
