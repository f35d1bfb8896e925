"""Finds any of some phrases in a text."""

from __future__ import annotations

import re
from collections.abc import Iterable

from service.grammar.patterns import expand


def any_of(patterns: Iterable[str]) -> re.Pattern[str]:
    """What matches whole words of any phrase of these patterns, the longest first, in any case of letters."""
    phrases = {words for each in patterns for words in expand(each, {})}
    longest_first = sorted(phrases, key=lambda words: (-len(words), words))
    said = "|".join(r"\s+".join(map(re.escape, words)) for words in longest_first)
    return re.compile(rf"(?<![\w'])(?:{said})(?![\w'])", re.IGNORECASE)
