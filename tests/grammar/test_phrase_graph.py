"""The graph of phrases holds what its patterns stand for, and nothing else, however many that are."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from service.grammar.lexicon import Lexicon
from service.grammar.patterns import expand

WORDS = st.sampled_from(["go", "to", "the", "left", "{n}"])


def optional(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return inner.map("[{}]".format)


def chosen(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.lists(inner, min_size=1, max_size=3).map(lambda ways: f"({'|'.join(ways)})")


def row(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.lists(inner, min_size=1, max_size=3).map(" ".join)


PATTERNS = st.recursive(
    WORDS, lambda inner: st.one_of(optional(inner), chosen(inner), row(inner)), max_leaves=10
)


@given(st.lists(st.tuples(PATTERNS, st.sampled_from(["one", "two"])), min_size=1, max_size=4))
def test_it_holds_the_phrases_of_its_patterns(said: list[tuple[str, str]]) -> None:
    lexicon = Lexicon({})
    meant: dict[tuple[str, ...], set[str]] = {}
    typical: dict[str, tuple[str, ...]] = {}
    for text, concept in said:
        lexicon.add_section({concept: [text]})
        for words in expand(text, {}):
            meant.setdefault(words, set()).add(concept)
            if "{n}" not in words:
                typical.setdefault(concept, words)
    found = {words: {sense.concept for sense in senses} for words, senses in lexicon.phrases()}
    assert found == meant
    assert {concept: words for (concept, _), words in lexicon.typical.items()} == typical
    begun = {each: {words[0] for words in meant if each in meant[words]} for each in lexicon.concepts}
    assert {each: words for each, words in lexicon.begins.items() if words} == {
        each: words for each, words in begun.items() if words
    }


@given(st.lists(PATTERNS, min_size=2, max_size=3))
def test_a_pattern_without_a_new_phrase_is_told(said: list[str]) -> None:
    lexicon = Lexicon({})
    lexicon.add_section({"one": said})
    known: set[tuple[str, ...]] = set()
    repeats = 0
    for text in said:
        phrases = set(expand(text, {}))
        repeats += bool(phrases) and phrases <= known
        known |= phrases
    assert len(lexicon.repeats) == repeats


def test_a_pattern_may_stand_for_more_phrases_than_could_be_written_out() -> None:
    lexicon = Lexicon({})
    lexicon.add_section({"long": " ".join("[(a|b|c)]" for _ in range(60)) + " end"})
    words = ["a"] * 60
    assert lexicon.senses_of((*words, "end"))
    assert not lexicon.senses_of((*words, "a", "end"))
