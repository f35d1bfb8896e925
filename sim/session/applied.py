"""What an action has done to a session, in facts: the state after it, and every figure that differs."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from sim.actions import WorldAction
from sim.config import Config
from sim.events import Event
from sim.state import FIRST, SimState
from sim.types import KINDS, Cell
from sim.world import Thing


@dataclass(frozen=True, slots=True)
class Change:
    """One figure that differs: a count (`potholes`), a setting (`config.road`), `mode`, `queue`.

    Those of egos beside the first have its id before them (`av-2.mode`); the place of a moved thing has
    the thing's id (`pothole-3.cell`).
    """

    path: str
    before: Any
    after: Any


@dataclass(frozen=True, slots=True)
class Moved:
    """A thing that was put elsewhere: as it is now, and the cell it came from."""

    thing: Thing
    before: Cell


@dataclass(frozen=True, slots=True)
class Applied:
    """What an action has done."""

    action: WorldAction
    state: SimState
    changes: tuple[Change, ...] = ()
    added: tuple[Thing, ...] = ()
    removed: tuple[Thing, ...] = ()
    events: tuple[Event, ...] = ()
    moved: tuple[Moved, ...] = ()


def differences(before: SimState, after: SimState) -> tuple[Change, ...]:
    """Lists every figure that differs between two states."""
    changes = []
    if before.world.episode != after.world.episode:
        changes.append(Change("episode", before.world.episode, after.world.episode))
    counts = after.world.counts()
    for kind, count in before.world.counts().items():
        if count != counts[kind]:
            changes.append(Change(KINDS[kind].plural, count, counts[kind]))
    if before.config is not after.config:
        for field in fields(Config):
            was, now = getattr(before.config, field.name), getattr(after.config, field.name)
            if was != now:
                changes.append(Change(f"config.{field.name}", was, now))
    if before.triggers != after.triggers:
        made = (len(state.triggers.standing) for state in (before, after))
        changes.append(Change("triggers", *made))
    for was, ego in zip(before.egos.values(), after.egos.values(), strict=True):
        path = "" if ego.id == FIRST else f"{ego.id}."
        if was.mode is not ego.mode:
            changes.append(Change(f"{path}mode", was.mode, ego.mode))
        if was.queue != ego.queue:
            changes.append(Change(f"{path}queue", was.queue, ego.queue))
    return tuple(changes)


def moves_told(moved: tuple[Moved, ...]) -> tuple[Change, ...]:
    """The places of things that were moved, before and after."""
    return tuple(Change(f"{each.thing.id}.cell", each.before, each.thing.cell) for each in moved)
