"""Questions asked while a past tick is looked at: each answer is about its moment, and says which that is."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from service.actions import Ask
from service.actions.question_moments import moment_of
from service.sessions.facts import Asked
from sim.explain.query import SAID_OF
from sim.session.timeline import Timeline
from sim.types import Move, Outcome

Preface = Literal["then", "drive", "now"]
"""What an answer begins with: at that tick, of that whole drive, or now."""


def at_viewed_tick(asked: Asked) -> tuple[Asked, Preface | None]:
    """The question as it is asked of the tick that is looked at, and what its answer begins with.

    The past is asked like the present: on a timeline that ends there. An answer that names its tick by itself
    has no preface.
    """
    tick, ask, timeline = asked.viewed, asked.ask, asked.timeline
    if tick is None or tick >= timeline.tick:
        return asked, None
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


def until(timeline: Timeline, tick: int) -> Timeline:
    """The same timeline with a past tick as its present one."""
    if tick == timeline.tick:
        return timeline
    earlier = timeline.copy()
    earlier.rewind(tick)
    return earlier


def _says_tick(ask: Ask) -> bool:
    """Whether the answer about a tick names it by itself."""
    return ask.about in ("why", "why_not") or ask.what in ("seen", "choices", "runner_up", "scores")


def _is_made(timeline: Timeline, tick: int, move: Move | None) -> bool:
    """Whether the decision at a tick is a move, as people call it; any is where none is named."""
    decision = timeline.decision(tick)
    return move is None or (decision is not None and decision.move in SAID_OF.get(move, (move,)))


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
