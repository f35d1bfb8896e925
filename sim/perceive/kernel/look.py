"""What devices report and what bodies hide, in machine code (`sim.perceive.look`, `occlusion`)."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import fraction, on_given_arrays, scaled, word_at
from sim.perceive.kernel.bits import bit
from sim.perceive.kernel.places import (
    AVS,
    COLUMN,
    COLUMNS,
    EGO,
    EPISODE,
    HEAD,
    KEY,
    REPORT_CELL,
    REPORT_COLUMN,
    REPORT_HEADING,
    REPORT_KIND,
    REPORT_ROW,
    REPORT_THING,
    ROAD_RIGHT,
    ROW,
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
_ALL: Final = np.uint64(2**64 - 1)
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
    columns, things, row = np.uint32(numbers[COLUMNS]), numbers[THINGS], numbers[ROW]
    for thing in range(things + numbers[AVS]):
        # Divisions of short words take half the time.
        cell = np.uint32(numbers[HEAD + thing] if thing < things else numbers[HEAD + 2 * things + thing])
        there = cell // columns
        spots[thing, 0], spots[thing, 1] = row - np.int64(there), np.int64(cell - there * columns)


@on_given_arrays
def hide(numbers, tables, spots, dark, hidden):
    """Mark what the bodies on the road hide: `sim.perceive.occlusion.hidden`.

    `dark` (rows ahead; uint64), all 0: is filled with the columns that are hidden, as bits. All of `hidden`
    that is in front of the vehicle is written.
    """
    columns, row, column, things = numbers[COLUMNS], numbers[ROW], numbers[COLUMN], numbers[THINGS]
    furthest = tables.seen.shape[1] - 1
    rows = min(furthest, row) + 1
    for thing in range(things + numbers[AVS]):
        kind = numbers[HEAD + things + thing] if thing < things else AV_NUMBER
        ahead, across = spots[thing, 0], spots[thing, 1]
        if tables.halves[np.uintp(kind), 0] == 0 or ahead < 0 or ahead >= rows:
            continue
        if ahead == 0 and across == column:
            continue
        shadow = tables.shadows[np.uintp(kind), np.uintp(across - column + columns - 1), np.uintp(ahead)]
        for there in range(ahead, rows):
            first = max(shadow[np.uintp(there), 0] + column, 0)
            last = min(shadow[np.uintp(there), 1] + column, columns - 1)
            if first <= last:
                dark[np.uintp(there)] |= (_ALL >> np.uint64(63 - last)) & (_ALL << np.uint64(first))
    for there in range(rows):
        word, at = dark[there], (furthest - there) * columns
        for other in range(columns):
            hidden[np.uintp(at + other)] = np.int16(word >> np.uint64(other) & _ONE)


@on_given_arrays
def may_see(numbers, spots, hidden, in_view):
    """Write the places of the things that are not hidden, nor behind or too far for any device; how many."""
    columns, count = numbers[COLUMNS], 0
    furthest = hidden.size // columns - 1
    for thing in range(numbers[THINGS]):
        ahead, there = spots[thing, 0], spots[thing, 1]
        near = 0 <= ahead <= furthest
        at = (furthest - ahead) * columns + there if near else 0
        in_view[0, np.uintp(count)] = thing
        # Without branches, which nobody could foresee.
        count += 1 if near and hidden[np.uintp(at)] == 0 else 0
    return count


@on_given_arrays
def look(numbers, boards, tables, spots, hidden, device, in_view, seen, reports, count):
    """Write the reports of a device behind the first `count`; returns how many there are then.

    `in_view`, `seen`: what `may_see` wrote and how many.
    """
    columns, things, row, column = numbers[COLUMNS], numbers[THINGS], numbers[ROW], numbers[COLUMN]
    size = (columns * numbers[ROWS] + 7) // 8
    number, reach, wrong = tables.devices[device, 0], tables.devices[device, 1], tables.devices[device, 2]
    key = word_at(np.uint64(numbers[KEY]), numbers[EPISODE])
    key = word_at(word_at(word_at(key, numbers[TICK]), numbers[EGO]), number)
    drawn_kind, stream, detected = np.int64(-1), key, 0
    drawn, words = tables.drawn[device], in_view[1]
    for place_seen in range(seen):
        thing = in_view[0, place_seen]
        kind = numbers[np.uintp(HEAD + things + thing)]
        if kind != drawn_kind:
            drawn_kind, stream = kind, word_at(key, kind)
        word = word_at(stream, numbers[np.uintp(HEAD + 2 * things + thing)])
        ahead, there = spots[np.uintp(thing), 0], spots[np.uintp(thing), 1]
        # Beyond the reach of a device nothing is drawn.
        chance = drawn[np.uintp(kind), np.uintp(ahead), np.uintp(there - column + columns - 1)]
        reports[np.uintp(count + detected), REPORT_THING] = thing
        words[np.uintp(detected)] = np.int64(word)
        detected += 1 if np.int64(word & _LOW) < chance else 0
    first = max(0, row - reach)
    for report in range(detected):
        thing, word = reports[np.uintp(count + report), REPORT_THING], np.uint64(words[report])
        kind, cell = numbers[np.uintp(HEAD + things + thing)], numbers[np.uintp(HEAD + thing)]
        ahead, there = spots[np.uintp(thing), 0], spots[np.uintp(thing), 1]
        place = there - column + columns - 1
        share = np.int64(word >> _HALF & _SHARE) / 0x1000000
        own = row - ahead
        to_row, to_column = own, there
        for shift in range(SHIFTS):
            share -= tables.shares[device, np.uintp(ahead), np.uintp(place), shift]
            if share < 0.0:
                to_row = own - tables.shifts[device, np.uintp(ahead), np.uintp(place), shift, 0]
                to_column = there + tables.shifts[device, np.uintp(ahead), np.uintp(place), shift, 1]
                break
        outside = to_column < 0 or to_column >= columns or to_row < first or to_row > row
        if outside or (to_row == row and to_column == column):
            to_row, to_column = own, there
        heading = np.int64(0)
        if kind >= _FIXED_KINDS:
            heading = np.int64(bit(boards, ROAD_RIGHT, size, cell))
            if np.int64(word >> _TOP) < wrong:
                heading = np.int64(1) - heading
        _report(reports, count + report, kind, to_row, to_column, columns, heading, thing)
    return _alarm(numbers, tables, hidden, device, word_at(key, ALARMS), reports, count + detected)


@on_given_arrays
def _report(reports, at, kind, row, column, columns, heading, thing):
    own = reports[np.uintp(at)]
    own[REPORT_KIND], own[REPORT_CELL], own[REPORT_HEADING] = kind, row * columns + column, heading
    own[REPORT_THING], own[REPORT_ROW], own[REPORT_COLUMN] = thing, row, column


@on_given_arrays
def _alarm(numbers, tables, hidden, device, key, reports, count):
    """The false alarms of a device: at most one of each kind."""
    columns, row, column = numbers[COLUMNS], numbers[ROW], numbers[COLUMN]
    reach = tables.devices[device, 1]
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
        _report(reports, count, kind, row - ahead, there, columns, heading, -1)
        count += 1
    return count
