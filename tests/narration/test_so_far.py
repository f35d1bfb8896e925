"""Answers about the drive so far with something otherwise, what it hung on, and a person's own moves."""

from __future__ import annotations

import pytest

from sim.actions import Set
from sim.explain.expectation import Entry, expectation
from sim.explain.question_error import QuestionError
from sim.explain.single_factors import single_factors
from sim.explain.so_far import so_far
from sim.explain.unsafe_moves import latest_by_hand, unsafe_moves
from sim.types import Move, Outcome
from tests.narration.test_barred_rows import NARRATORS, YES_NO, told
from tests.sim.explain.test_so_far import SEEDS, VARIED, by_hand, driven, failed


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("varied", VARIED, ids=str)
def test_yes_or_no_is_by_the_moves_or_by_a_crash(code: str, varied: dict[str, str | float]) -> None:
    yes, no = YES_NO[code]
    change = tuple(Set(parameter=name, value=value) for name, value in varied.items())  # type: ignore[arg-type]
    for seed in SEEDS:
        timeline = driven(seed)
        found = so_far(timeline, varied)
        agreed = {
            "same": found.same,
            "differs": not found.same,
            "clear": found.outcome is not Outcome.CRASH,
        }
        for supposes, is_so in agreed.items():
            answer = told(timeline, code, supposes, about="what_if", what="so_far", change=change)
            text = str(answer["text"])
            assert text.startswith(yes if is_so else no)
            if found.differs is not None:
                assert f"{found.differs.tick}:" in text
        plainly = told(timeline, code, about="what_if", what="so_far", change=change)
        assert not str(plainly["text"]).startswith((yes, no))


@pytest.mark.parametrize("code", NARRATORS)
def test_one_factor_is_yes_or_no_and_all_of_them_are_named_first(code: str) -> None:
    yes, no = YES_NO[code]
    names = {"en": ("The sensor", "The planner"), "de": ("Der Sensor", "Der Planer")}[code]
    for timeline in failed():
        found = single_factors(timeline)
        for factor in ("sensor", "weather", "planner"):
            text = str(told(timeline, code, factor, about="blame", what="factor")["text"])
            assert text.startswith(yes if found.helps(factor) else no)
        text = str(told(timeline, code, about="blame", what="factor")["text"])
        helps = [bool(found.helps(factor)) for factor in ("sensor", "planner")]
        if helps in ([True, False], [False, True]) and not found.helps("weather"):
            assert text.startswith(names[helps.index(True)])
    assert "driven_again" not in told(driven(1, 3), code, about="blame", what="factor")


@pytest.mark.parametrize("code", NARRATORS)
def test_what_was_expected_and_why_the_cell_was_entered(code: str) -> None:
    free = {"en": "taking that cell for free", "de": "hielt das Feld für frei"}[code]
    seen = 0
    for seed in range(30):
        timeline = driven(seed, 200)
        for what in ("expected", "entered"):
            text = str(told(timeline, code, about="blame", what=what)["text"])
            try:
                found = expectation(timeline)
            except QuestionError:
                continue
            seen += 1
            assert (free in text) is (found.entry in (Entry.UNSEEN, Entry.ELSEWHERE))
            assert str(found.tick) in text or what == "entered"
    assert seen


@pytest.mark.parametrize("code", NARRATORS)
def test_moves_of_a_person(code: str) -> None:
    for seed in range(8):
        timeline = by_hand(seed)
        found = unsafe_moves(timeline)
        answer = told(timeline, code, about="history", what="unsafe_moves")
        assert len(answer["unsafe"]) == len(found.found)  # type: ignore[arg-type]
        if found.found:
            assert f"ick {found.found[-1].tick}," in str(answer["text"])
        tick = latest_by_hand(timeline)
        decision = timeline.decided(timeline.at(tick or 0))
        other = Move.STAY if decision is not None and decision.move is not Move.STAY else Move.FORWARD
        at_tick = told(timeline, code, about="what_if", move=other, tick=tick)
        own = told(timeline, code, about="what_if", what="own_last", move=other)
        assert own["text"] == at_tick["text"]
    nobody = told(driven(1, 3), code, about="what_if", what="own_last", move=Move.LEFT)
    assert nobody["tick"] == 3
