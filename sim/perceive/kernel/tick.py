"""One tick of sensing in machine code: belief moved on, looks of all devices, belief weighed, what is shown.

The same results as `sim.perceive.grid_sensor` to the last bit: loops over the cells of the grid in machine
words, with floating-point sums made in the same order. `run` packs the arguments and unpacks what comes back;
`places` says what they hold. Importing this loads numba.
"""

from __future__ import annotations

import numpy as np

from sim.compilation import compiled
from sim.perceive.belief import LAYERS
from sim.perceive.kernel.look import fill_shadows, hide, look, may_see, place_things
from sim.perceive.kernel.places import (
    AVS,
    COLUMNS,
    HEAD,
    REMEMBERED,
    REPORT,
    REPORT_CELL,
    REPORT_KIND,
    REPORT_THING,
    REPORTS,
    ROWS,
    SHOWN_FIXED,
    SHOWN_HEAD,
    SHOWN_MOVERS,
    THINGS,
    TRIPLE,
)
from sim.perceive.kernel.predict import predict
from sim.perceive.kernel.show import show
from sim.perceive.kernel.tables import KINDS_SEEN
from sim.perceive.kernel.update import SOURCES, weigh_misses, weigh_report
from sim.perceive.log_odds import LIMIT

__all__ = ["fill_shadows", "sense_tick"]


@compiled
def sense_tick(numbers, boards, before, threshold, mixing, least, tables, layers, shown, likelihoods, marked):
    """One tick. Written to: `layers` (the belief after it) and what is shown.

    `before`: the belief before; `shown` (int64): the head, then cell, kind and thing of each, then kind, cell
    and thing of each report; `likelihoods` of what is shown; `marked` (uint8): boards, `SEEN_RIGHT` to
    `SEEN`. Returns how much of `shown` is used.
    """
    shown[:SHOWN_HEAD] = 0
    marked[:] = 0
    columns = numbers[COLUMNS]
    cells = columns * numbers[ROWS]
    layers[:] = before
    if numbers[REMEMBERED]:
        predict(numbers, boards, layers, mixing, least, numbers[ROWS])
    count_of_devices = len(tables.devices)
    hidden = np.zeros(tables.seen.shape[1] * columns, np.int16)
    spots = np.empty((numbers[THINGS] + numbers[AVS], 2), np.int64)
    place_things(numbers, spots)
    hide(numbers, tables, spots, np.zeros(tables.seen.shape[1], np.uint64), hidden)
    reports = np.empty((count_of_devices * (numbers[THINGS] + KINDS_SEEN), REPORT), np.int64)
    in_view = np.empty((2, numbers[THINGS]), np.int64)
    sources, weights, ratios = np.empty((2, SOURCES), np.int64), np.empty((2, SOURCES)), np.empty(SOURCES)
    words = ratios.view(np.int64)
    first, seen = 0, may_see(numbers, spots, hidden, in_view)
    for device in range(count_of_devices):
        last = look(numbers, boards, tables, spots, hidden, device, in_view, seen, reports, first)
        weigh_misses(numbers, layers, tables, hidden, device)
        for report in range(first, last):
            weigh_report(
                numbers, layers, tables, hidden, device, reports[report], sources, weights, ratios, words
            )
        first = last
    at = HEAD + 3 * numbers[THINGS]
    for vehicle in range(numbers[AVS]):
        for layer in range(LAYERS):
            layers[layer * cells + numbers[at + vehicle]] = -LIMIT
    show(numbers, layers, threshold, shown, likelihoods, marked)
    shown[REPORTS] = first
    at = SHOWN_HEAD + TRIPLE * (shown[SHOWN_FIXED] + shown[SHOWN_MOVERS])
    for report in range(first):
        shown[at], shown[at + 1] = reports[report, REPORT_KIND], reports[report, REPORT_CELL]
        shown[at + 2] = reports[report, REPORT_THING]
        at += TRIPLE
    return at
