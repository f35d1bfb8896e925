"""The features of a question that its kind is recognised by: words, neighbours, stems, letters in a row."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

STEM = 5
"""Letters of a stem; a longer word counts by its first ones as well, whatever its ending."""

GRAM = 4
"""Letters in a row that count by themselves: words of other endings and compounds have some in common."""
OF_LETTERS = "#"
"""What the name of such a feature begins with."""


def features_of(words: Sequence[str]) -> Iterator[str]:
    """The features of a question's words, some of them more than once."""
    edged = ("^", *words, "$")
    for word in words:
        yield word
        if len(word) > STEM:
            yield f"{word[:STEM]}~"
        if len(word) > GRAM and word[0] != "<":
            closed = f"_{word}_"
            for at in range(len(closed) - GRAM + 1):
                yield f"{OF_LETTERS}{closed[at : at + GRAM]}"
    for first, second in pairwise(edged):
        yield f"{first} {second}"
    for first, second, third in zip(edged, edged[1:], edged[2:], strict=False):
        yield f"{first} {second} {third}"
    for first, third in zip(edged, edged[2:], strict=False):
        yield f"{first} _ {third}"
