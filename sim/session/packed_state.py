"""States packed into few bytes, for those that are looked at seldom.

A session keeps hundreds of past states so that none is far away; as objects each takes about five kilobytes,
packed less than one. Packed states stay in the memory of this process: what is stored elsewhere is written by
`sim.session.serialization`. Configurations, which all states of a drive share, stay the same objects.
"""

from __future__ import annotations

import io
import pickle
import zlib
from typing import Any, Final

from sim.config import Config
from sim.state import SimState

_LEVEL: Final = 1
"""Of zlib: the next ones take longer and save little."""


class PackedState:
    """A state in few bytes."""

    __slots__ = ("_bytes", "_configs")

    def __init__(self, state: SimState) -> None:
        """Raises whatever a sensor's belief raises that cannot be packed."""
        buffer = io.BytesIO()
        packer = _Packer(buffer)
        packer.dump(state)
        self._bytes = zlib.compress(buffer.getvalue(), _LEVEL)
        self._configs = tuple(packer.configs)

    def unpack(self) -> SimState:
        """A state equal to the one that was packed, with its very configurations."""
        return _Unpacker(io.BytesIO(zlib.decompress(self._bytes)), self._configs).load()  # type: ignore[no-any-return]


class _Packer(pickle.Pickler):
    def __init__(self, file: io.BytesIO) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self.configs: list[Config] = []

    def persistent_id(self, part: Any) -> int | None:
        if type(part) is not Config:
            return None
        for number, known in enumerate(self.configs):
            if known is part:
                return number
        self.configs.append(part)
        return len(self.configs) - 1


class _Unpacker(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, configs: tuple[Config, ...]) -> None:
        super().__init__(file)
        self._configs = configs

    def persistent_load(self, number: int) -> Any:
        return self._configs[number]


def pack(state: SimState) -> PackedState | SimState:
    """The state packed, or as it is where the belief of its sensor cannot be packed."""
    try:
        return PackedState(state)
    except Exception:  # beliefs may be anything, of packages that are not known here
        return state
