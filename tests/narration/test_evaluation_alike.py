"""What is told of runs that are all the same."""

from __future__ import annotations

import pytest

from service.evaluations.named import state_as_road
from service.narration import evaluation_words
from sim.config import Config
from sim.evaluate import Evaluation
from sim.evaluate.run import evaluate
from sim.state import SimState


@pytest.mark.parametrize("language", ["en", "de"])
def test_of_runs_that_are_all_the_same_no_interval_is_told(language: str) -> None:
    config = Config(seed=9)
    spec = Evaluation(
        planners=("astar",), episodes=3, config=config, seed=9, world=state_as_road(SimState.start(config))
    )
    summary = evaluate(spec)
    assert summary["alike"]
    told = " ".join(evaluation_words(language).paragraphs(spec, summary))
    assert "95" not in told
