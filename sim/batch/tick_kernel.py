"""Many ticks of many worlds in one call: movers, the rule planner (or moves handed in), commit, judge.

One text is specialised in several ways, so that a batch without pedestrians, courtesy or held
results does not pay for them. All loops over lanes are written so that a compiler turns them into
instructions on several worlds at once; only what is rare is handled lane by lane: a mover that brakes, a
situation to be kept or compared, the end of an episode.

Array arguments of the kernel (lane planes are read at `PLANE * LANES + lane`, `sim.batch.layout`):

- `state`, `first_state` (blocks, words · `PLANES` · `LANES`; uint64): boards now, and of the first roads;
  `boards` is one block of them;
- `lanes`, `first_lanes` (blocks, `LANE_PLANES` · `LANES`; uint64): what a world has once; `v` is one block;
- `wholes` (lanes, 8; int64), `shares` (lanes, 4; float64): numbers and probabilities, by column;
- `left_edge`, `right_edge` (uint64): the first and the last column of a word; `ticks`: how many are run;
- `queue` (episodes, 3; uint64): the episodes of a relay, by the columns that `sim.batch.layout` names.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Final

import numpy as np

from sim.batch.compiled import (
    brake,
    cut_off,
    first_bit,
    followed_board,
    free_steps,
    max_ticks,
    move_movers,
    pedestrians_walk,
)
from sim.batch.layout import (
    ASKED,
    ATTENTIVE,
    ATTENTIVE_KEY,
    BRAKING,
    CAME_LEFT,
    CAME_LEFT_AHEAD,
    CAME_RIGHT,
    CAME_RIGHT_AHEAD,
    CELL,
    COLUMN_BIT,
    COURTESY,
    COURTESY_KEY,
    ENDS,
    EPISODE_TICK,
    FIXED,
    HELD_BACK,
    HOLD_TICKS,
    HOLES,
    IN_ROW,
    KEPT_AT,
    KEPT_LEFT,
    KEPT_LEFT_AHEAD,
    KEPT_RIGHT,
    KEPT_RIGHT_AHEAD,
    KEPT_WALKERS,
    KEPT_WALKERS_AHEAD,
    LANES,
    LEFT,
    MOVES,
    NEXT_ROW,
    OUTCOME,
    OWN_ROW,
    PLANES,
    QUEUE_MOVES,
    QUEUE_OUTCOME,
    QUEUE_SEED,
    RIGHT,
    SEED,
    SHIFT,
    SINCE_END,
    SWEPT,
    TICKS_TO_GOAL,
    WALKERS,
    WATCHING,
    WORD,
    YIELDING,
)
from sim.batch.roads import begin, begin_next
from sim.compilation import compiled, fraction, word_at
from sim.rules.mover_boards import PERIODS
from sim.rules.traffic import Motion
from sim.types import Kind

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)

RUNNING, SUCCESS, CRASH, STUCK = (np.uint64(code) for code in range(4))
"""Outcomes, in the order of `sim.types.Outcome`."""

MOVE_FIELD: Final = 16
"""Bits of each of the four counters in `MOVES`: forward, sideways, diagonal, stay."""
END_FIELD: Final = 16
"""Bits of each of the three counters in `ENDS`: success, crash, stuck."""
MAX_TICKS_A_CALL: Final = 2**MOVE_FIELD - 1
"""So that no counter overflows before it is emptied."""

_PERIOD: Final = np.uint64(PERIODS[Kind.PEDESTRIAN])
# What was kept in one tick cannot be what is so in the next, so it is first compared after two.
assert PERIODS[Kind.PEDESTRIAN] > 1


@compiled
def _hold_back(boards, v, i, walking):
    """Undo the step of the mover that entered the cell of lane `i`, which stands: it has braked."""
    at = np.int64(v[WORD * LANES + i]) * PLANES * LANES + i
    standing = v[HELD_BACK * LANES + i] << v[SHIFT * LANES + i]
    right, left = boards[at + RIGHT * LANES], boards[at + LEFT * LANES]
    motion = brake(Motion(right, left, v[CAME_RIGHT * LANES + i], v[CAME_LEFT * LANES + i]), standing, _ALL)
    boards[at + RIGHT * LANES] = motion.right
    boards[at + LEFT * LANES] = motion.left
    if walking and boards[at + WALKERS * LANES] & standing:
        boards[at + WALKERS * LANES] ^= (right | left) ^ (motion.right | motion.left)


@compiled
def _offsets(v, i):
    """Where a lane's two rows lie: the offsets of their words among the boards."""
    word = np.int64(v[WORD * LANES + i])
    word_ahead = word - (1 if v[SHIFT * LANES + i] == _ZERO else 0)
    return word * PLANES * LANES + i, word_ahead * PLANES * LANES + i


