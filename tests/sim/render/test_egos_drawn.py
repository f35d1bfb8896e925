"""Pictures of several egos: each is drawn in its own colour, and a view is about the one it is asked of."""

from __future__ import annotations

import pygame
import pytest

from sim.config import Config
from sim.forecast import predict
from sim.render import render, theme
from sim.render.motion import poses
from sim.render.occupancy_view import draw_occupancy
from sim.render.plan_view import draw_plan, reason_of
from sim.render.schematic import draw_schematic
from sim.state import SimState
from sim.transition import step, transition
from sim.types import Kind, Mode, Move, Outcome
from tests.support.roads import road

WORLD = road(*("........",) * 20, "...A....", "...A....", *("........",) * 20, ".A......", "........")
STATE = SimState.start(Config(columns=8, rows=44, vehicles=0, potholes=0, planner="rules"), WORLD).with_ego(
    "av-1", mode=Mode.MANUAL
)
COLOURS = [theme.colour_of_ego(number) for number in range(3)]


def colours(picture: pygame.Surface) -> set[tuple[int, ...]]:
    width, height = picture.get_size()
    return {tuple(picture.get_at((x, y)))[:3] for x in range(width) for y in range(height)}


@pytest.mark.parametrize("draw", [draw_schematic, draw_occupancy])
def test_whole_roads_show_every_ego_in_its_own_cell(draw: object) -> None:
    picture = draw(STATE, (160, 880))  # type: ignore[operator]
    px = picture.get_height() // 44
    for number, cell in enumerate(WORLD.avs):
        column, row = WORLD.road.cell(cell)
        assert tuple(picture.get_at((column * px + px // 4, row * px + px // 4)))[:3] == COLOURS[number]


def test_road_view_follows_the_ego_it_is_asked_of() -> None:
    first, third = render("road", STATE, size=(400, 400)), render("road", STATE, size=(400, 400), ego="av-3")
    assert {COLOURS[0], COLOURS[1]} <= colours(first)
    assert COLOURS[2] not in colours(first)
    assert COLOURS[2] in colours(third)
    assert not {COLOURS[0], COLOURS[1]} & colours(third)


def test_plan_view_is_of_the_ego_that_decided() -> None:
    tick = step(STATE)
    second = tick.steps["av-2"]
    picture = draw_plan(STATE, second.decision, (400, 520))
    known = draw_plan(STATE, second.decision, (400, 520), forecast=predict(second.percept, 1))
    assert pygame.image.tobytes(picture, "RGB") == pygame.image.tobytes(known, "RGB")
    other = draw_plan(STATE, tick.steps["av-3"].decision, (400, 520))
    assert {COLOURS[0], COLOURS[1]} <= colours(picture)
    assert COLOURS[0] not in colours(other) or colours(other) != colours(picture)
    assert reason_of(second.decision.option(Move.FORWARD), second.decision).startswith("av-1 ")


def test_crash_between_egos_is_drawn_where_they_touch() -> None:
    crashed = transition(STATE, {"av-2": Move.FORWARD}).state
    assert crashed.world.outcome is Outcome.CRASH
    for number in (0, 1):
        seen = poses(WORLD, crashed.world, 1.0, number)
        assert seen.touch is not None
        assert seen.share < 1.0
        egos = {pose.thing.id: pose for pose in (*seen.things, seen.av) if pose.thing.kind is Kind.AV}
        one, other = egos["av-1"].box, egos["av-2"].box
        assert one[3] == pytest.approx(other[1]), "the second stops at the first's rear"
        assert seen.touch[1] == pytest.approx(one[3])
    assert render("road", crashed, before=WORLD).get_size() == render("road", STATE).get_size()
