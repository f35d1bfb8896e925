"""Whether a text reads like sentences, and the ids in it."""

from __future__ import annotations

import re

ID = re.compile(r"\b(?:pothole|barrier|vehicle|pedestrian)-\d+\b")


def looks_like_sentences(text: str) -> bool:
    return bool(re.fullmatch(r"[A-Z].*[.]", text)) and not re.search(r"[{}]|  |\.\.|\bNone\b|\bnan\b", text)


def ids_in(value: object) -> set[str]:
    return set(ID.findall(repr(value)))
