"""Roads to be changed, and what holds of every change and of every refusal."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.actions import (
    PlaceableKind,
    WorldAction,
)
from sim.codes import EDITS
from sim.session.edits import Applied, apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.types import Kind
from sim.world import World
from sim.world.grid import bits
from tests.support.roads import road, run_on

EMPTY = run_on(
    road(
        ".......",
        ".......",
        ".......",
        ".......",
        "...A...",
        ".......",
    )
)
FULL = run_on(
    road(
        "o......",
        "..>..#.",
        "o..o...",
        ".).....",
        "...A.o.",
        "..<....",
    )
)
KINDS: list[PlaceableKind] = ["pothole", "barrier", "vehicle", "pedestrian"]


def refusal(state: SimState, action: WorldAction) -> EditError:
    """The error of an action; its code is listed and the run is as it was."""
    before = replace(state)
    with pytest.raises(EditError) as refused:
        apply(state, action)
    error = refused.value
    assert state == before
    assert EDITS[error.code] == (error.category, tuple(error.facts))
    assert str(error).startswith(error.code.replace("_", " "))
    return error


def tried(state: SimState, action: WorldAction) -> Applied | None:
    """What an action has done, or None if it was refused."""
    try:
        return apply(state, action)
    except EditError:
        refusal(state, action)
        return None


def counts_of(world: World) -> tuple[int, ...]:
    return tuple(world.counts().values())


def sound(world: World) -> None:
    """The tables and the boards tell one story."""
    assert set(world.movers) == set(bits(world.moving))
    assert set(world.hazards) == set(bits(world.fixed))
    assert world.right & world.left == 0
    assert world.potholes & world.barriers == 0
    assert world.pedestrians & ~world.moving == 0
    assert world.moving & world.barriers == 0
    names = [*world.movers.values(), *world.hazards.values()]
    assert len(set(names)) == len(names)
    for name in names:
        kind, _, number = name.rpartition("-")
        assert int(number) <= world.numbered[Kind(kind)]
