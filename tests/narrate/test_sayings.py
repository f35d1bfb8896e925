"""Every saying can be said: the data has all that the code asks for, and nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from service.narrate.sayings import Sayings
from sim.forecast import StepVerdict
from sim.types import Kind, Move, Outcome

SAYINGS = Sayings.load()


@pytest.mark.parametrize("move", Move)
@pytest.mark.parametrize("form", ["did", "do", "name", "place"])
def test_every_move_has_every_form(move: Move, form: str) -> None:
    assert SAYINGS.move(move, form)


@pytest.mark.parametrize("verdict", StepVerdict)
@pytest.mark.parametrize("tense", ["now", "then"])
def test_every_verdict_can_be_told(verdict: StepVerdict, tense: str) -> None:
    assert "X" in SAYINGS.say("words", "reasons", verdict, tense, who="W", a="A", place="X")


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_has_a_singular_and_a_plural(kind: Kind) -> None:
    assert SAYINGS.things(kind, 1) != SAYINGS.things(kind, 2)


@pytest.mark.parametrize("outcome", [outcome for outcome in Outcome if outcome is not Outcome.RUNNING])
def test_every_outcome_has_a_word(outcome: Outcome) -> None:
    assert SAYINGS.say("answers", "outcomes", outcome)


def test_lists_are_joined_as_people_do() -> None:
    assert [SAYINGS.joined("abc"[:n]) for n in range(4)] == ["", "a", "a and b", "a, b and c"]


def test_a_language_without_sayings_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no sayings"):
        Sayings.load("xx", tmp_path)
