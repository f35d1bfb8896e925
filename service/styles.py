"""Driving styles by name: what `prompts/styles.yaml` holds, as actions."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, cast

from service import actions as contract
from service.resources import prompts_folder
from service.yaml_files import read_cached_yaml, read_yaml
from sim.actions import Prefer, Set

FILE = "styles.yaml"


class StyleError(ValueError):
    """A style that is none: only preferences and settings may stand in one."""


@lru_cache(maxsize=1)
def styles() -> Mapping[str, tuple[Prefer | Set, ...]]:
    """Every style by its name, in the order of the file."""
    return checked_styles(read_cached_yaml([prompts_folder() / FILE])[0])


def read_styles(path: Path) -> Mapping[str, tuple[Prefer | Set, ...]]:
    """The styles of another file. Raises `StyleError` or `pydantic.ValidationError`."""
    return checked_styles(read_yaml(path))


def checked_styles(held: Mapping[str, list[dict[str, Any]]]) -> Mapping[str, tuple[Prefer | Set, ...]]:
    """Styles as actions, each of which is a preference or a setting. Raises as `read_styles` does."""
    found = {}
    for name, values in held.items():
        actions = contract.load(values)
        if not actions or not all(isinstance(action, Prefer | Set) for action in actions):
            raise StyleError(f"the style {name!r} has something else than preferences and settings")
        found[name] = cast(tuple[Prefer | Set, ...], actions)
    return found
