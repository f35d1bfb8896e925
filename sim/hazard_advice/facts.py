"""The parts of an advice: the choice, the outcome of each choice, and the figures behind it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from sim.actions import Weather
from sim.codes import ADVICE, check_facts, plain_text
from sim.types import Kind


class Choice(StrEnum):
    """The choices, the one of least effort first."""

    KEEP = "keep"
    BRAKE = "brake"
    STEER = "steer"
    BRAKE_AND_STEER = "brake_and_steer"
    """both at once, sharing the friction"""


class Ending(StrEnum):
    """The outcome of a choice with every quantity at its median or mean."""

    STOPS = "stops"
    CLEARS = "clears"
    CROSSES = "crosses"
    """drives over the hazard, too slowly for harm"""
    HITS = "hits"


@dataclass(frozen=True, slots=True)
class Prospect:
    """The outcome of one choice."""

    choice: Choice
    chance: float
    """share of samples without harm: the hazard is not reached, or met too slowly for harm"""
    interval: tuple[float, float]
    """95 % confidence interval of `chance`, for the number of samples"""
    ending: Ending
    needs_m: float
    """distance (m) that this choice needs to avoid the hazard; 0 for keeping on"""
    meets_kmh: float
    """speed (km/h) at the hazard; 0 if it is not reached"""
    harm_kmh: float
    """mean over the samples of the speed (km/h) at which harm is done; 0 in samples without harm"""
    death: float = 0.0
    """of a person on foot: mean over the samples of the published risk of death at the speed of impact"""

    @property
    def sure(self) -> bool:
        """Whether the chance, in whole hundredths, is 100 %."""
        return round(self.chance, 2) == 1.0


@dataclass(frozen=True, slots=True)
class Figures:
    """The physics with every quantity at its median or mean. Units: s, m, m/s, m/s²; `_kmh` km/h."""

    speed_ms: float
    time_s: float
    """time until the hazard is reached if nothing is done"""
    reaction_s: float
    friction: float
    deceleration_ms2: float
    reaction_m: float
    braking_m: float
    stopping_m: float
    stopping_most_m: float
    """stopping distance at the 95th percentile of the samples"""
    offset_m: float
    """sideways distance that clears the hazard"""
    lateral_ms2: float
    steering_s: float
    steering_m: float
    """distance needed to steer clear, reaction included"""
    unharmed_kmh: float
    """highest speed at which the hazard does no harm"""


@dataclass(frozen=True, slots=True)
class Advice:
    """What to do about a hazard, and why."""

    hazard: Kind
    distance_m: float
    speed_kmh: float
    weather: Weather
    choice: Choice
    prospects: tuple[Prospect, ...]
    """one per choice, in the order of `Choice`"""
    figures: Figures
    samples: int

    @property
    def chosen(self) -> Prospect:
        """The outcome of the advised choice."""
        return self.prospect(self.choice)

    @property
    def confidence(self) -> float:
        """The chance of no harm if the advice is followed, in whole hundredths: no more is claimed."""
        return round(self.chosen.chance, 2)

    def prospect(self, choice: Choice) -> Prospect:
        """The outcome of a choice."""
        return next(prospect for prospect in self.prospects if prospect.choice is choice)


class NoAdviceError(ValueError):
    """The question has a value out of range, as a code and facts (`sim.codes.ADVICE`); `field` names it."""

    def __init__(self, code: str, field: str, **facts: float) -> None:
        check_facts(code, facts, ADVICE.get(code))
        super().__init__(plain_text(code, facts))
        self.code = code
        self.field = field
        self.facts = MappingProxyType(facts)
