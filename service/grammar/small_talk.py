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
TAUGHT = "taught"


def small_talk(lattice: Lattice) -> list[dict[str, Any]]:
    """The actions of a sentence that is only small talk, each kind once; empty for any other sentence."""
    if CHAT not in lattice.concepts:
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
            if concept not in (CHAT, FILLER, SEPARATOR) or edge.part:
                continue
            kinds = (*here[1], str(value)) if concept == CHAT else here[1]
            pieces = here[0] + 1
            known = reached[edge.end]
            if known is None or (pieces, not kinds) < (known[0], not known[1]):
                reached[edge.end] = pieces, kinds
    whole = reached[lattice.size]
    return [] if whole is None else [{"do": CHAT, "kind": kind} for kind in dict.fromkeys(whole[1])]
