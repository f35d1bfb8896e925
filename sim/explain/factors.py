"""What a decision may hang on beside things: preferences, and settings that are not as they are by default.

They have names like things have ids (`preference:cautious`, `setting:safety_buffer`), so that sets of
causes can hold both. Taking one away is being without the preference, or at the setting's default.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Final

from sim.actions import Prefer, Remove, Set, Where, WorldAction
from sim.config import Config
from sim.plan import traits_of
from sim.types import kind_of

PREFERENCE: Final = "preference"
SETTING: Final = "setting"
_BUFFER: Final = "safety_buffer"
_USUAL_BUFFER: Final = Config().safety_buffer


def is_factor(name: str) -> bool:
    """Whether a name is that of a preference or setting, and not a thing's id."""
    return ":" in name


def factors(config: Config) -> list[str]:
    """What a decision may hang on beside things: only planners that weigh costs ask for any of it."""
    if not traits_of(config.planner).weighs_costs:
        return []
    found = [f"{PREFERENCE}:{wish}" for wish in config.preferences]
    if config.safety_buffer != _USUAL_BUFFER:
        found.append(f"{SETTING}:{_BUFFER}")
    return found


def without(config: Config, names: Iterable[str]) -> Config:
    """The configuration without these."""
    gone = {name for name in names if is_factor(name)}
    if not gone:
        return config
    kept = tuple(wish for wish in config.preferences if f"{PREFERENCE}:{wish}" not in gone)
    changed = replace(config, preferences=kept)
    return replace(changed, safety_buffer=_USUAL_BUFFER) if f"{SETTING}:{_BUFFER}" in gone else changed


def removal(names: Iterable[str], config: Config) -> tuple[WorldAction, ...]:
    """The actions that take these away, things and factors."""
    names = tuple(names)
    actions: list[WorldAction] = [
        Remove(kind=kind_of(name).value, count=1, where=Where(id=name))
        for name in names
        if not is_factor(name)
    ]
    left = without(config, names)
    if left.preferences != config.preferences:
        actions.append(Prefer(preference="balanced"))
        actions += [Prefer(preference=wish) for wish in left.preferences]
    if left.safety_buffer != config.safety_buffer:
        actions.append(Set(parameter=_BUFFER, value=left.safety_buffer))
    return tuple(actions)
