"""Where the ego can be at every tick, in compiled words: least ticks, and the move that begins them.

Structure: movers are rolled out by the rules word by word; the set of cells the ego can be in is
stepped along with them (`spread`) until it meets row 0; a backward pass over the layers
(`spread_back`) keeps what lies on a shortest way, and the first move of the six that stays on one is taken.
Words behind the ego are left out, since it never goes back. Where a mover brakes for a vehicle that
stays now, what comes of staying is searched by itself, from movers that have braked (`Forecast.standing`).
Guarantee: exact where nothing is left to chance; with courtesy the first tick is exact, later ones assume
that nobody gives way. Where no way leads to the goal, the move after which one can keep clear of collisions
longest.

The same as `sim.search.reachability`, which serves one live world with Python's integers.

Array arguments, here and in `sim.batch.backward_dp` (words: those of a board, `Layout.words`):

- `state` (blocks, words · `PLANES` · `LANES`; uint64) and `lanes` (blocks, `LANE_PLANES` · `LANES`; uint64);
  `block` and `lane_block` are a row of each (`sim.batch.layout`), `lane` and `inner` a world's number in it;
- `shares` (lanes, 4; float64), in functions of one lane its row: probabilities, by `COURTESY`, `ATTENTIVE`;
- `now` (8, words; uint64): boards of the tick that is rolled out next, see `NOW_RIGHT`;
- `layers` (ticks, 8, words; uint64): what is known of each tick, see `BLOCKED`;
- `board` (words; uint64): one board;
- `moves` (lanes; uint8), `ticks` (lanes; int64): the answers, a place in `MOVES` and a number of ticks.

Numbers: `ahead`, `ticks`, `limit`, `rolled`, `episode_tick` are in ticks; `cell`, `row`, `columns`, `rows` on
the road; `first`, `last`, `w` number words; `left_edge`, `right_edge` are the first and last column of a word
(uint64); `swept` is all ones where bodies collide by what they sweep, else 0 (uint64).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import (
    brake,
    cut_off,
    followed_board,
    free_steps,
    max_ticks,
    move_movers,
    pedestrians_walk,
    spread,
    spread_back,
    steps_left,
)
from sim.batch.drawn_reactions import drawn_beside
from sim.batch.layout import (
    ATTENTIVE,
    ATTENTIVE_KEY,
    CELL,
    COLUMN_BIT,
    COURTESY,
    COURTESY_KEY,
    EPISODE_TICK,
    FIXED,
    HOLES,
    LANES,
    LEFT,
    OUTCOME,
    PLANES,
    RIGHT,
    SHIFT,
    SWEPT,
    WALKERS,
    WORD,
)
from sim.compilation import compiled
from sim.rules.traffic import Motion

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
STAY: Final = 5

NOW_RIGHT, NOW_LEFT, NOW_WALKERS, ALL_FIXED, RESTING_IN_HOLES, YIELDS, BRAKES, VEHICLE = range(8)
BOARDS: Final = 8
"""Rows of the scratch board of a roll-out (shape: 8, words): the movers, what they meet, who gives way and
who brakes in the first tick, and the ego."""
BLOCKED, CAME_RIGHT, CAME_LEFT, CUT_LEFT, CUT_RIGHT, MOVERS, REACHED, NEEDED = range(8)
FIELDS: Final = 8
"""Planes of a roll-out (shape: ticks, 8, words); of tick k: after k + 1 ticks, the last two after k."""


@compiled
def prepare(now, block, lane_block, lane, columns, rows, shares, behind):
    """Take a lane's boards up to the word `behind` rows after the ego, and who reacts to it now.

    Returns the last word taken.
    """
    word = np.int64(lane_block[WORD * LANES + lane])
    row = np.int64(lane_block[CELL * LANES + lane]) // columns
    last = min(row + behind, rows - 1) // (64 // columns)
    for w in range(last + 1):
        at = w * PLANES * LANES + lane
        now[NOW_RIGHT, w] = block[at + RIGHT * LANES]
        now[NOW_LEFT, w] = block[at + LEFT * LANES]
        now[NOW_WALKERS, w] = block[at + WALKERS * LANES]
        now[ALL_FIXED, w] = block[at + FIXED * LANES]
        now[RESTING_IN_HOLES, w] = (now[NOW_RIGHT, w] | now[NOW_LEFT, w]) & block[at + HOLES * LANES]
        now[YIELDS, w] = _ZERO
        now[BRAKES, w] = _ZERO
        now[VEHICLE, w] = _ZERO
    bit, shift = lane_block[COLUMN_BIT * LANES + lane], lane_block[SHIFT * LANES + lane]
    now[VEHICLE, word] = bit << shift
    cell = np.int64(lane_block[CELL * LANES + lane])
    tick = np.int64(lane_block[EPISODE_TICK * LANES + lane])
    last_bit = _ONE << np.uint64(columns - 1)
    key = lane_block[COURTESY_KEY * LANES + lane]
    now[YIELDS, word] = drawn_beside(key, tick, cell, bit, last_bit, shares[COURTESY]) << shift
    key = lane_block[ATTENTIVE_KEY * LANES + lane]
    now[BRAKES, word] = drawn_beside(key, tick, cell, bit, last_bit, shares[ATTENTIVE]) << shift
    return last


@compiled
def roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands):
    """One tick of the movers of words 0 to `last`, into layer `ahead`.

    With `stands` the ego does not move in the first tick, and movers brake for it.
    """
    walking = pedestrians_walk(episode_tick + ahead)
    unused, up, most = np.uint64(64 % columns), np.uint64(64 - columns), np.uint64(columns - 1)
    for w in range(last + 1):
        resting = now[RESTING_IN_HOLES, w]
        if not walking:
            resting |= now[NOW_WALKERS, w]
        motion = move_movers(
            now[NOW_RIGHT, w],
            now[NOW_LEFT, w],
            resting,
            now[ALL_FIXED, w],
            now[YIELDS, w] if ahead == 0 else _ZERO,
            now[VEHICLE, w] if ahead == 0 else _ZERO,
            left_edge,
            right_edge,
        )
        if stands and ahead == 0:
            motion = brake(motion, now[VEHICLE, w], now[BRAKES, w])
        if now[NOW_WALKERS, w]:
            now[NOW_WALKERS, w] = followed_board(now[NOW_WALKERS, w], motion)
        now[NOW_RIGHT, w] = motion.right
        now[NOW_LEFT, w] = motion.left
        layers[ahead, BLOCKED, w] = motion.right | motion.left | now[ALL_FIXED, w]
        layers[ahead, MOVERS, w] = motion.right | motion.left
        layers[ahead, CAME_RIGHT, w] = motion.came_right
        layers[ahead, CAME_LEFT, w] = motion.came_left
        right, left = motion.came_right & swept, motion.came_left & swept
        cut_left, cut_right = cut_off(right, left, right >> most >> _ONE, left >> most >> _ONE)
        layers[ahead, CUT_LEFT, w] = cut_left
        layers[ahead, CUT_RIGHT, w] = cut_right
        if w > 0:
            # The first row of a word lies behind the last one of the word before.
            layers[ahead, CUT_LEFT, w - 1] |= right << up >> unused
            layers[ahead, CUT_RIGHT, w - 1] |= left << up >> unused


@compiled
def someone_brakes(now, layers, last):
    """Whether a mover brakes if the ego stays now; layer 0 holds the movers' tick where it does not."""
    changed = _ZERO
    for w in range(last + 1):
        right, left = layers[0, CAME_RIGHT, w], layers[0, CAME_LEFT, w]
        braked = brake(Motion(right, left, right, left), now[VEHICLE, w], now[BRAKES, w])
        changed |= right ^ braked.came_right | left ^ braked.came_left
    return changed != _ZERO


