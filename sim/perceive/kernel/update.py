"""The weighing of looks: `sim.perceive.bayes_filter.update_layers` in machine code."""

from __future__ import annotations

from math import exp, log
from typing import Final

import numpy as np

from sim.compilation import on_given_arrays
from sim.perceive.belief import LAYERS
from sim.perceive.kernel.places import COLUMNS, HERE, ROWS
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
    columns, here = numbers[COLUMNS], numbers[HERE]
    cells, row, column = columns * numbers[ROWS], here // columns, here % columns
    seen = columns * (min(tables.devices[device, 1], row) + 1)
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
def find_sources(numbers, layers, tables, hidden, device, report, odds, sources, weights):
    """What may have caused a report: where in the layers, what is believed of each, and how likely it is.

    Returns how many there are and the weight of all, that of a false alarm included. Written to `weights`:
    the belief of each, and its weight; with `odds`, the odds of the report were it there instead, by which
    the weight of all is summed in another order that may differ in the last bit.
    """
    columns, here = numbers[COLUMNS], numbers[HERE]
    cells, row, column = columns * numbers[ROWS], here // columns, here % columns
    kind, heading, reach = report[0], report[2], tables.devices[device, 1]
    to_row = report[1] // columns
    to_column = report[1] - to_row * columns
    wrong, alarm, hypotheses = tables.wrong[device], tables.alarms[device, kind], 1
    if kind >= _FIXED_KINDS:
        hypotheses, alarm = 2, alarm / 2
    whole, count, furthest = alarm / (1.0 - alarm), 0, tables.seen.shape[1] - 1
    ahead, place = row - to_row, to_column - column + columns - 1
    for shift in range(SHIFTS):
        part = tables.shares[device, ahead, place, shift]
        if part == 0.0:
            break
        own_row = to_row + tables.shifts[device, ahead, place, shift, 0]
        own_column = to_column - tables.shifts[device, ahead, place, shift, 1]
        rows, from_ego = row - own_row, own_column - column + columns - 1
        if own_column < 0 or own_column >= columns or own_row < 0 or own_row > row or rows > reach:
            continue
        if hidden[(furthest - rows) * columns + own_column]:
            continue
        chance = tables.odds[device, kind, rows, from_ego]  # 0 where nothing is seen
        if chance == 0.0:
            continue
        if not odds:
            chance = tables.detection[device, kind, rows, from_ego]
        for turn in range(hypotheses):
            fits = 1.0
            if hypotheses == 2:
                fits = 1.0 - wrong if (turn == 0) == (heading == 1) else wrong
            at = (LAYER_OF[kind] + turn) * cells + own_row * columns + own_column
            missed = CHANCES[layers[at] + LIMIT]
            if odds:
                likely = chance * part * fits
                whole += missed * likely
            else:
                likely = missed * chance / (1.0 - chance) * part * fits
                whole += likely
            weights[0, count] = missed
            weights[1, count] = likely
            sources[count] = at
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
    count, whole = find_sources(numbers, layers, tables, hidden, device, report, True, at, weights)
    for source in range(count):
        likely = weights[1, source]
        ratios[source] = 1.0 + likely / (whole - weights[0, source] * likely)
    surely = True
    for source in range(count):
        ratio, step = ratios[source], (words[source] >> _BITS) - _FIRST
        if step >= len(_BELOW):
            after[source] = LIMIT
        else:
            border = _BORDER[step]
            surely = surely and abs(ratio - border) > _NEAR * border
            after[source] = min(LIMIT, layers[at[source]] + _BELOW[step] + (1 if ratio > border else 0))
    if surely:
        for source in range(count):
            layers[at[source]] = np.int16(after[source])
    else:
        weigh_exactly(numbers, layers, tables, hidden, device, report, at, weights)


@on_given_arrays
def weigh_exactly(numbers, layers, tables, hidden, device, report, sources, weights):
    """`weigh_report` with all that it computes in the order of `sim.perceive.bayes_filter`."""
    count, whole = find_sources(numbers, layers, tables, hidden, device, report, False, sources, weights)
    for source in range(count):
        share = weights[1, source] / whole
        layers[sources[source]] = _log_odds(share + (1.0 - share) * weights[0, source])
