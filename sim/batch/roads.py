"""Roads drawn in compiled code, bit for bit those of `sim.generation`: the same streams, the same draws.

Furnishing a road is no rule of motion and is written twice, as boards there and as words here; what is
drawn is written once, in `sim.randomness`. The tests compare digests of both over many configurations.

Array arguments: `state`, `lanes`, `block`, `lane_block` (uint64) as in `sim.batch.layout`; `wholes`
(lanes, 8; int64) and `shares` (lanes, 4; float64), in functions of one lane its row, by the columns named
there; `chosen`, `taken` (rows; uint64): things of a row, a bit a column; in `renew`, `chosen` (lanes; uint8).
Keys are uint64.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import first_bit
from sim.batch.layout import (
    ATTENTIVE_KEY,
    BARRIERS,
    CELL,
    COLUMN_BIT,
    COURTESY_KEY,
    EPISODE,
    EPISODE_TICK,
    FIXED,
    HOLES,
    IN_ROW,
    LANES,
    LEFT,
    OUTCOME,
    PEDESTRIANS,
    PLANES,
    POTHOLE_PROBABILITY,
    POTHOLES,
    RIGHT,
    SEED,
    SHIFT,
    SINCE_END,
    SOLVABLE,
    SPAWN_PROBABILITY,
    VEHICLES,
    WALKERS,
    WORD,
)
from sim.batch.reachability import drivable
from sim.compilation import compiled, fraction, mix, scaled, word_at
from sim.generation import MAX_ATTEMPTS
from sim.randomness import purpose_key
from sim.types import Kind

_GOLDEN: Final = np.uint64(0x9E3779B97F4A7C15)
_VEHICLE_KEY: Final = np.uint64(purpose_key(f"spawn {Kind.VEHICLE}"))
_PEDESTRIAN_KEY: Final = np.uint64(purpose_key(f"spawn {Kind.PEDESTRIAN}"))
_BARRIER_KEY: Final = np.uint64(purpose_key(f"spawn {Kind.BARRIER}"))
_POTHOLE_KEY: Final = np.uint64(purpose_key(f"spawn {Kind.POTHOLE}"))
_HEADING_KEY: Final = np.uint64(purpose_key("heading"))
_COURTESY_KEY: Final = np.uint64(purpose_key("courtesy"))
_ATTENTIVE_KEY: Final = np.uint64(purpose_key("attentive"))
_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)


@compiled
def _one_a_row(chosen, taken, columns, probability, key):
    """One thing in each row with that probability, in a free cell of the row."""
    whole = ((_ONE << np.uint64(columns - 1)) << _ONE) - _ONE
    # Without branches: the words of several rows are computed at once.
    for row in range(1, len(taken) - 1):
        draws = word_at(key, row)
        there = fraction(word_at(draws, 0)) < probability
        first = _ONE << scaled(word_at(draws, 1), np.uint64(columns))
        chosen[row] = first if there else _ZERO
    for row in range(1, len(taken) - 1):
        if chosen[row] and taken[row]:
            chosen[row] = _ZERO
            free = ~taken[row] & whole
            count, rest = columns, taken[row]
            while rest:
                rest &= rest - _ONE
                count -= 1
            if count:
                nth = scaled(word_at(word_at(key, row), 1), np.uint64(count))
                for _ in range(nth):
                    free &= free - _ONE
                chosen[row] = free & ~(free - _ONE)


@compiled
def _exactly(chosen, taken, columns, count, key):
    """The free cells of lowest random rank, `count` of them."""
    if count <= 0:
        return
    rows = len(taken)
    ranks = np.empty(rows * columns, np.uint64)
    free = 0
    for row in range(1, rows - 1):
        for column in range(columns):
            if not taken[row] >> np.uint64(column) & _ONE:
                ranks[free] = word_at(key, row * columns + column)
                free += 1
    if free == 0:
        return
    count = min(count, free)
    last = np.sort(ranks[:free])[count - 1]
    for row in range(1, rows - 1):
        for column in range(columns):
            free = not taken[row] >> np.uint64(column) & _ONE
            if count and free and word_at(key, row * columns + column) <= last:
                chosen[row] |= _ONE << np.uint64(column)
                count -= 1


@compiled
def _furnish(chosen, taken, columns, count, probability, key):
    """Put things of a kind on the free cells: into `chosen`, which is empty, and into `taken`."""
    if count < 0:
        _one_a_row(chosen, taken, columns, probability, key)
    else:
        _exactly(chosen, taken, columns, count, key)
    if count:
        for row in range(len(taken)):
            taken[row] |= chosen[row]


@compiled
def _turn(rightward, vehicles, walkers, columns, heading):
    """Choose which movers head to the right."""
    several = _ZERO
    # Without branches as above: in most rows there is one mover at most, the first.
    for row in range(len(rightward)):
        movers = vehicles[row] | walkers[row]
        others = movers & (movers - _ONE)
        right = scaled(word_at(heading, row * columns + first_bit(movers)), np.uint64(2))
        rightward[row] = movers ^ others if right else _ZERO
        several |= others
    for row in range(len(rightward) if several else 0):
        rest = vehicles[row] | walkers[row]
        rest &= rest - _ONE
        while rest:
            column = first_bit(rest)
            rest &= rest - _ONE
            if scaled(word_at(heading, row * columns + column), np.uint64(2)):
                rightward[row] |= _ONE << np.uint64(column)


@compiled
def _stream(base, purpose, episode, attempt):
    stream = word_at(base ^ purpose, episode)
    return word_at(stream, attempt) if attempt else stream


@compiled
def begin(block, lane_block, lane, columns, rows, wholes, shares):
    """Begin episode `wholes[EPISODE]` in a lane, as `sim.generation.generate`; False: no road was found."""
    if not wholes[SOLVABLE]:
        _draw(block, lane_block, lane, columns, rows, wholes, shares, 0)
        return True
    for attempt in range(MAX_ATTEMPTS):
        _draw(block, lane_block, lane, columns, rows, wholes, shares, attempt)
        if drivable(block, lane_block, lane, columns, rows, shares):
            return True
    return False


@compiled
def begin_next(block, lane_block, lane, columns, rows, wholes, shares):
    """Begin the next episode, or where no road is found the present one again (`sim.state.next_episode`)."""
    wholes[EPISODE] += 1
    if not begin(block, lane_block, lane, columns, rows, wholes, shares):
        wholes[EPISODE] -= 1
        begin(block, lane_block, lane, columns, rows, wholes, shares)


@compiled
def _draw(block, lane_block, lane, columns, rows, wholes, shares, attempt):
    """Write a road into one lane of a block and put the ego at its start."""
    episode = wholes[EPISODE]
    base = mix(np.uint64(wholes[SEED]) + _GOLDEN)
    # One array for all kinds: making six of them would take as long as the rest.
    taken, vehicles, walkers, barriers, potholes, rightward = np.zeros((6, rows), np.uint64)
    key = _stream(base, _VEHICLE_KEY, episode, attempt)
    _furnish(vehicles, taken, columns, wholes[VEHICLES], shares[SPAWN_PROBABILITY], key)
    key = _stream(base, _PEDESTRIAN_KEY, episode, attempt)
    _furnish(walkers, taken, columns, wholes[PEDESTRIANS], 0.0, key)
    key = _stream(base, _BARRIER_KEY, episode, attempt)
    _furnish(barriers, taken, columns, wholes[BARRIERS], 0.0, key)
    key = _stream(base, _POTHOLE_KEY, episode, attempt)
    _furnish(potholes, taken, columns, wholes[POTHOLES], shares[POTHOLE_PROBABILITY], key)
    heading = _stream(base, _HEADING_KEY, episode, attempt)
    _turn(rightward, vehicles, walkers, columns, heading)
    rows_per_word = 64 // columns
    for word in range(-(-rows // rows_per_word)):
        right = left = fixed = holes = walking = _ZERO
        for inner in range(min(rows_per_word, rows - word * rows_per_word)):
            row = word * rows_per_word + inner
            shift = np.uint64(inner * columns)
            movers = vehicles[row] | walkers[row]
            right |= rightward[row] << shift
            left |= (movers & ~rightward[row]) << shift
            fixed |= (barriers[row] | potholes[row]) << shift
            holes |= potholes[row] << shift
            walking |= walkers[row] << shift
        at = word * PLANES * LANES + lane
        block[at + RIGHT * LANES] = right
        block[at + LEFT * LANES] = left
        block[at + FIXED * LANES] = fixed
        block[at + HOLES * LANES] = holes
        block[at + WALKERS * LANES] = walking
    last = rows - 1
    lane_block[WORD * LANES + lane] = np.uint64(last // rows_per_word)
    lane_block[SHIFT * LANES + lane] = np.uint64(last % rows_per_word * columns)
    lane_block[COLUMN_BIT * LANES + lane] = _ONE << np.uint64(columns // 2)
    lane_block[CELL * LANES + lane] = np.uint64(last * columns + columns // 2)
    lane_block[EPISODE_TICK * LANES + lane] = _ZERO
    lane_block[OUTCOME * LANES + lane] = _ZERO
    lane_block[SINCE_END * LANES + lane] = _ZERO
    lane_block[IN_ROW * LANES + lane] = _ALL
    lane_block[COURTESY_KEY * LANES + lane] = _stream(base, _COURTESY_KEY, episode, 0)
    lane_block[ATTENTIVE_KEY * LANES + lane] = _stream(base, _ATTENTIVE_KEY, episode, 0)


@compiled
def begin_all(state, lanes, count, columns, rows, wholes, shares):
    """Begin the episode of every lane. Shapes: `sim.batch.batch`. False: for some no road was found."""
    found = True
    for lane in range(count):
        block = lane // LANES
        found &= begin(state[block], lanes[block], lane % LANES, columns, rows, wholes[lane], shares[lane])
    return found


@compiled
def renew(state, lanes, chosen, columns, rows, wholes, shares):
    """Begin an episode in some lanes: `chosen` is 0 for none, 1 for the next one, 2 for `wholes[EPISODE]`.

    False: for some that had to begin this very episode no road was found.
    """
    found = True
    for lane in range(len(chosen)):
        block, inner = lane // LANES, lane % LANES
        if chosen[lane] == 1:
            begin_next(state[block], lanes[block], inner, columns, rows, wholes[lane], shares[lane])
        elif chosen[lane] == 2:
            found &= begin(state[block], lanes[block], inner, columns, rows, wholes[lane], shares[lane])
    return found