@compiled
def one_row_on(board, w, last, columns):
    """Word `w` of a board moved one row towards the destination; no word is beyond `last`."""
    ahead = board[w] >> np.uint64(columns - 1) >> _ONE
    if w < last:
        # The first row of the next word comes last in this one.
        unused = np.uint64(64 % columns)
        ahead |= (board[w + 1] << np.uint64(64 - columns)) >> unused
    return ahead


@compiled
def one_row_back(board, w, columns):
    """Word `w` of a board moved one row away from the destination; bits that no cell has stay empty."""
    unused = np.uint64(64 % columns)
    behind = board[w] << np.uint64(columns - 1) << _ONE << unused >> unused
    if w > 0:
        behind |= board[w - 1] >> np.uint64(64 - columns - 64 % columns)
    return behind


@compiled
def expand(layers, ahead, first, last, columns, left_edge, right_edge):
    """Step the reached set over one tick, from word `first` on; whether it is not empty."""
    alive = _ZERO
    unused, up = np.uint64(64 % columns), np.uint64(64 - columns)
    if first > 0:
        layers[ahead + 1, REACHED, first - 1] = _ZERO  # read when the next word comes into reach
    for w in range(first, last + 1):
        start = layers[ahead, REACHED, w]
        on = start >> np.uint64(columns - 1) >> _ONE
        if w < last:
            on |= layers[ahead, REACHED, w + 1] << up >> unused
        after = spread(
            start,
            on,
            layers[ahead, BLOCKED, w],
            layers[ahead, CAME_RIGHT, w],
            layers[ahead, CAME_LEFT, w],
            layers[ahead, CUT_LEFT, w],
            layers[ahead, CUT_RIGHT, w],
            left_edge,
            right_edge,
        )
        layers[ahead + 1, REACHED, w] = after
        alive |= after
    return alive != _ZERO


