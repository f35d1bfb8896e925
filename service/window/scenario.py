"""A road from a sentence, before there is any session."""

from __future__ import annotations

from service.grammar.parse_types import Ambiguous, Refused, Understood
from service.interpreter.languages import Languages
from service.resources import DEFAULT_LANGUAGE
from service.sessions.availability import refusal_of
from sim.actions import Scenario


class NoScenarioError(ValueError):
    """The sentence describes no road that can be had; the message says why."""


def scenario_in(sentence: str, languages: Languages) -> Scenario:
    """The scenario that a sentence describes. Raises `NoScenarioError`."""
    parse = languages[DEFAULT_LANGUAGE].parse(sentence)
    match parse:
        case Understood(actions=(Scenario() as scenario,)):
            missing = refusal_of(scenario)
            if missing is not None:
                raise NoScenarioError(missing)
            return scenario
        case Understood():
            raise NoScenarioError(
                f"{sentence!r} does not describe a road; say for instance: a highway with 10 potholes"
            )
        case Ambiguous():
            raise NoScenarioError(f"{parse.question} Say one of: {'; '.join(c.text for c in parse.choices)}")
        case Refused():
            raise NoScenarioError(parse.message)
