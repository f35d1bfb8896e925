"""Answers about who reacted to the ego and what made trouble: yes or no first, brief, in both languages."""

from __future__ import annotations

import pytest

from tests.narration.test_barred_rows import NARRATORS, YES_NO, told
from tests.sim.explain.test_influence import driven


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("ticks", [0, 20])
def test_who_was_swayed_is_yes_or_no_and_trouble_names_one(code: str, ticks: int) -> None:
    yes, no = YES_NO[code]
    for seed in range(8):
        timeline = driven(seed, ticks, courtesy=0.7 if seed % 2 else 0.0)
        answer = told(timeline, code, about="history", what="influence")
        if ticks:
            assert str(answer["text"]).startswith(yes if answer["swayed"] else no)
        for kind in (None, "vehicle", "pothole"):
            found = told(timeline, code, about="history", what="trouble", kind=kind)
            for each in found.get("trouble", ()):  # type: ignore[attr-defined]
                assert kind in (None, each["kind"])


@pytest.mark.parametrize("code", NARRATORS)
def test_where_nobody_heeds_the_ego_that_is_the_ground(code: str) -> None:
    answer = told(driven(1, attentive=0.0, courtesy=0.0), code, about="history", what="influence")
    assert answer["heeding"] is False
