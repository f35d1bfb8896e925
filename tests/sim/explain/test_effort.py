"""An answer takes bounded work, says what was left untried, and looks further with more."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain import effort, why, why_not
from sim.explain.effort import FOR_CAUSES, MORE, Effort
from sim.search.compiled_costs import forget_compiled_costs
from sim.session.timeline import Timeline
from sim.types import Move


def crowded(planner: str) -> Timeline:
    """A drive on a road on which very many things may have a part in a decision."""
    config = Config(
        seed=3, columns=8, rows=30, potholes=25, vehicles=90, pedestrians=6, barriers=8, planner=planner
    )
    timeline = Timeline(config)
    for _ in range(4):
        timeline.advance()
    return timeline


@pytest.fixture(autouse=True)
def _searching(monkeypatch: pytest.MonkeyPatch) -> None:
    """Decisions are searched for, so that there is something to leave untried."""
    forget_compiled_costs()
    monkeypatch.setattr(effort, "load_compiled_costs", lambda: False)


def test_an_answer_says_what_it_left_untried() -> None:
    found = why(crowded("dijkstra"))
    assert found.untried
    assert found.reruns < 60


def test_more_work_leaves_less_untried_and_keeps_what_was_found() -> None:
    timeline = crowded("dijkstra")
    usual, more = why(timeline), why(timeline, effort=Effort.MORE)
    assert more.reruns > usual.reruns
    assert len(more.untried) <= len(usual.untried)
    alone = {cause.id for cause in (*usual.causes, *usual.also) if cause.necessary}
    assert alone <= {cause.id for cause in (*more.causes, *more.also) if cause.necessary}


def test_more_work_never_tells_a_larger_change() -> None:
    timeline = crowded("rules")
    made = timeline.decision(timeline.tick - 1)
    assert made is not None
    for foil in Move:
        if foil is not made.move:
            usual, more = why_not(timeline, foil), why_not(timeline, foil, effort=Effort.MORE)
            assert more.searched >= usual.searched
    assert Effort.MORE.of(FOR_CAUSES) == MORE * FOR_CAUSES
