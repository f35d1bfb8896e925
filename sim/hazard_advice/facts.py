"""What advice consists of: the choice, what each choice leads to, and the figures behind it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from sim.actions import Weather
from sim.codes import ADVICE, check_facts, plain_text
from sim.types import Kind


class Choice(StrEnum):
    """What can be done, the least effort first."""

    KEEP = "keep"
    BRAKE = "brake"
    STEER = "steer"


class Ending(StrEnum):
    """What a choice leads to when everything is in the middle of its range."""

    STOPS = "stops"
    CLEARS = "clears"
    CROSSES = "crosses"
    """over the hazard, too slowly to be harmed"""
    HITS = "hits"


@dataclass(frozen=True, slots=True)
class Prospect:
    """What one choice leads to."""

    choice: Choice
    chance: float
    """the share of samples that come away unharmed: never at the hazard, or too slow there for harm"""
    interval: tuple[float, float]
    """95 % interval of that chance, for the number of samples"""
    ending: Ending
    needs_m: float
    """the distance in which it avoids the hazard; 0 for keeping on"""
    meets_kmh: float
    """speed at the hazard, 0 where it is not reached"""
    harm_kmh: float
    """mean over the samples of the speed at which harm is done, 0 where none is"""


@dataclass(frozen=True, slots=True)
class Figures:
    """The physics, with every quantity in the middle of its range."""

    speed_ms: float
    time_s: float
    """until the hazard is reached if nothing is done"""
    reaction_s: float
    friction: float
    deceleration_ms2: float
    reaction_m: float
    braking_m: float
    stopping_m: float
    stopping_most_m: float
    """enough to stop in 95 % of the samples"""
    offset_m: float
    """how far to move aside"""
    lateral_ms2: float
    steering_s: float
    steering_m: float
    """reaction included"""
    unharmed_kmh: float
    """up to this speed the hazard can be driven over"""


@dataclass(frozen=True, slots=True)
class Advice:
    """What to do, and why."""

    hazard: Kind
    distance_m: float
    speed_kmh: float
    weather: Weather
    choice: Choice
    prospects: tuple[Prospect, ...]
    """one for each choice, in the order of `Choice`"""
    figures: Figures
    samples: int

    @property
    def chosen(self) -> Prospect:
        """What the advised choice leads to."""
        return self.prospect(self.choice)

    @property
    def confidence(self) -> float:
        """The chance of coming away unharmed by doing as advised."""
        return self.chosen.chance

    def prospect(self, choice: Choice) -> Prospect:
        """What a choice leads to."""
        return next(prospect for prospect in self.prospects if prospect.choice is choice)


class NoAdviceError(ValueError):
    """A question about no hazard at all, as a code and facts (`sim.codes.ADVICE`); `field` is the trouble."""

    def __init__(self, code: str, field: str, **facts: float) -> None:
        check_facts(code, facts, ADVICE.get(code))
        super().__init__(plain_text(code, facts))
        self.code = code
        self.field = field
        self.facts = MappingProxyType(facts)
