"""One tick of sensing in machine code: belief moved on, looks of all devices, belief weighed, what is shown.

The same results as `sim.perceive.grid_sensor` to the last bit, in a thirtieth of its time: the loops go over
cells of the grid in plain words, and floating-point sums are made in the same order. `sim.perceive.fast_look`
packs the arguments and unpacks what comes back. Importing this loads numba.

Arguments that many functions take:

- `numbers` (int64): the head (`KEY` to `HEAD`), then the things (cells, kinds, numbers), the cells of the
  autonomous vehicles, and the movers that are followed (layer, cell before, cell after);
- `boards` (uint8): the bytes of the boards `ROAD_RIGHT`, `BELIEVED_FIXED`, `FOLLOWED_RIGHT`, one after another;
- `layers` (int16): log odds by layer and cell, changed in place;
- `tables`: `sim.perceive.look_tables.SuiteTables`;
- `hidden` (uint8): by rows ahead and column, whether a body hides the cell.
"""

from __future__ import annotations

from math import log
from typing import Final

import numpy as np

from sim.compilation import compiled, fraction, scaled, word_at
from sim.perceive.belief import FIXED, LAYERS
from sim.perceive.log_odds import LIMIT, UNITS
from sim.perceive.look import ALARMS
from sim.perceive.look_tables import (
    AV_NUMBER,
    BOARD_OF,
    CHANCES,
    HOLDS,
    KINDS_SEEN,
    LAYER_OF,
    LEVELS,
    PERIOD_OF,
    SHIFTS,
)
from sim.perceive.occlusion import UNIT
from sim.types import HAZARDS

KEY, EPISODE, TICK, EGO, HERE, COLUMNS, ROWS, REMEMBERED, TICK_BEFORE, THINGS, FIXED_THINGS, AVS, FOLLOWED = (
    range(13)
)
HEAD: Final = 13
"""Places in `numbers`. `REMEMBERED`: whether there is a belief from the tick before; `THINGS`, `FIXED_THINGS`,
`AVS`, `FOLLOWED`: how many there are."""
ROAD_RIGHT, BELIEVED_FIXED, FOLLOWED_RIGHT = range(3)

SHOWN_FIXED, SHOWN_MOVERS, REPORTS, TIES = range(4)
SHOWN_HEAD: Final = 4
"""Places in `shown`: how many there are, and whether a likelihood is too near a tie to be rounded here."""
TRIPLE: Final = 3

SEEN_RIGHT, SEEN_LEFT, SEEN_FIXED, SEEN_HOLDING, SEEN_OTHERS, SEEN_BOARDS = range(6)
SEEN_DOUBTS: Final = SEEN_BOARDS + int(BOARD_OF.max()) + 1
SEEN: Final = SEEN_DOUBTS + len(LEVELS)
"""Places in `marked`: movers by heading, the unions of `Boards`, the kinds with a board, the levels of doubt."""

_FIXED_KINDS: Final = len(HAZARDS)
_MOVING_KINDS: Final = KINDS_SEEN - _FIXED_KINDS
_LEVELS: Final = len(LEVELS)
_LOW: Final = np.uint64(0xFFFFFFFF)
_SHARE: Final = np.uint64(0xFFFFFF)
_HALF: Final = np.uint64(32)
_TOP: Final = np.uint64(56)
_ONE: Final = np.uint64(1)
_PLACES: Final = 4
"""Words that false alarms of a kind may draw (`sim.perceive.look`)."""


@compiled
def _bit(boards, which, size, cell):
    """Whether a cell is on one of the boards, each of `size` bytes."""
    return boards[which * size + (cell >> 3)] >> (cell & 7) & 1


@compiled
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


