"""The weighing of looks: `sim.perceive.bayes_filter.update_layers` in machine code."""

from __future__ import annotations

from math import exp, log
from typing import Final

import numpy as np

from sim.compilation import on_given_arrays
from sim.perceive.belief import LAYERS
from sim.perceive.kernel.places import (
    COLUMN,
    COLUMNS,
    REPORT_COLUMN,
    REPORT_HEADING,
    REPORT_KIND,
    REPORT_ROW,
    ROW,
    ROWS,
)
from sim.perceive.kernel.tables import CHANCES, LAYER_OF, SHIFTS
from sim.perceive.log_odds import LIMIT, UNITS
from sim.types import HAZARDS

_FIXED_KINDS: Final = len(HAZARDS)
SOURCES: Final = 2 * SHIFTS
"""Hypotheses that may have caused one report, at most: a mover in a cell may head either way."""

_BITS: Final = 44
"""Bits that are dropped of a ratio as a machine word: exponent and 8 bits of the fraction are left."""
_FIRST: Final = int(np.float64(1.0).view(np.int64)) >> _BITS
_LAST: Final = int(np.float64(exp(2 * LIMIT / UNITS)).view(np.int64)) >> _BITS
_LOWEST: Final = np.arange(_FIRST, _LAST + 2).astype(np.int64) << _BITS
_BELOW: Final = np.ceil(UNITS * np.log(_LOWEST.view(np.float64)) - 0.5).astype(np.int16)
"""By ratio as such a word, less `_FIRST`: the logarithm of the lowest of them, in log odds, rounded."""
_BORDER: Final = np.exp((_BELOW + 0.5) / UNITS)
"""The ratio from which it is one more; steps of 2⁻⁸ make it at most one more."""
_NEAR: Final = 1e-9
"""Share of a ratio within which sums made in another order may be rounded otherwise."""


@on_given_arrays
def weigh_misses(numbers, layers, tables, hidden, device):
    """Make what was seen without a report less likely."""
    columns, row, column = numbers[COLUMNS], numbers[ROW], numbers[COLUMN]
    cells, seen = columns * numbers[ROWS], columns * (min(tables.devices[device, 1], row) + 1)
    first, covered = (row + 1) * columns - seen, hidden[hidden.size - seen :]
    for layer in range(LAYERS):
        own = layers[layer * cells + first : layer * cells + first + seen]
        less = tables.miss[device, column, layer, hidden.size - seen :]
        for cell in range(seen):
            # Where nothing can be detected, `miss` is 0. Without branches this becomes SIMD code.
            value = np.int16(own[cell] + np.int16(less[cell] * np.int16(np.int16(1) - covered[cell])))
            own[cell] = max(np.int16(-LIMIT), min(np.int16(LIMIT), value))


@on_given_arrays
def _log_odds(chance):
    """`sim.perceive.log_odds.log_odds`."""
    if chance <= CHANCES[0]:
        return -LIMIT
    if chance >= CHANCES[2 * LIMIT]:
        return LIMIT
    return np.int64(np.rint(UNITS * log(chance / (1.0 - chance))))


@on_given_arrays
def find_sources(numbers, layers, tables, hidden, device, report, sources, weights):
    """What may have caused a report: where in the layers, what is believed of each, and how likely it is.

    Returns how many there are and the weight of all, that of a false alarm included. Written to `weights`:
    the belief of each, and the odds of the report were it there instead. The weight of all is summed in
    another order than that of `sim.perceive.bayes_filter` and may differ in the last bits.
    """
    columns, row, column = numbers[COLUMNS], numbers[ROW], numbers[COLUMN]
    cells, kind, reach = columns * numbers[ROWS], report[REPORT_KIND], tables.devices[device, 1]
    to_row, to_column = report[REPORT_ROW], report[REPORT_COLUMN]
    whole, count, furthest = tables.alarm_odds[device, np.uintp(kind)], 0, tables.seen.shape[1] - 1
    ahead, place, first = row - to_row, to_column - column + columns - 1, LAYER_OF[np.uintp(kind)] * cells
    shares, shifts = (
        tables.shares[device, np.uintp(ahead), np.uintp(place)],
        tables.shifts[device, np.uintp(ahead), np.uintp(place)],
    )
    odds, moves, wrong = tables.odds[device, np.uintp(kind)], kind >= _FIXED_KINDS, tables.wrong[device]
    fits = 1.0 - wrong if report[REPORT_HEADING] == 1 else wrong
    for shift in range(SHIFTS):
        part = shares[shift]
        if part == 0.0:
            break
        rows, own_column = ahead - shifts[shift, 0], to_column - shifts[shift, 1]
        if own_column < 0 or own_column >= columns or rows < 0 or rows > reach or rows > row:
            continue
        if hidden[np.uintp((furthest - rows) * columns + own_column)]:
            continue
        # 0 where nothing is seen.
        likely = odds[np.uintp(rows), np.uintp(own_column - column + columns - 1)] * part
        if likely == 0.0:
            continue
        at = first + (row - rows) * columns + own_column
        if moves:
            missed = CHANCES[np.uintp(layers[np.uintp(at + cells)] + LIMIT)]
            other = likely * (1.0 - fits)
            whole += missed * other
            weights[0, np.uintp(count)] = missed
            weights[1, np.uintp(count)] = other
            sources[np.uintp(count)] = at + cells
            count += 1
            likely *= fits
        missed = CHANCES[np.uintp(layers[np.uintp(at)] + LIMIT)]
        whole += missed * likely
        weights[0, np.uintp(count)] = missed
        weights[1, np.uintp(count)] = likely
        sources[np.uintp(count)] = at
        count += 1
    return count, whole


