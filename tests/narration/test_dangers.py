"""Answers about danger: a thing or a crash first, brief, in both languages."""

from __future__ import annotations

import pytest

from sim.types import Outcome
from tests.narration.test_barred_rows import NARRATORS, told
from tests.sim.explain.test_dangers import begun

CRASH = {"en": "A crash", "de": "Ein Zusammenstoß"}
NONE = {"en": "No crash", "de": "Kein Zusammenstoß"}


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("sensor", ["perfect", "radar"])
def test_the_most_dangerous_thing_and_the_worst_case_are_told(code: str, sensor: str) -> None:
    for seed in range(10):
        timeline = begun(seed, 4, sensor=sensor)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        for kind in (None, "vehicle", "pothole"):
            answer = told(timeline, code, about="outlook", what="danger", kind=kind)
            assert all(kind in (None, each["kind"]) for each in answer["dangers"])  # type: ignore[attr-defined]
        for ticks in (None, 1, 8):
            worst = told(timeline, code, about="outlook", what="worst", ticks=ticks)
            assert str(worst["text"]).startswith((CRASH if worst["may_crash"] else NONE)[code])
            assert worst["ticks"] == (ticks or 1)
        seconds = told(timeline, code, about="outlook", what="worst", seconds=2.0)
        assert seconds["ticks"] == 4
