"""Answers about being stuck: what is proved first, brief, in both languages."""

from __future__ import annotations

import pytest

from sim.types import Outcome
from tests.narration.test_barred_rows import NARRATORS, told
from tests.sim.explain.test_lost_way import SEEDS, ended


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("sensor", ["perfect", "camera"])
def test_the_tick_and_the_moves_are_told(code: str, sensor: str) -> None:
    exact = 0
    for seed in list(SEEDS)[:16]:
        timeline = ended(seed, sensor=sensor)
        if timeline.state.world.outcome is not Outcome.STUCK:
            continue
        why = told(timeline, code, about="history", what="stuck_cause")
        knowable = told(timeline, code, about="history", what="knowable")
        assert why["no_way_since"] == knowable["no_way_since"]
        if why["last_way_at"] is not None:
            assert f" {why['last_way_at']} " in str(why["text"])
            exact += why["made"] is not None
        if why["no_way_since"] is not None and (sensor == "perfect" or not why["closed_by"]):
            assert f" {knowable['no_way_since']}, " in str(knowable["text"]).partition(".")[0] + " "
    assert exact


@pytest.mark.parametrize("code", NARRATORS)
def test_of_a_drive_that_did_not_get_stuck_that_is_said(code: str) -> None:
    timeline = ended(0, planner="astar")
    for what in ("stuck_cause", "knowable"):
        answer = told(timeline, code, about="history", what=what)
        assert "no_way_since" not in answer
