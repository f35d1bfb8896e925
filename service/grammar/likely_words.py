"""Reads an unknown word that several words are one edit away from: as the one that makes a sentence.

"Fater" may be "faster", "later" or "father"; "cruise 10 mph fater" is a request with one of them alone. Where
two of them make different requests nothing is guessed. Words for numbers are never among them. A letter left out,
doubled or swapped is commoner than a wrong one, so where such words are near the others are not tried.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from service.grammar.parse_types import Correction, Parse, Understood
from service.grammar.tokens import Token
from service.grammar.typos import Typos

MOST_WORDS = 8
"""More words than this near an unknown one say that it could be anything."""


def read_likely(
    text: str, plain: str, unknown: Sequence[Token], typos: Typos, read: Callable[[str], Parse]
) -> Understood | None:
    """What a sentence with one unknown word means; None where no word, or not only one meaning, fits."""
    if len(unknown) != 1:
        return None
    (token,) = unknown
    said = plain[token.start : token.end]
    meant: Understood | None = None
    near = typos.near(token.text)
    slips = [word for word in near if len(word) != len(token.text) or sorted(word) == sorted(token.text)]
    for word in (slips or near)[:MOST_WORDS]:
        parsed = read(plain[: token.start] + word + plain[token.end :])
        if not isinstance(parsed, Understood):
            continue
        if meant is None:
            others = (*parsed.corrections, Correction(said, word))
            meant = Understood(text, parsed.actions, others, parsed.supposes)
        elif meant.actions != parsed.actions:
            return None
    return meant
