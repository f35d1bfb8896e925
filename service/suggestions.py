"""The nearest known name, for "did you mean": keys, parameters, addresses, settings."""

from __future__ import annotations

from collections.abc import Iterable

MAX_CHARS = 120
"""Longer names are no typing errors."""


def nearest(name: str, known: Iterable[str], least: float = 0.6) -> str | None:
    """The known name nearest to a name, in any case of letters; None if none is alike.

    `least` is the share of letters that have to agree, 0 to 1.
    """
    from rapidfuzz import fuzz, process  # loaded with the first mistake, not at start

    if len(name) > MAX_CHARS:
        return None
    by_lower = {each.lower(): each for each in known}
    found = process.extractOne(name.lower(), by_lower.keys(), scorer=fuzz.ratio, score_cutoff=100 * least)
    return None if found is None else by_lower[found[0]]
