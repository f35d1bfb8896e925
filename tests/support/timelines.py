"""Timelines on a given road."""

from __future__ import annotations

from sim.session.timeline import Timeline
from sim.state import SimState


def timeline_on(state: SimState) -> Timeline:
    """A timeline that has taken one decision, from `run`."""
    timeline = Timeline(state.config)
    timeline.state = state
    timeline.advance()
    return timeline