@compiled
def _predict(numbers, boards, layers, mixing, least):
    """`sim.perceive.bayes_filter.predict_layers`; where the rule leads the movers is in `numbers`."""
    columns, rows, followed = numbers[COLUMNS], numbers[ROWS], numbers[FOLLOWED]
    cells = columns * rows
    size = (cells + 7) // 8
    at = HEAD + 3 * numbers[THINGS] + numbers[AVS]
    values = np.empty(followed, np.int64)
    for place in range(followed):
        layer, cell = numbers[at + place], numbers[at + followed + place]
        values[place] = layers[layer * cells + cell]
        layers[layer * cells + cell] = -LIMIT
    for place in range(_MOVING_KINDS):
        if numbers[TICK_BEFORE] % PERIOD_OF[place] == PERIOD_OF[place] - 1:
            right = (FIXED + 2 * place) * cells
            for row in range(rows):
                _drift(layers, right + row * columns, right + cells + row * columns, columns)
    for place in range(2 * _MOVING_KINDS):
        first = (FIXED + place) * cells
        for cell in range(first, first + cells):
            layers[cell] = mixing[place, layers[cell] + LIMIT]
    for cell in range(cells):
        if _bit(boards, BELIEVED_FIXED, size, cell):
            edge = 1 if cell < columns or cell >= cells - columns else 0
            for place in range(2 * _MOVING_KINDS):
                there = (FIXED + place) * cells + cell
                layers[there] = min(layers[there], least[place, edge])
    for place in range(followed):
        cell = numbers[at + 2 * followed + place]
        moving = (numbers[at + place] - FIXED) // 2 * 2
        if not _bit(boards, FOLLOWED_RIGHT, size, cell):
            moving += 1
        there = (FIXED + moving) * cells + cell
        layers[there] = max(layers[there], mixing[moving, values[place] + LIMIT])


@compiled
def _drift(layers, right, left, columns):
    """One row of one kind of mover one step on, with movers that turn at the edges."""
    turned_left, turned_right = layers[right + columns - 1], layers[left]
    for column in range(columns - 1, 0, -1):
        layers[right + column] = layers[right + column - 1]
    layers[right] = -LIMIT
    for column in range(columns - 1):
        layers[left + column] = layers[left + column + 1]
    layers[left + columns - 1] = -LIMIT
    layers[left + columns - 2] = max(layers[left + columns - 2], turned_left)
    layers[right + 1] = max(layers[right + 1], turned_right)


@compiled
def _hide(numbers, tables, hidden):
    """Mark what the bodies on the road hide: `sim.perceive.occlusion.hidden`."""
    columns, here, things = numbers[COLUMNS], numbers[HERE], numbers[THINGS]
    row, column = here // columns, here % columns
    rows = min(hidden.shape[0], row + 1)
    for thing in range(things + numbers[AVS]):
        if thing < things:
            cell, kind = numbers[HEAD + thing], numbers[HEAD + things + thing]
        else:
            cell, kind = numbers[HEAD + 2 * things + thing], AV_NUMBER
        ahead = row - cell // columns
        if cell == here or tables.halves[kind, 0] == 0 or ahead < 0 or ahead >= rows:
            continue
        place = cell % columns - column + columns - 1
        for there in range(ahead, rows):
            first = max(tables.shadows[kind, place, ahead, there, 0] + column, 0)
            last = min(tables.shadows[kind, place, ahead, there, 1] + column, columns - 1)
            for other in range(first, last + 1):
                hidden[there, other] = 1


@compiled
def _look(numbers, boards, tables, hidden, device, reports, count):
    """The reports of a device, written behind the first `count` of `reports`: `sim.perceive.look.look`.

    A report: kind, cell, heading (1 right, 0 left), and the place of the thing among all, −1 for a false alarm.
    """
    columns, here, things = numbers[COLUMNS], numbers[HERE], numbers[THINGS]
    row, column = here // columns, here % columns
    size = (columns * numbers[ROWS] + 7) // 8
    number, reach, wrong = tables.devices[device, 0], tables.devices[device, 1], tables.devices[device, 2]
    key = word_at(np.uint64(numbers[KEY]), numbers[EPISODE])
    key = word_at(word_at(word_at(key, numbers[TICK]), numbers[EGO]), number)
    for thing in range(things):
        cell, kind = numbers[HEAD + thing], numbers[HEAD + things + thing]
        ahead, there = row - cell // columns, cell % columns
        place = there - column + columns - 1
        if ahead < 0 or ahead > reach or hidden[ahead, there] or not tables.seen[device, ahead, place]:
            continue
        word = word_at(word_at(key, kind), numbers[HEAD + 2 * things + thing])
        if np.int64(word & _LOW) >= tables.drawn[device, kind, ahead, place]:
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
        heading = 0
        if kind >= _FIXED_KINDS:
            heading = np.int64(_bit(boards, ROAD_RIGHT, size, cell))
            if np.int64(word >> _TOP) < wrong:
                heading = 1 - heading
        count = _add(reports, count, kind, to_row * columns + to_column, heading, thing)
    return _alarm(numbers, tables, hidden, device, word_at(key, ALARMS), reports, count)


