"""A recording packed into a piece of a URL, which opens it on any service that follows the same rules."""

from __future__ import annotations

import zlib
from base64 import urlsafe_b64encode
from collections.abc import Mapping
from typing import Any, Final

from service.contract.encode.json import encoded

CARRIES: Final = "#/r/"
"""How a link begins that carries its session."""
RAW: Final = -15
"""Deflate without a header."""


def pack_recording(recording: Mapping[str, Any]) -> str:
    """The link that carries a recording."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, RAW)
    packed = deflate.compress(encoded(recording)) + deflate.flush()
    return CARRIES + urlsafe_b64encode(packed).rstrip(b"=").decode()
