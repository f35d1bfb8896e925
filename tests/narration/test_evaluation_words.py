"""How the figures of an evaluation are told: runs that are all the same, shares that are nearly all."""

from __future__ import annotations

import pytest

from service.evaluations.named import state_as_road
from service.evaluations.report.document import make_document
from service.narration import evaluation_words
from sim.config import Config
from sim.evaluate import Evaluation
from sim.evaluate.run import evaluate
from sim.state import SimState


@pytest.mark.parametrize("language", ["en", "de"])
def test_of_runs_that_are_all_the_same_no_interval_is_told(language: str) -> None:
    config = Config(seed=9)
    spec = Evaluation(
        planners=("astar", "bfs"),
        episodes=3,
        config=config,
        seed=9,
        world=state_as_road(SimState.start(config)),
    )
    summary = evaluate(spec)
    assert summary["alike"]
    told = " ".join(evaluation_words(language).paragraphs(spec, summary))
    assert "95" not in told
    words = evaluation_words(language)
    document = make_document(spec, summary, words, language)
    assert not document.plots
    cells = {cell.text for table in document.tables for row in table.rows for cell in row}
    assert not cells & {words.label("interval"), words.label("p")}


@pytest.mark.parametrize(
    ("share", "told"),
    [(0.0, "0"), (1.0, "100"), (0.5, "50"), (0.12345, "12.3"), (0.99995, "99.995"), (0.0001, "0.01")],
)
def test_nearly_all_is_not_told_as_all(share: float, told: str) -> None:
    assert evaluation_words("en").percent(share) == told
