"""Pictures as files, in memory.

Encoded by Pillow: pygame's own writer of files in memory keeps every file it has written for as long as the
process lives (2.5.8 and 2.6.1), which is a megabyte a second for one who watches.
"""

from __future__ import annotations

from io import BytesIO
from typing import Any, Final

import pygame
from PIL import Image

_ENCODER_OPTIONS: Final[dict[str, dict[str, Any]]] = {
    "png": {"compress_level": 3},
    "jpeg": {"quality": 85},
    "webp": {"quality": 80, "method": 0},
}
"""By format; with as little effort as may be, since a picture of a stream is looked at for 16 ms."""


def encode_image(picture: pygame.Surface, form: str) -> bytes:
    """The bytes of a PNG, JPEG or WebP file."""
    file = BytesIO()
    pixels = pygame.image.tobytes(picture, "RGB")
    Image.frombuffer("RGB", picture.get_size(), pixels, "raw", "RGB", 0, 1).save(
        file, form.upper(), **_ENCODER_OPTIONS[form]
    )
    return file.getvalue()
