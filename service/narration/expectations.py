"""Answers about what was expected of what was hit, and why its cell was entered."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.crash import Crashes
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.cell_entered import cell_entered
from sim.explain.expectation import Entry, Expectation, Expected, expectation

MOST_TOLD: Final = 2
"""Things that are told of."""
_BELIEVED_FREE: Final = (Entry.UNSEEN, Entry.ELSEWHERE)


class Expectations:
    """Answers to "what did the planner expect the other car to do?", "why did you go into the car?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._crashes = Crashes(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where there was no crash, that is the answer."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = expectation(timeline, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, self._crashes.not_so(error))
        naming = Naming(self._sayings, found.crash.explanation.moment, as_seen=False)
        expected = [
            Part(0 if at == 0 else 2, capital(self._expected(each, naming, found)))
            for at, each in enumerate(found.found[:MOST_TOLD])
            if each.moves or each.detected or ask.what == "expected"
        ]
        if ask.what == "expected":
            parts = [*expected, Part(1, self._entry(found, naming))]
        else:
            parts = [Part(0, self._entry(found, naming)), *expected, Part(1, self._sure(asked, found))]
        return plain(self._sayings, ask, timeline.state, within(parts)) | {"what": ask.what} | _json(found)

    def _expected(self, each: Expected, naming: Naming, found: Expectation) -> str:
        """What was expected of one thing, and what it did."""
        who = naming.thing(each.id)
        if not each.moves:
            return self._say("fixed", "seen" if each.detected else "unseen", who=who, tick=found.tick)
        did = self._say("did", each.did)
        if each.step is None:
            return self._say("nothing", who=who, tick=found.tick, did=did)
        key = "as_expected" if each.expected == each.went else "otherwise"
        step = self._say("step", each.step)
        return self._say(key, who=who, tick=found.tick, step=step, did=did)

    def _entry(self, found: Expectation, naming: Naming) -> str:
        """Why the move was made all the same."""
        decision = found.crash.explanation.decision
        entry = found.entry
        key = str(entry)
        if entry is Entry.KNEW:
            key = "knew_free" if found.free else "knew"
        return self._say(
            "entry",
            key,
            did=self._sayings.move(decision.move, "did"),
            who=naming.things([each.id for each in found.found[:MOST_TOLD]]),
            planner=self._sayings.planner(decision.planner, "id"),
            fault="" if decision.fault is None else self._sayings.fault(decision.fault),
            free=self._sayings.joined([self._sayings.move(move, "name") for move in found.free[:MOST_TOLD]]),
        )

    def _sure(self, asked: Asked, found: Expectation) -> str:
        """How likely the cell was held to be free, where that is known."""
        if found.entry not in _BELIEVED_FREE:
            return ""
        try:
            cell = cell_entered(asked.timeline, found.tick)
        except QuestionError:
            return ""
        if cell.faithful or cell.taken is None:
            return ""
        return self._say("sure", percent=self._sayings.number(100 * (1 - cell.taken), ".0f"))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("expectation", *keys, **parts)


def _json(found: Expectation) -> Json:
    return {
        "last_move": found.tick,
        "entry": found.entry,
        "expected": [
            {
                "id": each.id,
                "detected": each.detected,
                "was": list(each.was),
                "expected": None if each.expected is None else list(each.expected),
                "went": list(each.went),
            }
            for each in found.found
        ],
    }
