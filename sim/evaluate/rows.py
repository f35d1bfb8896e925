"""The figures of episodes as columns, one value an episode, and the same as bytes.

Columns of a planner (shape: episodes):

- `outcome` (uint8): the place in `sim.types.Outcome`; 1 is arrived, 2 crashed, 3 stuck;
- `ticks` (uint16), and as many of each move: `forward`, `sideways`, `diagonal`, `stay` (uint16).

Of the episodes that are followed closely (`sim.evaluate.spec.DETAILED`) as well:

- `gap_m` (float32): the least distance to something that moves, metres from body to body; NaN where nothing
  came near;
- `ttc_s` (float32): the least time to collision, seconds; NaN where nothing was on a course to collide;
- `exposed` (uint16): ticks with a time to collision of at most `sim.evaluate.closeness.TTC_S`;
- `changes` (uint16): moves that differ from the one before.

Of the roads: `solvable` (uint8): 0 proved to have no way, 1 a way is known, 2 not known; and of those
followed closely, `fewest` (uint16): ticks of the quickest way, 0 where it is not known.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from io import BytesIO
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

Columns: TypeAlias = dict[str, NDArray[Any]]
"""The columns of one planner, or of the roads, by name."""
Rows: TypeAlias = dict[str, Columns]
"""The columns of each planner by its name, and of the roads under `ROADS`."""

ROADS: Final = "roads"
ARRIVED, CRASHED, STUCK = 1, 2, 3
NO_WAY, WAY, UNKNOWN = 0, 1, 2
_BETWEEN: Final = "/"


def pack(rows: Mapping[str, Columns]) -> bytes:
    """The columns as bytes, the same for the same columns."""
    buffer = BytesIO()
    arrays = {
        f"{of}{_BETWEEN}{name}": column for of, columns in rows.items() for name, column in columns.items()
    }
    for name, array in sorted(arrays.items()):
        title = f"{name}:{array.dtype.str}:{array.size}\n".encode()
        buffer.write(title)
        buffer.write(np.ascontiguousarray(array).tobytes())
    return zlib.compress(buffer.getvalue(), 1)


def unpack(body: bytes) -> Rows:
    """The columns of bytes that `pack` made. Raises `ValueError` for others."""
    try:
        data = zlib.decompress(body)
    except zlib.error as error:
        raise ValueError("not the figures of episodes") from error
    rows: Rows = {}
    at = 0
    while at < len(data):
        end = data.index(b"\n", at)
        title, kind, size = data[at:end].decode().rsplit(":", 2)
        dtype = np.dtype(kind)
        stop = end + 1 + int(size) * dtype.itemsize
        of, _, name = title.partition(_BETWEEN)
        rows.setdefault(of, {})[name] = np.frombuffer(data[end + 1 : stop], dtype)
        at = stop
    return rows


def join(parts: Sequence[Rows]) -> Rows:
    """The columns of parts in their order as one; later parts may lack columns that the first has."""
    joined: Rows = {}
    for of in parts[0]:
        names = parts[0][of]
        joined[of] = {
            name: np.concatenate([part[of][name] for part in parts if name in part[of]]) for name in names
        }
    return joined
