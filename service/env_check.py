"""Names in the environment that look like settings and are none: a slip in one would otherwise never show."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from service.settings import Settings

PREFIX = "roadtalk_"


def strays(environment: Iterable[str]) -> list[str]:
    """A sentence for each name that begins as settings do and is none."""
    known = list(Settings.model_fields)
    told = []
    for name in sorted(environment):
        low = name.lower()
        part = low.removeprefix(PREFIX)
        if low == part or part in known:
            continue
        near = get_close_matches(part, known, n=1)
        meant = f"; did you mean {(PREFIX + near[0]).upper()}?" if near else "."
        told.append(f"{name} is no setting{meant}")
    return told