@compiled
def _add(reports, count, kind, cell, heading, thing):
    reports[count, 0], reports[count, 1] = kind, cell
    reports[count, 2], reports[count, 3] = heading, thing
    return count + 1


@compiled
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
        if cell < 0 or hidden[ahead, there] or not tables.seen[device, ahead, there - column + columns - 1]:
            continue
        heading = 0
        if kind >= _FIXED_KINDS:
            heading = np.int64(word_at(key, _PLACES * kind + 2) & _ONE)
        count = _add(reports, count, kind, cell, heading, -1)
    return count


@compiled
def _miss(numbers, layers, tables, hidden, device):
    """Make what was seen without a report less likely."""
    columns, here = numbers[COLUMNS], numbers[HERE]
    cells, row, column = columns * numbers[ROWS], here // columns, here % columns
    left = columns - 1 - column
    for layer in range(LAYERS):
        for ahead in range(min(tables.devices[device, 1], row) + 1):
            own = layers[layer * cells + (row - ahead) * columns :][:columns]
            less, covered = tables.miss[device, layer, ahead, left:], hidden[ahead]
            for there in range(columns):
                # Where nothing can be detected, `miss` is 0. No branches, so that a compiler takes many at once.
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
def _weigh(numbers, layers, tables, hidden, device, report, sources, weights):
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


@compiled
def _likelihood(shown, chance):
    """A probability rounded to thousandths; as it is where that is too near a tie, which is noted."""
    scaled_up = chance * 1000.0
    if abs(scaled_up - np.floor(scaled_up) - 0.5) < 1e-6:
        shown[TIES] = 1
        return chance
    return np.rint(scaled_up) / 1000.0


@compiled
def _show_cell(numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, fixed):
    """What is shown in a cell: of hazards (`fixed`) or of movers. Returns how many were added.

    `fixed_kinds`: by cell, the kind of the hazard that is shown there, −1 for none.
    """
    cells, size = numbers[COLUMNS] * numbers[ROWS], (numbers[COLUMNS] * numbers[ROWS] + 7) // 8
    best, likely, right = -1, 0.0, False
    for kind in range(0 if fixed else _FIXED_KINDS, _FIXED_KINDS if fixed else KINDS_SEEN):
        at = LAYER_OF[kind] * cells + cell
        chance, heads_right = CHANCES[layers[at] + LIMIT], False
        if not fixed:
            other = CHANCES[layers[at + cells] + LIMIT]
            heads_right = chance >= other
            chance = chance + other
        if chance < threshold:
            continue
        chance = min(chance, 1.0)
        if best < 0 or chance > likely:
            best, likely, right = kind, chance, heads_right
    if best < 0 or (not fixed and fixed_kinds[cell] >= 0 and not HOLDS[fixed_kinds[cell]]):
        return 0
    if fixed:
        fixed_kinds[cell] = best
        _mark(marked, SEEN_FIXED, size, cell)
        if HOLDS[best]:
            _mark(marked, SEEN_HOLDING, size, cell)
    else:
        _mark(marked, SEEN_RIGHT if right else SEEN_LEFT, size, cell)
        if BOARD_OF[best] >= 0:
            _mark(marked, SEEN_OTHERS, size, cell)
    if BOARD_OF[best] >= 0:
        _mark(marked, SEEN_BOARDS + BOARD_OF[best], size, cell)
    place = shown[SHOWN_FIXED] + shown[SHOWN_MOVERS]
    at = SHOWN_HEAD + TRIPLE * place
    shown[at], shown[at + 1], shown[at + 2] = cell, best, _thing_at(numbers, cell, best, fixed)
    likelihoods[place] = _likelihood(shown, likely)
    return 1


