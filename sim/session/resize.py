"""A road that is given more or fewer lanes or rows while it is driven: what is on it stays."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from sim.actions import Adjust
from sim.config import Config
from sim.perceive import NO_BELIEF
from sim.rules.versions import ROADS_KEEP_THEIR_THINGS
from sim.session.applied import Applied
from sim.session.errors import EditError
from sim.session.put import with_world
from sim.state import SimState
from sim.types import Outcome
from sim.world.placing import off_road, on_road

SIZES: Final = frozenset(("columns", "rows"))


def keeps_things(state: SimState, action: Adjust) -> bool:
    """Whether a change of this setting leaves what is on the road there; otherwise it begins a new road."""
    return (
        action.parameter in SIZES
        and action.by is not None
        and state.world.outcome is Outcome.RUNNING
        and state.config.rules >= ROADS_KEEP_THEIR_THINGS
    )


def resize(state: SimState, action: Adjust, config: Config) -> Applied:
    """Gives the road its new size. Lanes come and go on the right, rows beyond the destination.

    Raises `EditError` where something stands on what would go, or the destination would come to an ego.
    """
    world = state.world
    gone = off_road(world, config.columns, config.rows)
    fewer_rows = world.road.rows - config.rows
    arrived = [index for index in world.avs if fewer_rows > 0 and index // world.road.columns == fewer_rows]
    if gone or arrived:
        raise EditError("would_fall_off", "by", lost=len(gone) + len(arrived), setting=action.parameter)
    after = replace(with_world(state, on_road(world, config.columns, config.rows)), config=config)
    # What was seen and reckoned on the road of the old size is told in its cells.
    for id, ego in state.egos.items():
        course = replace(ego.record, start=None, changed=True)
        after = after.with_ego(id, record=course, belief=NO_BELIEF)
    return Applied(action, after)
