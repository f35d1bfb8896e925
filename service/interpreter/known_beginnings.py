"""Whether a phrase is a piece of what can be said anyway, and so cannot be taught as something else.

"Add" alone is no request, but it begins one: who says it has not finished, and must not be taken at a word
that somebody taught. A single word of the language is such a piece, and so is the beginning of a saying.
"""

from __future__ import annotations

from service.grammar import Language as Grammar
from service.grammar.tokens import normalise, tokenise


def is_piece(language: Grammar, phrase: str) -> bool:
    """Whether the language knows the phrase as a word, or begins one of its sayings with it."""
    words = language.words_of(phrase)
    if len(words) == 1:
        tokens = tokenise(normalise(phrase), language.data.contractions)
        return not language.scan(tokens).uncovered()
    return any(
        language.words_of(say)[: len(words)] == words
        for frame in language.data.frames
        for say in frame.says
        if normalise(say).startswith(words[0])
    )
