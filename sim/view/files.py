"""Pictures as files, in memory."""

from __future__ import annotations

from io import BytesIO

import pygame

WEBP_QUALITY = 80
WEBP_EFFORT = 0
"""The least: a picture that is looked at for 16 ms is not worth more."""


def encoded(picture: pygame.Surface, form: str) -> bytes:
    """The bytes of a PNG, JPEG or WebP file."""
    file = BytesIO()
    if form == "webp":
        from PIL import Image

        pixels = pygame.image.tobytes(picture, "RGB")
        image = Image.frombytes("RGB", picture.get_size(), pixels)
        image.save(file, "WEBP", quality=WEBP_QUALITY, method=WEBP_EFFORT)
    else:
        pygame.image.save(picture, file, f"picture.{form}")
    return file.getvalue()
