"""Compares what parts of a sentence mean together with what each of them means alone.

A frame may take several parts as one listing ("highway, night, 10 potholes"), and a part may lean on the
clause before it ("remove two cars and a bus"). Both are ways to leave words out. Where a part leaves nothing
out, being a request of its own, it must mean in company what it means alone: "explain your last decision and
stop" is a question and a request. Where a part may be either, the person is asked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from service.actions.table import verbs_where
from service.grammar.fragments import STOP, Fragment
from service.grammar.frames import Filled
from service.grammar.paths import Stretch
from service.grammar.stretches import Context, Stretches

Reading = tuple[Filled, list[dict[str, Any]]]
"""A frame, filled, and its actions."""

_MARKED = (".more", ".exact", ".post", ".fewer")
"""Ends of the concepts of amounts that say what to do with them: "two more cars", "cars: 7"."""

_QUESTIONS = verbs_where(lambda traits: traits.is_question)

_GATHERING = verbs_where(lambda traits: traits.gathers)
"""Actions that one sentence may say in several requests: "run 200 episodes and compare A* with DWA"."""


class Matcher(Protocol):
    """What finds the frame for a stretch of tokens."""

    @property
    def nominal(self) -> frozenset[str]:
        """The concepts of what requests are about; none of them alone says what to do."""

    def match(self, stretch: Stretch, *, verbless: bool | None = None) -> Reading | None:
        """The best frame, filled, and its actions; None when none fits or two fit equally well."""


class Composition:
    """What the parts of one sentence mean alone, each read once."""

    def __init__(self, matcher: Matcher, stretches: Stretches) -> None:
        self._matcher = matcher
        self._stretches = stretches
        self._known: dict[tuple[int, int, bool], Reading | None] = {}

    def verb_of_its_own(self, part: Fragment) -> Reading | None:
        """What a part means that says for itself what to do; None for one that leaves that out."""
        found = self._alone(part, verbless=False)
        if found is None or found[0].frame.leaves_out:
            return None
        nominal = self._matcher.nominal
        return found if any(edge.concept not in nominal for edge in found[0].slots) else None

    def alone(self, part: Fragment) -> Reading | None:
        """What a part means alone, with or without a verb."""
        return self._alone(part, verbless=False) or self._alone(part, verbless=True)

    def heads(self, joint: Filled, parts: Sequence[Fragment]) -> list[int]:
        """Which parts of a listing after the first are requests of their own."""
        kept = [_kept(joint, part) for part in parts]
        return [
            at
            for at, part in enumerate(parts)
            if at and not kept[at] and self.verb_of_its_own(part) is not None and not all(kept[:at])
        ]

    def swallows(self, joint: Reading, parts: Sequence[Fragment]) -> bool:
        """Whether a listing gives a part without a verb another meaning than it has alone."""
        for part in (each for each in parts if not _kept(joint[0], each)):
            own = self.alone(part)
            if own is not None and (
                asks(own[1]) != asks(joint[1]) or (_is_marked(own[0]) and not within(own[1], joint[1]))
            ):
                return True
        return False

    def differs(self, part: Fragment, leaning: Reading) -> Reading | None:
        """What a part means alone where that is another thing than what it means leaning on the one before.

        A part leans without a word for it ("remove two cars and a bus"), but not over a full stop, nor where
        it says what to do with its amount, nor where a request becomes a question by it.
        """
        own = self._alone(part, verbless=True)
        if own is None or own[1] == leaning[1]:
            return None
        apart = part.after == STOP or _is_marked(own[0]) or asks(own[1]) != asks(leaning[1])
        return own if apart else None

    def also_leans(self, part: Fragment, own: Reading, context: Context) -> Reading | None:
        """The question that a request may belong to: "why did you stop and turn left"."""
        if not (part.after == "and" and context.asks and context.verb) or asks(own[1]) or context.negated:
            return None
        leaning = self._matcher.match(self._stretches.make(part.start, part.end, context), verbless=False)
        return leaning if leaning is not None and asks(leaning[1]) else None

    def _alone(self, part: Fragment, *, verbless: bool) -> Reading | None:
        key = part.start, part.end, verbless
        if key not in self._known:
            stretch = self._stretches.make(part.start, part.end)
            self._known[key] = self._matcher.match(stretch, verbless=verbless)
        return self._known[key]


def asks(actions: Sequence[Mapping[str, Any]]) -> bool:
    """Whether one of the actions is a question."""
    return any(action["do"] in _QUESTIONS for action in actions)
    return asks(actions)


def _kept(joint: Filled, part: Fragment) -> bool:
    """Whether the frame declares that words which are a request elsewhere belong to it."""
    inside = [edge for edge in joint.slots if part.start <= edge.start and edge.end <= part.end]
    return bool(inside) and all(edge.concept in joint.frame.keeps for edge in inside)


def _is_marked(filled: Filled) -> bool:
    return any(edge.concept.startswith("thing") and edge.concept.endswith(_MARKED) for edge in filled.slots)


def within(own: Sequence[Mapping[str, Any]], joint: Sequence[Mapping[str, Any]]) -> bool:
    """Whether a listing does all that several requests do: "a highway, heavy traffic, exactly 12 cars"."""
    if not any(action["do"] in _GATHERING for action in joint):
        return False
    left = [fact for action in joint for fact in _facts(action)]
    for fact in (fact for action in own for fact in _facts(action)):
        if fact not in left:
            return False
        left.remove(fact)
    return True


def _facts(action: Mapping[str, Any]) -> list[tuple[str, object]]:
    """What an action sets, as keys and values; an action that sets nothing as it is."""
    match action["do"]:
        case do if do in _GATHERING:
            listed = ((key, each) for key, each in action.items() if key != "do")
            return [
                (key, one) for key, each in listed for one in (each if isinstance(each, list) else [each])
            ]
        case "set" | "set_count" | "add" if "where" not in action:
            key = action.get("parameter") or f"{action['kind']}s"
            return [(str(key), action.get("value", action.get("count")))]
    return [(str(action["do"]), dict(action))]
