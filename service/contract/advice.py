"""The documented shape of an advice: what to do about a hazard ahead, and every number behind it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from service.contract.parts import Answered
from sim.actions import Weather
from sim.hazard_advice import Choice, Ending
from sim.types import Kind

Share = Annotated[float, Field(ge=0, le=1)]
Interval = Annotated[list[Share], Field(min_length=2, max_length=2, description="95 % interval")]


class AdviceOption(Answered):
    """What one choice leads to."""

    option: Choice
    chance: Share = Field(description="Of never reaching the hazard, or too slowly to be harmed.")
    interval: Interval
    ending: Ending = Field(description="With every quantity in the middle of its range.")
    needs_m: float = Field(description="The distance in which it avoids the hazard.")
    meets_kmh: float = Field(description="Speed at the hazard; 0: not reached.")
    harm_kmh: float = Field(description="Mean speed at which harm is done; 0 counts where none is.")


class AdvicePhysics(Answered):
    """The physics, with every quantity in the middle of its range."""

    speed_ms: float
    time_s: float = Field(description="Until the hazard is reached if nothing is done.")
    reaction_s: float
    friction: float
    deceleration_ms2: float
    reaction_m: float
    braking_m: float
    stopping_m: float = Field(description="Reaction and braking: v·t + v²/(2·μ·g).")
    stopping_most_m: float = Field(description="Enough to stop in 95 % of cases.")
    offset_m: float = Field(description="How far to move aside.")
    lateral_ms2: float
    steering_s: float = Field(description="To move that far aside: sqrt(2·y/a).")
    steering_m: float = Field(description="Driven meanwhile, reaction included.")
    unharmed_kmh: float = Field(description="Up to this speed the hazard can be driven over.")


class AdviceQuantity(Answered):
    """A number that the advice rests on, and where it is from."""

    name: str
    law: Literal["lognormal", "normal", "fixed"]
    middle: float = Field(description="Median, or mean of a normal quantity.")
    spread: float = Field(description="Standard deviation; of the logarithm, where lognormal.")
    unit: str
    source: str


class Advice(Answered):
    """What to do about a hazard ahead, how sure that is, and the physics behind it."""

    question: str
    text: str
    source: Literal["typed", "grammar", "llm"]
    hazard: Kind
    distance_m: float
    speed_kmh: float
    weather: Weather
    recommendation: Choice
    confidence: Share = Field(description="The chance of coming away unharmed by doing so.")
    interval: Interval
    options: list[AdviceOption]
    physics: AdvicePhysics
    parameters: list[AdviceQuantity]
    samples: int
    seed: int
