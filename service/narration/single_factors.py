"""Answers about what one thing a failure hung on: "was it the sensor, the weather or the planner?"."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.single_factors import FACTORS, Factor, Replaced, SingleFactors, single_factors
from sim.types import Outcome

_ORDER: Final = (Outcome.SUCCESS, Outcome.STUCK, Outcome.CRASH, Outcome.RUNNING, None)


class SingleFactorsTold:
    """What the drive comes to with one thing replaced at a time."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. `supposes`: the one factor that is asked about, with yes or no first."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        try:
            found = single_factors(timeline)
        except QuestionError as error:
            failed = error.code != "not_failed"
            text = not_so(self._sayings, error.code, error.facts) if failed else self._say("not_failed")
            return plain(self._sayings, ask, state, text) | {"what": ask.what}
        one = next((each for each in FACTORS if each == asked.supposes), None)
        parts = [Part(0, self._head(found) if one is None else self._verdict(found, one))]
        rest = [factor for factor in FACTORS if factor != one]
        parts += [Part(0 if one is None else 1, self._line(found, factor)) for factor in rest]
        parts.append(Part(2, self._say("measure")))
        facts = [
            {"factor": each.factor, "value": each.value, "outcome": each.outcome, "ticks": each.ticks}
            for each in found.found
        ]
        return plain(self._sayings, ask, state, within(parts)) | {"what": ask.what, "driven_again": facts}

    def _verdict(self, found: SingleFactors, factor: Factor) -> str:
        """Yes or no to one of them, and how it goes without; neither where that was not found out."""
        line, helps = self._line(found, factor), found.helps(factor)
        if helps is None:
            return line
        answer = self._sayings.say("ahead", "answer", "agree" if helps else "disagree")
        return self._say("verdict", answer=answer, line=line)

    def _head(self, found: SingleFactors) -> str:
        """Which of them would have led to the goal."""
        good = [self._say("names", each) for each in FACTORS if found.helps(each)]
        if not good:
            unknown = any(found.helps(each) is None for each in FACTORS)
            return self._say("head", "unknown" if unknown else "none")
        return capital(
            self._say("head", "one" if len(good) == 1 else "many", factors=self._sayings.joined(good))
        )

    def _line(self, found: SingleFactors, factor: Factor) -> str:
        """How it goes with one of them replaced; planners that end alike are told together."""
        replaced = found.of(factor)
        if not replaced:
            return self._say("best", factor)
        alike: dict[Outcome | None, list[Replaced]] = {}
        for each in replaced:
            alike.setdefault(each.outcome, []).append(each)
        told = [
            self._say("with", ending(outcome), what=self._what(factor, alike[outcome]))
            for outcome in _ORDER
            if outcome in alike
        ]
        return capital(f"{'; '.join(told)}.")

    def _what(self, factor: Factor, alike: list[Replaced]) -> str:
        if factor != "planner":
            return self._say("replaced", factor)
        names = self._sayings.joined([self._sayings.planner(each.value, "with") for each in alike])
        return self._say("replaced", "planner", planners=names)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("single_factors", *keys, **parts)


def ending(outcome: Outcome | None) -> str:
    """The end as the sayings call it."""
    return "unknown" if outcome is None else str(outcome)
