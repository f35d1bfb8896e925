"""Ways to see one road, in compiled words: what is seen, without some things and with others.

A change is said by parts, each a set of cells where something is gone or added (`sim.search.compiled_costs`:
`Unlike`), so that the many changes of a few parts are put together here.

Array arguments, besides those of `sim.batch.one_decision`:

- `planes` (7, words; uint64): what is seen, see `HOLDING`;
- `parts` (parts, 4, words; uint64): what is otherwise, see `GONE`;
- `chosen` (any number; int64): the parts that make up one change.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.reachability import (
    ALL_FIXED,
    BRAKES,
    NOW_LEFT,
    NOW_RIGHT,
    NOW_WALKERS,
    RESTING_IN_HOLES,
    YIELDS,
)
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)

HOLDING: Final = 4
"""The plane of what holds a mover in it; the other planes stand as in what is seen (`NOW_RIGHT`)."""
GONE, GONE_FIXED, BARRIERS, POTHOLES = range(4)
"""Of a part: movers and fixed things that are not there, and barriers and potholes more."""
NOTHING: Final = np.zeros((0, 4, 1), np.uint64)
SEEN_AS_IT_IS: Final = np.zeros(0, np.int64)


@compiled
def see(seen, planes, parts, chosen):
    """Write what is seen after a change (`seen`: 7, words)."""
    for w in range(planes.shape[1]):
        gone, gone_fixed, barriers, potholes = _ZERO, _ZERO, _ZERO, _ZERO
        for part in chosen:
            gone |= parts[part, GONE, w]
            gone_fixed |= parts[part, GONE_FIXED, w]
            barriers |= parts[part, BARRIERS, w]
            potholes |= parts[part, POTHOLES, w]
        for plane in (NOW_RIGHT, NOW_LEFT, NOW_WALKERS, YIELDS, BRAKES):
            seen[plane, w] = planes[plane, w] & ~gone
        seen[ALL_FIXED, w] = planes[ALL_FIXED, w] & ~gone_fixed | barriers | potholes
        movers = seen[NOW_RIGHT, w] | seen[NOW_LEFT, w]
        seen[RESTING_IN_HOLES, w] = movers & (planes[HOLDING, w] & ~gone_fixed | potholes)