@compiled
def search(now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands):
    """Roll and expand until the goal is met. With `stands` the ego stays in the first tick, and may.

    Returns (ticks, −1 if it is not met; layers rolled; ticks for which one can keep clear of collisions).
    """
    begin = 1 if stands else 0
    if stands:
        roll(now, layers, 0, last, episode_tick, columns, left_edge, right_edge, swept, stands)
    for w in range(last + 1):
        layers[begin, REACHED, w] = now[VEHICLE, w]
    goal = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    rows_per_word = 64 // columns
    # Words before `first` cannot hold the ego yet: it gains a row a tick.
    first = row // rows_per_word
    for ahead in range(begin, limit):
        roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands)
        if first > 0 and row - ahead - 1 < first * rows_per_word:
            first -= 1
        alive = expand(layers, ahead, first, last, columns, left_edge, right_edge)
        if first == 0 and layers[ahead + 1, REACHED, 0] & goal:
            return ahead + 1, ahead + 1, ahead + 1
        if not alive:
            return -1, ahead + 1, ahead
    return -1, limit, limit


@compiled
def keep_shortest(layers, ticks, row, last, columns, left_edge, right_edge):
    """The backward pass: of every layer, the reached cells that lie on a way of so many ticks."""
    rows_per_word = 64 // columns
    down = np.uint64(64 - columns - 64 % columns)
    goal = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    for w in range(last + 1):
        layers[ticks, NEEDED, w] = _ZERO
    layers[ticks, NEEDED, 0] = layers[ticks, REACHED, 0] & goal
    # What is needed at a tick can neither be further on than the ego gets, nor too far back to arrive.
    nearest, furthest = 0, 0
    for ahead in range(ticks - 1, 0, -1):
        while (nearest + 1) * rows_per_word <= row - ahead:
            layers[ahead, NEEDED, nearest] = _ZERO
            nearest += 1
        if furthest < last and (furthest + 1) * rows_per_word <= ticks - ahead:
            furthest += 1
        if nearest > 0:
            layers[ahead, NEEDED, nearest - 1] = _ZERO
        if furthest < last:
            layers[ahead, NEEDED, furthest + 1] = _ZERO
        on_before = _ZERO  # of the word before: its last row leads to the first of the next
        for w in range(max(0, nearest - 1), furthest + 1):
            beside, on = spread_back(
                layers[ahead + 1, NEEDED, w],
                layers[ahead, CAME_RIGHT, w],
                layers[ahead, CAME_LEFT, w],
                layers[ahead, CUT_LEFT, w],
                layers[ahead, CUT_RIGHT, w],
                left_edge,
                right_edge,
            )
            if w >= nearest:
                kept = beside | on << np.uint64(columns - 1) << _ONE | on_before >> down
                layers[ahead, NEEDED, w] = kept & layers[ahead, REACHED, w]
            on_before = on


@compiled
def crossings(layers, ahead, row, columns):
    """The columns of a row from which a diagonal to the left, or right, is cut off, as bits."""
    rows_per_word = 64 // columns
    w, shift = (row - 1) // rows_per_word, np.uint64((row - 1) % rows_per_word * columns)
    return layers[ahead, CUT_LEFT, w] >> shift, layers[ahead, CUT_RIGHT, w] >> shift


@compiled
def step_from(layers, ahead, cell, columns):
    """The move that stays on a shortest way from a cell, and where it leads; ties in the order of moves."""
    rows_per_word = 64 // columns
    row, column = cell // columns, cell % columns
    w = row // rows_per_word
    shift = np.uint64(row % rows_per_word * columns + column)
    came_right = layers[ahead, CAME_RIGHT, w] >> shift & _ONE
    came_left = layers[ahead, CAME_LEFT, w] >> shift & _ONE
    cut_left, cut_right = crossings(layers, ahead, row, columns)
    cut_left, cut_right = cut_left >> np.uint64(column) & _ONE, cut_right >> np.uint64(column) & _ONE
    for move in range(6):
        sideways = -1 if move == 1 or move == 3 else 1 if move == 2 or move == 4 else 0
        on = 1 if move == 0 or move == 3 or move == 4 else 0
        to_row, to_column = row - on, column + sideways
        if to_row < 0 or to_column < 0 or to_column >= columns:
            continue
        if (move == 1 and came_right) or (move == 2 and came_left):
            continue
        if (move == 3 and cut_left) or (move == 4 and cut_right):
            continue
        to_word = to_row // rows_per_word
        to_shift = np.uint64(to_row % rows_per_word * columns + to_column)
        if layers[ahead + 1, NEEDED, to_word] >> to_shift & _ONE:
            return move, to_row * columns + to_column
    return -1, -1


