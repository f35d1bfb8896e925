"""Where what is seen and what is there differ: for hindsight, since no vehicle knows it of itself."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import sense
from sim.perceive import sensor_named
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing


@dataclass(frozen=True, slots=True)
class Misperception:
    """What one look got wrong. A thing seen in another cell than its own is in both."""

    phantoms: tuple[Thing, ...] = ()
    """as seen, and not there"""
    missed: tuple[Thing, ...] = ()
    """as they are, and not seen there"""

    def of(self, kind: Kind | None) -> Misperception:
        """All of it, or what is of one kind."""
        if kind is None:
            return self
        phantoms, missed = (
            tuple(thing for thing in things if thing.kind is kind) for things in (self.phantoms, self.missed)
        )
        return Misperception(phantoms, missed)


NONE = Misperception()


def misperception(state: SimState, ego: str | None = None) -> Misperception:
    """What the look of an ego (the first by default) gets wrong; nothing with a faithful sensor."""
    if sensor_named(state.config.sensor).faithful:
        return NONE
    seen = {(thing.id, thing.kind, thing.cell): thing for thing in sense(state, id=ego)[0].things()}
    there = {(thing.id, thing.kind, thing.cell): thing for thing in state.world.things()}
    return Misperception(
        tuple(thing for key, thing in seen.items() if key not in there),
        tuple(thing for key, thing in there.items() if key not in seen),
    )
