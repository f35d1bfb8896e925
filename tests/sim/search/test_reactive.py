"""The search with reacting movers, against every world that the transition itself leads to."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.config import Config
from sim.oracle import Blocked, Drivable, certify, least_ticks
from sim.state import SimState
from sim.transition import next_world
from sim.types import Move, Outcome

REACTIONS = [(courtesy, attentive) for courtesy in (0.0, 0.5, 1.0) for attentive in (0.0, 0.5, 1.0)]


def slowest(state: SimState, limit: int) -> int | None:
    """Least ticks by making every move in every world, one tick after the other."""
    layer = {state.world.digest(): state.world}
    for ticks in range(1, limit + 1):
        after = {}
        for world in layer.values():
            for move in Move:
                if world.road.moved(world.av, move) is None:
                    continue
                there = next_world(world, (move,), state.config)
                if there.outcome is Outcome.SUCCESS:
                    return ticks
                if there.outcome is Outcome.RUNNING:
                    after[there.digest()] = there
        layer = after
    return None


@pytest.mark.parametrize(("courtesy", "attentive"), REACTIONS)
def test_least_ticks_are_those_of_an_exhaustive_search(courtesy: float, attentive: float) -> None:
    blocked = quicker = 0
    for seed in range(30):
        config = Config(
            columns=3,
            rows=6,
            vehicles=seed % 7,
            pedestrians=seed % 3,
            potholes=seed % 5,
            courtesy=courtesy,
            attentive=attentive,
            seed=seed,
        )
        state = SimState.start(config)
        found = least_ticks(state)
        truth = slowest(state, 16)
        assert found == truth if truth is not None else found is None or found > 16
        blocked += truth is None
        unreacting = least_ticks(replace(state, config=config.with_parts(courtesy=0.0, attentive=0.0)))
        quicker += found != unreacting
        match certify(state):
            case Drivable(plan):
                assert len(plan) == found
            case Blocked():
                assert found is None
    assert blocked
    assert (quicker > 0) is (courtesy > 0 or attentive > 0)
