"""Builds a configuration from saved or given settings, with the defaults of their version of the rules."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sim.config import Config
from sim.rules.versions import RULES, check_known, completed, version_of


def saved_config(parts: Mapping[str, Any]) -> Config:
    """Returns the configuration that saved settings mean; settings without a version are of version 1.

    Raises `ConfigError` or `NewerRulesError`.
    """
    check_known(version_of(parts))
    return Config().with_parts(**completed(parts))


def new_config(parts: Mapping[str, Any]) -> Config:
    """Returns the configuration of settings given now, with the current defaults or those of a named version.

    Raises `ConfigError`.
    """
    return Config().with_parts(**completed({"rules": RULES, **parts}))


def defaults_under(rules: int) -> Config:
    """Returns the default configuration of a version. Raises `ConfigError` for an unknown version."""
    return new_config({"rules": rules})
