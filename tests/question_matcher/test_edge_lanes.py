"""Lanes that are named by the edge they lie at have their numbers."""

from __future__ import annotations

import pytest

from service.question_matcher.edge_lanes import EdgeLanes
from service.resources import prompts_folder

LANES = {code: EdgeLanes(prompts_folder() / "questions" / code) for code in ("en", "de")}


@pytest.mark.parametrize(
    ("code", "text", "numbered"),
    [
        ("en", "Is the leftmost lane free?", "Is lane 1 free?"),
        ("en", "why don't you use the right-most lane?", "why don't you use lane 6?"),
        ("en", "have you been in the lane on the far right?", "have you been in lane 6?"),
        ("en", "leftmost lane or rightmost lane?", "lane 1 or lane 6?"),
        ("de", "Ist die Spur ganz rechts frei?", "Ist Spur 6 frei?"),
    ],
)
def test_a_lane_at_an_edge_is_named_by_its_number(code: str, text: str, numbered: str) -> None:
    assert LANES[code].numbered(text, 6) == numbered


@pytest.mark.parametrize(
    "text",
    ["is the left lane free?", "is the lane on my left free?", "what is on the far left?", "the right one"],
)
def test_a_lane_beside_the_vehicle_is_not_at_an_edge(text: str) -> None:
    assert LANES["en"].numbered(text, 6) == text


def test_a_language_without_words_for_them_leaves_all_as_it_is(tmp_path) -> None:
    assert EdgeLanes(tmp_path).numbered("is the leftmost lane free?", 8) == "is the leftmost lane free?"
