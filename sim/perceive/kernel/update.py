"""The weighing of looks: `sim.perceive.bayes_filter.update_layers` in machine code."""

from __future__ import annotations

from math import log
from typing import Final

import numpy as np

from sim.compilation import compiled
from sim.perceive.belief import LAYERS
from sim.perceive.kernel.places import COLUMNS, HERE, ROWS
from sim.perceive.kernel.tables import CHANCES, LAYER_OF, SHIFTS
from sim.perceive.log_odds import LIMIT, UNITS
from sim.types import HAZARDS

_FIXED_KINDS: Final = len(HAZARDS)


@compiled
def weigh_misses(numbers, layers, tables, hidden, device):
    """Make what was seen without a report less likely."""
    columns, here = numbers[COLUMNS], numbers[HERE]
    cells, row, column = columns * numbers[ROWS], here // columns, here % columns
    left = columns - 1 - column
    for layer in range(LAYERS):
        for ahead in range(min(tables.devices[device, 1], row) + 1):
            own = layers[layer * cells + (row - ahead) * columns :][:columns]
            less, covered = tables.miss[device, layer, ahead, left:], hidden[ahead]
            for there in range(columns):
                # Where nothing can be detected, `miss` is 0. Without branches this becomes SIMD code.
                value = own[there] + np.int16(less[there] * np.int16(1 - covered[there]))
                own[there] = max(-LIMIT, min(LIMIT, value))


@compiled
def _log_odds(chance):
    """`sim.perceive.log_odds.log_odds`."""
    if chance <= CHANCES[0]:
        return -LIMIT
    if chance >= CHANCES[2 * LIMIT]:
        return LIMIT
    return np.int64(np.rint(UNITS * log(chance / (1.0 - chance))))


@compiled
def weigh_report(numbers, layers, tables, hidden, device, report, sources, weights):
    """Share a report out among all that may have caused it: `sim.perceive.bayes_filter.update_layers`."""
    columns, here = numbers[COLUMNS], numbers[HERE]
    cells, row, column = columns * numbers[ROWS], here // columns, here % columns
    kind, heading, reach = report[0], report[2], tables.devices[device, 1]
    to_row, to_column = report[1] // columns, report[1] % columns
    wrong, alarm, hypotheses = tables.wrong[device], tables.alarms[device, kind], 1
    if kind >= _FIXED_KINDS:
        hypotheses, alarm = 2, alarm / 2
    whole, count = alarm / (1.0 - alarm), 0
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
        if hidden[rows, own_column] or not tables.seen[device, rows, from_ego]:
            continue
        chance = tables.detection[device, kind, rows, from_ego]
        if chance == 0.0:
            continue
        for turn in range(hypotheses):
            fits = 1.0
            if hypotheses == 2:
                fits = 1.0 - wrong if (turn == 0) == (heading == 1) else wrong
            at = (LAYER_OF[kind] + turn) * cells + own_row * columns + own_column
            missed = CHANCES[layers[at] + LIMIT]
            weights[count, 0] = missed
            weights[count, 1] = missed * chance / (1.0 - chance) * part * fits
            whole += weights[count, 1]
            sources[count] = at
            count += 1
    for source in range(count):
        share = weights[source, 1] / whole
        layers[sources[source]] = _log_odds(share + (1.0 - share) * weights[source, 0])
