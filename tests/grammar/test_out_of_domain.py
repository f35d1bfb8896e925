"""Nothing that is not for the simulator does anything to it."""

from __future__ import annotations

from service.grammar import Language, Refused
from tools.out_of_domain import sentences


def test_nothing_out_of_domain_is_understood_or_asked_about(language: Language) -> None:
    said = sentences()
    assert len(set(said)) >= 3_000
    assert [text for text in said if not isinstance(language.parse(text), Refused)] == []
