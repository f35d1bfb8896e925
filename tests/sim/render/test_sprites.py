"""Sprites are as large as the boxes that are judged: they fill them, and nothing solid lies outside."""

from __future__ import annotations

import pygame
import pytest

from sim.render import sprites
from sim.rules.collision_geometry import SIZES
from sim.types import Kind
from sim.world import Thing

SOLID = 128
"""least alpha of what is no shadow"""
WIDTHS = (26, 41, 64, 90, 160)


def drawn(kind: Kind, px: int) -> list[pygame.Surface]:
    """Looks of one kind."""
    if kind.moves:
        looks = ((1, "left", False), (2, "right", False), (3, "left", True))
        things = [Thing(f"{kind}-{look}", kind, (0, 0), heading, held) for look, heading, held in looks]
    else:
        things = [Thing(f"{kind}-{number}", kind, (0, 0)) for number in range(1, 30)]
    return [sprites.sprite_of(thing, px) for thing in things]


@pytest.mark.parametrize("px", WIDTHS)
@pytest.mark.parametrize("kind", list(Kind))
def test_what_is_solid_lies_within_the_box(kind: Kind, px: int) -> None:
    across, along = (float(side) * px for side in SIZES[kind])
    for sprite in drawn(kind, px):
        assert sprite.get_size() == (px, px)
        solid = pygame.mask.from_surface(sprite, SOLID).get_bounding_rects()
        seen = solid[0].unionall(solid[1:])
        # A pixel that is half covered may stand out by half.
        assert seen.left >= px / 2 - across / 2 - 1, (seen, across)
        assert seen.right <= px / 2 + across / 2 + 1, (seen, across)
        assert seen.top >= px / 2 - along / 2 - 1, (seen, along)
        assert seen.bottom <= px / 2 + along / 2 + 1, (seen, along)


@pytest.mark.parametrize("px", WIDTHS)
@pytest.mark.parametrize("kind", [Kind.AV, Kind.VEHICLE, Kind.BARRIER])
def test_bodies_fill_their_boxes(kind: Kind, px: int) -> None:
    across, along = (float(side) * px for side in SIZES[kind])
    for sprite in drawn(kind, px):
        solid = pygame.mask.from_surface(sprite, SOLID).get_bounding_rects()
        seen = solid[0].unionall(solid[1:])
        assert seen.width >= across - 2
        assert seen.height >= along - 2


def test_vehicles_and_headings_can_be_told_apart() -> None:
    pictures = [
        sprites.av_sprite(90),
        *(
            sprites.vehicle_sprite(90, look, heading, False)
            for look in (0, 1)
            for heading in ("left", "right")
        ),
        sprites.vehicle_sprite(90, 0, "left", True),
    ]
    assert len({pygame.image.tobytes(picture, "RGBA") for picture in pictures}) == len(pictures)
