"""Episodes in a relay end as those of a batch do, however many there are."""

from __future__ import annotations

import numpy as np
import pytest

from sim.batch import Batch
from sim.batch.relay import drive_to_end
from sim.config import Config
from sim.generation import GenerationError

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")


@pytest.mark.parametrize("count", [1, 63, 64, 65, 700])
@pytest.mark.parametrize(
    "config",
    [
        Config(),
        Config(columns=5, rows=12, pedestrians=4, potholes=6),
        Config(columns=7, rows=23, courtesy=0.3, attentive=0.5, vehicles=20),
        Config(solvable=True, columns=4, rows=16, potholes=16, barriers=2),
        Config(columns=64, rows=9, collision="cell", repetition=False),
    ],
    ids=["usual", "pedestrians", "chance", "solvable", "wide"],
)
def test_episodes_end_as_those_of_a_batch(config: Config, count: int) -> None:
    seeds = np.arange(40, 40 + 3 * count, 3)
    ends = drive_to_end(config, seeds)
    batch = Batch.of_seeds(config, seeds, after="stop")
    batch.run_to_end()
    totals = batch.totals()
    assert ends.outcomes.tolist() == batch.outcomes.tolist()
    assert count < 700 or config.columns > 8 or {1, 3} <= set(ends.outcomes.tolist())
    for name in ("forward", "lateral", "diagonal", "stay"):
        assert getattr(ends, name).tolist() == getattr(totals, name).tolist(), name


def test_no_episodes_end_at_once() -> None:
    assert drive_to_end(Config(), np.zeros(0, np.int64)).outcomes.size == 0


def test_what_it_does_not_do_is_refused() -> None:
    with pytest.raises(ValueError, match="camera"):
        drive_to_end(Config(sensor="camera"), np.arange(3))
    closed = Config(solvable=True, columns=3, rows=6, potholes=12, vehicles=0)
    with pytest.raises(GenerationError):
        drive_to_end(closed, np.arange(200))
