"""Answers about a lane that is not taken: what is free now and what would come of it, in both languages."""

from __future__ import annotations

import pytest

from tests.narration.test_barred_rows import NARRATORS, told
from tests.sim.explain.test_to_lane import begun


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("ticks", [4, 400])
def test_each_lane_has_an_answer(code: str, ticks: int) -> None:
    for seed in range(4):
        timeline = begun(seed, ticks)
        for lane in (1, 3, 6):
            now = told(timeline, code, about="outlook", what="lane", lane=lane)
            had = told(timeline, code, about="what_if", what="to_lane", lane=lane)
            for each in (now, had):
                assert each["policy"]["lane"] == lane  # type: ignore[index]
                assert f" {lane}" in str(each["text"])
            assert had["policy"]["from_tick"] == 0  # type: ignore[index]
        off = told(timeline, code, about="outlook", what="lane", lane=9)
        assert "policy" not in off
        assert " 9 " in str(off["text"])
