"""An advice: what to do about a hazard ahead, and every number behind it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from service.contract import notebook_html as html
from service.contract.model import Answered, DocumentedAs, KindName, Model
from sim.actions import Weather
from sim.hazard_advice import Choice, Ending

Share = Annotated[float, Field(ge=0, le=1)]
Interval = Annotated[tuple[Share, Share], Field(description="95 % interval")]
ChoiceName = Annotated[str, DocumentedAs(Choice)]


@dataclass(frozen=True, slots=True)
class AdviceOption(Model):
    """What one choice leads to."""

    option: ChoiceName
    chance: Share
    """Probability of never reaching the hazard, or too slowly to be harmed."""
    interval: Interval
    ending: Annotated[str, DocumentedAs(Ending)]
    """With every quantity in the middle of its range."""
    needs_m: float
    """The distance in which it avoids the hazard."""
    meets_kmh: float
    """Speed at the hazard; 0: not reached."""
    harm_kmh: float
    """Mean speed at which harm is done; 0 counts where none is."""
    death: Share
    """Of a person on foot: mean published risk of death at the speed of impact; 0 for other hazards."""


@dataclass(frozen=True, slots=True)
class AdvicePhysics(Model):
    """The physics, with every quantity in the middle of its range."""

    speed_ms: float
    time_s: float
    """Until the hazard is reached if nothing is done."""
    reaction_s: float
    friction: float
    deceleration_ms2: float
    reaction_m: float
    braking_m: float
    stopping_m: float
    """Reaction and braking: v·t + v²/(2·μ·g)."""
    stopping_most_m: float
    """Enough to stop in 95 % of cases."""
    offset_m: float
    """How far to move aside."""
    lateral_ms2: float
    steering_s: float
    """To move that far aside: sqrt(2·y/a)."""
    steering_m: float
    """Driven meanwhile, reaction included."""
    unharmed_kmh: float
    """Up to this speed the hazard can be driven over."""


@dataclass(frozen=True, slots=True)
class AdviceQuantity(Model):
    """A number that the advice rests on, and its source."""

    name: str
    law: Annotated[str, DocumentedAs(Literal["lognormal", "normal", "fixed"])]
    middle: float
    """Median, or mean of a normal quantity."""
    spread: float
    """Standard deviation; of the logarithm, where lognormal."""
    unit: str
    source: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Advice(Answered):
    """What to do about a hazard ahead, how sure that is, and the physics behind it."""

    question: str
    text: str
    source: Annotated[str, DocumentedAs(Literal["typed", "grammar", "matched", "llm"])]
    hazard: KindName
    distance_m: float
    speed_kmh: float
    weather: Annotated[str, DocumentedAs(Weather)]
    recommendation: ChoiceName
    confidence: Share
    """Probability of coming away unharmed by doing so."""
    interval: Interval
    options: tuple[AdviceOption, ...]
    physics: AdvicePhysics
    parameters: tuple[AdviceQuantity, ...]
    samples: int
    seed: int

    def _repr_html_(self) -> str:
        """The advice and every choice, for notebooks."""
        rows = [(each.option, f"{each.chance:.0%}", each.ending) for each in self.options]
        return html.table(self.text, ("choice", "unharmed", "in the middle of the range"), rows)
