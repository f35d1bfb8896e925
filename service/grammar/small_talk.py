"""Small talk: sentences that are nothing but manners, each answered in a line.

It is no frame: next to a request the same words are glue, and so they can neither become a part of one nor
take its place. A sentence is small talk only where its phrases, fillers and marks cover every word.
"""

from __future__ import annotations

from typing import Any

from service.grammar.lattice import Lattice
from service.grammar.paths import SEPARATOR

CHAT = "chat"
FILLER = "chat_filler"
DETAIL = "detail"
"""Concept of words that want the last answer again in some way ("shorter"); nothing else may be said."""
TAUGHT = "taught"


def small_talk(lattice: Lattice) -> list[dict[str, Any]]:
    """The actions of a sentence that is only small talk, each kind once; empty for any other sentence."""
    return [{"do": CHAT, "kind": kind} for kind in _whole(lattice, CHAT)]


def same_again(lattice: Lattice) -> list[dict[str, Any]]:
    """The question of a sentence that only wants the last answer again in some way; empty for any other."""
    ways = _whole(lattice, DETAIL)
    return [{"do": "ask", "about": DETAIL, "how": ways[0]}] if len(ways) == 1 else []


def _whole(lattice: Lattice, wanted: str) -> list[str]:
    """The values of a concept that covers a sentence, with fillers and marks; empty where it does not."""
    if wanted not in lattice.concepts:
        return []
    reached: list[tuple[int, tuple[str, ...]] | None] = [None] * (lattice.size + 1)
    reached[0] = (0, ())
    for at, starting in enumerate(lattice.edges):
        here = reached[at]
        if here is None:
            continue
        for edge in starting:
            concept, value = edge.sense.concept, edge.sense.value
            if concept == TAUGHT:
                return []
            if concept not in (wanted, FILLER, SEPARATOR) or edge.part:
                continue
            kinds = (*here[1], str(value)) if concept == wanted else here[1]
            pieces = here[0] + 1
            known = reached[edge.end]
            if known is None or (pieces, not kinds) < (known[0], not known[1]):
                reached[edge.end] = pieces, kinds
    whole = reached[lattice.size]
    return [] if whole is None else list(dict.fromkeys(whole[1]))
