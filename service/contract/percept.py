"""What an ego sees at a tick, beside what is there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from service.contract.model import Answered, Cell, DocumentedAs, KindName, Model, Tick
from sim.actions import TimeOfDay, Weather

WeatherName = Annotated[str, DocumentedAs(Weather)]
TimeOfDayName = Annotated[str, DocumentedAs(TimeOfDay)]


@dataclass(frozen=True, slots=True)
class SensedThing(Model):
    """A thing as it is seen."""

    id: str
    kind: KindName
    cell: Cell
    likelihood: float
    """How sure the sensor is that it is there, 0 to 1."""
    sensors: tuple[str, ...]
    """The devices that report it in this tick; none where it is remembered, or with another sensor."""
    real: bool
    """Whether it is there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensed(Answered):
    """What the first ego sees at a tick, and what it misses."""

    tick: Tick
    sensor: str
    weather: WeatherName
    time_of_day: TimeOfDayName
    seen: tuple[SensedThing, ...]
    missed: tuple[str, ...]
    """Ids of things that are there and not seen where they are."""
