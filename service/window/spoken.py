"""Sentences for what a key or click of the window does by itself; all others the service understands."""

from __future__ import annotations

import re
from collections.abc import Iterator

from service.window.panels import PANELS
from service.window.texts import table, text

BETWEEN = " | "
"""Between the phrases of one act."""


def spoken_act(said: str) -> tuple[str, str] | None:
    """The act that a sentence names, and the view that it is about (or nothing); None where it names none."""
    wanted = _plain(said)
    for name, view, phrase in phrases():
        if _plain(phrase) == wanted:
            return name, view
    return None


def phrases() -> Iterator[tuple[str, str, str]]:
    """Every act by name, the view that it is about, and a phrase for it."""
    others: dict[str, str] = table("called", "names")
    for name, told in table("acts").items():
        for phrase in told.split(BETWEEN):
            if "{view}" not in phrase:
                yield name, "", phrase
                continue
            for view in PANELS:
                for called in (text("views", view), text("titles", view), others.get(view)):
                    if called is not None:
                        yield name, view, phrase.format(view=called)


def _plain(said: str) -> str:
    """Without capitals, and without what is written for the eye."""
    return " ".join(re.findall(r"\w+", said.casefold()))
