"""What happened in a stretch of a drive under conditions: stops, lane changes, moves, ends, ticks in lanes.

A moment counts where all conditions hold in the state in which it was decided. What a decision was for is
what it hung on, by running it again: without that, another move would have been made.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise

from sim.explain.facts import QuestionError
from sim.explain.past import MOST_TICKS
from sim.explain.pattern import instance_of, most_retaken, move_between
from sim.explain.query import SAID_OF
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.triggers import NO_TRIGGERS
from sim.types import Kind, Move, Outcome, kind_of

Step = tuple[SimState, SimState]
"""A state, and the one that its decision led to."""


class Event(StrEnum):
    """What is looked for."""

    STOP = "stop"
    """ticks in a row in which a wait was decided"""
    GO = "go"
    """ticks in a row in which no wait was decided"""
    LANE_CHANGE = "lane_change"
    """a move that led into another lane"""
    MOVE = "move"
    """a move that was made"""
    END = "end"
    """an end of an episode, in a crash or otherwise"""
    DRIVE = "drive"
    """any tick of a drive"""


class Stretch(StrEnum):
    """A stretch that is named without ticks."""

    EPISODE = "episode"
    FIRST_HALF = "first_half"
    SECOND_HALF = "second_half"
    SESSION = "session"


@dataclass(frozen=True, slots=True, kw_only=True)
class Query:
    """What is looked for, where, and under which conditions; None is any."""

    event: Event
    move: Move | None = None
    """of moves and lane changes: the move; "left" is a diagonal to the left too"""
    straight: bool = True
    """whether moves straight on count among moves"""
    outcome: Outcome | None = None
    """of ends: how"""
    cause: Kind | None = None
    """the kind of things it was for; of a crash: of what was hit"""
    first: int | None = None
    last: int | None = None
    """the ticks of the stretch, both included; without them `stretch` says it"""
    stretch: Stretch = Stretch.EPISODE
    lane: int | None = None
    """from 1 at the left"""
    weather: str | None = None
    time_of_day: str | None = None


@dataclass(frozen=True, slots=True)
class Occurrence:
    """One time it happened."""

    before: SimState
    """the state in which it was decided; of an end the one that shows it"""
    ticks: int
    move: Move | None
    ids: tuple[str, ...] | None
    """what it was for; None where that was not looked for"""

    @property
    def tick(self) -> int:
        """The tick at which it was decided, or at which an end shows."""
        return self.before.world.tick

    @property
    def left(self) -> bool:
        """Whether its move led to the left."""
        return self.move in SAID_OF[Move.LEFT]

    @property
    def diagonal(self) -> bool:
        """Whether its move was a diagonal one."""
        return self.move is not None and all(self.move.offset)

    @property
    def kinds(self) -> tuple[Kind, ...]:
        """The kinds of things that it was for."""
        return tuple(dict.fromkeys(map(kind_of, self.ids or ())))


@dataclass(frozen=True, slots=True)
class Occurrences:
    """All that was found, in its order."""

    first: int
    last: int
    """the first and the last tick of the stretch"""
    driven: int
    """its ticks of a drive in which the conditions of lane, weather and time of day held"""
    found: tuple[Occurrence, ...]
    unknown: int
    """earlier ones that may be meant, of which it was not looked for what they were for"""
    lanes: tuple[tuple[int, int], ...]
    """lanes, each with its ticks among those driven; the longest first"""

    @property
    def ticks(self) -> int:
        """Ticks that they took in all."""
        return sum(each.ticks for each in self.found)


def occurrences(timeline: Timeline, query: Query) -> Occurrences:
    """What a query finds, of the first ego. Raises `QuestionError`: `no_such_tick`, `too_long`."""
    first, stop = stretch_of(timeline, query)
    if query.event is Event.END:
        steps = list(_steps(timeline, max(0, first - 1), stop))
        ends = tuple(_ends(steps, query, first))
        return Occurrences(first, stop - 1, len(steps), ends, 0, ())
    steps = [each for each in _steps(timeline, first, stop) if _meets(each[0], query)]
    groups = _groups(timeline, steps, query)
    causes_wanted = query.cause is not None or query.event is Event.STOP
    unseen = max(0, len(groups) - most_retaken(timeline)) if causes_wanted else len(groups)
    found = []
    for number, (move, group) in enumerate(groups):
        ids = instance_of(timeline, group[0]).ids if number >= unseen else None
        if query.cause is None or query.cause in map(kind_of, ids or ()):
            found.append(Occurrence(group[0], len(group), move, ids))
    lanes = Counter(_lane(before) for before, _ in steps)
    ranked = tuple(sorted(lanes.items(), key=lambda each: (-each[1], each[0])))
    return Occurrences(first, stop - 1, len(steps), tuple(found), unseen if causes_wanted else 0, ranked)


def stretch_of(timeline: Timeline, query: Query) -> tuple[int, int]:
    """The first tick that is meant, and the one after the last. Raises `QuestionError`."""
    world, now = timeline.state.world, timeline.tick
    if query.first is not None:
        last = now if query.last is None else query.last
        if max(query.first, last) > now:
            raise QuestionError("no_such_tick", tick=max(query.first, last), now=now)
        first, stop = query.first, last + 1
    elif query.stretch is Stretch.SESSION:
        first, stop = 0, now + 1
    else:
        first = world.episode_start
        stop = now if world.ended is None else world.ended
        middle = first + (stop - first + 1) // 2
        if query.stretch is Stretch.FIRST_HALF:
            stop = middle
        elif query.stretch is Stretch.SECOND_HALF:
            first = middle
    if stop - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=stop - first, most=MOST_TICKS)
    return first, stop


def _steps(timeline: Timeline, first: int, stop: int) -> Iterator[Step]:
    """Each state of a drive and what its decision led to, before a person or a rule changed that."""
    said = {entry.tick for entry in timeline.entries}
    for before, after in pairwise(timeline.between(first, min(stop, timeline.tick) + 1)):
        if before.world.outcome is not Outcome.RUNNING:
            continue
        if before.triggers or after.world.tick in said:
            yield before, timeline.led_to(replace(before, triggers=NO_TRIGGERS)).state
        else:
            yield before, after


def _meets(state: SimState, query: Query) -> bool:
    """Whether the conditions hold in a state."""
    return (
        query.lane in (None, _lane(state))
        and query.weather in (None, state.config.weather)
        and query.time_of_day in (None, state.config.time_of_day)
    )


def _lane(state: SimState) -> int:
    return state.world.road.cell(state.world.av)[0] + 1


def _groups(timeline: Timeline, steps: Sequence[Step], query: Query) -> list[tuple[Move, list[SimState]]]:
    """What is looked for, each with the states in which it was decided; ticks of a stop in a row are one."""
    groups: list[tuple[Move, list[SimState]]] = []
    if query.event is Event.DRIVE:
        return groups
    for before, after in steps:
        move = move_between(before, after)
        if move is None or not _is_meant(timeline, before, after, move, query):
            continue
        previous = groups[-1][1][-1].world if groups else None
        goes_on = previous is not None and (previous.tick + 1, previous.episode) == (
            before.world.tick,
            before.world.episode,
        )
        if goes_on and query.event in (Event.STOP, Event.GO):
            groups[-1][1].append(before)
        else:
            groups.append((move, [before]))
    return groups


def _is_meant(timeline: Timeline, before: SimState, after: SimState, move: Move, query: Query) -> bool:
    if query.event in (Event.STOP, Event.GO):  # a step that is lost on snow is no wait
        decision = timeline.decided(before) if move is Move.STAY else None
        waits = decision is not None and decision.move is Move.STAY
        return waits is (query.event is Event.STOP)
    if query.move is not None and move not in SAID_OF.get(query.move, (query.move,)):
        return False
    if move is Move.FORWARD and not query.straight:
        return False
    return query.event is Event.MOVE or _lane(before) != _lane(after)


def _ends(steps: Sequence[Step], query: Query, first: int) -> Iterator[Occurrence]:
    """The ends of episodes that show from a tick on, each with what was hit."""
    for before, after in steps:
        world = after.world
        if world.ended is None or world.tick < first or not _meets(before, query):
            continue
        hit = () if world.cause is None else world.cause.ids
        kinds = () if world.cause is None else (world.cause.kind,)
        if query.outcome in (None, world.outcome) and query.cause in (None, *kinds):
            yield Occurrence(after, 1, None, hit)
