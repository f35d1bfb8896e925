"""How episodes end in an environment is a state like any other: nothing is wrong with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.batch import Batch
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


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from(["swept", "cell"]), st.sampled_from([0.0, 1.0]))
def test_every_crash_of_many_worlds_is_the_crash_of_one(seed: int, collision: str, attentive: float) -> None:
    """The worlds of a batch, as vector environments have one, are without defects, and say what was hit."""
    config = {"rows": 6, "columns": 5, "pedestrians": 2, "vehicles": 6, "potholes": 2}
    config |= {"collision": collision, "attentive": attentive}
    lanes, actions = 12, np.random.default_rng(seed).integers(0, 6, (40, 12))
    ones = [RoadEnv(config) for _ in range(lanes)]
    for lane, one in enumerate(ones):
        one.reset(seed=seed + lane)
    batch = Batch([one.config_of_episode for one in ones], after="stop")
    running = [True] * lanes
    for row in actions:
        batch.step(row.astype(np.uint8))
        for lane, one in enumerate(ones):
            if not running[lane]:
                assert validate_world(batch.world(lane)) == ()
                continue
            _, _, terminated, truncated, _ = one.step(int(row[lane]))
            running[lane] = not (terminated or truncated)
            state = one.get_state()
            alone, beside = Unpacker(state).runs[state["run"]].world, batch.world(lane)
            assert validate_world(beside) == validate_world(alone) == ()
            assert beside.digest() == alone.digest()
            assert (beside.cause is None) is (alone.cause is None)
            if beside.cause is not None and alone.cause is not None:
                assert replace(beside.cause, ids=()) == replace(alone.cause, ids=())
    assert not all(running)
