"""Saved states of learning environments, and what must come of them."""

from __future__ import annotations

import json
from hashlib import blake2b
from pathlib import Path
from typing import Any, Final

import numpy as np

from sim.env import RoadEnv, RoadVectorEnv

BEFORE, AFTER = 45, 120
"""Steps taken before the state is saved, and steps that are followed from there."""
LANES: Final = 6
COMMON: Final[dict[str, Any]] = {
    "columns": 6,
    "rows": 10,
    "potholes": 8,
    "vehicles": 6,
    "pedestrians": 2,
    "courtesy": 0.5,
    "attentive": 0.5,
    "preferences": ["cautious"],
    "rules": 2,
}
"""States every setting that may get another default: a state fits its own configuration only."""
CONFIGS: Final[dict[str, dict[str, Any]]] = {
    "one": {**COMMON, "planner": "exact", "collision": "swept", "repetition": True},
    "many": {**COMMON, "planner": "rules", "collision": "cell", "repetition": False},
}


def action(step: int, lane: int = 0) -> int:
    """Mostly forward; the same on every machine."""
    word = blake2b(f"{step} {lane}".encode(), digest_size=2).digest()
    return min(5, word[0] % 12) if word[1] % 2 else 0


def environment(form: str) -> RoadEnv | RoadVectorEnv:
    """The environment that a state of this form fits."""
    return RoadEnv(CONFIGS[form]) if form == "one" else RoadVectorEnv(LANES, CONFIGS[form])


def followed(env: RoadEnv | RoadVectorEnv, first: int, steps: int) -> str:
    """A hash of all observations, rewards, ends and masks of so many steps."""
    found = blake2b(digest_size=16)
    for step in range(first, first + steps):
        if isinstance(env, RoadEnv):
            answer: tuple[Any, ...] = env.step(action(step))
            if answer[2] or answer[3]:
                found.update(env.reset()[0].tobytes())
        else:
            answer = env.step(np.array([action(step, lane) for lane in range(env.num_envs)]))
        observation, rewards, terminated, truncated, info = answer
        for array in (observation, rewards, terminated, truncated, info["action_mask"]):
            found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


def make(folder: Path) -> None:
    """A state of each form, with what comes of it, into a folder."""
    for form in CONFIGS:
        env = environment(form)
        env.reset(seed=17)
        followed(env, 0, BEFORE)
        state = env.get_state()
        kept = {"state": state, "expected": followed(env, BEFORE, AFTER)}
        (folder / f"env_{form}.json").write_text(json.dumps(kept) + "\n")
