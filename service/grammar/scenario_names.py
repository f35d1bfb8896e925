"""The name of a scenario in a request: "run the scenario monday demo 100 times with A*".

It is found before anything else is read, as other names are: one in quotation marks, one that was given in
the session, or any words after "the scenario called", which end before a number, a mark, or a word of
`scenario_name_end`. Scenarios that come with Roadtalk are phrases of the language.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from service.grammar.free_text import end_of_name, longest, quoted_name
from service.grammar.lattice import Name
from service.grammar.lexicon import Lexicon
from service.grammar.tokens import Token
from service.grammar.topic import Topic

NAME: Final = "scenario_name"
"""Concept of a name."""
MARK: Final = "scenario_mark"
"""Concept of words before a name: "the scenario", "the scenario called"."""
CALLED: Final = "called"
"""The mark after which all words are a name, whatever they mean elsewhere."""
ENDS: Final = "scenario_name_end"
_NONE: Final[frozenset[str]] = frozenset()


def find_scenario_name(tokens: Sequence[Token], lexicon: Lexicon, said: str, topic: Topic) -> dict[int, Name]:
    """Start (token) → name, for the first scenario that is named in a sentence; `said` is its text."""
    begins = lexicon.begins.get(MARK, _NONE)
    for at, token in enumerate(tokens):
        if token.text not in begins or not (after := longest(lexicon, tokens, at, MARK)):
            continue
        if after >= len(tokens):
            continue
        if (quoted := quoted_name(tokens, after, said)) is not None:
            return {after: Name(quoted.end, quoted.text, NAME)}
        end = _known(tokens, after, topic.names) or _called(tokens, at, after, lexicon)
        if end:
            return {after: Name(end, said[tokens[after].start : tokens[end - 1].end], NAME)}
    return {}


def _known(tokens: Sequence[Token], start: int, names: frozenset[str]) -> int:
    """The end of the longest name at `start` that was given in the session; 0 where there is none."""
    said = [token.text for token in tokens[start:]]
    words = [name.replace("-", " ").replace("_", " ").split() for name in names]
    fits = [len(each) for each in words if each and each == said[: len(each)]]
    return start + max(fits) if fits else 0


def _called(tokens: Sequence[Token], at: int, start: int, lexicon: Lexicon) -> int:
    """The end of any other name, after words that only a name can follow; 0 where they are not such."""
    senses = [s for stop, found, _ in lexicon.matches(tokens, at, {}, {}) if stop == start for s in found]
    if not any(sense.concept == MARK and sense.value == CALLED for sense in senses):
        return 0
    end = start
    while end < len(tokens) and not tokens[end].digits and not _is(lexicon, tokens[end], ENDS):
        end += 1
    end = end_of_name(tokens, start, end, lexicon)
    return end if end > start else 0


def _is(lexicon: Lexicon, token: Token, concept: str) -> bool:
    return any(sense.concept == concept for sense in lexicon.senses_of((token.text,)))
