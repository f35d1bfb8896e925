"""A configuration that exists is valid; one that cannot be names every bad field."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.config import _SWITCHES as SWITCHES
from sim.config import CHOICES, LISTS, RANGES, Config, ConfigError

WHOLE = ["columns", "visible_rows", "rows", "potholes", "vehicles", "barriers", "pedestrians", "seed"]
COUNTS = ["potholes", "vehicles", "barriers", "pedestrians"]
WIDE = {"columns": 64, "rows": 512}
"""A road with room for whatever the limits allow."""


def problems(**parts: Any) -> dict[str, str]:
    with pytest.raises(ConfigError) as refused:
        Config(**parts)
    told = {problem.field: str(problem) for problem in refused.value.problems}
    assert len(told) == len(refused.value.problems), "one problem a field"
    assert all(f"{field}: {message}" in str(refused.value) for field, message in told.items())
    return told


def test_the_defaults_are_the_source_s_table_and_the_rules_of_version_3() -> None:
    config = Config()
    assert (config.columns, config.visible_rows, config.rows) == (8, 8, 30)
    assert (config.cell_m, config.step_seconds) == (5.0, 0.5)
    assert (config.spawn_probability, config.pothole_probability) == (0.68, 0.15)
    assert (config.potholes, config.vehicles) == (None, None)
    assert (config.sensor, config.courtesy) == ("perfect", 0.0)
    assert (config.planner, config.collision) == ("rules", "swept")
    assert (config.attentive, config.repetition, config.rules) == (1.0, True, 3)
    assert config.max_ticks == 300
    assert config.reset_delay_ticks == 4


def test_every_field_has_a_range_or_a_choice_and_nothing_else_has() -> None:
    assert sorted([*RANGES, *CHOICES, *LISTS, *SWITCHES, "planner", "sensor"]) == sorted(
        field.name for field in fields(Config)
    )


@pytest.mark.parametrize("name", list(RANGES))
def test_the_limits_are_inclusive(name: str) -> None:
    low, high = RANGES[name]
    step = 1 if name in WHOLE else 1e-6
    room = {} if name in WIDE else WIDE
    bare = {"vehicles": 0, "potholes": 0} if name in ("columns", "rows", *COUNTS) else {}
    for value in (low, high):
        parts: dict[str, Any] = {**room, **bare, name: value}
        assert getattr(Config(**parts), name) == value
    for value in (low - step, high + step):
        assert list(problems(**{**room, **bare, name: value})) == [name]


@pytest.mark.parametrize("name", list(RANGES))
@pytest.mark.parametrize("value", ["8", [], True, float("nan"), float("inf")])
def test_what_is_not_a_number_in_range(name: str, value: object) -> None:
    assert list(problems(**{name: value})) == [name]


@pytest.mark.parametrize("name", WHOLE)
def test_whole_numbers_are_whole(name: str) -> None:
    assert "whole" in problems(**{name: 4.5})[name]


@pytest.mark.parametrize("name", [name for name in RANGES if name not in ("potholes", "vehicles")])
def test_a_number_must_be_given(name: str) -> None:
    assert list(problems(**{name: None})) == [name]


@pytest.mark.parametrize(("name", "choices"), list(CHOICES.items()))
def test_words_are_among_those_known(name: str, choices: tuple[str, ...]) -> None:
    for choice in choices:
        parts: dict[str, Any] = {name: choice}
        assert getattr(Config(**parts), name) == choice
    for wrong in ("", "elsewhere", 3):
        message = problems(**{name: wrong})[name]
        assert all(choice in message for choice in choices)


@given(st.sets(st.sampled_from(sorted(RANGES)), min_size=1), st.sets(st.sampled_from(sorted(CHOICES))))
def test_every_bad_field_is_named(numbers: set[str], words: set[str]) -> None:
    told = problems(**dict.fromkeys(numbers, -1), **dict.fromkeys(words, "elsewhere"))
    assert set(told) == numbers | words


def test_the_road_must_hold_what_is_asked_for() -> None:
    assert Config(potholes=224, vehicles=0).potholes == 224
    assert list(problems(potholes=225, vehicles=0)) == ["potholes"]
    assert list(problems(potholes=300)) == ["potholes"]
    assert "224" in problems(barriers=300, vehicles=0, potholes=0)["barriers"]
    # Each of 28 rows may have a vehicle drawn.
    assert Config(potholes=196).vehicles is None
    assert list(problems(potholes=197)) == ["potholes"]
    # The largest of several is named.
    assert list(problems(vehicles=100, pedestrians=20, barriers=130, potholes=0)) == ["barriers"]


def test_the_smallest_road_can_be_drawn() -> None:
    assert Config(columns=3, rows=4).geometry.between.bit_count() == 6


def test_changing_parts() -> None:
    config = Config(seed=4).with_parts(rows=20, planner="priority")
    assert (config.seed, config.rows, config.max_ticks) == (4, 20, 200)
    with pytest.raises(ConfigError) as refused:
        config.with_parts(rows=20, lanes=3, wheels=4)
    assert [problem.field for problem in refused.value.problems] == ["lanes", "wheels"]
    with pytest.raises(ConfigError):
        config.with_parts(rows=1)


@pytest.mark.parametrize(
    ("delay_s", "step_s", "ticks"),
    [(2.0, 0.5, 4), (2.1, 0.5, 5), (0.0, 0.5, 1), (0.3, 0.1, 3), (1.0, 10.0, 1)],
)
def test_a_result_stands_for_whole_ticks(delay_s: float, step_s: float, ticks: int) -> None:
    assert Config(reset_delay_s=delay_s, step_seconds=step_s).reset_delay_ticks == ticks


def test_a_configuration_needs_no_planner_to_be_loaded() -> None:
    code = (
        "from sim.config import Config; Config(planner='astar'); import sys; "
        "assert 'sim.plan' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
