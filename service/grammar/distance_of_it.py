"""Asks how far "it" is after a question about a thing: of that thing, and not of the goal.

The answers about things name each with its distance. So within one sentence the second question asks nothing
more, and in the next sentence it asks the same again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from service.actions import Ask, dump
from service.grammar.clause import Clause
from service.grammar.lattice import Lattice
from service.grammar.parse_types import Parse, Understood
from service.grammar.references import REFERS
from service.grammar.tokens import Token
from service.grammar.topic import Topic

_ONE = "one"
"""Value of the words that refer to one thing: "it"."""


def without_distance_again(
    clauses: Sequence[Clause], lattice: Lattice, tokens: Sequence[Token]
) -> list[Clause]:
    """The clauses without those that ask how far "it" is, right after one about a thing."""
    kept: list[Clause] = []
    for clause in clauses:
        asks_where = len(clause.actions) == 1 and _is_of_place(clause.actions[0]) and clause.supposes is None
        if (
            asks_where
            and kept
            and any(map(_is_of_a_thing, kept[-1].actions))
            and _ends_with_it(lattice, tokens, clause.start, clause.end)
        ):
            continue
        kept.append(clause)
    return kept


def of_the_thing(lattice: Lattice, tokens: Sequence[Token], topic: Topic, parsed: Parse) -> Parse:
    """What a sentence means after a question about a thing, where it asks by itself how far "it" is."""
    if not isinstance(parsed, Understood) or len(parsed.actions) != 1 or parsed.supposed(0) is not None:
        return parsed
    last = topic.asked[-1] if topic.asked and topic.actions == topic.asked else None
    (asked,) = parsed.actions
    if not isinstance(last, Ask) or not isinstance(asked, Ask):
        return parsed
    before, now = dump((last, asked))
    if not (_is_of_a_thing(before) and _is_of_place(now) and _ends_with_it(lattice, tokens, 0, lattice.size)):
        return parsed
    return replace(parsed, actions=(last,), supposes=(), alignment=())


def _is_of_place(action: Mapping[str, Any]) -> bool:
    return action.get("do") == "ask" and action.get("about") == "status" and not action.get("what")


def _is_of_a_thing(action: Mapping[str, Any]) -> bool:
    return action.get("do") == "ask" and action.get("kind") is not None and action.get("about") in _TOLD_OF


_TOLD_OF = frozenset(("scene", "outlook"))
"""Questions whose answers say how far a thing is."""


def _ends_with_it(lattice: Lattice, tokens: Sequence[Token], start: int, end: int) -> bool:
    """Whether the last word of some tokens is "it": in "how far is it to the goal?" it stands for nothing."""
    last = max((at for at in range(start, end) if tokens[at].text.isalnum()), default=None)
    return any(
        edge.concept == REFERS and edge.sense.value == _ONE and edge.start == last for edge in lattice.all()
    )
