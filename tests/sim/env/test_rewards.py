"""Rewards: what each part pays, and that trying is worth more than standing still."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from statistics import fmean
from typing import Any

import numpy as np
import pytest

from sim.config import Config
from sim.env import RoadEnv
from sim.perceive import perceive_truth
from sim.perceive.observe import VEHICLE
from sim.plan.safe_planning import plan_safely
from sim.state import FIRST, SimState
from sim.transition import transition
from sim.types import Move

MOVES = tuple(Move)
SEEDS = range(25)
Policy = Callable[[SimState, Any], int]


def played(env: RoadEnv, seed: int, policy: Policy) -> tuple[list[float], list[int], str]:
    """Rewards, rows before each step and after the last, and the outcome."""
    observation, info = env.reset(seed=seed)
    state, paid, ended = SimState.start(env.config.with_parts(seed=seed)), [], False
    rows = [int(np.argwhere(observation[VEHICLE])[0][0])]
    while not ended:
        action = policy(state, info)
        road = state.world.road
        move = MOVES[action] if road.moved(state.world.av, MOVES[action]) is not None else Move.STAY
        state = transition(state, {FIRST: move}).state
        observation, reward, terminated, truncated, info = env.step(action)
        paid.append(float(reward))
        rows.append(int(np.argwhere(observation[VEHICLE])[0][0]))
        ended = terminated or truncated
    return paid, rows, info["outcome"]


def by_planner(name: str) -> Policy:
    def policy(state: SimState, _: Any) -> int:
        config = state.config.with_parts(planner=name)
        return MOVES.index(plan_safely(perceive_truth(state.world, config), config)[1].move)

    return policy


def stays(_: SimState, __: Any) -> int:
    return MOVES.index(Move.STAY)


def at_random(only_free: bool) -> Policy:
    draw = np.random.default_rng(0)

    def policy(state: SimState, info: Any) -> int:
        on_road = [state.world.road.moved(state.world.av, move) is not None for move in MOVES]
        return int(draw.choice(np.flatnonzero(info["action_mask"] if only_free else on_road)))

    return policy


@pytest.mark.parametrize("parts", [{"rows": 12}, {"rows": 12, "potholes": 16}], ids=["default", "potholes"])
def test_who_stands_still_is_paid_least_and_who_arrives_most(parts: dict[str, Any]) -> None:
    env = RoadEnv(parts)

    def mean(policy: Policy) -> float:
        return fmean(sum(played(env, seed, policy)[0]) for seed in SEEDS)

    still = mean(stays)
    assert still < mean(by_planner("priority")) < mean(by_planner("bfs"))
    assert still < mean(at_random(only_free=True))
    assert still < mean(at_random(only_free=False))


def test_the_parts_of_a_return() -> None:
    """Without a discount the potential cancels out: only the end and the ticks are left."""
    env = RoadEnv({"rows": 12}, goal_reward=5, crash_penalty=3, step_cost=0.25, progress_reward=7)
    seen = set()
    for policy in (at_random(only_free=False), by_planner("bfs")):
        for seed in range(10):
            paid, _, outcome = played(env, seed, policy)
            assert outcome in ("success", "crash")
            assert sum(paid) == pytest.approx({"success": 5, "crash": -3}[outcome] - 0.25 * len(paid))
            seen.add(outcome)
    assert seen == {"success", "crash"}


def test_shaping_is_that_of_the_paper() -> None:
    """F = γΦ(s′) − Φ(s) at every step, with Φ = 0 once it has terminated: its discounted sum is −Φ(s₀)."""
    gamma, worth = 0.9, 4.0
    shaped = RoadEnv({"rows": 12}, progress_reward=worth, discount=gamma)
    plain = RoadEnv({"rows": 12}, progress_reward=0)
    for seed in range(8):
        paid, rows, outcome = played(shaped, seed, at_random(only_free=False))
        bare, _, _ = played(plain, seed, at_random(only_free=False))  # the same draws
        potential = [worth * (11 - row) / 11 for row in rows]
        potential[-1] = 0.0 if outcome != "stuck" else potential[-1]
        extra = [one - other for one, other in zip(paid, bare, strict=True)]
        steps = pairwise(potential)
        assert extra == pytest.approx([gamma * after - before for before, after in steps])
        assert sum(gamma**step * each for step, each in enumerate(extra)) == pytest.approx(0.0, abs=1e-9)


def test_time_costs_twice_a_crash_by_default() -> None:
    env = RoadEnv({"rows": 4, "vehicles": 0, "potholes": 0})
    paid, _, outcome = played(env, 0, stays)
    assert outcome == "stuck"
    assert sum(paid) == pytest.approx(-2 * len(paid) / Config(rows=4).max_ticks)
    assert played(env, 0, by_planner("bfs"))[0] == pytest.approx(
        [1 / 3 - 0.05, 1 / 3 - 0.05, 2 - 2 / 3 - 0.05]
    )