@on_given_arrays
def weigh_report(numbers, layers, tables, hidden, device, report, sources, weights, ratios, words):
    """Share a report out among all that may have caused it: `sim.perceive.bayes_filter.update_layers`.

    `sources` (2, `SOURCES`; int64), `weights` (2, `SOURCES`; float64) and `ratios` (`SOURCES`; float64;
    `words`: read as int64) are scratch.

    A report makes the odds of each source larger by a ratio: one more than the odds of the report were it
    there, over the weight of all other causes. So the log odds, which are whole numbers, grow by the ratio's
    logarithm, rounded; it is read from a table of the ratios at which it is rounded otherwise. Too near to
    one of these, it is computed.
    """
    at, after = sources[0], sources[1]
    count, whole = find_sources(numbers, layers, tables, hidden, device, report, at, weights)
    for source in range(count):
        likely = weights[1, source]
        ratios[source] = 1.0 + likely / (whole - weights[0, source] * likely)
    surely = True
    for source in range(count):
        ratio, step = ratios[source], (words[source] >> _BITS) - _FIRST
        own = layers[np.uintp(at[source])]
        if step >= len(_BELOW):
            after[source] = LIMIT
        else:
            border = _BORDER[np.uintp(step)]
            surely &= abs(ratio - border) > _NEAR * border
            after[source] = min(LIMIT, own + _BELOW[np.uintp(step)] + (1 if ratio > border else 0))
    if surely:
        for source in range(count):
            layers[np.uintp(at[source])] = np.int16(after[source])
    else:
        weigh_exactly(numbers, layers, tables, hidden, device, report, at, weights)


@on_given_arrays
def weigh_exactly(numbers, layers, tables, hidden, device, report, sources, weights):
    """`weigh_report` with all that it computes in the order of `sim.perceive.bayes_filter`."""
    columns, row, column = numbers[COLUMNS], numbers[ROW], numbers[COLUMN]
    cells, kind, reach = columns * numbers[ROWS], report[REPORT_KIND], tables.devices[device, 1]
    to_row, to_column = report[REPORT_ROW], report[REPORT_COLUMN]
    wrong, alarm, hypotheses = tables.wrong[device], tables.alarms[device, kind], 1
    if kind >= _FIXED_KINDS:
        hypotheses, alarm = 2, alarm / 2
    whole, count, furthest = alarm / (1.0 - alarm), 0, tables.seen.shape[1] - 1
    ahead, place = row - to_row, to_column - column + columns - 1
    for shift in range(SHIFTS):
        part = tables.shares[device, ahead, place, shift]
        if part == 0.0:
            break
        rows = ahead - tables.shifts[device, ahead, place, shift, 0]
        own_column = to_column - tables.shifts[device, ahead, place, shift, 1]
        if own_column < 0 or own_column >= columns or rows < 0 or rows > reach or rows > row:
            continue
        if hidden[(furthest - rows) * columns + own_column]:
            continue
        chance = tables.detection[device, kind, rows, own_column - column + columns - 1]
        if chance == 0.0 or not tables.seen[device, rows, own_column - column + columns - 1]:
            continue
        for turn in range(hypotheses):
            fits = 1.0
            if hypotheses == 2:
                fits = 1.0 - wrong if (turn == 0) == (report[REPORT_HEADING] == 1) else wrong
            at = (LAYER_OF[kind] + turn) * cells + (row - rows) * columns + own_column
            missed = CHANCES[layers[at] + LIMIT]
            likely = missed * chance / (1.0 - chance) * part * fits
            whole += likely
            weights[0, count] = missed
            weights[1, count] = likely
            sources[count] = at
            count += 1
    for source in range(count):
        share = weights[1, source] / whole
        layers[sources[source]] = _log_odds(share + (1.0 - share) * weights[0, source])
