"""One tick of sensing in many lanes: the kernel of `sim.perceive.kernel` on words, without names.

Things have no names in a batch, but draws are numbered by them. Movers stay in their rows and never change
places there, so the place of a thing among those of its kind, in reading order, gives its number.

Array arguments: `state`, `believed`, `lanes`, `wholes`, `shares` as in `sim.batch.layout`, of which
`believed` holds the boards that are shown; `layers` (lanes, layers · cells; int16); `memory` (lanes,
`COLUMNS_KEPT`; int64); `looked` (lanes; uint8); `chosen` (int64): the lanes that are looked at; `tables`,
`mixing`, `least`: `sim.perceive.kernel`.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from sim.batch.compiled import brake, first_bit
from sim.batch.layout import (
    ATTENTIVE,
    CELL,
    EPISODE,
    EPISODE_TICK,
    FIXED,
    HOLES,
    LANES,
    LEFT,
    OUTCOME,
    PLANES,
    RIGHT,
    SEED,
    WALKERS,
)
from sim.batch.sensing.memory import BEFORE, COUNT, LAST_NUMBER, TICK_BEFORE
from sim.batch.sensing.rule import motion_of, rule_move
from sim.batch.sensing.show import least_shown, show_words
from sim.compilation import mix, on_given_arrays
from sim.perceive.belief import FIXED as FIXED_LAYERS
from sim.perceive.belief import LAYERS
from sim.perceive.kernel import places as at
from sim.perceive.kernel.look import hide, look, may_see, place_things
from sim.perceive.kernel.predict import predict
from sim.perceive.kernel.tables import KINDS_SEEN, SuiteTables
from sim.perceive.kernel.update import SOURCES, weigh_misses, weigh_report
from sim.perceive.log_odds import LIMIT
from sim.randomness import purpose_key
from sim.types import HAZARDS

_SENSOR_KEY: Final = np.uint64(purpose_key("sensor"))
_GOLDEN: Final = np.uint64(0x9E3779B97F4A7C15)
_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)
_TWO, _FOUR, _TOP = np.uint64(2), np.uint64(4), np.uint64(56)
_ODD, _PAIRS = np.uint64(0x5555555555555555), np.uint64(0x3333333333333333)
_NIBBLES, _BYTES = np.uint64(0x0F0F0F0F0F0F0F0F), np.uint64(0x0101010101010101)
_FIXED_KINDS: Final = len(HAZARDS)
_HEAD, _AVS, _FOLLOWED, _THINGS = at.HEAD, at.AVS, at.FOLLOWED, at.THINGS


@on_given_arrays
def _of_kind(block, place, kind):
    """The things of a kind in a word; `place`: where its planes begin."""
    movers = block[place + RIGHT * LANES] | block[place + LEFT * LANES]
    if kind == 0:
        return block[place + HOLES * LANES]
    if kind == 1:
        return block[place + FIXED * LANES] & ~block[place + HOLES * LANES]
    if kind == 2:
        return movers & ~block[place + WALKERS * LANES]
    return block[place + WALKERS * LANES]


@on_given_arrays
def _list_things(block, i, columns, memory, begins, numbers):
    """Write cells, kinds and numbers of things behind the head of `numbers`, as `places` says.

    What is behind the vehicle comes last in reading order, and is left out.
    """
    per_word, row = 64 // columns, numbers[at.HERE] // columns
    words, size = row // per_word + 1, per_word * columns
    spare = np.uint64(64 - (row % per_word + 1) * columns)
    things = 0
    for kind in range(KINDS_SEEN):
        for word in range(words):
            near = _ALL >> spare if word == words - 1 else _ALL
            things += _count(_of_kind(block, word * PLANES * LANES + i, kind) & near)
        if kind == _FIXED_KINDS - 1:
            numbers[at.FIXED_THINGS] = things
    numbers[_THINGS] = things
    thing = 0
    for kind in range(KINDS_SEEN):
        first = thing
        if begins:
            memory[LAST_NUMBER + kind] += memory[COUNT + kind]
        for word in range(words):
            near = _ALL >> spare if word == words - 1 else _ALL
            left = _of_kind(block, word * PLANES * LANES + i, kind) & near
            while left:
                numbers[_HEAD + thing] = word * size + first_bit(left)
                numbers[_HEAD + things + thing] = kind
                numbers[_HEAD + 2 * things + thing] = memory[LAST_NUMBER + kind] + thing - first + 1
                left &= left - _ONE
                thing += 1
        if begins:  # in the last row, so that nothing is behind
            memory[COUNT + kind] = thing - first


@on_given_arrays
def _count(word):
    """The number of bits of a word, by sums of ever wider fields."""
    word -= word >> _ONE & _ODD
    word = (word & _PAIRS) + (word >> _TWO & _PAIRS)
    return np.int64((word + (word >> _FOUR) & _NIBBLES) * _BYTES >> _TOP)


@on_given_arrays
def _put_board(boards, which, size, word, per_word_cells, cells, value):
    """The bits of a word as bytes of a board."""
    if per_word_cells == 64:
        for byte in range(8):
            if word * 8 + byte < size:
                boards[which * size + word * 8 + byte] = np.uint8(
                    value >> np.uint64(8 * byte) & np.uint64(255)
                )
        return
    for inner in range(min(per_word_cells, cells - word * per_word_cells)):
        if value >> np.uint64(inner) & _ONE:
            cell = word * per_word_cells + inner
            boards[which * size + (cell >> 3)] |= np.uint8(1 << (cell & 7))


@on_given_arrays
def _follow(believed, i, columns, rows, memory, here, reacting, left_edge, right_edge, numbers, boards):
    """Where the rule leads what was shown to be movers: behind the things and the vehicle in `numbers`."""
    per_word, cells = 64 // columns, columns * rows
    words, per_word_cells, size = -(-rows // per_word), per_word * columns, (cells + 7) // 8
    row = here // columns
    place = _HEAD + 3 * numbers[_THINGS] + numbers[_AVS]
    followed = 0
    for word in range(words):
        there = word * PLANES * LANES + i
        followed += _count(believed[there + RIGHT * LANES] | believed[there + LEFT * LANES])
    numbers[_FOLLOWED] = followed
    count = 0
    for word in range(words):
        there = word * PLANES * LANES + i
        right = believed[there + RIGHT * LANES]
        movers = right | believed[there + LEFT * LANES]
        motion = motion_of(believed, there, memory[TICK_BEFORE], _ZERO, _ZERO, left_edge, right_edge)
        if reacting and memory[BEFORE] == here and row // per_word == word:
            standing = _ONE << np.uint64(row % per_word * columns + here % columns)
            motion = brake(motion, standing, _ALL)
        _put_board(
            boards, at.BELIEVED_FIXED, size, word, per_word_cells, cells, believed[there + FIXED * LANES]
        )
        _put_board(boards, at.FOLLOWED_RIGHT, size, word, per_word_cells, cells, motion.right)
        gone_right, gone_left = motion.came_right >> _ONE, motion.came_left << _ONE
        walkers = believed[there + WALKERS * LANES]
        left = movers
        while left:
            inner = first_bit(left)
            bit = _ONE << np.uint64(inner)
            left &= left - _ONE
            layer = FIXED_LAYERS + (2 if walkers & bit else 0) + (0 if right & bit else 1)
            cell = word * per_word_cells + inner
            numbers[place + count] = layer
            numbers[place + followed + count] = cell
            after = cell + (1 if gone_right & bit else 0) - (1 if gone_left & bit else 0)
            numbers[place + 2 * followed + count] = after
            count += 1


def scratch_arrays(columns: int, rows: int, tables: SuiteTables) -> tuple[NDArray[Any], ...]:
    """Arrays for `sense_lanes` to write in."""
    cells, devices = columns * rows, len(tables.devices)
    ratios, found = np.empty(SOURCES), np.zeros((cells + 7) // 8, np.uint64)
    return (
        np.empty(_HEAD + 9 * cells + 1, np.int64),
        np.zeros(3 * ((cells + 7) // 8), np.uint8),
        found.view(np.uint8),
        found,
        np.zeros(tables.seen.shape[1] * columns, np.int16),
        np.empty(tables.seen.shape[1], np.uint64),
        np.empty((2 * cells + 1, 2), np.int64),
        np.empty((2, 2 * cells + 1), np.int64),
        np.empty((devices * (2 * cells + KINDS_SEEN), at.REPORT), np.int64),
        np.empty((2, SOURCES), np.int64),
        np.empty((2, SOURCES)),
        ratios,
        ratios.view(np.int64),
    )


@on_given_arrays
def sense_lanes(
    state,
    lanes,
    believed,
    layers,
    memory,
    looked,
    ended,
    wholes,
    shares,
    chosen,
    columns,
    rows,
    left_edge,
    right_edge,
    threshold,
    prior,
    mixing,
    least,
    tables,
    scratch,
):
    """Look at the road in chosen lanes that have not looked in this tick: belief and what is shown, one on.

    `ended`: whether also where a result stands.
    `scratch`: of `scratch_arrays`.
    """
    cells = columns * rows
    devices = len(tables.devices)
    least_fixed, least_mover = least_shown(threshold)
    numbers, boards, found, eights, hidden, dark, spots, in_view, reports, sources, weights, ratios, words = (
        scratch
    )
    for lane in chosen:
        block, v, i = state[lane // LANES], lanes[lane // LANES], lane % LANES
        if looked[lane] or (v[OUTCOME * LANES + i] and not ended):
            continue
        looked[lane] = 1
        shown, own, kept = believed[lane // LANES], layers[lane], memory[lane]
        tick, here = np.int64(v[EPISODE_TICK * LANES + i]), np.int64(v[CELL * LANES + i])
        if tick == 0:
            kept[BEFORE] = -1
        key = mix(np.uint64(wholes[lane, SEED]) + _GOLDEN) ^ _SENSOR_KEY
        numbers[at.KEY], numbers[at.EPISODE], numbers[at.TICK] = np.int64(key), wholes[lane, EPISODE], tick
        numbers[at.EGO], numbers[at.HERE], numbers[at.COLUMNS], numbers[at.ROWS] = 0, here, columns, rows
        row = here // columns
        numbers[at.ROW], numbers[at.COLUMN] = row, here - row * columns
        numbers[at.TICK_BEFORE], numbers[_AVS], numbers[_FOLLOWED] = kept[TICK_BEFORE], 1, 0
        _list_things(block, i, columns, kept, tick == 0, numbers)
        numbers[_HEAD + 3 * numbers[_THINGS]] = here
        boards[:] = 0
        _put_right(block, i, columns, rows, row, boards)
        if kept[BEFORE] >= 0:
            reacting = shares[lane, ATTENTIVE] >= 0.5
            _follow(shown, i, columns, rows, kept, here, reacting, left_edge, right_edge, numbers, boards)
            predict(numbers, boards, own, mixing, least, row + 1)
        else:
            for cell in range(len(prior)):
                own[cell] = prior[cell]
        dark[:] = 0
        place_things(numbers, spots)
        hide(numbers, tables, spots, dark, hidden)
        first, seen = 0, may_see(numbers, spots, hidden, in_view)
        for device in range(devices):
            last = look(numbers, boards, tables, spots, hidden, device, in_view, seen, reports, first)
            weigh_misses(numbers, own, tables, hidden, device)
            for report in range(first, last):
                weigh_report(
                    numbers, own, tables, hidden, device, reports[report], sources, weights, ratios, words
                )
            first = last
        for layer in range(LAYERS):
            own[layer * cells + here] = -LIMIT
        show_words(own, threshold, least_fixed, least_mover, columns, rows, row + 1, shown, i, found, eights)
        kept[BEFORE], kept[TICK_BEFORE] = here, tick


@on_given_arrays
def _put_right(block, i, columns, rows, row, boards):
    """The movers that head right as bytes, as far as the vehicle's own row."""
    per_word, cells = 64 // columns, columns * rows
    for word in range(row // per_word + 1):
        value = block[word * PLANES * LANES + RIGHT * LANES + i]
        _put_board(boards, at.ROAD_RIGHT, (cells + 7) // 8, word, per_word * columns, cells, value)


@on_given_arrays
def rule_moves(state, lanes, believed, shares, columns, left_edge, right_edge, count, moves):
    """The move of `priority` in every lane, by what is believed; to stay where a result stands."""
    for lane in range(count):
        block, i = lane // LANES, lane % LANES
        moves[lane] = 5
        if not lanes[block][OUTCOME * LANES + i]:
            moves[lane] = rule_move(
                state[block], believed[block], lanes[block], i, columns, shares[lane], left_edge, right_edge
            )
