"""The kinds of contact as a picture: each at the moment it happens, and what passes a corner untouched."""

from __future__ import annotations

from os import environ
from pathlib import Path

environ["SDL_VIDEODRIVER"] = "dummy"

import pygame

from sim.render import theme
from sim.render.motion import Pose, poses
from sim.render.sprites import av_sprite, barrier_sprite, pedestrian_sprite, pothole_sprite, vehicle_sprite
from sim.render.text import render_text
from sim.rules.collision_geometry import SIZES
from sim.types import Kind, Move
from tools.contacts import MIDDLE, Case, worlds

PX = 96
SHOWN: tuple[tuple[str, Case, float], ...] = (
    ("same cell", Case(Move.FORWARD, Kind.VEHICLE, (1, -1), -1), 1.0),
    ("swap", Case(Move.LEFT, Kind.VEHICLE, (-1, 0), 1), 1.0),
    ("diagonal, from behind", Case(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, 0), 1), 1.0),
    ("diagonal, ahead", Case(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, -1), 1), 1.0),
    ("diagonal, pedestrian", Case(Move.FORWARD_LEFT, Kind.PEDESTRIAN, (-1, 0), 1), 1.0),
    ("leaves in time", Case(Move.FORWARD, Kind.VEHICLE, (0, -1), 1), 0.5),
    ("drives away", Case(Move.FORWARD_LEFT, Kind.VEHICLE, (0, -1), 1), 0.5),
    ("beside a car", Case(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, 0), 0), 0.5),
    ("beside a pothole", Case(Move.FORWARD_LEFT, Kind.POTHOLE, (0, -1), 0), 0.5),
    ("beside a barrier", Case(Move.FORWARD_LEFT, Kind.BARRIER, (-1, 0), 0), 0.5),
)
"""names, cases, and the phases at which they are shown"""


def figure(path: Path) -> None:
    """Write the picture."""
    pygame.font.init()
    across, high = 5, 3 * PX + 40
    picture = pygame.Surface((across * (3 * PX + 12), -(-len(SHOWN) // across) * high))
    picture.fill(theme.BODY)
    for number, (name, case, phase) in enumerate(SHOWN):
        corner = (number % across * (3 * PX + 12), number // across * high)
        picture.blit(_drawn(case, phase), corner)
        picture.blit(render_text(name, 24, theme.TEXT), (corner[0] + 4, corner[1] + 3 * PX + 8))
    pygame.image.save(picture, path)


def _drawn(case: Case, phase: float) -> pygame.Surface:
    """Three by three cells around the vehicle's way."""
    top = (MIDDLE[0] - 1, MIDDLE[1] - 2 if case.move is not Move.LEFT else MIDDLE[1] - 1)
    tile = pygame.Surface((3 * PX, 3 * PX))
    tile.fill(theme.ASPHALT)
    for n in range(4):
        pygame.draw.line(tile, theme.LANE_LINE, (n * PX, 0), (n * PX, 3 * PX))
        pygame.draw.line(tile, theme.LANE_LINE, (0, n * PX), (3 * PX, n * PX))

    def at(column: float, row: float) -> tuple[int, int]:
        return round((column - top[0] + 0.5) * PX), round((row - top[1] + 0.5) * PX)

    before, after = worlds(case)
    start, seen = poses(before, after, 0.0), poses(before, after, phase)
    for first, now in zip((start.av, *start.things), (seen.av, *seen.things), strict=True):
        pygame.draw.line(tile, theme.LANE_LINE, at(first.column, first.row), at(now.column, now.row), 5)
    if seen.touch is not None:
        pygame.draw.circle(tile, theme.OUTCOMES["crash"], at(*seen.touch), PX // 5)
    for pose in (*seen.things, seen.av):
        sprite = _sprite(pose)
        tile.blit(sprite, sprite.get_rect(center=at(pose.column, pose.row)))
        size = SIZES[pose.thing.kind]
        box = pygame.Rect(0, 0, round(size.across * PX), round(size.along * PX))
        box.center = at(pose.column, pose.row)
        pygame.draw.rect(tile, theme.TEXT, box, 1)
    return tile


def _sprite(pose: Pose) -> pygame.Surface:
    match pose.thing.kind:
        case Kind.AV:
            return av_sprite(PX)
        case Kind.VEHICLE:
            return vehicle_sprite(PX, 0, pose.thing.heading or "left", disabled=False)
        case Kind.PEDESTRIAN:
            return pedestrian_sprite(PX, 0, pose.thing.heading or "left", disabled=False)
        case Kind.BARRIER:
            return barrier_sprite(PX)
        case Kind.POTHOLE:
            return pothole_sprite(PX, pose.thing.id)
