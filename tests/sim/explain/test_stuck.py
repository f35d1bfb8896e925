"""An episode that is proved to end stuck does, when it is driven to its end."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import pytest

from sim.config import Config
from sim.explain.episode_rollout import rollout
from sim.explain.stuck import is_stuck, shut_off
from sim.state import SimState
from sim.types import Mode, Outcome


def drives(planner: str, attentive: float) -> list[SimState]:
    """Beginnings of drives on roads that are mostly shut."""
    return [
        SimState.start(
            Config(
                seed=seed,
                columns=4,
                rows=6,
                potholes=8,
                vehicles=seed % 5,
                barriers=seed % 3,
                attentive=attentive,
                repetition=False,
                planner=planner,
            )
        )
        for seed in range(40)
    ]


@pytest.mark.parametrize(("planner", "attentive"), [*product(["astar", "bfs"], [0.0, 1.0])])
def test_what_is_proved_comes(planner: str, attentive: float) -> None:
    proved = 0
    for state in drives(planner, attentive):
        said, last = False, state
        for _, tick in rollout(state):
            last = tick.state
            if not said and shut_off(tick) and is_stuck(tick.state):
                said = True
        if said:
            proved += 1
            assert last.world.outcome is Outcome.STUCK
            assert last.world.episode_tick == state.config.max_ticks + 1
    assert proved > 10


def test_nothing_is_proved_of_what_hangs_on_chance_or_a_person() -> None:
    state = next(
        tick.state
        for begun in drives("astar", 0.0)
        for _, tick in rollout(begun)
        if shut_off(tick) and is_stuck(tick.state)
    )
    by_chance = replace(state, config=state.config.with_parts(courtesy=0.5))
    assert not is_stuck(by_chance)
    assert not is_stuck(state.with_ego(mode=Mode.MANUAL))