@compiled
def _keep(boards, v, i, spot, walking):
    """Keep the situation of lane `i`. `spot`: its cell and beat, as in `KEPT_AT`."""
    own, ahead = _offsets(v, i)
    v[KEPT_AT * LANES + i] = spot
    v[KEPT_RIGHT * LANES + i] = boards[own + RIGHT * LANES]
    v[KEPT_LEFT * LANES + i] = boards[own + LEFT * LANES]
    v[KEPT_RIGHT_AHEAD * LANES + i] = boards[ahead + RIGHT * LANES]
    v[KEPT_LEFT_AHEAD * LANES + i] = boards[ahead + LEFT * LANES]
    if walking:
        v[KEPT_WALKERS * LANES + i] = boards[own + WALKERS * LANES]
        v[KEPT_WALKERS_AHEAD * LANES + i] = boards[ahead + WALKERS * LANES]


@compiled
def _repeats(boards, v, i, columns, walking):
    """Whether the rows of lane `i`, which has not left its row, hold what they held when it was kept."""
    own, ahead = _offsets(v, i)
    differ = boards[own + RIGHT * LANES] ^ v[KEPT_RIGHT * LANES + i]
    differ |= boards[own + LEFT * LANES] ^ v[KEPT_LEFT * LANES + i]
    differ_ahead = boards[ahead + RIGHT * LANES] ^ v[KEPT_RIGHT_AHEAD * LANES + i]
    differ_ahead |= boards[ahead + LEFT * LANES] ^ v[KEPT_LEFT_AHEAD * LANES + i]
    if walking:
        differ |= boards[own + WALKERS * LANES] ^ v[KEPT_WALKERS * LANES + i]
        differ_ahead |= boards[ahead + WALKERS * LANES] ^ v[KEPT_WALKERS_AHEAD * LANES + i]
    row = ((_ONE << np.uint64(columns - 1)) << _ONE) - _ONE
    shift = v[SHIFT * LANES + i]
    top = np.uint64((64 // columns - 1) * columns)
    shift_ahead = top if shift == _ZERO else shift - np.uint64(columns)
    return (differ >> shift | differ_ahead >> shift_ahead) & row == _ZERO


@compiled
def _all_ended(v):
    """Whether no lane of a block is running."""
    running = 0
    for i in range(LANES):
        running += v[OUTCOME * LANES + i] == RUNNING
    return running == 0


@compiled
def _let_pass(v, ticks, watching):
    """So many ticks of lanes that have all ended, and for which nothing begins: only clocks go on."""
    for i in range(LANES):
        v[EPISODE_TICK * LANES + i] += ticks
        v[SINCE_END * LANES + i] += ticks
        if watching:
            v[IN_ROW * LANES + i] += ticks


@cache
def ticks_kernel(
    *,
    walking: bool,
    courteous: bool,
    bodily: bool,
    watching: bool,
    held: bool,
    asked: bool,
    renewed: bool,
    relayed: bool = False,
) -> Any:
    """The compiled loop for batches with or without any of these.

    `walking`: pedestrians. `courteous`: movers who give way or brake by chance. `bodily`: swept bodies, or
    movers who brake; which, says each lane. `watching`: lanes that are STUCK when a situation repeats.
    `held`: an ended lane stands for its hold ticks, then (if `renewed`) its next road begins; otherwise
    an ended lane starts its first road again in the same tick. `asked`: moves are handed in; otherwise the
    rule planner decides. `relayed`: an ended lane begins the next episode of the queue, until all have ended;
    the lanes of the one block have begun its first episodes.
    """

    def run(
        state,
        first_state,
        lanes,
        first_lanes,
        wholes,
        shares,
        columns,
        rows,
        left_edge,
        right_edge,
        ticks,
        queue,
    ):
        rows_per_word = 64 // columns
        words = -(-rows // rows_per_word)
        row_size = np.uint64(columns)
        top = np.uint64((rows_per_word - 1) * columns)
        last_bit = _ONE << np.uint64(columns - 1)
        limit = np.uint64(max_ticks(rows))
        end_field = np.uint64(END_FIELD)
        sideways = _ONE << np.uint64(MOVE_FIELD)
        diagonal = _ONE << np.uint64(2 * MOVE_FIELD)
        waited = _ONE << np.uint64(3 * MOVE_FIELD)
        # Of a relay: the episode of each lane, the next one to begin, and how many have not ended.
        episode, following, left_over = np.arange(LANES), LANES, len(queue)
        for block in range(state.shape[0]):
            boards, v = state[block], lanes[block]
            for done in range(ticks):
                if relayed and left_over == 0:
                    break
                if held and not renewed and _all_ended(v):
                    _let_pass(v, np.uint64(ticks - done), watching)
                    break
                for i in range(LANES):
                    v[OWN_ROW * LANES + i] = _ZERO
                    v[NEXT_ROW * LANES + i] = _ZERO
                    v[CAME_RIGHT * LANES + i] = _ZERO
                    v[CAME_LEFT * LANES + i] = _ZERO
                    if bodily:
                        v[CAME_RIGHT_AHEAD * LANES + i] = _ZERO
                        v[CAME_LEFT_AHEAD * LANES + i] = _ZERO
                if courteous:
                    for i in range(LANES):
                        bit, cell = v[COLUMN_BIT * LANES + i], np.int64(v[CELL * LANES + i])
                        draws = word_at(v[COURTESY_KEY * LANES + i], np.int64(v[EPISODE_TICK * LANES + i]))
                        share = shares[block * LANES + i, COURTESY]
                        yields = _ZERO
                        if fraction(word_at(draws, cell - 1)) < share:
                            yields |= (bit & ~_ONE) >> _ONE
                        if fraction(word_at(draws, cell + 1)) < share:
                            yields |= (bit & ~last_bit) << _ONE
                        v[YIELDING * LANES + i] = yields
                for w in range(words):
                    x = boards[w * PLANES * LANES : (w + 1) * PLANES * LANES]
                    this_word = np.uint64(w)
                    for i in range(LANES):
                        right, left = x[RIGHT * LANES + i], x[LEFT * LANES + i]
                        fixed = x[FIXED * LANES + i]
                        shift = v[SHIFT * LANES + i]
                        word = v[WORD * LANES + i]
                        here = word == this_word
                        ahead = word - (_ONE if shift == _ZERO else _ZERO) == this_word
                        resting = (right | left) & x[HOLES * LANES + i]
                        yielding = vehicle = _ZERO
                        if walking:
                            walkers = x[WALKERS * LANES + i]
                            step = pedestrians_walk(np.int64(v[EPISODE_TICK * LANES + i]))
                            resting |= _ZERO if step else walkers
                        if courteous:
                            yielding = v[YIELDING * LANES + i] << shift if here else _ZERO
                            vehicle = v[COLUMN_BIT * LANES + i] << shift if here else _ZERO
                        motion = move_movers(
                            right, left, resting, fixed, yielding, vehicle, left_edge, right_edge
                        )
                        if held:
                            live = v[OUTCOME * LANES + i] == RUNNING
                            moved = _ALL if live else _ZERO
                            motion = Motion(
                                motion.right & moved | right & ~moved,
                                motion.left & moved | left & ~moved,
                                motion.came_right & moved,
                                motion.came_left & moved,
                            )
                        if walking:
                            x[WALKERS * LANES + i] = followed_board(walkers, motion)
                        x[RIGHT * LANES + i] = motion.right
                        x[LEFT * LANES + i] = motion.left
                        blocked = motion.right | motion.left | fixed
                        v[OWN_ROW * LANES + i] = blocked if here else v[OWN_ROW * LANES + i]
                        v[NEXT_ROW * LANES + i] = blocked if ahead else v[NEXT_ROW * LANES + i]
                        v[CAME_RIGHT * LANES + i] = motion.came_right if here else v[CAME_RIGHT * LANES + i]
                        v[CAME_LEFT * LANES + i] = motion.came_left if here else v[CAME_LEFT * LANES + i]
                        if bodily:
                            came_right, came_left = motion.came_right, motion.came_left
                            kept = v[CAME_RIGHT_AHEAD * LANES + i]
                            v[CAME_RIGHT_AHEAD * LANES + i] = came_right if ahead else kept
                            kept = v[CAME_LEFT_AHEAD * LANES + i]
                            v[CAME_LEFT_AHEAD * LANES + i] = came_left if ahead else kept
                ended = braking = met = due = _ZERO  # lanes that need more, as bits
                for i in range(LANES):
                    shift, word = v[SHIFT * LANES + i], v[WORD * LANES + i]
                    bit, cell = v[COLUMN_BIT * LANES + i], v[CELL * LANES + i]
                    carried = shift == _ZERO
                    shift_ahead = top if carried else shift - row_size
                    word_ahead = word - (_ONE if carried else _ZERO)
                    came_right = v[CAME_RIGHT * LANES + i] >> shift
                    came_left = v[CAME_LEFT * LANES + i] >> shift
                    cut_left = cut_right = held_back = _ZERO
                    if bodily:
                        swept = v[SWEPT * LANES + i]
                        cut_left, cut_right = cut_off(
                            v[CAME_RIGHT_AHEAD * LANES + i] >> shift_ahead & swept,
                            v[CAME_LEFT_AHEAD * LANES + i] >> shift_ahead & swept,
                            came_right & swept,
                            came_left & swept,
                        )
                        attentive = v[BRAKING * LANES + i]
                        if courteous:
                            draws = word_at(
                                v[ATTENTIVE_KEY * LANES + i], np.int64(v[EPISODE_TICK * LANES + i])
                            )
                            share = shares[block * LANES + i, ATTENTIVE]
                            attentive = _ZERO
                            if fraction(word_at(draws, np.int64(cell) - 1)) < share:
                                attentive |= bit >> _ONE
                            if fraction(word_at(draws, np.int64(cell) + 1)) < share:
                                attentive |= bit << _ONE
                        braked = brake(Motion(came_right, came_left, came_right, came_left), bit, attentive)
                        held_back = came_right ^ braked.came_right | came_left ^ braked.came_left
                    own = free_steps(
                        bit,
                        _ZERO,
                        v[OWN_ROW * LANES + i] >> shift,
                        came_right,
                        came_left,
                        _ZERO,
                        _ZERO,
                        _ONE,
                        last_bit,
                    )
                    on = free_steps(
                        _ZERO,
                        bit,
                        v[NEXT_ROW * LANES + i] >> shift_ahead,
                        _ZERO,
                        _ZERO,
                        cut_left,
                        cut_right,
                        _ONE,
                        last_bit,
                    )
                    free_stay = own.stay | held_back  # where a mover would enter, nothing else stands
                    if asked:
                        move = v[ASKED * LANES + i]
                        leads_left = (bit & ~_ONE) >> _ONE
                        leads_right = (bit & ~last_bit) << _ONE
                        to_left = (move == np.uint64(1)) | (move == np.uint64(3))
                        to_right = (move == np.uint64(2)) | (move == np.uint64(4))
                        leads = leads_left if to_left else (leads_right if to_right else bit)
                        on_road = leads != _ZERO  # a move off the road is a wait
                        goes_straight = move == np.uint64(0)
                        goes_beside = on_road & ((move == np.uint64(1)) | (move == np.uint64(2)))
                        goes_aslant = on_road & ((move == np.uint64(3)) | (move == np.uint64(4)))
                        goes_on = goes_straight | goes_aslant
                        stays = (not goes_on) & (not goes_beside)
                        bit_after = leads if on_road else bit
                        free_on = on.forward | on.forward_left | on.forward_right
                        free_beside = own.left | own.right
                        free = free_on if goes_on else (free_beside if goes_beside else free_stay)
                        crashed = (free & bit_after) == _ZERO
                    else:
                        beside = own.left if own.left != _ZERO else own.right
                        aslant = on.forward_left if on.forward_left != _ZERO else on.forward_right
                        goes_straight = on.forward != _ZERO
                        goes_beside = (on.forward == _ZERO) & (beside != _ZERO)
                        goes_aslant = (on.forward == _ZERO) & (beside == _ZERO) & (aslant != _ZERO)
                        goes_on = goes_straight | goes_aslant
                        bit_after = on.forward if goes_straight else beside
                        bit_after = aslant if goes_aslant else bit_after
                        stays = (not goes_straight) & (not goes_beside) & (not goes_aslant)
                        bit_after = bit if stays else bit_after
                        crashed = stays & (free_stay == _ZERO)
                    count = _ONE if goes_straight else waited
                    count = sideways if goes_beside else count
                    count = diagonal if goes_aslant else count
                    cell_after = cell - (row_size if goes_on else _ZERO)
                    cell_after = cell_after + (_ONE if bit_after > bit else _ZERO)
                    cell_after = cell_after - (_ONE if bit_after < bit else _ZERO)
                    tick = v[EPISODE_TICK * LANES + i] + _ONE
                    outcome = STUCK if tick > limit else RUNNING
                    outcome = SUCCESS if cell_after < row_size else outcome
                    outcome = CRASH if crashed else outcome
                    ending = _ONE << (outcome - _ONE) * end_field if outcome != RUNNING else _ZERO
                    arriving = tick if outcome == SUCCESS else _ZERO
                    if held:
                        live = v[OUTCOME * LANES + i] == RUNNING
                        ending = ending if live else _ZERO
                        arriving = arriving if live else _ZERO
                        goes_on = goes_on & live
                        bit_after = bit_after if live else bit
                        cell_after = cell_after if live else cell
                        count = count if live else _ZERO
                        outcome = outcome if live else v[OUTCOME * LANES + i]
                        since = v[SINCE_END * LANES + i]
                        v[SINCE_END * LANES + i] = since if live else since + _ONE
                    v[COLUMN_BIT * LANES + i] = bit_after
                    v[SHIFT * LANES + i] = shift_ahead if goes_on else shift
                    v[WORD * LANES + i] = word_ahead if goes_on else word
                    v[CELL * LANES + i] = cell_after
                    v[EPISODE_TICK * LANES + i] = tick
                    v[MOVES * LANES + i] += count
                    v[ENDS * LANES + i] += ending
                    v[TICKS_TO_GOAL * LANES + i] += arriving
                    v[OUTCOME * LANES + i] = outcome
                    this_lane = _ONE << np.uint64(i)
                    ended |= this_lane if outcome != RUNNING else _ZERO
                    if bodily:
                        held_back = held_back if stays else _ZERO
                        v[HELD_BACK * LANES + i] = held_back
                        braking |= this_lane if held_back != _ZERO else _ZERO
                    if watching:
                        in_row = _ZERO if goes_on else v[IN_ROW * LANES + i] + _ONE
                        v[IN_ROW * LANES + i] = in_row
                        spot = cell_after << _ONE | tick % _PERIOD
                        watched = v[WATCHING * LANES + i] if outcome == RUNNING else _ZERO
                        again = (in_row > _ONE) & (v[KEPT_AT * LANES + i] == spot)
                        met |= watched & this_lane if again else _ZERO
                        renewed_now = (in_row > _ZERO) & (in_row & (in_row + _ONE) == _ZERO)
                        due |= watched & this_lane if renewed_now else _ZERO
                while bodily and braking != _ZERO:
                    i = first_bit(braking)
                    braking &= braking - _ONE
                    _hold_back(boards, v, i, walking)
                while watching and met != _ZERO:
                    i = first_bit(met)
                    met &= met - _ONE
                    if _repeats(boards, v, i, columns, walking):
                        v[OUTCOME * LANES + i] = STUCK
                        v[ENDS * LANES + i] += _ONE << (STUCK - _ONE) * end_field
                        ended |= _ONE << np.uint64(i)
                while watching and due != _ZERO:
                    i = first_bit(due)
                    due &= due - _ONE
                    beat = v[EPISODE_TICK * LANES + i] % _PERIOD
                    _keep(boards, v, i, v[CELL * LANES + i] << _ONE | beat, walking)
                while ended != _ZERO:
                    i = first_bit(ended)
                    ended &= ended - _ONE
                    if held:
                        lane = block * LANES + i
                        if renewed and v[SINCE_END * LANES + i] == np.uint64(wholes[lane, HOLD_TICKS]):
                            begin_next(boards, v, i, columns, rows, wholes[lane], shares[lane])
                    elif relayed:
                        if episode[i] < len(queue):
                            queue[episode[i], QUEUE_OUTCOME] = v[OUTCOME * LANES + i]
                            queue[episode[i], QUEUE_MOVES] = v[MOVES * LANES + i]
                            left_over -= 1
                        episode[i] = following  # past the end: the last road is driven again, for nobody
                        if following < len(queue):
                            wholes[i, SEED] = np.int64(queue[following, QUEUE_SEED])
                            following += 1
                        v[MOVES * LANES + i] = _ZERO
                        if not begin(boards, v, i, columns, rows, wholes[i], shares[i]):
                            queue[episode[i], QUEUE_OUTCOME] = _ALL
                            return
                    else:
                        first, u = first_state[block], first_lanes[block]
                        v[WORD * LANES + i] = u[WORD * LANES + i]
                        v[SHIFT * LANES + i] = u[SHIFT * LANES + i]
                        v[COLUMN_BIT * LANES + i] = u[COLUMN_BIT * LANES + i]
                        v[CELL * LANES + i] = u[CELL * LANES + i]
                        v[EPISODE_TICK * LANES + i] = u[EPISODE_TICK * LANES + i]
                        v[OUTCOME * LANES + i] = RUNNING
                        v[IN_ROW * LANES + i] = _ALL
                        for w in range(words):
                            at = w * PLANES * LANES + i
                            boards[at + RIGHT * LANES] = first[at + RIGHT * LANES]
                            boards[at + LEFT * LANES] = first[at + LEFT * LANES]
                            if walking:
                                boards[at + WALKERS * LANES] = first[at + WALKERS * LANES]

    return compiled(run)
