"""Names: the words after "save this as", kept as they were written.

They are found before anything else is read, so that no typo is "repaired" in a name and no word of
it is taken for a request. A name ends at a comma, at "then" or at the end.
"""

from __future__ import annotations

from collections.abc import Sequence

from service.language.lattice import GLUE
from service.language.lexicon import Lexicon
from service.language.tokens import Token

CAPTURE = "captures"
ENDS = "name_end"
TRAILING = "name_tail"
TEACH = "teach"
MEANS = "means"
STARTS_AFTER = "separator"


def names(tokens: Sequence[Token], lexicon: Lexicon) -> dict[int, int]:
    """Start → end (tokens) of every name in the sentence."""
    found: dict[int, int] = {}
    at = 0
    while at < len(tokens):
        after = _longest(lexicon, tokens, at, TEACH)
        if after and not found and (end := _before_meaning(tokens, after, lexicon)) is not None:
            found[after] = end
            break
        after = _longest(lexicon, tokens, at, CAPTURE)
        if not after:
            at += 1
            continue
        if not _begins(tokens, at, lexicon):
            at += 1
            continue
        at = end = after
        while end < len(tokens) and not _is(lexicon, tokens[end], ENDS):
            end += 1
        last = end
        if any(_names_a_thing(lexicon, token) for token in tokens[at:end]):
            continue
        while last > at and _is(lexicon, tokens[last - 1], TRAILING):
            last -= 1
        if last > at:
            found[at] = last
        at = max(end, at)
    return found


def _before_meaning(tokens: Sequence[Token], at: int, lexicon: Lexicon) -> int | None:
    """Where a taught phrase that starts at `at` ends: before "I mean" and what separates it."""
    for end in range(at + 1, len(tokens)):
        if _longest(lexicon, tokens, end, MEANS):
            while end - 1 > at and _is(lexicon, tokens[end - 1], STARTS_AFTER):
                end -= 1
            return end
    return None


def _longest(lexicon: Lexicon, tokens: Sequence[Token], at: int, concept: str) -> int:
    """The end of the longest phrase at `at` with this concept; 0 when there is none."""
    matches = lexicon.matches(tokens, at, {}, {})
    return max((end for end, senses, _ in matches if any(s.concept == concept for s in senses)), default=0)


def _begins(tokens: Sequence[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether a request can begin at this token: after a separator, or after nothing but glue."""
    return at == 0 or _is(lexicon, tokens[at - 1], STARTS_AFTER) or _is(lexicon, tokens[at - 1], GLUE)


def _names_a_thing(lexicon: Lexicon, token: Token) -> bool:
    """Whether the word is a kind of thing: "load five cars" is no name."""
    return any(sense.concept.startswith("noun.thing") for sense in lexicon.senses_of((token.text,)))


def _is(lexicon: Lexicon, token: Token, concept: str) -> bool:
    return any(sense.concept == concept for sense in lexicon.senses_of((token.text,)))
