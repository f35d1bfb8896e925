"""Suggests the nearest sentences that can be said, for one that was not understood."""

from __future__ import annotations

from collections.abc import Iterable

HOW_MANY = 3
_SHARED_WEIGHT = 40.0
_LEAST = 45.0
"""Below this score a saying has nothing to do with what was said."""


class Suggestions:
    """Example sayings, each known to parse, ranked by shared concepts and by likeness of words."""

    def __init__(self, sayings: Iterable[tuple[str, frozenset[str]]]) -> None:
        self._sayings = list(sayings)

    def nearest(self, text: str, concepts: frozenset[str]) -> tuple[str, ...]:
        """Up to three sayings, nearest first; empty when nothing is near."""
        from rapidfuzz import fuzz  # needed at the first refusal, not before

        text = text.lower()[:200]
        scored = []
        for say, shared in self._sayings:
            both = len(concepts & shared)
            score = fuzz.token_set_ratio(text, say.lower()) + _SHARED_WEIGHT * both / (1 + len(shared))
            scored.append((-score, say))
        scored.sort()
        return tuple(say for score, say in scored[:HOW_MANY] if -score >= _LEAST)