@compiled
def first_step(now, layers, move, last, columns, left_edge, right_edge):
    """Put where a move leads now into layer 1; whether it meets nothing."""
    vehicle = now[VEHICLE]
    alive = _ZERO
    for w in range(last + 1):
        steps = free_steps(
            vehicle[w],
            one_row_on(vehicle, w, last, columns),
            layers[0, BLOCKED, w],
            layers[0, CAME_RIGHT, w],
            layers[0, CAME_LEFT, w],
            layers[0, CUT_LEFT, w],
            layers[0, CUT_RIGHT, w],
            left_edge,
            right_edge,
        )
        there = (
            steps.forward,
            steps.left,
            steps.right,
            steps.forward_left,
            steps.forward_right,
            steps.stay,
        )[move]
        layers[1, REACHED, w] = there
        alive |= there
    return alive != _ZERO


@compiled
def longest_survival(now, layers, rolled, last, columns, left_edge, right_edge):
    """The move after which one can keep clear longest within the layers rolled, and for how many ticks.

    Waiting and 0 if none is free.
    """
    best, best_ticks = STAY, 0
    for move in range(6):
        alive = first_step(now, layers, move, last, columns, left_edge, right_edge)
        ticks = 1 if alive else 0
        while alive and ticks < rolled:
            alive = expand(layers, ticks, 0, last, columns, left_edge, right_edge)
            if alive:
                ticks += 1
        if ticks > best_ticks:
            best, best_ticks = move, ticks
        if best_ticks >= rolled:
            break  # no move can last longer
    return best, best_ticks


@compiled
def exact_moves(state, lanes, shares, columns, rows, left_edge, right_edge, count, moves, ticks):
    """For every lane the move of the exact planner and the least ticks to the goal (−1: no way)."""
    words = -(-rows // (64 // columns))
    now = np.empty((BOARDS, words), np.uint64)
    layers = np.empty((max_ticks(rows) + 3, FIELDS, words), np.uint64)
    for lane in range(count):
        block, inner = state[lane // LANES], lane % LANES
        lane_block = lanes[lane // LANES]
        moves[lane], ticks[lane] = STAY, 0
        if lane_block[OUTCOME * LANES + inner]:
            continue
        last = prepare(now, block, lane_block, inner, columns, rows, shares[lane], 0)
        episode_tick = np.int64(lane_block[EPISODE_TICK * LANES + inner])
        limit = steps_left(rows, episode_tick)
        swept = lane_block[SWEPT * LANES + inner]
        cell = np.int64(lane_block[CELL * LANES + inner])
        row = cell // columns
        least, rolled, lasted = search(
            now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, False
        )
        if least >= 0:
            keep_shortest(layers, least, row, last, columns, left_edge, right_edge)
            move = step_from(layers, 0, cell, columns)[0]
        else:
            move, lasted = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)
        if someone_brakes(now, layers, last):
            prepare(now, block, lane_block, inner, columns, rows, shares[lane], 0)
            stayed, _, kept_clear = search(
                now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, True
            )
            # Staying comes last in the order of moves: it has to be better.
            if stayed >= 0 and (least < 0 or stayed < least):
                least, move = stayed, STAY
            elif least < 0 and kept_clear > lasted:
                move = STAY
        moves[lane], ticks[lane] = move, least


@compiled
def drivable(block, lane_block, lane, columns, rows, shares):
    """Whether a lane's vehicle can reach row 0 in time if nobody gives way after the first tick or brakes."""
    rows_per_word = 64 // columns
    words = -(-rows // rows_per_word)
    first_column = np.uint64(0)
    for row in range(rows_per_word):
        first_column |= _ONE << np.uint64(row * columns)
    now = np.empty((BOARDS, words), np.uint64)
    layers = np.empty((max_ticks(rows) + 3, FIELDS, words), np.uint64)
    last = prepare(now, block, lane_block, lane, columns, rows, shares, 0)
    row = np.int64(lane_block[CELL * LANES + lane]) // columns
    episode_tick = np.int64(lane_block[EPISODE_TICK * LANES + lane])
    limit = steps_left(rows, episode_tick)
    last_column = first_column << np.uint64(columns - 1)
    swept = lane_block[SWEPT * LANES + lane]
    found = search(
        now, layers, row, last, episode_tick, limit, columns, first_column, last_column, swept, False
    )
    return found[0] >= 0
