"""The moment that a question is about, where that is not now; the answer says which it is.

While a past tick is looked at that is its moment. Of a drive that has just begun nothing can be said yet: how
it went is told of the one before.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final, Literal

from service.actions import Ask
from service.actions.question_moments import moment_of
from service.sessions.facts import Asked
from sim.explain.query import SAID_OF
from sim.session.timeline import Timeline
from sim.types import Move, Outcome

Preface = Literal["then", "drive", "before", "now"]
"""What an answer begins with: at that tick, of that whole drive, of the drive before, or now."""

JUST_BEGUN_TICKS: Final = 5
"""A drive that is younger than this has not gone well or badly yet."""


def at_its_moment(asked: Asked) -> tuple[Asked, Preface | None]:
    """The question as it is asked of the tick that is looked at, and what its answer begins with.

    The past is asked like the present: on a timeline that ends there. An answer that names its tick by itself
    has no preface.
    """
    tick, ask, timeline = asked.viewed, asked.ask, asked.timeline
    if tick is None or tick >= timeline.tick:
        return _of_drive_before(asked)
    match moment_of(ask, asked.supposes):
        case "none":
            return asked, None
        case "present":
            return asked, "now"
        case "drive":
            return replace(asked, timeline=until(timeline, _end_of_episode(timeline, tick))), "drive"
        case "decision" if timeline.at(tick).world.outcome is Outcome.RUNNING:
            if ask.about == "why" and not _is_made(timeline, tick, ask.move):
                return replace(asked, timeline=until(timeline, tick)), "then"  # the latest such move before
            return replace(asked, ask=replace(ask, tick=tick)), None if _says_tick(ask) else "then"
        case _:
            past = replace(asked, timeline=until(timeline, tick))
            return past, None if ask.ticks is not None and _says_tick(ask) else "then"


def _of_drive_before(asked: Asked) -> tuple[Asked, Preface | None]:
    """The question of the drive before, where it is about a drive and the present one has just begun."""
    world = asked.timeline.state.world
    least = JUST_BEGUN_TICKS if asked.ask.what == "verdict" else 1
    of_drive = asked.ask.about == "history" and moment_of(asked.ask) == "drive"
    if not of_drive or not world.episode_start or world.episode_tick >= least or world.ended is not None:
        return asked, None
    return replace(asked, timeline=until(asked.timeline, world.episode_start - 1)), "before"


def until(timeline: Timeline, tick: int) -> Timeline:
    """The same timeline with a past tick as its present one."""
    if tick == timeline.tick:
        return timeline
    earlier = timeline.copy()
    earlier.rewind(tick)
    return earlier


def where_stuck(timeline: Timeline) -> Timeline | None:
    """The timeline up to where the ego got no further; None unless the episode has ended stuck."""
    world = timeline.state.world
    if world.outcome is not Outcome.STUCK or world.ended is None:
        return None
    road = world.road
    states = timeline.between(world.episode_start, world.ended)
    nearest = min(states, key=lambda state: road.cell(state.world.av)[1], default=None)
    return None if nearest is None else until(timeline, nearest.world.tick)


def _says_tick(ask: Ask) -> bool:
    """Whether the answer about a tick names it by itself."""
    return ask.about in ("why", "why_not") or ask.what in ("seen", "choices", "runner_up", "scores", "needed")


def _is_made(timeline: Timeline, tick: int, move: Move | None) -> bool:
    """Whether the decision at a tick is a move, as people call it; any is where none is named."""
    if move is None:
        return True
    decision = timeline.decision(tick)
    return decision is not None and decision.move in SAID_OF.get(move, (move,))


def _end_of_episode(timeline: Timeline, tick: int) -> int:
    """The last tick of the episode that a tick belongs to; found by halves, as episodes count upwards."""
    episode = timeline.at(tick).world.episode
    if timeline.state.world.episode == episode:
        return timeline.tick
    first, stop = tick, timeline.tick
    while stop - first > 1:
        middle = (first + stop) // 2
        if timeline.at(middle).world.episode == episode:
            first = middle
        else:
            stop = middle
    return first
