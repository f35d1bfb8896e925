"""How episodes end in an environment is a state like any other: nothing is wrong with it."""

from __future__ import annotations

import numpy as np

from sim.env import RoadEnv
from sim.session.serialization import Unpacker
from sim.types import Outcome
from sim.validation import validate_world


def test_every_state_of_an_episode_is_without_defects() -> None:
    env, draw, seen = RoadEnv({"rows": 6, "pedestrians": 1}), np.random.default_rng(0), set()
    for seed in range(60):
        env.reset(seed=seed)
        actions = np.full(100, 5) if seed == 0 else draw.integers(0, 6, 100)
        for action in actions:
            _, _, terminated, truncated, info = env.step(int(action))
            state = env.get_state()
            world = Unpacker(state).runs[state["run"]].world
            assert validate_world(world) == ()
            assert (world.ended == world.tick) is (terminated or truncated)
            if terminated or truncated:
                assert info["is_success"] is (world.outcome is Outcome.SUCCESS)
                seen.add((world.outcome, world.cause.how if world.cause else None))
                break
    assert {Outcome.SUCCESS, Outcome.STUCK, Outcome.CRASH} == {outcome for outcome, _ in seen}
    assert (Outcome.CRASH, "hit") in seen
