"""An environment whose state holds several egos: the agent drives the first, the others drive by planners."""

from __future__ import annotations

from typing import Any

import pytest

from sim.config import Config
from sim.env.single import RoadEnv
from sim.session.serialization import Packer
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move
from tests.support.roads import road

MOVES = list(Move)
WORLD = road(".....", ".....", "A....", ".....", "...A.", ".....")
PARTS: dict[str, Any] = {"columns": 5, "rows": 6, "vehicles": 0, "potholes": 0, "planner": "rules"}


def begun(*, parked: bool) -> tuple[RoadEnv, SimState]:
    env = RoadEnv(PARTS)
    env.reset(seed=1)
    state = SimState.start(Config(**PARTS).with_parts(seed=env.config_of_episode.seed), WORLD)
    if parked:
        state = state.with_ego("av-2", mode=Mode.MANUAL)
    packer = Packer()
    number = packer.run(state)
    env.set_state({**env.get_state(), **packer.packed(), "run": number})
    return env, state


@pytest.mark.parametrize("parked", [False, True])
def test_others_drive_or_stay_while_the_agent_drives_the_first(parked: bool) -> None:
    env, state = begun(parked=parked)
    rewards = []
    for expected in (False, True):
        state = step(state).state
        _, reward, terminated, truncated, info = env.step(MOVES.index(Move.FORWARD))
        saved = env.get_state()
        assert saved["digest"] == _digest(state)
        assert (terminated, truncated, info["is_success"]) == (expected, False, expected)
        rewards.append(reward)
    assert state.world.avs == (0, 23 if parked else 13)
    assert rewards[1] > rewards[0]
    with pytest.raises(RuntimeError, match="ended"):
        env.step(0)


def _digest(state: SimState) -> str:
    packer = Packer()
    packer.run(state)
    return str(packer.packed()["digest"])
