"""Whether others braked or gave way because of the ego, and which thing made its drive most difficult.

Who reacted is found by running each tick of the drive again in which nobody heeds the ego: whoever then is
elsewhere, or heads elsewhere, was swayed by it. What made trouble is counted by what the ego's moves hung on
(`sim.explain.pattern.instance_of`); the drive is run again without each of the first few.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final

from sim.explain.episode_rollout import EpisodeRollout, drive
from sim.explain.foresight import driving
from sim.explain.other_movers import REACTIONS
from sim.explain.past import MOST_TICKS
from sim.explain.pattern import instance_of, most_retaken, move_between
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world
from sim.types import Kind, Mode, Move, Outcome, kind_of

CANDIDATES: Final = 3
"""Things without which the drive is run again."""


@dataclass(frozen=True, slots=True)
class Swayed:
    """One time another road user went otherwise because of the ego."""

    before: SimState
    id: str
    kind: Kind
    turned: bool
    """whether it then headed elsewhere than it would have"""

    @property
    def tick(self) -> int:
        """The tick in which it did."""
        return self.before.world.tick


@dataclass(frozen=True, slots=True)
class Influence:
    """Who was swayed by the ego in its present drive."""

    first: int
    ticks: int
    """ticks that were run again"""
    found: tuple[Swayed, ...]
    heeding: bool
    """whether the others' rules let them heed the ego at all"""


@dataclass(frozen=True, slots=True)
class Troublemaker:
    """A thing that the ego's moves hung on."""

    id: str
    kind: Kind
    ticks: tuple[int, ...]
    """the ticks of moves other than straight on that would have been others without it"""
    without: EpisodeRollout | None
    """how the drive goes from its start without it; None where that was not run"""


@dataclass(frozen=True, slots=True)
class Trouble:
    """What made the drive difficult, the worst first."""

    state: SimState
    """the first state of the drive"""
    moves: int
    """moves other than straight on"""
    retaken: int
    """those of them of which it was looked for what they hung on"""
    by_hand: bool
    """whether a person made some of them, of which no reason is known"""
    real: EpisodeRollout
    """how the drive goes from its start as it is"""
    found: tuple[Troublemaker, ...]


def influence(timeline: Timeline) -> Influence:
    """Who braked or turned because of the first ego. Raises `QuestionError`: `nothing_yet`, `too_long`."""
    steps = _steps(timeline)
    found = []
    for before, made in steps:
        config = before.config
        if not config.reacting:
            continue
        own, other = (
            next_world(before.world, made, each)
            for each in (config, config.with_parts(**dict.fromkeys(REACTIONS, 0.0)))
        )
        for was in before.world.things():
            if was.heading is None:
                continue
            one, rather = own.find(was.id), other.find(was.id)
            if one is None or rather is None:
                continue
            if (one.cell, one.heading) != (rather.cell, rather.heading):
                found.append(Swayed(before, was.id, was.kind, one.heading != rather.heading))
    heeding = any(before.config.reacting for before, _ in steps)
    return Influence(steps[0][0].world.tick, len(steps), tuple(found), heeding)


def trouble(timeline: Timeline, kind: Kind | None = None) -> Trouble:
    """What the moves of this drive hung on most, of a kind or of all. Raises as `influence` does."""
    steps = [(before, made[0]) for before, made in _steps(timeline)]
    turned = [before for before, move in steps if move is not Move.FORWARD]
    looked = turned[-most_retaken(timeline) :]
    ticks: dict[str, list[int]] = {}
    for before in looked:
        for id in instance_of(timeline, before).ids:
            if kind in (None, kind_of(id)):
                ticks.setdefault(id, []).append(before.world.tick)
    start = steps[0][0]
    counts = Counter({id: len(each) for id, each in ticks.items()})
    real = drive(driving(start)).story
    found = [
        Troublemaker(id, kind_of(id), tuple(ticks[id]), _without(start, id))
        for id, _ in sorted(counts.items(), key=lambda each: (-each[1], each[0]))[:CANDIDATES]
    ]
    found.sort(key=lambda each: (-len(each.ticks), _cost(each.without), each.id))
    by_hand = any(before.ego().mode is Mode.MANUAL for before in looked)
    return Trouble(start, len(turned), len(looked), by_hand, real, tuple(found))


def _steps(timeline: Timeline) -> list[tuple[SimState, tuple[Move, ...]]]:
    """Each state of the drive of an only ego, with the move that was made in it."""
    world = timeline.state.world
    stop = timeline.tick if world.ended is None else world.ended
    if stop <= world.episode_start:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    if stop - world.episode_start > MOST_TICKS:
        raise QuestionError("too_long", ticks=stop - world.episode_start, most=MOST_TICKS)
    found: list[tuple[SimState, tuple[Move, ...]]] = []
    for before, after in pairwise(timeline.between(world.episode_start, stop + 1)):
        move = move_between(before, after)
        if move is not None and len(before.world.avs) == 1:
            found.append((before, (move,)))
    if not found:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    return found


def _without(start: SimState, id: str) -> EpisodeRollout | None:
    """How it goes from the start without a thing that was there then."""
    if start.world.find(id) is None:
        return None
    state = replace(start, world=start.world.without(frozenset((id,))))
    return drive(driving(state)).story


def _cost(story: EpisodeRollout | None) -> tuple[bool, int]:
    """The less a drive costs without a thing, the more trouble that made."""
    if story is None:
        return True, 0
    return story.outcome is not Outcome.SUCCESS, story.driven
