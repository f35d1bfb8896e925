"""The road view: what is around the vehicle, gliding between two ticks."""

from __future__ import annotations

import pygame

from sim.kinds import HAZARDS, Cell, Kind, Outcome
from sim.plan import Decision
from sim.run import Run
from sim.view import theme
from sim.view.camera import Camera, camera_on
from sim.view.ground import lay_ground
from sim.view.hud import draw_figures, draw_verdict
from sim.view.motion import between, eased
from sim.view.sprites import av_sprite, barrier_sprite, pedestrian_sprite, pothole_sprite, vehicle_sprite
from sim.world import Thing, World


def draw_road(
    run: Run,
    before: World | None,
    decision: Decision | None,
    phase: float,
    size: tuple[int, int] | None,
) -> pygame.Surface:
    """See `sim.view.render`."""
    world, share = run.world, eased(phase)
    if before is None or before.episode_start != world.episode_start:
        before = world
    av = _gliding(before.road.cell(before.av), world.road.cell(world.av), share)
    camera = camera_on(run.config, av[1], size)
    picture = pygame.Surface(camera.size)
    lay_ground(picture, camera, run.config.rows)
    was = {thing.id: thing.cell for thing in _things(before)}
    for thing in _things(world):
        column, row = _gliding(was.get(thing.id, thing.cell), thing.cell, share)
        if camera.sees(row):
            _draw_thing(picture, camera, thing, column, row)
    if decision is not None and world.outcome is Outcome.RUNNING:
        _draw_move(picture, camera, before, decision, share)
    _blit(picture, av_sprite(camera.cell_px), camera.centre(*av))
    _draw_box(picture, camera, av, theme.AV)
    draw_figures(picture, run, camera.cell_px)
    draw_verdict(picture, run, camera.cell_px)
    return picture


_SEEN: list[tuple[World, tuple[Thing, ...]]] = []
"""The two latest worlds, each with what is in it: the same two are drawn for many frames."""


def _things(world: World) -> tuple[Thing, ...]:
    """What is on the road, from the ground up."""
    for seen, things in _SEEN:
        if seen is world:
            return things
    things = tuple(sorted(world.things(), key=lambda thing: thing.kind not in HAZARDS))
    _SEEN.append((world, things))
    del _SEEN[:-2]
    return things


def _gliding(start: Cell, end: Cell, share: float) -> tuple[float, float]:
    return between(start[0], end[0], share), between(start[1], end[1], share)


def _draw_thing(picture: pygame.Surface, camera: Camera, thing: Thing, column: float, row: float) -> None:
    px, look = camera.cell_px, int(thing.id.rpartition("-")[2])
    heading = thing.heading or "left"
    match thing.kind:
        case Kind.POTHOLE:
            sprite = pothole_sprite(px, thing.id)
        case Kind.BARRIER:
            sprite = barrier_sprite(px)
        case Kind.PEDESTRIAN:
            sprite = pedestrian_sprite(px, look, heading, thing.disabled)
        case _:
            sprite = vehicle_sprite(px, look, heading, thing.disabled)
    _blit(picture, sprite, camera.centre(column, row))
    if thing.kind.moves:
        _draw_box(picture, camera, (column, row), theme.BOX)


def _draw_box(
    picture: pygame.Surface, camera: Camera, place: tuple[float, float], colour: theme.Colour
) -> None:
    """The corners of a bounding box, as a detector would draw it."""
    half, arm = int(camera.cell_px * 0.46), camera.cell_px // 8
    x, y = camera.centre(*place)
    for dx in (-1, 1):
        for dy in (-1, 1):
            corner = (x + dx * half, y + dy * half)
            pygame.draw.line(picture, colour, corner, (corner[0] - dx * arm, corner[1]))
            pygame.draw.line(picture, colour, corner, (corner[0], corner[1] - dy * arm))


def _draw_move(
    picture: pygame.Surface, camera: Camera, before: World, decision: Decision, share: float
) -> None:
    """An arrow from where the decision was taken to where it leads, fading as the way is gone."""
    columns, rows = decision.move.offset
    if (columns, rows) == (0, 0) or share >= 1.0:
        return
    column, row = before.road.cell(before.av)
    start, end = camera.centre(column, row), camera.centre(column + columns, row + rows)
    tip = camera.cell_px // 8
    room = pygame.Rect(start, (1, 1)).union(pygame.Rect(end, (1, 1))).inflate(2 * tip, 2 * tip)
    layer = pygame.Surface(room.size, pygame.SRCALPHA)
    corner = pygame.Vector2(room.topleft)
    colour = (*theme.MOVE, int(230 * (1 - share)))
    pygame.draw.line(layer, colour, start - corner, end - corner, max(3, camera.cell_px // 14))
    pygame.draw.circle(layer, colour, end - corner, tip)
    picture.blit(layer, room)


def _blit(picture: pygame.Surface, sprite: pygame.Surface, centre: tuple[int, int]) -> None:
    picture.blit(sprite, sprite.get_rect(center=centre))
