"""Every term can be asked about, is explained shortly in each language, and no word is taken for another."""

from __future__ import annotations

import re
from typing import get_args

import pytest

from service.actions import Ask, Term
from service.grammar import Language, Refused, Understood
from service.narration import Narrator
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline

LANGUAGE = Language.load()
TIMELINE = Timeline(Config())


@pytest.mark.parametrize("term", get_args(Term))
def test_every_term_is_understood_in_several_forms(term: Term) -> None:
    word = LANGUAGE.data.sentences["terms"][term]
    for form in ("what does {} mean?", "define {}", "what is meant by {}?"):
        parsed = LANGUAGE.parse(form.format(word))
        assert isinstance(parsed, Understood), form.format(word)
        assert parsed.actions == (Ask(about="term", term=term),)


@pytest.mark.parametrize("code", ["en", "de"])
@pytest.mark.parametrize("term", get_args(Term))
def test_every_term_is_explained_in_two_sentences_at_most(code: str, term: Term) -> None:
    answer = Narrator.load(code).answer(Asked(Ask(about="term", term=term), TIMELINE))
    text = Sayings.load(code).say("glossary", "terms", term, "text")
    assert answer["text"].startswith(text)
    assert 1 <= len(re.findall(r"[.!?](?: |$)", text)) <= 2, text
    assert (answer["source"] is None) == (answer["text"] == text)


@pytest.mark.parametrize("code", ["en", "de"])
def test_the_glossary_holds_the_terms_and_no_others(code: str) -> None:
    for table in ("terms", "names"):
        assert set(Sayings.load(code).words("glossary", table)) == set(get_args(Term))


@pytest.mark.parametrize("word", ["entropy", "a carburettor", "the gearbox", "quantum physics", "bravery"])
def test_other_words_are_refused(word: str) -> None:
    for form in ("what is {}?", "explain {}", "what does {} mean?"):
        assert isinstance(LANGUAGE.parse(form.format(word)), Refused)
