"""Names in the environment that look like settings and are none: a slip in one would otherwise never show."""

from __future__ import annotations

from collections.abc import Iterable

from service.cache_files import FOLDER_VARIABLE
from service.settings import Settings
from service.suggestions import nearest

PREFIX = "roadtalk_"


def strays(environment: Iterable[str]) -> list[str]:
    """A sentence for each name that begins as settings do and is none."""
    known = [*Settings.model_fields, FOLDER_VARIABLE.lower().removeprefix(PREFIX)]
    told = []
    for name in sorted(environment):
        low = name.lower()
        part = low.removeprefix(PREFIX)
        if low == part or part in known:
            continue
        near = nearest(part, known)
        meant = f"; did you mean {(PREFIX + near).upper()}?" if near else "."
        told.append(f"{name} is no setting{meant}")
    return told
