"""A configuration out of parts that were kept, or that somebody gives, under the rules they come from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sim.config import Config
from sim.rules.versions import RULES, check_known, completed, version_of


def saved_config(parts: Mapping[str, Any]) -> Config:
    """The configuration that kept parts meant when they were kept; without a version they are of the first.

    Raises `ConfigError` or `NewerRulesError`.
    """
    check_known(version_of(parts))
    return Config().with_parts(**completed(parts))


def new_config(parts: Mapping[str, Any]) -> Config:
    """The configuration of parts that are given now: with the defaults of today, or of the version they name.

    Raises `ConfigError`.
    """
    return Config().with_parts(**completed({"rules": RULES, **parts}))


def defaults_under(rules: int) -> Config:
    """The default configuration of a version. Raises `ConfigError` for none that is known."""
    return new_config({"rules": rules})
