"""Frames: which concepts together make a request, whatever their order, and what it then is.

A frame needs some concepts, takes others, and nothing else: a word it has no use for keeps it from
matching, which is what makes every content word count. Values are filled into its actions by
name (`$thing.count`). A frame with a question instead of actions is an ambiguity to be asked about.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from service.grammar.lattice import Edge


@dataclass(frozen=True, slots=True)
class Ask:
    """A question for the speaker; choices are sentences, with `{slot}` for what was said."""

    question: str
    choices: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Frame:
    """One way concepts combine into actions. See `prompts/README.md` for the fields."""

    name: str
    needs: tuple[frozenset[str], ...]
    takes: frozenset[str]
    many: frozenset[str]
    says: tuple[str, ...] = ()
    actions: tuple[Mapping[str, Any], ...] = ()
    per: tuple[str, ...] = ()
    forms: frozenset[str] = frozenset()
    inherits: frozenset[str] = frozenset()
    joins: bool = False
    leaves_out: bool = False
    """Whether it says what there shall not be, and so does nothing: "but no cars"."""
    only_negated: bool = False
    """Whether it says too little to be done, and enough to be left out: "don't change the weather"."""
    verbless: bool = False
    rank: int = 0
    ask: Ask | None = None
    keeps: frozenset[str] = frozenset()
    """Concepts of parts that belong to it although they are requests elsewhere: "…, what do I do"."""
    last: bool = False
    """whether of two values of a kind the last is meant: "replace A* with Dijkstra" """
    supposes: str | None = None
    """what the request takes for granted beyond its actions: a `crash`"""
    speaker: bool = True
    """Whether the speaker may be the one to do it: "let me …", "can I …"."""
    agree: Mapping[str, str] = field(default_factory=dict)
    """Concept → the concept that must be there with it."""
    only: Mapping[str, tuple[Any, ...]] = field(default_factory=dict)
    """Concept, or concept.attribute → the values with which alone it fits."""
    drops: frozenset[str] = frozenset()
    """Concepts that it takes although its actions do not say them: with them the request is the same."""
    accepted: frozenset[str] = frozenset()
    """Every concept the frame has a use for."""


@dataclass(slots=True)
class Filled:
    """A frame with the edges that fill it, in the order said."""

    frame: Frame
    slots: list[Edge]

    def of(self, *concepts: str) -> list[Edge]:
        """The filled slots whose concept, or whose concept's first part, is one of these."""
        return [
            edge
            for edge in self.slots
            if (concept := edge.sense.concept) in concepts or concept.partition(".")[0] in concepts
        ]


class FrameError(ValueError):
    """A frame that cannot be read."""


def read_frames(data: Mapping[str, Any]) -> list[Frame]:
    """The frames of `frames.yaml` files, by descending rank; `sets` there names lists of concepts."""
    sets: dict[str, str] = data.get("sets", {})
    agree: dict[str, str] = data.get("agree", {})
    frames = [_frame(name, content, sets, agree) for name, content in data["frames"].items()]
    return sorted(frames, key=lambda frame: -frame.rank)


def _frame(name: str, data: Mapping[str, Any], sets: Mapping[str, str], agree: Mapping[str, str]) -> Frame:
    known = {"say", "needs", "takes", "do", "per", "forms", "inherits", "joins", "verbless", "rank", "ask"}
    known |= {"speaker", "leaves_out", "only_negated", "supposes", "last", "drops", "keeps", "only"}
    if odd := set(data) - known:
        raise FrameError(f"frame {name}: no such fields: {', '.join(sorted(odd))}")
    many: set[str] = set()
    groups = str(data["needs"]).split()
    needs = [frozenset(_concepts(group.replace("|", " "), sets, many)) for group in groups]
    takes = frozenset(_concepts(str(data.get("takes", "")), sets, many))
    does = data.get("do", [])
    ask = data.get("ask")
    return Frame(
        name=name,
        needs=tuple(needs),
        takes=takes,
        many=frozenset(many),
        says=tuple(data.get("say", ())),
        actions=tuple(does) if isinstance(does, list) else (does,),
        per=tuple(str(data.get("per", "")).split()),
        forms=frozenset(str(data.get("forms", "")).split()),
        inherits=frozenset(_concepts(str(data.get("inherits", "")), sets, set())),
        keeps=frozenset(_concepts(str(data.get("keeps", "")), sets, set())),
        last=bool(data.get("last", False)),
        supposes=data.get("supposes"),
        speaker=bool(data.get("speaker", True)),
        agree=agree,
        only={
            path: tuple(values) if isinstance(values, list) else (values,)
            for path, values in data.get("only", {}).items()
        },
        drops=frozenset(_concepts(str(data.get("drops", "")), sets, set())),
        leaves_out=bool(data.get("leaves_out", False)),
        only_negated=bool(data.get("only_negated", False)),
        joins=bool(data.get("joins", False)),
        verbless=bool(data.get("verbless", False)),
        rank=int(data.get("rank", 0)),
        ask=Ask(ask["question"], tuple(ask["choices"])) if ask else None,
        accepted=frozenset().union(takes, *needs),
    )


def _concepts(text: str, sets: Mapping[str, str], many: set[str]) -> Iterable[str]:
    for word in text.split():
        if word.startswith("<"):
            yield from _concepts(sets[word.strip("<>")].replace("|", " "), sets, many)
            continue
        concept = word.rstrip("*")
        if word.endswith("*"):
            many.add(concept)
        yield concept
