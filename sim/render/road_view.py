"""Draws the road view: the surroundings of the ego, interpolated between two ticks."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin

import pygame

from sim.plan import Decision
from sim.render import theme
from sim.render.camera import Camera, camera_on
from sim.render.ground import draw_ground
from sim.render.hud import draw_figures, draw_verdict
from sim.render.intent import (
    draw_forecast,
    draw_intent,
    draw_next,
    draw_trail,
    expected_cells,
    movers,
)
from sim.render.look import PLAIN, Look
from sim.render.motion import Pose, glide_start, poses
from sim.render.sensed_marks import draw_marks, marks_of
from sim.render.sprites import av_sprite, sprite_of
from sim.render.text import render_text
from sim.render.weather import draw_weather
from sim.rules.collision_geometry import SIZES
from sim.state import SimState
from sim.types import Cell, Kind, Outcome
from sim.world import World

BOX_FROM_PX = 48
"""Bounding boxes are drawn from this cell size on (pixels)."""
LEAST_NUMBER_PX = 8
"""Smaller numbers of egos are left out, since they could not be read."""


def draw_road(
    state: SimState,
    before: World | None,
    decision: Decision | None,
    phase: float,
    size: tuple[int, int] | None,
    ego: str | None = None,
    look: Look = PLAIN,
    trail: Sequence[Cell] = (),
    coming: Decision | None = None,
) -> pygame.Surface:
    """See `sim.render.render`."""
    world, number = state.world, state.number(ego)
    start, gone = glide_start(state, before, phase, ego=ego)
    seen = poses(start, world, gone, number)
    camera = camera_on(state.config, seen.av.row, size)
    picture = pygame.Surface(camera.size)
    draw_ground(picture, camera, state.config.rows, light=look.theme == "light")
    shown = [pose for pose in seen.things if camera.sees(pose.row)]
    running = world.outcome is Outcome.RUNNING
    if seen.touch is not None:
        _draw_impact(picture, camera, seen.touch)
    if look.path:
        draw_trail(picture, camera, trail)
        if running and decision is not None and seen.share < 1.0:
            at, to = (seen.av.column, seen.av.row), seen.av.thing.cell
            draw_intent(picture, camera, at, to, decision.move, seen.share)
        elif running and coming is not None:
            draw_next(picture, camera, seen.av.thing.cell, coming.move)
    if look.forecast and running:
        draw_forecast(picture, camera, movers(shown), expected_cells(state, ego))
    for pose in shown:
        _draw_thing(picture, camera, pose, boxes=look.boxes)
    _blit(picture, av_sprite(camera.cell_px, number), camera.centre(seen.av.column, seen.av.row))
    if look.boxes:
        _draw_box(picture, camera, seen.av, theme.colour_of_ego(number))
    if len(world.avs) > 1:
        for pose in (*seen.things, seen.av):
            if pose.thing.kind is Kind.AV:
                _draw_number(picture, camera, pose)
    draw_weather(picture, state.config, camera.cell_px, world.tick, phase)
    draw_marks(picture, camera, marks_of(state, ego))
    if look.figures:
        draw_figures(picture, state, camera.cell_px, ego=ego)
        draw_verdict(picture, state, camera.cell_px)
    return picture


def _draw_thing(picture: pygame.Surface, camera: Camera, pose: Pose, *, boxes: bool) -> None:
    thing = pose.thing
    _blit(picture, sprite_of(thing, camera.cell_px), camera.centre(pose.column, pose.row))
    if boxes and thing.kind.moves:
        _draw_box(picture, camera, pose, theme.BOX)


def _draw_box(picture: pygame.Surface, camera: Camera, pose: Pose, colour: theme.Colour) -> None:
    """Draws the corners of a body's bounding box, as a detector would, if cells are large enough."""
    if camera.cell_px < BOX_FROM_PX:
        return
    across, along = (float(side) * camera.cell_px / 2 for side in SIZES[pose.thing.kind])
    x, y = camera.centre(pose.column, pose.row)
    arm = max(2, camera.cell_px // 14)
    for dx in (-1, 1):
        for dy in (-1, 1):
            corner = (x + round(dx * across), y + round(dy * along))
            pygame.draw.line(picture, colour, corner, (corner[0] - dx * arm, corner[1]))
            pygame.draw.line(picture, colour, corner, (corner[0], corner[1] - dy * arm))


def _draw_number(picture: pygame.Surface, camera: Camera, pose: Pose) -> None:
    """Draws the number of an ego beside it, where there are several and it can be read."""
    px = camera.cell_px // 4
    if px < LEAST_NUMBER_PX:
        return
    sign = render_text(pose.thing.id.rpartition("-")[2], px, theme.TEXT)
    across, along = (float(side) * camera.cell_px / 2 for side in SIZES[Kind.AV])
    x, y = camera.centre(pose.column, pose.row)
    room = sign.get_rect(midleft=(x + round(across) + px // 3, y - round(along) + px // 2))
    picture.blit(sign, room)


def _draw_impact(picture: pygame.Surface, camera: Camera, touch: tuple[float, float]) -> None:
    """Draws a burst at the first contact, under the bodies."""
    x, y = camera.centre(*touch)
    for share, colour in zip((1.0, 0.74, 0.48), theme.IMPACT, strict=True):
        points = []
        for n in range(24):
            radius = camera.cell_px * 0.5 * share * (1 - 0.12 * (n * 5 % 3) if n % 2 == 0 else 0.58)
            points.append((x + radius * cos(pi * n / 12), y + radius * sin(pi * n / 12)))
        pygame.draw.polygon(picture, colour, points)


def _blit(picture: pygame.Surface, sprite: pygame.Surface, centre: tuple[int, int]) -> None:
    picture.blit(sprite, sprite.get_rect(center=centre))
