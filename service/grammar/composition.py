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
from service.grammar.fragments import AND, BUT, PAUSE, STOP, THEN, Fragment
from service.grammar.frames import Filled
from service.grammar.noun_phrases import Amount
from service.grammar.paths import Stretch
from service.grammar.stretches import Context, Stretches

Reading = tuple[Filled, list[dict[str, Any]]]
"""A frame, filled, and its actions."""

_MARKED = (".more", ".exact", ".post", ".fewer")
"""Ends of the concepts of amounts that say what to do with them: "two more cars", "cars: 7"."""

_DOING = frozenset(("dir_bare",))
"""Concepts that are a request without a verb, and a part of many others."""

_QUESTIONS = verbs_where(lambda traits: traits.is_question)

_SCENARIO = "scenario"

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
        kept = [self._belongs(joint, parts, at) for at in range(len(parts))]
        return [
            at
            for at, part in enumerate(parts)
            if at and not kept[at] and self.verb_of_its_own(part) is not None and not all(kept[:at])
        ]

    def first_question(self, joint: Reading, parts: Sequence[Fragment]) -> int | None:
        """The first part that is a question by its own words, where the listing asks nothing.

        What a frame keeps is none: "run it 100 times and give me the success rate" asks for that of the runs.
        """
        if asks(joint[1]):
            return None
        apart = [at for at in range(len(parts)) if not self._belongs(joint[0], parts, at)]
        own = ((at, self.verb_of_its_own(parts[at])) for at in apart)
        return next((at for at, found in own if found is not None and asks(found[1])), None)

    def swallows(self, joint: Reading, parts: Sequence[Fragment]) -> bool:
        """Whether a listing gives one of its parts another meaning than it has alone."""
        verbs = {action["do"] for action in joint[1]}
        for at, part in enumerate(parts):
            own = self.alone(part)
            verb = self.verb_of_its_own(part) is not None
            if own is None or (self._belongs(joint[0], parts, at) and (asks(own[1]) or not verb)):
                continue
            if at and part.after == AND and not verb and asks(joint[1]) and not asks(own[1]):
                continue  # it would be done beside a question that it belongs to
            if asks(own[1]) != asks(joint[1]) and (verb or not asks(own[1])):
                return True
            apart = at > 0 and part.after in (BUT, STOP)
            says = verb and verbs.isdisjoint(action["do"] for action in own[1])
            if part.after == STOP and at > 0 and any(action["do"] == _SCENARIO for action in own[1]):
                return True
            if (apart or says or _says_what_to_do(own[0])) and not done_by(own[1], joint[1]):
                return True
        return False

    def loses_first(self, joint: Sequence[Mapping[str, Any]], parts: Sequence[Fragment]) -> bool:
        """Whether a listing does nothing of what its first part says, which is set off from the others."""
        own = self.verb_of_its_own(parts[0])
        if own is None or parts[1].after not in ("and", STOP):
            return False
        verbs = {action["do"] for action in joint}
        return verbs.isdisjoint(action["do"] for action in own[1]) and not done_by(own[1], joint)

    def differs(self, part: Fragment, leaning: Reading) -> Reading | None:
        """What a part means alone where that is another thing than what it means leaning on the one before.

        A part leans without a word for it ("remove two cars and a bus"), but not over a full stop, nor where
        it says what to do with its amount, nor where a request becomes a question by it.
        """
        own = self._alone(part, verbless=True)
        if own is None or own[1] == leaning[1]:
            return None
        apart = part.after in (STOP, THEN) or _says_what_to_do(own[0])
        apart = apart or (asks(leaning[1]) and not asks(own[1]))
        apart = apart or (asks(own[1]) and not asks(leaning[1]) and part.after == PAUSE)
        return own if apart else None

    def also_leans(self, part: Fragment, own: Reading, context: Context) -> Reading | None:
        """The question that a request may belong to: "why did you stop and turn left"."""
        if part.after not in ("and", THEN) or not (context.asks and context.verb):
            return None
        if asks(own[1]) or context.negated or self._stretches.follows_mark(part.start):
            return None
        leaning = self._matcher.match(self._stretches.make(part.start, part.end, context), verbless=False)
        return leaning if leaning is not None and asks(leaning[1]) else None

    def _belongs(self, joint: Filled, parts: Sequence[Fragment], at: int) -> bool:
        """Whether a part has only what the frame keeps, and is set off by a comma: "at tick 12, why …".

        What is kept may hold the "and" before it itself: "run it 100 times and give me the success rate".
        """
        part = parts[at]
        if len(parts) == 1:
            return False
        said = [edge for edge in joint.slots if edge.start < part.end and edge.end > part.start]
        spans = any(edge.start < part.start for edge in said)
        if not spans and parts[max(at, 1)].after != PAUSE:
            return False
        inside = {edge.concept for edge in said}
        fillers = joint.frame.many.difference(*joint.frame.needs)
        return not inside.isdisjoint(joint.frame.keeps) and inside <= joint.frame.keeps | fillers

    def _alone(self, part: Fragment, *, verbless: bool) -> Reading | None:
        key = part.start, part.end, verbless
        if key not in self._known:
            stretch = self._stretches.make(part.start, part.end)
            self._known[key] = self._matcher.match(stretch, verbless=verbless)
        return self._known[key]


def asks(actions: Sequence[Mapping[str, Any]]) -> bool:
    """Whether one of the actions is a question."""
    return any(action["do"] in _QUESTIONS for action in actions)


def _says_what_to_do(filled: Filled) -> bool:
    """Whether something in a part without a verb says what to do: "two more cars", "straight ahead"."""
    amounts = [edge.concept for edge in filled.slots if isinstance(edge.sense.value, Amount)]
    if not amounts:
        return any(edge.concept in _DOING for edge in filled.slots)
    return any(concept.startswith("thing") and concept.endswith(_MARKED) for concept in amounts)


def within(own: Sequence[Mapping[str, Any]], joint: Sequence[Mapping[str, Any]]) -> bool:
    """Whether a listing does what several requests do: "a highway, heavy traffic, exactly 12 cars".

    The first of them must be such an action itself: to ask for two cars is not to ask for another road.
    """
    verbs = [action["do"] for action in own]
    roads = verbs.count(_SCENARIO)
    if not verbs or verbs[0] not in _GATHERING or roads > 1:
        return False
    if roads and all(action["do"] != _SCENARIO for action in joint):
        return False
    return done_by(own, joint)


def done_by(own: Sequence[Mapping[str, Any]], joint: Sequence[Mapping[str, Any]]) -> bool:
    """Whether all that some actions set is set by others."""
    left = [fact for action in joint if action["do"] in _GATHERING for fact in _facts(action)]
    for action in own:
        if action in joint:
            continue
        for fact in _facts(action):
            if fact not in left:
                return False
            left.remove(fact)
    return True


def _facts(action: Mapping[str, Any]) -> list[tuple[str, object]]:
    """What an action sets, as keys and values; an action that sets nothing as it is."""
    match action["do"]:
        case do if do in _GATHERING:
            listed = [*action.items(), *action.get("scenario", {}).items()]
            said = [(key, each) for key, each in listed if key not in ("do", "scenario")]
            return [(key, one) for key, each in said for one in (each if isinstance(each, list) else [each])]
        case "set" | "set_count" | "add" if "where" not in action:
            key = action.get("parameter") or f"{action['kind']}s"
            return [(str(key), action.get("value", action.get("count")))]
    return [(str(action["do"]), dict(action))]
