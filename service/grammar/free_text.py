"""Free-text slots: the name after "save this as", a taught phrase, kept as they were written.

They are found before anything else is read, so that no typo is corrected in a name and no word of a name is
read as a request. A name ends at a comma, at "then" or at the end of the text; a name in quotation marks ends
at the closing mark (`\\"` is a mark within).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from service.grammar.accounting import CLAUSE, IDIOM
from service.grammar.fragments import BUT, THEN
from service.grammar.lattice import GLUE, Name
from service.grammar.lexicon import Lexicon, Sense
from service.grammar.tokens import Token
from service.grammar.topic import Phrases, Topic

CAPTURE = "captures"
ENDS = "name_end"
TRAILING = "name_tail"
FORGETS = "forgets"
TEACH = "teach"
MEANS = "means"
SAVES = "save"
CHAT = "chat"
"""Concept of small talk."""
ORDER = "order"
"""Concept of words that say that something is done before the rest; a name ends before them."""
SHORT = "short"
RETURNS = "returns"
"""The form of what brings a name only where that name is known: "go back to autopilot" names no moment."""
MAX_SHORT = 3
"""Words a name may have after a bare verb, unless it is in quotation marks."""
QUANTITY = "quantity"
_NONE: frozenset[str] = frozenset()
STARTS_AFTER = "separator"
COLON = "colon"


QUOTE = '"'
ESCAPE = "\\"
_DASHES = ("-", "–", "—")
_LOOSE = "\"' "
"""Marks around a name that are no part of it."""


def find_names(tokens: Sequence[Token], lexicon: Lexicon, said: str, topic: Topic) -> dict[int, Name]:
    """Start (token) → name, for every name in the sentence.

    `said` is the text they are taken from; `topic` has the phrases that were taught and so can be forgotten,
    and the names that were given and so can be gone back to.
    """
    found: dict[int, Name] = {}
    words = {token.text for token in tokens}
    teaching, capturing = lexicon.begins.get(TEACH, _NONE), lexicon.begins.get(CAPTURE, _NONE)
    forgetting = lexicon.begins.get(FORGETS, _NONE)
    if words.isdisjoint(forgetting) and words.isdisjoint(teaching) and words.isdisjoint(capturing):
        return found
    if (begun := _forgets(tokens, lexicon, topic.phrases)) is not None:
        start, end = begun
        quoted = quoted_name(tokens, start, said)
        return {start: quoted or Name(end, said[tokens[start].start : tokens[end - 1].end])}
    at, meaning = 0, 0
    while at < len(tokens):
        word = tokens[at].text
        if word not in teaching and word not in capturing:
            at += 1
            continue
        after = longest(lexicon, tokens, at, TEACH)
        if after and not found and (name := _taught(tokens, after, lexicon, said)) is not None:
            found[after] = name
            meaning = at = _past_means(tokens, name.end, lexicon)
            continue
        after = longest(lexicon, tokens, at, CAPTURE)
        another = max(longest(lexicon, tokens, at, CHAT), longest(lexicon, tokens, at, IDIOM))
        if after < another:  # "call it a day" names nothing
            at += 1
            continue
        if not after or not (at == meaning or _begins(tokens, at, lexicon)):
            at += 1
            continue
        name = quoted_name(tokens, after, said)
        if name is None:
            name = _open(tokens, after, lexicon, said)
            if name is not None and not _fits(tokens, at, after, name.end, lexicon):
                name = None
        if name is not None and _only(RETURNS, lexicon, tokens, at, after):
            name = name if name.text.casefold() in topic.names else None
        if name is not None:
            found[after] = name
        at = name.end if name else after
    return found


def find_taught(tokens: Sequence[Token], lexicon: Lexicon, said: str) -> tuple[int, Name, int] | None:
    """A phrase that is taught: where it begins, the phrase, and where its meaning begins."""
    for at in range(len(tokens)):
        after = longest(lexicon, tokens, at, TEACH)
        if after and (name := _taught(tokens, after, lexicon, said)) is not None:
            return after, name, _past_means(tokens, name.end, lexicon)
        if not _is(lexicon, tokens[at], GLUE):
            return None
    return None


def _forgets(tokens: Sequence[Token], lexicon: Lexicon, phrases: Phrases) -> tuple[int, int] | None:
    """Where the phrase to be forgotten is: one in quotation marks, or one that was taught."""
    words = [token.text for token in tokens]
    begins = lexicon.begins.get(FORGETS, set())
    for at in (at for at, word in enumerate(words) if word in begins):
        ends = {end for end, senses, _ in lexicon.matches(tokens, at, {}, {}) if _any_is(senses, FORGETS)}
        for start in sorted(ends, reverse=True):
            if start < len(tokens) and words[start] == QUOTE:
                return start, len(tokens)
            if start < len(tokens) and (end := phrases.named_at(words, start)) is not None:
                return start, end
    return None


def quoted_name(tokens: Sequence[Token], at: int, said: str) -> Name | None:
    """The name between quotation marks at `at`, or None."""
    if at >= len(tokens) or tokens[at].text != QUOTE:
        return None
    end = at + 1
    while end < len(tokens) and tokens[end].text != QUOTE:
        escaped = tokens[end].text == ESCAPE and end + 1 < len(tokens)
        end += 2 if escaped and tokens[end + 1].start == tokens[end].end else 1
    if end >= len(tokens) or end == at + 1:
        return None
    inside = said[tokens[at].end : tokens[end].start]
    return Name(end + 1, re.sub(r"\\(.)", r"\1", inside, flags=re.DOTALL))


def _open(tokens: Sequence[Token], at: int, lexicon: Lexicon, said: str) -> Name | None:
    """The name that starts at `at` and ends at the next mark."""
    end = at
    while end < len(tokens) and (not _is(lexicon, tokens[end], ENDS) or _inside_word(tokens, end, said)):
        end += 1
    end = end_of_name(tokens, at, end, lexicon)
    return Name(end, said[tokens[at].start : tokens[end - 1].end].strip(_LOOSE)) if end > at else None


def end_of_name(tokens: Sequence[Token], start: int, end: int, lexicon: Lexicon) -> int:
    """Where a name ends before words that are no part of it: "please", "first"."""
    while end > start and (
        _is(lexicon, tokens[end - 1], TRAILING) or (end - 1 > start and _is(lexicon, tokens[end - 1], ORDER))
    ):
        end -= 1
    return end


def _taught(tokens: Sequence[Token], at: int, lexicon: Lexicon, said: str) -> Name | None:
    """The phrase that starts at `at` and ends before "I mean" and what separates it."""
    quoted = quoted_name(tokens, at, said)
    if quoted is not None:
        return quoted
    for end in range(at + 1, len(tokens)):
        if longest(lexicon, tokens, end, MEANS):
            while end - 1 > at and _is(lexicon, tokens[end - 1], STARTS_AFTER):
                end -= 1
                if _parts_requests(lexicon, tokens[end]):
                    return None
            return Name(end, said[tokens[at].start : tokens[end - 1].end].strip(_LOOSE))
    return None


def _parts_requests(lexicon: Lexicon, token: Token) -> bool:
    """Whether a word leads to another request: after "define courtesy but" nothing says what it means."""
    senses = lexicon.senses_of((token.text,))
    return any(sense.concept == STARTS_AFTER and sense.value in (BUT, THEN) for sense in senses)


def _past_means(tokens: Sequence[Token], at: int, lexicon: Lexicon) -> int:
    """Where what a taught phrase means begins, the phrase ending at `at`."""
    for start in range(at, len(tokens)):
        if end := longest(lexicon, tokens, start, MEANS):
            return end
    return len(tokens)


def longest(lexicon: Lexicon, tokens: Sequence[Token], at: int, concept: str) -> int:
    """The end of the longest phrase at `at` with this concept; 0 when there is none."""
    if tokens[at].text not in lexicon.begins.get(concept, ()):
        return 0
    matches = lexicon.matches(tokens, at, {}, {})
    return max((end for end, senses, _ in matches if _any_is(senses, concept)), default=0)


def _only(form: str, lexicon: Lexicon, tokens: Sequence[Token], at: int, end: int) -> bool:
    """Whether what brings the name is only of a form.

    After a bare verb ("load the dishwasher before you go") not every word is a name.
    """
    senses = [s for stop, found, _ in lexicon.matches(tokens, at, {}, {}) if stop == end for s in found]
    return all(sense.form == form for sense in senses if sense.concept == CAPTURE)


def _any_is(senses: Sequence[Sense], concept: str) -> bool:
    return any(sense.concept == concept for sense in senses)


def _begins(tokens: Sequence[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether a request can begin at this token: after a separator, or after nothing but glue."""
    return at == 0 or any(_is(lexicon, tokens[at - 1], each) for each in (STARTS_AFTER, GLUE, COLON))


