"""Lanes tried, renewed, copied, saved and restored: the same worlds as by every other way."""

from __future__ import annotations

import numpy as np
import pytest

from sim.batch import Batch, lanes
from sim.config import Config
from sim.state import SimState, next_episode
from sim.types import Kind

pytestmark = pytest.mark.xdist_group("compiled")

CONFIGS = [Config(seed=seed, rows=9, potholes=10, pedestrians=2, courtesy=0.5) for seed in range(70)]


def digests(batch: Batch) -> list[str]:
    return [batch.digest(lane) for lane in range(len(batch))]


def driven(steps: int) -> Batch:
    batch, draw = Batch(CONFIGS, after="stop"), np.random.default_rng(0)
    for _ in range(steps):
        batch.step(draw.integers(0, 6, len(batch)).astype(np.uint8))
    return batch


@pytest.mark.parametrize("after", ["next", "restart", "stop"])
def test_a_trial_is_what_a_step_leads_to_and_changes_nothing(after: str) -> None:
    batch = Batch(CONFIGS, after=after)  # type: ignore[arg-type]
    if after != "restart":
        batch.step(np.zeros(len(batch), np.uint8))
    before = digests(batch)
    tried = batch.trials()
    assert digests(batch) == before
    for move in range(6):
        stepped = batch.copy(after="stop")
        stepped.step(np.full(len(batch), move, np.uint8))
        assert (tried[:, move] == stepped.outcomes).all()
    assert digests(batch) == before
    assert len(np.unique(tried)) > 1


def test_a_renewed_lane_is_the_next_episode_and_the_others_stand() -> None:
    batch = driven(6)
    before, chosen = digests(batch), batch.outcomes != 0
    assert chosen.any()
    assert not chosen.all()
    batch.renew(chosen)
    for lane in range(len(batch)):
        if chosen[lane]:
            expected = next_episode(SimState.start(CONFIGS[lane]))[0].world
            found = batch.world(lane)
            assert (found.episode, found.episode_tick, found.ended) == (2, 0, None)
            assert (found.right, found.left, found.fixed) == (expected.right, expected.left, expected.fixed)
        else:
            assert batch.digest(lane) == before[lane]


def test_a_lane_renewed_with_a_seed_is_the_first_episode_of_it() -> None:
    batch = driven(6)
    chosen = np.zeros(len(batch), np.bool_)
    chosen[3] = True
    batch.renew(chosen, [None, None, 5, 500, *[None] * 66])
    assert batch.seeds[:5].tolist() == [0, 1, 2, 500, 4]
    assert batch.configs[3].seed == 500
    expected, found = SimState.start(batch.configs[3]).world, batch.world(3)
    assert (found.episode, found.right, found.left) == (1, expected.right, expected.left)


def test_a_copy_goes_on_by_itself() -> None:
    for after in ("next", "restart", "stop"):
        batch = Batch(CONFIGS, after=after)  # type: ignore[arg-type]
        batch.run(5)
        twin, before = batch.copy(), digests(batch)
        twin.run(9)
        assert digests(batch) == before
        batch.run(9)
        assert digests(batch) == digests(twin)


def test_what_was_saved_is_restored() -> None:
    batch = driven(5)
    saved, before = batch.saved(), digests(batch)
    batch.run(4)
    other = Batch([config.with_parts(seed=0) for config in CONFIGS], after="stop")
    other.restore(saved)
    assert digests(other) == before
    assert other.configs == CONFIGS
    other.run(4)
    assert digests(other) == digests(batch)
    with pytest.raises(ValueError, match="of this size"):
        Batch(CONFIGS[:60], after="stop").restore(saved)
    with pytest.raises(ValueError, match="restart"):
        Batch(CONFIGS, after="restart").saved()


def test_a_kind_that_the_kernels_do_not_know_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a kind that comes later would be."""
    monkeypatch.setattr(lanes, "_UNKNOWN", (Kind.PEDESTRIAN,))
    with pytest.raises(ValueError, match="and no pedestrians; run such roads one by one"):
        Batch(CONFIGS[:2])
    states = [SimState.start(config) for config in CONFIGS[:2]]
    with pytest.raises(ValueError, match="and no pedestrians"):
        Batch.of(states)
    Batch([config.with_parts(pedestrians=0) for config in CONFIGS[:2]])
