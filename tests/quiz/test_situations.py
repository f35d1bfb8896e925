"""The situations of a quiz: the same for the same seed, alike before and after, and with one right reason."""

from __future__ import annotations

from collections import Counter

import pytest

from service.narration.quiz.situations import NOTHING, PHASES, situations
from service.narration.sayings import Sayings

SAYINGS = Sayings.load()


@pytest.mark.parametrize("planner", ["priority", "rules", "astar"])
def test_a_quiz_is_the_same_for_the_same_seed(planner: str) -> None:
    quiz = situations(3, planner, 3, SAYINGS)
    assert quiz == situations(3, planner, 3, SAYINGS)
    assert quiz != situations(4, planner, 3, SAYINGS)
    assert [each.phase for each in quiz] == [phase for phase in PHASES for _ in range(3)]


def test_after_is_as_hard_as_before_and_not_all_is_straight_ahead() -> None:
    quiz = situations(5, "priority", 6, SAYINGS)
    before, after = (
        Counter(each.move for each in quiz if each.phase == phase) for phase in ("before", "after")
    )
    assert (before - after).total() <= 2
    assert max(before.values()) <= 3
    assert len(before) >= 3


@pytest.mark.parametrize("seed", range(4))
def test_one_reason_is_right_and_the_others_read_differently(seed: int) -> None:
    for each in situations(seed, "priority", 4, SAYINGS):
        ids, texts = [reason.id for reason in each.reasons], [reason.text for reason in each.reasons]
        assert ids.count(each.reason) == 1
        assert NOTHING in ids
        assert len(set(texts)) == len(texts)
        assert each.explanation
        assert sum(row.count("A") for row in each.picture) == 1


@pytest.mark.parametrize("count", [0, 13])
def test_a_quiz_has_an_end(count: int) -> None:
    with pytest.raises(ValueError, match="1 to 12"):
        situations(1, "priority", count, SAYINGS)
