"""The formulas against what is printed in standards, and against motion summed up step by step."""

from __future__ import annotations

import pytest

from sim.actions import Weather
from sim.hazard_advice import physics
from sim.hazard_advice.parameters import GRAVITY
from tools.published_stopping import (
    GREEN_BOOK,
    HIGHWAY_CODE,
    NOON_FRICTION,
    ROSEN_SANDER_RATIOS,
    TEFFT_DEATH,
    rss_distance,
)
from tools.stopping_by_surface import SPEEDS_KMH, braking


@pytest.mark.parametrize("kmh", range(20, 131, 10))
def test_stopping_is_the_green_books_sight_distance(kmh: int) -> None:
    """AASHTO Green Book, stopping sight distance: 0.278·V·t + 0.039·V²/a, with t = 2.5 s, a = 3.4 m/s²."""
    printed = 0.278 * kmh * 2.5 + 0.039 * kmh**2 / 3.4
    assert physics.stopping_distance(kmh / 3.6, 2.5, 3.4 / GRAVITY) == pytest.approx(printed, rel=0.01)


@pytest.mark.parametrize(("kmh", "metres"), GREEN_BOOK.items())
def test_the_green_books_table_is_stopping_rounded_up(kmh: int, metres: int) -> None:
    exact = physics.stopping_distance(kmh / 3.6, 2.5, 3.4 / GRAVITY)
    assert 0 <= metres - exact < 7


@pytest.mark.parametrize("kmh", [5, 30, 50, 100, 150])
def test_stopping_is_the_distance_of_responsibility_sensitive_safety(kmh: int) -> None:
    """Before something that stands still, if the car does not speed up first."""
    ours = physics.stopping_distance(kmh / 3.6, 1.0, 0.7)
    assert rss_distance(kmh / 3.6, 1.0, 0.0, 0.7 * GRAVITY) == pytest.approx(ours)
    assert rss_distance(kmh / 3.6, 1.0, 3.5, 0.7 * GRAVITY) > ours


@pytest.mark.parametrize(("speeds", "least"), ROSEN_SANDER_RATIOS.items())
def test_the_risk_of_death_grows_as_published(speeds: tuple[int, int], least: float) -> None:
    fast, slow = (float(physics.death_risk(float(kmh))) for kmh in speeds)
    assert least < fast / slow < least + 1


@pytest.mark.parametrize(("kmh", "risk"), TEFFT_DEATH.items())
def test_the_older_american_study_has_the_same_rise_at_lower_speeds(kmh: float, risk: float) -> None:
    """Tefft's sample has heavier cars and older people: its risks are met at 10 to 22 km/h more by ours."""
    assert physics.death_risk(kmh) < risk
    assert physics.death_risk(kmh + 10) < risk < physics.death_risk(kmh + 22)


@pytest.mark.parametrize(("mph", "metres"), HIGHWAY_CODE.items())
def test_stopping_is_that_of_the_highway_code(mph: int, metres: tuple[int, int]) -> None:
    """Its distances are those of 0.67 s and a deceleration of 0.67 g, in whole metres."""
    speed = mph * 0.44704
    assert physics.braking_distance(speed, 0.67) == pytest.approx(metres[1], abs=0.8)
    assert physics.stopping_distance(speed, 0.67, 0.67) == pytest.approx(sum(metres), abs=0.8)


@pytest.mark.parametrize("weather", NOON_FRICTION)
@pytest.mark.parametrize("kmh", SPEEDS_KMH)
def test_braking_is_between_that_of_published_friction(weather: Weather, kmh: int) -> None:
    ours, shortest, longest = braking(weather, kmh)
    assert shortest < ours < longest


@pytest.mark.parametrize(("speed", "reaction", "friction"), [(3, 0.5, 0.7), (14, 1.0, 0.55), (40, 2.0, 0.22)])
def test_a_car_moved_step_by_step_stops_there(speed: float, reaction: float, friction: float) -> None:
    left, along, time, step = float(speed), 0.0, 0.0, 1e-4
    needed = physics.stopping_distance(speed, reaction, friction)
    half_way_speed = None
    while left > 0:
        if half_way_speed is None and along >= 0.8 * needed:
            half_way_speed = left
        along += left * step
        time += step
        if time > reaction:
            left -= friction * GRAVITY * step
    assert along == pytest.approx(needed, rel=1e-3)
    there = physics.speed_left(speed, reaction, friction, 0.8 * needed)
    assert half_way_speed == pytest.approx(there, rel=5e-3)


def test_before_the_reaction_nothing_is_slower_and_after_the_stop_nothing_moves() -> None:
    assert physics.speed_left(20.0, 1.0, 0.7, 19.9) == 20.0
    assert physics.speed_left(20.0, 1.0, 0.7, 1000.0) == 0.0


def test_nobody_steers_tighter_than_the_car_can_turn() -> None:
    assert physics.lateral_acceleration(1.0, 0.7, 0.6) == pytest.approx(1 / 5.5)
    assert physics.lateral_acceleration(30.0, 0.7, 0.5) == pytest.approx(0.35 * GRAVITY)
    assert physics.steering_time(2.0, 4.0) == 1.0
