"""Advice as JSON values: the choice, the chances of each, the physics and where its numbers are from."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from sim.hazard_advice import Advice, Prospect
from sim.hazard_advice.parameters import SEED, Quantity, parameters

Json = dict[str, Any]

_DIGITS = 4


def advice_json(advice: Advice) -> Json:
    """All that the words were made from; keys end in the unit of their number."""
    return {
        "hazard": advice.hazard,
        "distance_m": advice.distance_m,
        "speed_kmh": advice.speed_kmh,
        "weather": advice.weather,
        "recommendation": advice.choice,
        "confidence": _rounded(advice.confidence),
        "interval": [_rounded(bound) for bound in _around(advice)],
        "options": [_prospect_json(prospect) for prospect in advice.prospects],
        "physics": {name: _rounded(value) for name, value in asdict(advice.figures).items()},
        "parameters": [_quantity_json(each) for each in parameters(advice.hazard, advice.weather)],
        "samples": advice.samples,
        "seed": SEED,
    }


def _around(advice: Advice) -> tuple[float, float]:
    """The interval of the chosen chance, which holds the confidence in whole hundredths as well."""
    low, high = advice.chosen.interval
    return min(low, advice.confidence), max(high, advice.confidence)


def _prospect_json(prospect: Prospect) -> Json:
    return {
        "option": prospect.choice,
        "chance": _rounded(prospect.chance),
        "interval": [_rounded(bound) for bound in prospect.interval],
        "ending": prospect.ending,
        "needs_m": _rounded(prospect.needs_m),
        "meets_kmh": _rounded(prospect.meets_kmh),
        "harm_kmh": _rounded(prospect.harm_kmh),
        "death": _rounded(prospect.death),
    }


def _quantity_json(quantity: Quantity) -> Json:
    return {
        "name": quantity.name,
        "law": quantity.law,
        "middle": quantity.middle,
        "spread": quantity.spread,
        "unit": quantity.unit,
        "source": quantity.source,
    }


def _rounded(value: float) -> float:
    return round(float(value), _DIGITS)
