"""Encodes pictures as files in memory, with Pillow.

pygame's own in-memory writer leaks every file it writes (2.5.8 and 2.6.1): a megabyte a second per viewer.
"""

from __future__ import annotations

from io import BytesIO
from typing import Any, Final

import pygame
from PIL import Image, ImageFile

_ENCODER_OPTIONS: Final[dict[str, dict[str, Any]]] = {
    "png": {"compress_level": 3},
    "jpeg": {"quality": 85},
    "webp": {"quality": 80, "method": 0},
}
"""Encoder options by format; fast rather than small, since a picture of a stream is shown for 16 ms."""


ImageFile.MAXBLOCK = 4_096
"""Bytes that Pillow's encoder makes in one call, in which no other thread of the process goes on: 64 kB, its
default, is a whole picture, which takes tens of milliseconds."""


def encode_image(picture: pygame.Surface, form: str) -> bytes:
    """Returns the bytes of a PNG, JPEG or WebP file."""
    file = BytesIO()
    pixels = pygame.image.tobytes(picture, "RGB")
    Image.frombuffer("RGB", picture.get_size(), pixels, "raw", "RGB", 0, 1).save(
        file, form.upper(), **_ENCODER_OPTIONS[form]
    )
    return file.getvalue()
