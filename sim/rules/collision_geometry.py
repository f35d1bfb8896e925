"""How large things are, and when two of them first touch within a tick.

Bodies are boxes parallel to the lanes, their sizes in cells. Within a tick every body goes in a straight
line from the centre of one cell to the centre of another (or stays), all by the same share of their way at
the same time; so where one is, seen from another, is a straight line too, and the time of their first contact
follows from two intervals: swept boxes in relative motion (C. Ericson, *Real-Time Collision Detection*,
Morgan Kaufmann 2005, section 5.5.8). The drawing shows these boxes and no others; `tools/contacts.py`
lists every contact.

The sizes are chosen so that the half-sums of any vehicle with anything else are at most a cell together: then
what changes cells beside a vehicle that drives straight on, or stands at the inside of its diagonal, never
touches it (`clearance`).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import Final, NamedTuple

from sim.types import KINDS, Cell, Kind, Size

SIZES: Final[Mapping[Kind, Size]] = MappingProxyType({kind: spec.size for kind, spec in KINDS.items()})
"""The box of every kind (`sim.types.KINDS`)."""


class Path(NamedTuple):
    """A body's way through one tick, from one cell's centre to another's."""

    kind: Kind
    start: Cell
    end: Cell


def clearance(one: Kind, other: Kind) -> Fraction:
    """What is left of a cell beside the half-sums of two bodies, in cells; never negative for a vehicle.

    Passing a corner, the distances across and along of two centres add up to one cell. At some time both are
    less than their half-sums, which is contact, exactly if the half-sums add up to more.
    """
    a, b = SIZES[one], SIZES[other]
    return 1 - (a.across + b.across + a.along + b.along) / 2


def first_contact(one: Path, other: Path) -> Fraction | None:
    """The share of the tick's way, from 0 to 1, at which two bodies first touch; None if they never overlap.

    Exact. From that share on they overlap; sides that only meet are no contact.
    """
    enter, leave = Fraction(0), Fraction(1)
    for axis in (0, 1):
        reach = (SIZES[one.kind][axis] + SIZES[other.kind][axis]) / 2
        apart = other.start[axis] - one.start[axis]
        speed = (other.end[axis] - other.start[axis]) - (one.end[axis] - one.start[axis])
        if speed == 0:
            if abs(apart) >= reach:
                return None
            continue
        times = sorted(((-reach - apart) / speed, (reach - apart) / speed))
        enter, leave = max(enter, times[0]), min(leave, times[1])
    return enter if enter < leave else None
