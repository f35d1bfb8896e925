"""What devices report and what bodies hide, in machine code (`sim.perceive.look`, `occlusion`)."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import fraction, on_given_arrays, scaled, word_at
from sim.perceive.kernel.bits import bit
from sim.perceive.kernel.places import (
    AVS,
    COLUMNS,
    EGO,
    EPISODE,
    HEAD,
    HERE,
    KEY,
    ROAD_RIGHT,
    ROWS,
    THINGS,
    TICK,
)
from sim.perceive.kernel.tables import AV_NUMBER, KINDS_SEEN, SHIFTS
from sim.perceive.look import ALARMS
from sim.perceive.occlusion import UNIT
from sim.types import HAZARDS

_FIXED_KINDS: Final = len(HAZARDS)
_LOW: Final = np.uint64(0xFFFFFFFF)
_SHARE: Final = np.uint64(0xFFFFFF)
_HALF: Final = np.uint64(32)
_TOP: Final = np.uint64(56)
_ONE: Final = np.uint64(1)
_PLACES: Final = 4
"""Words that false alarms of a kind may draw (`sim.perceive.look`)."""


@on_given_arrays
def fill_shadows(tables, columns):
    """Fill `SuiteTables.shadows`: see `sim.perceive.occlusion.ray_meets_body`."""
    shadows, halves = tables.shadows, tables.halves
    kinds, places, rows = shadows.shape[0], shadows.shape[1], shadows.shape[2]
    for kind in range(kinds):
        half_x, half_y = halves[kind, 0], halves[kind, 1]
        for place in range(places):
            x = (place - columns + 1) * UNIT
            for ahead in range(rows):
                y = ahead * UNIT
                for row in range(rows):
                    first, last = 1, 0
                    for there in range(places):
                        if row < ahead or half_x == 0 or (there == place and row == ahead):
                            continue
                        to_x, to_y = (there - columns + 1) * UNIT, row * UNIT
                        if max(0, to_x) <= x - half_x or min(0, to_x) >= x + half_x:
                            continue
                        if max(0, to_y) <= y - half_y or min(0, to_y) >= y + half_y:
                            continue
                        if abs(to_x * y - to_y * x) >= half_x * to_y + half_y * abs(to_x):
                            continue
                        if first > last:
                            first = there - columns + 1
                        last = there - columns + 1
                    shadows[kind, place, ahead, row, 0] = first
                    shadows[kind, place, ahead, row, 1] = last


@on_given_arrays
def place_things(numbers, spots):
    """Write where things and vehicles are, in rows ahead of the vehicle and in columns."""
    columns, things = np.uint32(numbers[COLUMNS]), numbers[THINGS]
    row = np.int64(np.uint32(numbers[HERE]) // columns)
    for thing in range(things + numbers[AVS]):
        # Divisions of short words take half the time.
        cell = np.uint32(numbers[HEAD + thing] if thing < things else numbers[HEAD + 2 * things + thing])
        there = cell // columns
        spots[thing, 0], spots[thing, 1] = row - np.int64(there), np.int64(cell - there * columns)


@on_given_arrays
def hide(numbers, tables, spots, hidden):
    """Mark what the bodies on the road hide: `sim.perceive.occlusion.hidden`."""
    columns, here, things = numbers[COLUMNS], numbers[HERE], numbers[THINGS]
    row, column, furthest = here // columns, here % columns, tables.seen.shape[1] - 1
    rows = min(furthest, row) + 1
    for thing in range(things + numbers[AVS]):
        kind = numbers[HEAD + things + thing] if thing < things else AV_NUMBER
        ahead, across = spots[thing, 0], spots[thing, 1]
        if tables.halves[kind, 0] == 0 or ahead < 0 or ahead >= rows:
            continue
        if ahead == 0 and across == column:
            continue
        place = across - column + columns - 1
        for there in range(ahead, rows):
            first = max(tables.shadows[kind, place, ahead, there, 0] + column, 0)
            last = min(tables.shadows[kind, place, ahead, there, 1] + column, columns - 1)
            for other in range(first, last + 1):
                hidden[(furthest - there) * columns + other] = 1


@on_given_arrays
def look(numbers, boards, tables, spots, hidden, device, reports, count):
    """Write the reports of a device behind the first `count`; returns how many there are then."""
    columns, here, things = numbers[COLUMNS], numbers[HERE], numbers[THINGS]
    row, column = here // columns, here % columns
    size = (columns * numbers[ROWS] + 7) // 8
    number, reach, wrong = tables.devices[device, 0], tables.devices[device, 1], tables.devices[device, 2]
    key = word_at(np.uint64(numbers[KEY]), numbers[EPISODE])
    key = word_at(word_at(word_at(key, numbers[TICK]), numbers[EGO]), number)
    furthest, drawn_kind, stream = tables.seen.shape[1] - 1, np.int64(-1), key
    for thing in range(things):
        ahead, there = spots[thing, 0], spots[thing, 1]
        place = there - column + columns - 1
        if ahead < 0 or ahead > reach or hidden[(furthest - ahead) * columns + there]:
            continue
        cell, kind = numbers[HEAD + thing], numbers[HEAD + things + thing]
        chance = tables.drawn[device, kind, ahead, place]
        if chance == 0:
            continue
        if kind != drawn_kind:
            drawn_kind, stream = kind, word_at(key, kind)
        word = word_at(stream, numbers[HEAD + 2 * things + thing])
        if np.int64(word & _LOW) >= chance:
            continue
        share = np.int64(word >> _HALF & _SHARE) / 0x1000000
        own = row - ahead
        to_row, to_column = own, there
        for shift in range(SHIFTS):
            share -= tables.shares[device, ahead, place, shift]
            if share < 0.0:
                to_row = own - tables.shifts[device, ahead, place, shift, 0]
                to_column = there + tables.shifts[device, ahead, place, shift, 1]
                break
        outside = to_column < 0 or to_column >= columns or to_row < max(0, row - reach) or to_row > row
        if outside or (to_row == row and to_column == column):
            to_row, to_column = own, there
        heading = np.int64(0)
        if kind >= _FIXED_KINDS:
            heading = np.int64(bit(boards, ROAD_RIGHT, size, cell))
            if np.int64(word >> _TOP) < wrong:
                heading = np.int64(1) - heading
        count = _add(reports, count, kind, to_row * columns + to_column, heading, thing)
    return _alarm(numbers, tables, hidden, device, word_at(key, ALARMS), reports, count)


@on_given_arrays
def _add(reports, count, kind, cell, heading, thing):
    reports[count, 0], reports[count, 1] = kind, cell
    reports[count, 2], reports[count, 3] = heading, thing
    return count + 1


@on_given_arrays
def _alarm(numbers, tables, hidden, device, key, reports, count):
    """The false alarms of a device: at most one of each kind."""
    columns, here = numbers[COLUMNS], numbers[HERE]
    row, column, reach = here // columns, here % columns, tables.devices[device, 1]
    cells = (reach + 1) * columns
    for turn in range(KINDS_SEEN):
        kind = tables.alarm_order[device, turn]
        if kind < 0:
            continue
        if fraction(word_at(key, _PLACES * kind)) >= tables.alarms[device, kind] * cells:
            continue
        drawn = np.int64(scaled(word_at(key, _PLACES * kind + 1), np.uint64(cells)))
        cell = drawn + (row - reach) * columns
        ahead, there = row - cell // columns, cell % columns
        if cell < 0 or hidden[(tables.seen.shape[1] - 1 - ahead) * columns + there]:
            continue
        if not tables.seen[device, ahead, there - column + columns - 1]:
            continue
        heading = np.int64(0)
        if kind >= _FIXED_KINDS:
            heading = np.int64(word_at(key, _PLACES * kind + 2) & _ONE)
        count = _add(reports, count, kind, cell, heading, -1)
    return count
