"""What really happens, slowly: drivers drawn one by one, their cars moved a millisecond at a time.

It shares with `sim.hazard_advice` the table of quantities and nothing else: numbers come from numpy's own
generator, distances from summing up motion. A braking car sheds speed, a steering one drifts aside, and what
counts is how fast and where it is when the hazard is reached.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sim.actions import Weather
from sim.hazard_advice import Choice
from sim.hazard_advice.parameters import (
    CLEARING,
    DISTANCE,
    FRICTION,
    HARM,
    LATERAL,
    LATERAL_RANGE,
    MARGIN_M,
    REACTION,
    SPEED,
    TURNING_RADIUS,
    WIDTH,
    Quantity,
)
from sim.types import Kind

STEP_S = 0.001
G = 9.81
STRIDE = 200
"""Steps between two looks at who is still under way."""


@dataclass(frozen=True, slots=True)
class Case:
    """A question, and what is done about it."""

    hazard: Kind
    distance_m: float
    speed_kmh: float
    weather: Weather
    choice: Choice


def unharmed(cases: Sequence[Case], seed: int, build_up_s: float = 0.0) -> np.ndarray[Any, Any]:
    """Whether each comes away unharmed, with a driver, a car and a road drawn for it.

    `build_up_s`: seconds that brakes take to their full force, which the textbook leaves out.
    """
    draw = np.random.default_rng(seed)

    def drawn(quantities: Sequence[Quantity]) -> np.ndarray[Any, Any]:
        middle = np.array([each.middle for each in quantities])
        spread = np.array([each.spread for each in quantities])
        if quantities[0].law == "lognormal":
            return draw.lognormal(np.log(middle), spread)
        return draw.normal(middle, spread)

    count = len(cases)
    weathers = [case.weather for case in cases]
    holes = np.array([case.hazard is Kind.POTHOLE for case in cases])
    distance = np.array([case.distance_m for case in cases]) * drawn([DISTANCE[each] for each in weathers])
    speed = np.array([case.speed_kmh for case in cases]) / 3.6 * drawn([SPEED] * count)
    grip = drawn([FRICTION[each] for each in weathers]) * G
    reaction = drawn([REACTION] * count)
    share = np.clip(drawn([LATERAL] * count), *LATERAL_RANGE)
    width = drawn([WIDTH[case.hazard] for case in cases])
    offset = (np.array([CLEARING[case.hazard] for case in cases]) + width) / 2 + MARGIN_M
    harm = np.where(holes, drawn([HARM] * count) / 3.6, 0.0)
    both = np.array([case.choice is Choice.BRAKE_AND_STEER for case in cases])
    brakes = np.array([case.choice is Choice.BRAKE for case in cases])
    steers = np.array([case.choice is Choice.STEER for case in cases]) | both
    sideways = np.where(steers, np.minimum(share * grip, speed**2 / TURNING_RADIUS.middle), 0.0)
    slowing = np.where(brakes, grip, np.where(both, grip * np.sqrt(1 - share**2), 0.0))

    well = np.zeros(count, dtype=bool)
    who = np.arange(count)
    along, aside, drift, time = np.zeros(count), np.zeros(count), np.zeros(count), 0.0
    under_way = np.ones(count, dtype=bool)
    while who.size:
        for _ in range(STRIDE):
            time += STEP_S
            # A step in which the driver reacts counts from the reaction on.
            acting = np.clip((time - reaction) / STEP_S, 0.0, 1.0) * STEP_S
            pressed = 1.0 if build_up_s == 0 else np.clip((time - reaction) / build_up_s, 0.0, 1.0)
            faster = speed
            speed = np.maximum(speed - slowing * pressed * acting, 0.0)
            along += np.where(under_way, (faster + speed) / 2 * STEP_S, 0.0)
            drift_before = drift
            drift = drift + sideways * acting
            aside += (drift_before + drift) / 2 * STEP_S
            there = under_way & (along >= distance)
            stopped = under_way & ~there & (speed == 0.0)
            passed = steers & (aside >= offset)
            well[who[there]] = (passed | (speed <= harm))[there]
            well[who[stopped]] = True
            under_way &= ~(there | stopped)
        left = under_way
        who, distance, speed, reaction, offset = (
            each[left] for each in (who, distance, speed, reaction, offset)
        )
        harm, steers, sideways, slowing = (each[left] for each in (harm, steers, sideways, slowing))
        along, aside, drift, under_way = (each[left] for each in (along, aside, drift, under_way))
    return well
