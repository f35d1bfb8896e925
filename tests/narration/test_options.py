"""Every move of a decision is told in a few words, and two runs beside each other in a sentence or two."""

from __future__ import annotations

import pytest

from service.narration.narrator import Narrator
from sim.config import Config
from sim.explain.side_by_side import compare_change, compare_move
from sim.plan import Measure
from sim.session.timeline import Timeline


@pytest.fixture(scope="module")
def narrator() -> Narrator:
    return Narrator.load()


def driven(planner: str, ticks: int = 60) -> Timeline:
    timeline = Timeline(Config(planner=planner, seed=7, pothole_probability=0.15))
    for _ in range(ticks):
        timeline.advance()
    return timeline


@pytest.mark.parametrize("planner", ["priority", "astar", "bfs"])
def test_each_move_has_words_that_tell_what_its_option_tells(planner: str, narrator: Narrator) -> None:
    timeline = driven(planner)
    told: set[str] = set()
    for run in timeline.between(0, timeline.tick):
        decision = timeline.decided(run)
        if decision is None:
            continue
        texts = narrator.options(decision)
        assert len(texts) == len(decision.options)
        for option, text in zip(decision.options, texts, strict=True):
            assert ("free" in text or text == "chosen") == (not option.reason.blocks), (option, text)
            if text == "chosen":
                assert option.move is decision.move
            if "more" in text or "later" in text:
                assert decision.measure in (Measure.COST, Measure.TICKS)
                assert option.cost is not None
                assert option.cost > (decision.chosen.cost or 0)
        told.update(texts)
    assert {"chosen", "off the road"} <= told
    assert any("car" in text or "pedestrian" in text for text in told)


def test_a_run_beside_the_real_one_is_told_by_where_it_parts_and_how_both_end(narrator: Narrator) -> None:
    timeline = driven("priority", 3)
    decision = timeline.decided(timeline.at(1))
    assert decision is not None
    other = next(
        each.move for each in decision.options if each.cell is not None and each.move is not decision.move
    )
    texts = narrator.side_by_side(compare_move(timeline, 1, other))
    assert texts.difference.startswith("At tick 1 I ")
    assert texts.real_end
    assert texts.changed_end


def test_a_change_that_changes_nothing_is_told_as_such(narrator: Narrator) -> None:
    timeline = driven("priority", 3)
    found = compare_change(timeline, timeline.tick, [])
    texts = narrator.side_by_side(found)
    assert texts.difference.startswith("The moves are the same.")
    assert texts.real_end == texts.changed_end
