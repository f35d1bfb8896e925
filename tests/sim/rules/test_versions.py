"""Kept parts of a configuration mean what they meant when they were kept."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import pytest

from sim.actions import Scenario
from sim.config import Config, ConfigError
from sim.rules import versions as rules_version
from sim.rules.versions import (
    FIRST,
    LEFT,
    RULES,
    NewerRulesError,
    check_known,
    completed,
    default_under,
    held_under,
)
from sim.session.saved_config import defaults_under, new_config, saved_config
from sim.session.scenario import config_of_scenario

FIRST_DEFAULTS = {"attentive": 0.0, "collision": "cell", "planner": "priority", "repetition": False}


def test_parts_without_a_version_have_the_first_defaults() -> None:
    assert completed({"seed": 5}) == {**FIRST_DEFAULTS, "seed": 5, "rules": FIRST}


def test_what_parts_name_stays() -> None:
    named = {"planner": "bfs", "attentive": 0.5, "rules": 1}
    assert completed(named) == {**FIRST_DEFAULTS, **named}


def test_parts_of_today_are_given_nothing() -> None:
    assert completed({"seed": 5, "rules": RULES}) == {"seed": 5, "rules": RULES}


def test_the_defaults_of_a_version_are_those_that_next_were_changed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of several changes of one field, the one after that version counts."""
    monkeypatch.setattr(
        rules_version, "LEFT", {1: {"planner": "a", "rows": 1}, 2: {"planner": "b", "seed": 2}}
    )
    assert held_under(1) == {"planner": "a", "rows": 1, "seed": 2}
    assert held_under(2) == {"planner": "b", "seed": 2}
    assert held_under(3) == {}
    assert [default_under(rules, "planner", "c") for rules in (1, 2, 3)] == ["a", "b", "c"]


def test_every_older_version_has_left_defaults_that_a_configuration_can_have() -> None:
    assert sorted(LEFT) == [*range(FIRST, RULES)]
    names = {field.name for field in fields(Config)}
    for version, left in LEFT.items():
        assert set(left) <= names - {"rules"}
        made = defaults_under(version)
        assert made.rules == version
        assert {name: getattr(made, name) for name in left} == {**left}


def test_the_defaults_of_today_are_those_of_the_newest_version() -> None:
    assert defaults_under(RULES) == Config()
    assert new_config({"seed": 3}) == Config(seed=3)


@pytest.mark.parametrize("rules", [True, "1", None, 1.5])
def test_what_is_no_version_is_refused(rules: Any) -> None:
    with pytest.raises(ConfigError) as refused:
        saved_config({"rules": rules})
    assert [each.field for each in refused.value.problems] == ["rules"]


def test_a_newer_version_is_refused() -> None:
    with pytest.raises(NewerRulesError) as refused:
        saved_config({"rules": RULES + 1, "not known here": 1})
    assert (refused.value.rules, refused.value.known) == (RULES + 1, RULES)
    check_known(RULES)


@pytest.mark.parametrize("rules", [*range(FIRST, RULES + 1)])
def test_a_scenario_goes_back_to_the_defaults_of_its_version(rules: int) -> None:
    """A planner that is not named is the default one, and the rules themselves stay."""
    begun = new_config({"rules": rules, "planner": "bfs"})
    renewed = config_of_scenario(begun, Scenario(road="highway"))
    defaults = defaults_under(rules)
    assert renewed.planner == defaults.planner
    for name in ("rules", "attentive", "collision", "repetition"):
        assert getattr(renewed, name) == getattr(defaults, name)
