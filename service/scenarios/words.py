"""Scenarios and sentences: the sentence that makes a scenario, and the scenario that a sentence makes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from service.actions import Action
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.grammar.sentences import Unsayable
from service.scenarios.file import FORMAT, VERSION, ScenarioFile
from sim.actions import Add, Copy, MoveThings, Prefer, Remove, Replace, Scenario, Set, SetCount, Swap, Trigger
from sim.config import Config
from sim.session.config_to_actions import UndescribableError, config_to_actions
from sim.session.scenario import config_of_scenario
from sim.session.settings import add_preference, change_setting

_SETUP = (Add, Remove, SetCount, MoveThings, Swap, Replace, Copy)


class NoScenarioError(ValueError):
    """A sentence that makes no scenario; the message says why, for people."""


def sentence_of(scenario: ScenarioFile, language: Language) -> str | None:
    """The sentence that makes a scenario from an ordinary road; None where the language has none.

    It is checked: read again, it makes the same scenario.
    """
    try:
        actions: tuple[Any, ...] = (
            *config_to_actions(scenario.to_config()),
            *scenario.setup,
            *scenario.rules,
        )
        if not actions:
            return None
        said = language.sentence(actions)
        again = scenario_of(said, language, scenario.name, scenario.reason, scenario.seed)
    except (UndescribableError, Unsayable, NoScenarioError):
        return None
    return said if _alike(again, scenario) else None


def scenario_of(
    text: str, language: Language, name: str, reason: str, seed: int | None = None
) -> ScenarioFile:
    """The scenario that a sentence makes. Raises `NoScenarioError`, `ConfigError` or `EditError`."""
    parsed = language.parse(text)
    if not isinstance(parsed, Understood):
        raise NoScenarioError(str(getattr(parsed, "message", "") or getattr(parsed, "question", "")))
    config, setup, rules = _sorted(parsed.actions)
    usual = asdict(Config())
    parts = {key: value for key, value in asdict(config).items() if value != usual[key]}
    said_seed, planner = parts.pop("seed", None), parts.pop("planner", None)
    if "preferences" in parts:
        parts["preferences"] = list(parts["preferences"])
    seed = said_seed if seed is None else seed
    return ScenarioFile(
        format=FORMAT,
        version=VERSION,
        name=name,
        reason=reason,
        config=parts,
        seed=0 if seed is None and setup else seed,
        planner=planner,
        setup=setup,
        rules=rules,
    )


def _sorted(actions: Sequence[Action]) -> tuple[Config, list[Any], list[Trigger]]:
    """The configuration, what is put on the road, and the rules, of actions in the order of a scenario."""
    config, setup, rules = Config(), list[Any](), list[Trigger]()
    for action in actions:
        match action:
            case Scenario() if not setup:
                config = config_of_scenario(config, action)
            case Set() if not setup:
                config = change_setting(config, action)
            case Prefer() if not setup:
                config = add_preference(config, action.preference)
            case Trigger():
                rules.append(action)
            case _ if isinstance(action, _SETUP):
                setup.append(action)
            case _:
                raise NoScenarioError(f"{action.do} is no part of a scenario, or comes too late in it.")
    return config, setup, rules


def _alike(one: ScenarioFile, other: ScenarioFile) -> bool:
    return (one.to_config(), one.setup, one.rules) == (other.to_config(), other.setup, other.rules)
