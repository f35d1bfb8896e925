"""A road from a sentence, before there is any session."""

from __future__ import annotations

from service.grammar.parse_types import Ambiguous, Refused, Understood
from service.interpreter.languages import Languages
from service.refusals import refusals
from service.sessions.availability import refusal_of
from service.window.texts import language
from sim.actions import Scenario


class NoScenarioError(ValueError):
    """The sentence describes no road that can be had; the message says why."""


def scenario_in(sentence: str, languages: Languages) -> Scenario:
    """The scenario that a sentence describes. Raises `NoScenarioError`."""
    parse = languages[language()].parse(sentence)
    match parse:
        case Understood(actions=(Scenario() as scenario,)):
            missing = refusal_of(scenario, language())
            if missing is not None:
                raise NoScenarioError(missing)
            return scenario
        case Understood():
            told = refusals(language()).said("no_road_told", text=sentence)
            raise NoScenarioError(told.removesuffix("."))
        case Ambiguous():
            raise NoScenarioError(f"{parse.question} Say one of: {'; '.join(c.text for c in parse.choices)}")
        case Refused():
            raise NoScenarioError(parse.message)
