"""Splits a question into word pieces, the way the encoder's table of pieces is made (WordPiece).

Source: Wu et al. 2016, "Google's neural machine translation system"; the rules for case, accents and marks
are those of uncased BERT (Devlin et al. 2019).
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping

FIRST, LAST, UNKNOWN = "[CLS]", "[SEP]", "[UNK]"
CONTINUES = "##"
"""What a piece that continues a word begins with."""
MAX_LETTERS = 60
"""A longer word is unknown."""


def word_pieces(text: str, rows: Mapping[str, int], most: int) -> list[int]:
    """The rows of a text's pieces between `FIRST` and `LAST`; `most` of them at most.

    `rows`: the row of each piece of the table.
    """
    found = [rows[piece] for word in _words(text) for piece in _pieces(word, rows)]
    return [rows[FIRST], *found[: most - 2], rows[LAST]]


def _words(text: str) -> list[str]:
    """Words without case and accents; each mark is a word of its own."""
    plain = (
        letter
        for letter in unicodedata.normalize("NFD", text.lower())
        if unicodedata.category(letter) != "Mn"
    )
    return "".join(f" {letter} " if _is_mark(letter) else letter for letter in plain).split()


def _is_mark(letter: str) -> bool:
    return unicodedata.category(letter).startswith("P") or letter in "$+<=>^`|~"


def _pieces(word: str, rows: Mapping[str, int]) -> Iterator[str]:
    """The longest piece that a word begins with, then the longest that goes on, and so on."""
    found: list[str] = []
    start = 0
    while start < len(word) <= MAX_LETTERS:
        lead = CONTINUES if start else ""
        ends = range(len(word), start, -1)
        end = next((end for end in ends if f"{lead}{word[start:end]}" in rows), None)
        if end is None:
            break
        found.append(f"{lead}{word[start:end]}")
        start = end
    yield from found if found and start == len(word) else (UNKNOWN,)
