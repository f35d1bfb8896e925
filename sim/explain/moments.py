"""The moment a question is about."""

from __future__ import annotations

from sim.explain.facts import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState


def state_at(timeline: Timeline, tick: int | None) -> SimState:
    """The state at a tick, None for now. Raises `QuestionError`: `no_such_tick`."""
    if tick is None:
        return timeline.state
    try:
        return timeline.at(tick)
    except IndexError:
        raise QuestionError("no_such_tick", tick=tick, now=timeline.tick) from None
