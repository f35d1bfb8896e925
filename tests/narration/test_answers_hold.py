"""Answers to the canonical sentences hold by figures that are worked out anew, on a few drives."""

from __future__ import annotations

import pytest

from tools.false_answers import JUDGES, count

DEAR = frozenset(
    (
        "luck",
        "other_seeds",
        "factor",
        "factor_planner",
        "trouble",
        "tight",
        "best_time",
        "typical",
        "hard_road",
    )
)


@pytest.mark.parametrize("seed", [1, 2])
def test_no_answer_is_false_on_a_few_drives(seed: int) -> None:
    looked, false, lines = count(drives=3, seed=seed, kinds=frozenset(JUDGES) - DEAR)
    assert not false, "\n".join(lines)
    assert sum(looked.values()) > 300
