"""What is told of a person's driving says its facts, yes or no first where it is asked, in both languages."""

from __future__ import annotations

import re
from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.sim.explain.test_hand_beside import alone, by_hand
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def answer(timeline: Timeline, code: str, supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    told = NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))
    assert looks_like_sentences(re.sub(r"^\d+", "One", told["text"])), told["text"]
    assert len(told["text"].split()) <= MOST_WORDS, told["text"]
    assert ids_in(told["text"]) == set(), told["text"]
    return told


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize(("supposes", "contrary"), [("better", "worse"), ("safer", "riskier")])
def test_yes_turns_into_no_where_it_is_asked_the_other_way_round(
    code: str, supposes: str, contrary: str
) -> None:
    yes, no = YES_NO[code]
    found = set()
    for seed in range(12):
        timeline = by_hand(seed, 14)
        one, other = (
            answer(timeline, code, each, about="planners", what="hand_beside")["text"]
            for each in (supposes, contrary)
        )
        first = {text.split(".")[0] for text in (one, other)}
        if first & {yes, no}:
            assert first == {yes, no}
            found.add(one.split(".")[0])
        else:
            assert one == other
    assert found


@pytest.mark.parametrize("code", NARRATORS)
def test_both_are_told_at_every_end_and_of_another_planner_by_its_name(code: str) -> None:
    ends = set()
    for seed in range(24):
        timeline = by_hand(seed, (6, 60)[seed % 2])
        ends.add(timeline.state.world.outcome)
        for supposes in (None, "better", "smoother"):
            told = answer(timeline, code, supposes, about="planners", what="hand_beside")
            assert told["you"]["outcome"] is timeline.state.world.outcome
        assert (
            "A*"
            in answer(timeline, code, None, about="planners", what="hand_beside", planner="astar")["text"]
        )
    assert ends >= {Outcome.RUNNING, Outcome.SUCCESS}


def test_who_waits_is_told_by_how_far_they_are_behind() -> None:
    timeline = by_hand(3, 8, moves=(Move.STAY,))
    told = answer(timeline, "en", about="planners", what="hand_beside")
    rows = told["planner_instead"]["rows"] - told["you"]["rows"]
    assert told["text"].startswith(f"I would be {rows} rows ({5 * rows} m) ahead of you now.")


@pytest.mark.parametrize("code", NARRATORS)
def test_where_nobody_drove_that_is_said(code: str) -> None:
    told = answer(alone(1), code, "better", about="planners", what="hand_beside")
    assert "you" not in told


@pytest.mark.parametrize("code", NARRATORS)
def test_which_of_the_two_is_told_without_yes_or_no(code: str) -> None:
    yes, no = YES_NO[code]
    for seed in range(8):
        timeline = by_hand(seed, 14)
        for who, plain in (("who", "better"), ("who_safer", "safer"), ("who_smoother", "smoother")):
            named = answer(timeline, code, who, about="planners", what="hand_beside")["text"]
            judged = answer(timeline, code, plain, about="planners", what="hand_beside")["text"]
            assert not named.startswith((yes, no))
            if judged.startswith(yes):
                assert named.startswith({"en": "You do.", "de": "Du."}[code])
            elif judged.startswith(f"{no}."):
                assert named.startswith({"en": "I would.", "de": "Ich."}[code])
            else:
                assert named == judged
