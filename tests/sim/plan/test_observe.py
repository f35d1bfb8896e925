"""What planners and environments learn from is the same array."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from sim.batch import Batch
from sim.config import Config
from sim.env import RoadEnv
from sim.forecast import predict
from sim.perceive import perceive_truth
from sim.perceive.observe import PLANES, STEPPING, observe
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome


@pytest.mark.parametrize("seed", range(6))
def test_a_planner_sees_what_an_environment_shows(seed: int) -> None:
    parts = {"columns": 6, "rows": 12, "potholes": 5, "pedestrians": 3, "barriers": 2}
    state = SimState.start(Config(seed=seed, **parts))  # type: ignore[arg-type]
    env, batch = RoadEnv(parts), Batch([state.config])
    shown, _ = env.reset(seed=seed)
    while state.world.outcome is Outcome.RUNNING:
        planes = observe(predict(perceive_truth(state.world, state.config), 1).percept)
        assert planes.shape == (PLANES, 12, 6)
        assert planes.tobytes() == shown.tobytes()
        assert (batch.observe()[0] == planes).all()
        assert planes[STEPPING].min() == planes[STEPPING].max()
        result = step(state)
        assert result.decision is not None
        move = list(type(result.decision.move)).index(result.decision.move)
        shown, *_ = env.step(np.int64(move))
        batch.step(np.array([move], np.uint8))
        state = result.state
