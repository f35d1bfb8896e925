"""States go through JSON and pickle and back, go on the same, and are refused where they do not belong."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from sim.env import RoadEnv, RoadVectorEnv
from tests.support.alike import assert_alike

pytestmark = pytest.mark.xdist_group("compiled")

PARTS = {"rows": 10, "potholes": 8, "pedestrians": 2, "courtesy": 0.5, "preferences": ["cautious"]}

CARRIED: dict[str, Callable[[Any], Any]] = {
    "as it is": lambda state: state,
    "JSON": lambda state: json.loads(json.dumps(state)),
    "pickle": lambda state: pickle.loads(pickle.dumps(state)),
}
carried = pytest.mark.parametrize("carry", CARRIED.values(), ids=CARRIED.keys())


def one_on(env: RoadEnv, draw: np.random.Generator, steps: int) -> list[Any]:
    """What comes of steps at random, ends followed by a reset."""
    trail: list[Any] = []
    for _ in range(steps):
        answer = env.step(int(draw.integers(6)))
        trail.append(answer)
        if answer[2] or answer[3]:
            trail.append(env.reset())
    return trail


def many_on(env: RoadVectorEnv, draw: np.random.Generator, steps: int) -> list[Any]:
    return [env.step(draw.integers(0, 6, env.num_envs)) for _ in range(steps)]


@carried
@pytest.mark.parametrize("steps", [0, 3, 25])
def test_one_goes_on_the_same(carry: Callable[[Any], Any], steps: int) -> None:
    env, other = RoadEnv(PARTS), RoadEnv(PARTS, goal_reward=2)
    env.reset(seed=9)
    one_on(env, np.random.default_rng(1), steps)
    state = carry(env.get_state())
    expected = one_on(env, np.random.default_rng(2), 40)
    other.set_state(state)
    assert other.get_state() == state
    assert_alike(one_on(other, np.random.default_rng(2), 40), expected)
    env.set_state(state)
    assert_alike(one_on(env, np.random.default_rng(2), 40), expected)


def test_an_end_can_be_saved_and_told_again() -> None:
    env = RoadEnv(PARTS)
    env.reset(seed=0)
    ended = False
    while not ended:
        observation, _, one, two, info = env.step(0)
        ended = one or two
    state = env.get_state()
    other = RoadEnv(PARTS)
    assert_alike(other.set_state(state), (observation, info))
    with pytest.raises(RuntimeError, match="has ended"):
        other.step(0)
    assert_alike(other.reset(), env.reset())


@carried
@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_many_go_on_the_same(carry: Callable[[Any], Any], mode: str) -> None:
    made = [RoadVectorEnv(70, PARTS, autoreset_mode=mode) for _ in range(2)]
    env, other = made
    env.reset(seed=9)
    many_on(env, np.random.default_rng(1), 30)
    state = carry(env.get_state())
    expected = many_on(env, np.random.default_rng(2), 30)
    other.set_state(state)
    assert_alike(many_on(other, np.random.default_rng(2), 30), expected)
    assert other.get_state() == env.get_state()
    assert_alike(other.reset(), env.reset())


def test_seeds_that_nobody_gave_are_drawn_on() -> None:
    """The environment's own generator is part of the state."""
    env, other = RoadVectorEnv(2, PARTS), RoadVectorEnv(2, PARTS)
    env.reset(seed=4)
    other.set_state(env.get_state())
    assert other.np_random_seed == env.np_random_seed == 4
    assert other.np_random.integers(2**60) == env.np_random.integers(2**60)
    one, two = RoadEnv(PARTS), RoadEnv(PARTS)
    one.reset()
    two.set_state(json.loads(json.dumps(one.get_state())))
    assert two.np_random_seed == one.np_random_seed
    assert two.np_random.integers(2**60) == one.np_random.integers(2**60)


def test_states_that_belong_elsewhere_are_refused() -> None:
    one, many = RoadEnv(PARTS), RoadVectorEnv(3, PARTS)
    for env in (one, many):
        with pytest.raises(RuntimeError, match="reset first"):
            env.get_state()  # type: ignore[attr-defined]
    one.reset(seed=0)
    many.reset(seed=0)
    before = one.get_state(), many.get_state()
    other = {**PARTS, "rows": 12, "courtesy": 0.0}
    words = "another configuration: rows is 10 there and 12 here; courtesy is 0.5 there and 0.0 here"
    with pytest.raises(ValueError, match=words):
        RoadEnv(other).set_state(before[0])
    with pytest.raises(ValueError, match=words):
        RoadVectorEnv(3, other).set_state(before[1])
    with pytest.raises(ValueError, match="of 3 environments, and here are 4"):
        RoadVectorEnv(4, PARTS).set_state(before[1])
    with pytest.raises(ValueError, match="of a vector environment; here is one environment"):
        one.set_state(before[1])
    with pytest.raises(ValueError, match="of one environment; here is a vector environment"):
        many.set_state(before[0])
    assert (one.get_state(), many.get_state()) == before


@pytest.mark.parametrize("state", [{}, None, [], {"format": "something else"}])
def test_what_is_no_state_is_refused(state: Any) -> None:
    for env in (RoadEnv(), RoadVectorEnv(2)):
        with pytest.raises(ValueError, match="not a state that get_state made"):
            env.set_state(state)  # type: ignore[attr-defined]


def test_damage_is_found() -> None:
    one, many = RoadEnv(PARTS), RoadVectorEnv(3, PARTS)
    one.reset(seed=0)
    many.reset(seed=0)
    state = one.get_state()
    state["worlds"][0][8] = [3]  # the vehicle elsewhere
    with pytest.raises(ValueError, match="cannot be read: the worlds are not those that were written"):
        one.set_state(state)
    for key, value in (("type", "|u1"), ("shape", [1]), ("data", "!"), ("data", "AAAA")):
        damaged = many.get_state()
        damaged["arrays"]["lanes"][key] = value
        with pytest.raises(ValueError, match="the state cannot be read"):
            many.set_state(damaged)
    swapped = many.get_state()
    other = RoadVectorEnv(3, PARTS)
    other.reset(seed=8)
    swapped["arrays"]["state"] = other.get_state()["arrays"]["state"]
    with pytest.raises(ValueError, match="not those that were written"):
        many.set_state(swapped)
    for key in ("run", "random", "random_seed", "digest", "configs"):
        missing = one.get_state()
        del missing[key]
        with pytest.raises(ValueError, match="cannot be read"):
            one.set_state(missing)
