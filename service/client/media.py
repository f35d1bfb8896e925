"""Pictures and films of a road: what was answered that is no JSON, with how notebooks show it."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from pathlib import Path

from service.client.errors import UnexpectedAnswer
from service.contract import notebook_html as html

_HEADER = struct.Struct(">2sBBfQ")
"""What stands before a picture of the stream: `RT`, version, form, phase, tick."""
_FORMS = {1: "image/jpeg", 2: "image/webp"}


@dataclass(frozen=True)
class Media:
    """Bytes that can be looked at."""

    data: bytes = field(repr=False)
    media_type: str

    def save(self, path: str | Path) -> Path:
        """Write it."""
        written = Path(path)
        written.write_bytes(self.data)
        return written


@dataclass(frozen=True)
class Frame(Media):
    """A picture."""

    def _repr_html_(self) -> str:
        return html.picture(self.data, self.media_type)


@dataclass(frozen=True)
class Film(Media):
    """A stretch of ticks as a moving picture."""

    def _repr_html_(self) -> str:
        return html.film(self.data, self.media_type)


@dataclass(frozen=True)
class Picture(Frame):
    """A picture of the stream: of a tick, or of the way there (`phase`, from 0 to 1)."""

    tick: int
    phase: float


def picture(message: bytes) -> Picture:
    """A binary message of the stream. Raises `UnexpectedAnswer`."""
    if len(message) < _HEADER.size:
        raise UnexpectedAnswer("The stream sent a picture without a header.")
    magic, version, form, phase, tick = _HEADER.unpack_from(message)
    if magic != b"RT" or version != 1 or form not in _FORMS:
        raise UnexpectedAnswer("The stream sent a picture of a kind that is not known here.")
    return Picture(message[_HEADER.size :], _FORMS[form], tick, phase)