def _inside_word(tokens: Sequence[Token], at: int, said: str) -> bool:
    """Whether a mark is a dash with no space around it: "sweep-07" is one name."""
    mark = tokens[at]
    touching = (
        0 < at < len(tokens) - 1 and tokens[at - 1].end == mark.start and tokens[at + 1].start == mark.end
    )
    return touching and said[mark.start : mark.end] in _DASHES


def _fits(tokens: Sequence[Token], at: int, start: int, end: int, lexicon: Lexicon) -> bool:
    """Whether words may be a name: not "demo if it works", and after "load" not "five cars"."""
    short = _only(SHORT, lexicon, tokens, at, start)
    if short and (end - start > MAX_SHORT or _counts(lexicon, tokens[start])):
        return False
    if any(_is(lexicon, word, CLAUSE) for word in tokens[start + 1 : end]):
        return False
    senses = [s for stop, found, _ in lexicon.matches(tokens, at, {}, {}) if stop == start for s in found]
    saves = any(sense.concept == CAPTURE and sense.value == SAVES for sense in senses)
    return (saves and not short) or not any(_names_a_thing(lexicon, word) for word in tokens[start:end])


def _counts(lexicon: Lexicon, token: Token) -> bool:
    """Whether a word is an amount or says whose: no name begins so after a bare verb ("load of rubbish")."""
    senses = lexicon.senses_of((token.text,))
    return any(sense.concept in (QUANTITY, GLUE) for sense in senses)


def _names_a_thing(lexicon: Lexicon, token: Token) -> bool:
    """Whether the word is a kind of thing: "load five cars" is no name."""
    return any(sense.concept.startswith("noun.thing") for sense in lexicon.senses_of((token.text,)))


def _is(lexicon: Lexicon, token: Token, concept: str) -> bool:
    return any(sense.concept == concept for sense in lexicon.senses_of((token.text,)))