@compiled
def _mark(marked, which, size, cell):
    """Put a cell on one of the boards of what is shown."""
    marked[which * size + (cell >> 3)] |= np.uint8(1 << (cell & 7))


@compiled
def _thing_at(numbers, cell, kind, fixed):
    """The place of the thing of that kind in that cell, −1 where there is none."""
    things, standing = numbers[THINGS], numbers[FIXED_THINGS]
    for thing in range(0 if fixed else standing, standing if fixed else things):
        if numbers[HEAD + thing] == cell:
            return thing if numbers[HEAD + things + thing] == kind else -1
    return -1


@compiled
def _show(numbers, layers, threshold, shown, likelihoods, marked):
    """What is believed as far as the vehicle's own row: `sim.perceive.grid_sensor.show`."""
    columns = numbers[COLUMNS]
    cells = columns * numbers[ROWS]
    size, ahead = (cells + 7) // 8, (numbers[HERE] // columns + 1) * columns
    fixed_kinds = np.full(ahead, -1, np.int64)
    # Most cells hold nothing, which whole numbers say quickly: chances grow with log odds.
    least = np.searchsorted(CHANCES, threshold) - LIMIT
    least_mover = np.searchsorted(CHANCES, threshold / 2) - LIMIT - 1
    least_doubt = np.searchsorted(CHANCES, LEVELS[0]) - LIMIT
    likeliest = _likeliest(layers, cells, ahead, 0, FIXED)
    moving = _likeliest(layers, cells, ahead, FIXED, LAYERS)
    for cell in range(ahead):
        if likeliest[cell] >= least:
            shown[SHOWN_FIXED] += _show_cell(
                numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, True
            )
    for cell in range(ahead):
        if moving[cell] >= least_mover:
            shown[SHOWN_MOVERS] += _show_cell(
                numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, False
            )
    for cell in range(ahead):
        if likeliest[cell] >= least_doubt and fixed_kinds[cell] < 0:
            for level in range(_LEVELS):
                if CHANCES[likeliest[cell] + LIMIT] >= LEVELS[level]:
                    _mark(marked, SEEN_DOUBTS + level, size, cell)


@compiled
def _likeliest(layers, cells, ahead, first, last):
    """The greatest log odds of some layers in each of the first `ahead` cells."""
    found = layers[first * cells : first * cells + ahead].copy()
    for layer in range(first + 1, last):
        for cell in range(ahead):
            found[cell] = max(found[cell], layers[layer * cells + cell])
    return found


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
        _predict(numbers, boards, layers, mixing, least)
    count_of_devices = len(tables.devices)
    hidden = np.zeros((tables.seen.shape[1], columns), np.uint8)
    _hide(numbers, tables, hidden)
    reports = np.empty((count_of_devices * (numbers[THINGS] + KINDS_SEEN), 4), np.int64)
    sources, weights = np.empty(2 * SHIFTS, np.int64), np.empty((2 * SHIFTS, 2))
    first = 0
    for device in range(count_of_devices):
        last = _look(numbers, boards, tables, hidden, device, reports, first)
        _miss(numbers, layers, tables, hidden, device)
        for report in range(first, last):
            _weigh(numbers, layers, tables, hidden, device, reports[report], sources, weights)
        first = last
    at = HEAD + 3 * numbers[THINGS]
    for vehicle in range(numbers[AVS]):
        for layer in range(LAYERS):
            layers[layer * cells + numbers[at + vehicle]] = -LIMIT
    _show(numbers, layers, threshold, shown, likelihoods, marked)
    shown[REPORTS] = first
    at = SHOWN_HEAD + TRIPLE * (shown[SHOWN_FIXED] + shown[SHOWN_MOVERS])
    for report in range(first):
        shown[at], shown[at + 1], shown[at + 2] = reports[report, 0], reports[report, 1], reports[report, 3]
        at += TRIPLE
    return at
