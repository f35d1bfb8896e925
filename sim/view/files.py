"""Pictures as files, in memory."""

from __future__ import annotations

from io import BytesIO

import pygame


def encoded(picture: pygame.Surface, form: str) -> bytes:
    """The bytes of a PNG or JPEG file."""
    file = BytesIO()
    pygame.image.save(picture, file, f"picture.{form}")
    return file.getvalue()
