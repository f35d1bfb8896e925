"""Every defect of a state or a plan is listed: one bad example for each, and none for what is sound."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings

from sim.config import Config
from sim.oracle import Drivable, certify
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Move, Outcome
from sim.validation import validate_world
from sim.world import Cause, World
from tests.support.plan_defects import validate_plan
from tests.support.roads import road, run_on, worlds

SOUND = road("....", ".o#.", ".>(.", ".A..")
BIT = 1 << 15
"""An empty cell."""
with_kind = SOUND.boards.with_kind


@pytest.mark.parametrize(
    ("code", "parts"),
    [
        ("potholes_off_road", {"boards": with_kind(Kind.POTHOLE, SOUND.potholes | 1 << 99)}),
        ("movers_off_road", {"right": SOUND.right | 1 << 99}),
        ("two_headings", {"left": SOUND.left | SOUND.right}),
        (
            "pothole_and_barrier",
            {"boards": with_kind(Kind.BARRIER, SOUND.barriers | SOUND.potholes)},
        ),
        ("mover_in_barrier", {"boards": with_kind(Kind.BARRIER, SOUND.barriers | SOUND.right)}),
        (
            "pedestrian_without_heading",
            {"boards": with_kind(Kind.PEDESTRIAN, SOUND.pedestrians | BIT)},
        ),
        ("no_mover_here", {"movers": {**SOUND.movers, 15: "vehicle-1"}}),
        ("mover_without_id", {"right": SOUND.right | BIT}),
        ("no_hazard_here", {"hazards": {**SOUND.hazards, 15: "pothole-1"}}),
        ("hazard_without_id", {"boards": with_kind(Kind.POTHOLE, SOUND.potholes | BIT)}),
        ("wrong_kind", {"hazards": {5: "barrier-1", 6: "barrier-1"}}),
        ("number_not_given", {"hazards": {5: "pothole-9", 6: "barrier-1"}}),
        ("same_id", {"hazards": {5: "pothole-1", 6: "pothole-1"}}),
        ("no_vehicle", {"avs": ()}),
        ("vehicle_off_road", {"avs": (99,)}),
        ("vehicle_in_something", {"avs": (5,)}),
        ("two_vehicles", {"avs": (13, 13)}),
        ("end_without_outcome", {"ended": 0}),
        ("outcome_without_end", {"outcome": Outcome.STUCK}),
        ("crash_without_cause", {"outcome": Outcome.CRASH, "ended": 0}),
        ("cause_without_crash", {"cause": Cause("hit", Kind.POTHOLE, ("pothole-1",), (1, 1))}),
        ("not_at_goal", {"outcome": Outcome.SUCCESS, "ended": 0}),
        ("began_later", {"episode_start": 5}),
    ],
)
def test_each_defect_of_a_state_is_listed(code: str, parts: dict[str, Any]) -> None:
    assert validate_world(SOUND) == ()
    assert code in {defect.code for defect in validate_world(replace(SOUND, **parts))}


@pytest.mark.parametrize("planner", ["priority", "astar"])
def test_no_state_of_a_run_has_any(planner: str) -> None:
    state = SimState.start(Config(seed=5, potholes=25, pedestrians=3, barriers=2, planner=planner))
    for _ in range(120):
        assert validate_world(state.world) == ()
        state = step(state).state


@settings(max_examples=80)
@given(worlds())
def test_a_certified_plan_has_none(world: World) -> None:
    state = run_on(world)
    found = certify(state)
    if isinstance(found, Drivable):
        assert validate_plan(world, found.plan, state.config) == ()
        short = validate_plan(world, found.plan[:-1], state.config)
        assert "not_at_goal" in {defect.code for defect in short}


@pytest.mark.parametrize(
    ("rows", "plan", "codes"),
    [
        (("....", "....", "....", "A..."), [Move.LEFT, *[Move.FORWARD] * 3], ["off_road"]),
        (("....", ".o..", "....", ".A.."), [Move.FORWARD] * 3, ["hit_pothole"]),
        (("....", ".#..", "....", ".A.."), [Move.FORWARD] * 3, ["hit_barrier"]),
        (("....", "....", "....", ">A.."), [Move.LEFT, *[Move.FORWARD] * 3], ["swap_vehicle"]),
        (("....", "....", ">...", ".A.."), [Move.FORWARD] * 3, ["hit_vehicle"]),
        (("....", "....", "....", ".A.."), [Move.FORWARD] * 2, ["not_at_goal"]),
        (("....", "....", "....", ".A.."), [*[Move.FORWARD] * 3, Move.STAY], ["after_the_end"]),
        (("....", ".o..", ".o..", ".A.."), [Move.FORWARD] * 3, ["hit_pothole", "hit_pothole"]),
    ],
)
def test_each_defect_of_a_plan_is_listed(rows: tuple[str, ...], plan: list[Move], codes: list[str]) -> None:
    world = road(*rows)
    assert [defect.code for defect in validate_plan(world, plan, run_on(world).config)] == codes


def test_a_plan_may_be_too_long() -> None:
    world = road("....", "....", "....", ".A..")
    plan = [*[Move.STAY] * 41, *[Move.FORWARD] * 3]
    assert "too_long" in {defect.code for defect in validate_plan(world, plan, run_on(world).config)}
