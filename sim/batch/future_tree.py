"""The tree of futures of a moment where it is left to chance who reacts, in compiled words: how it grows.

Structure: as `sim.explain.futures`, in the same order, so that every share is the same one. A node is the
vehicle's cell and what its own row holds (`sim.batch.row_motion`); nodes that hold the same at the same tick
are one.

Array arguments, besides those of `sim.batch.row_motion` and `sim.batch.row_rules`:

- `nodes` (nodes, words; uint64): `row_words` of the vehicle's row, then of each row behind it whose movers it
  keeps clear of; `facts` (nodes, 5; int64): see `AHEAD`;
- `costs`: (scratch, size, weights) as in `sim.batch.row_costs`;
- `edges` (edges; int32) with `shares` (edges; float64): where a node leads, and the chance of it;
- `slots` (a power of two; int32): nodes by what they hold, −1 where there is none;
- `counts` (3; int64): nodes, ticks rolled, whether it is known from where the goal may be reached;
- `totals` (3; int64): work, nodes that branch, edges;
- `chances` (2, 3, 3; float64): for courtesy and attentiveness, the chance that so many of so many movers
  beside the vehicle react, by number beside and number that react;
- `seen` (3; uint64): whether it is known who reacts in the first tick, who gives way then, and who brakes.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER
from sim.batch.compiled import followed_board, pedestrians_walk
from sim.batch.row_costs import cheapest_move, put_row, put_vehicle
from sim.batch.row_motion import (
    LEFT,
    RIGHT,
    STAY,
    WALKERS,
    braked_motion,
    free_moves,
    roll_rows,
    row_motion,
)
from sim.batch.row_rules import BY_COST, made_move
from sim.compilation import compiled, word_at
from sim.types import Outcome

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)

RUNNING, SUCCESS, CRASH, STUCK = (list(Outcome).index(each) for each in Outcome)
SHUT_OFF: Final = 4
"""The outcome of a future in which no way leads to the goal any more."""

AHEAD, OUTCOME, FIRST_EDGE, EDGES, CELL = range(5)
"""Columns of `facts`: ticks from now, how it stands, the edges that lead on (none looked for yet: −1), and
the vehicle's cell."""
MOST_WAYS: Final = 16


@compiled
def _slot(slots, nodes, facts, made):
    """Where a node that holds the same as `made` stands among the slots, or would be put."""
    mask, width = np.uint64(slots.size - 1), nodes.shape[1]
    word = word_at(_ZERO, facts[made, CELL] * 4096 + facts[made, AHEAD] * 4 + facts[made, OUTCOME])
    for each in range(width):
        word = word_at(word ^ nodes[made, each], each)
    at = word & mask
    while True:
        node = slots[at]
        if node < 0:
            return at
        same = (
            facts[node, AHEAD] == facts[made, AHEAD]
            and facts[node, OUTCOME] == facts[made, OUTCOME]
            and facts[node, CELL] == facts[made, CELL]
        )
        for each in range(width):
            same = same and nodes[node, each] == nodes[made, each]
        if same:
            return at
        at = (at + _ONE) & mask


@compiled
def _decided_by_cost(tree, number, yields, brakes):
    """The move of a planner that goes by cost, in a node in which these movers react."""
    (_, nodes, facts, _, rolled, fixed, holes, _, costs, place) = tree
    columns, _, episode_tick, max_ticks, swept, _ = place
    scratch, size, weights = costs
    ahead, cell = facts[number, AHEAD], facts[number, CELL]
    row, now = cell // columns, scratch[0]
    for each in range(row):
        there = rolled[ahead, each]
        put_row(now, each, columns, there[RIGHT], there[LEFT], there[WALKERS], fixed[each], holes[each])
    last_row = min(row + max(1, weights[BUFFER]), fixed.size - 1)
    for each in range(row, last_row + 1):
        at = 3 * (each - row)
        right = left = walkers = _ZERO
        if at < nodes.shape[1]:  # without a buffer nothing is read of movers behind
            right, left = nodes[number, at + RIGHT], nodes[number, at + LEFT]
            walkers = nodes[number, at + WALKERS]
        put_row(now, each, columns, right, left, walkers, fixed[each], holes[each])
    put_vehicle(now, cell, columns, yields, brakes)
    limit = max_ticks + 1 - episode_tick - ahead
    tick = episode_tick + ahead
    return cheapest_move(scratch, size, fixed, cell, last_row, tick, limit, swept, weights, False)


@compiled
def _put_rows_behind(tree, number, made, on):
    """Write the rows behind the vehicle into a node that follows; `on`: whether it is one row further on."""
    (_, nodes, facts, _, _, fixed, holes, _, _, place) = tree
    columns, last_bit, episode_tick, _, _, _ = place
    row, ahead = facts[number, CELL] // columns, facts[number, AHEAD]
    walking = pedestrians_walk(episode_tick + ahead)
    shift = 3 if on else 0
    for at in range(3, nodes.shape[1] - shift, 3):
        behind = row + at // 3
        right, left = nodes[number, at + RIGHT], nodes[number, at + LEFT]
        walkers = nodes[number, at + WALKERS]
        if behind < fixed.size:
            motion = row_motion(
                right, left, walkers, holes[behind], fixed[behind], _ZERO, _ZERO, walking, last_bit
            )
            right, left = motion.right, motion.left
            walkers = followed_board(walkers, motion) if walkers else _ZERO
        nodes[made, at + shift + RIGHT], nodes[made, at + shift + LEFT] = right, left
        nodes[made, at + shift + WALKERS] = walkers


@compiled
def _grown(tree, planner, number, yields, brakes):
    """Take one tick from a node in which these movers react; the number of the node that it leads to."""
    (counts, nodes, facts, slots, rolled, fixed, holes, ways, _, place) = tree
    columns, last_bit, episode_tick, max_ticks, swept, start_row = place
    ahead, cell = facts[number, AHEAD], facts[number, CELL]
    row, column = cell // columns, cell % columns
    bit = _ONE << np.uint64(column)
    if ahead >= counts[1]:
        roll_rows(rolled, counts[1], ahead + 1, start_row, fixed, holes, episode_tick, last_bit)
        counts[1] = ahead + 1
    walkers, walking = nodes[number, WALKERS], pedestrians_walk(episode_tick + ahead)
    motion = row_motion(
        nodes[number, RIGHT],
        nodes[number, LEFT],
        walkers,
        holes[row],
        fixed[row],
        yields,
        bit,
        walking,
        last_bit,
    )
    braked = braked_motion(motion, bit, brakes)
    on = rolled[ahead + 1, row - 1]
    free = free_moves(bit, motion, braked, fixed[row], on, fixed[row - 1], swept, last_bit)
    if planner == BY_COST:
        move = np.int64(_decided_by_cost(tree, number, yields, brakes))
    else:
        move = made_move(planner, free, ways, row, column, columns, motion, on)
    crashed = move == STAY and not free >> STAY & 1
    if move == STAY:
        motion = braked
    made, end = counts[0], cell
    if move == 1 or move == 3:
        end -= 1
    elif move == 2 or move == 4:
        end += 1
    gone_on = move == 0 or move == 3 or move == 4
    own = 3 if gone_on else 0
    if gone_on:
        end -= columns
        nodes[made, :3] = on[:3]
    if own < nodes.shape[1]:
        nodes[made, own + RIGHT], nodes[made, own + LEFT] = motion.right, motion.left
        nodes[made, own + WALKERS] = followed_board(walkers, motion) if walkers else _ZERO
    _put_rows_behind(tree, number, made, gone_on)
    outcome = CRASH if crashed else RUNNING
    if not crashed:
        if end < columns:
            outcome = SUCCESS
        elif episode_tick + ahead + 1 > max_ticks:
            outcome = STUCK
    facts[made, AHEAD], facts[made, OUTCOME], facts[made, CELL] = ahead + 1, outcome, end
    at = _slot(slots, nodes, facts, made)
    if slots[at] < 0:
        slots[at] = made
        facts[made, FIRST_EDGE] = -1
        counts[0] += 1
    return slots[at]


@compiled
def _subset(near, which):
    """The movers of the subset `which` of those near (none, the first, the second, both)."""
    first = near & (~near + _ONE)
    if which == 0:
        return _ZERO
    if which == 1:
        return first
    return near ^ first if which == 2 else near


@compiled
def _ways_on(tree, number, chances, found, found_shares):
    """Write who may react in the coming tick: `found` (16, 2; uint64), with the chance of each; how many.

    What makes no difference to where anything goes is one way.
    """
    (_, nodes, facts, _, _, fixed, holes, _, _, place) = tree
    columns, last_bit, episode_tick, _, _, _ = place
    cell = facts[number, CELL]
    row, bit = cell // columns, _ONE << np.uint64(cell % columns)
    right, left, walkers = nodes[number, RIGHT], nodes[number, LEFT], nodes[number, WALKERS]
    near = ((bit & ~_ONE) >> _ONE | (bit & ~last_bit) << _ONE) & (right | left)
    beside = 0 if near == _ZERO else 1 if near & (near - _ONE) == _ZERO else 2
    walking = pedestrians_walk(episode_tick + facts[number, AHEAD])
    keys = np.empty((MOST_WAYS, 8), np.uint64)
    count, subsets = 0, 1 << beside
    for giving in range(subsets):
        reacting = 0 if giving == 0 else 2 if giving == 3 else 1
        chance = chances[0, beside, reacting]
        if chance == 0.0:
            continue
        yields = _subset(near, giving)
        motion = row_motion(right, left, walkers, holes[row], fixed[row], yields, bit, walking, last_bit)
        for braking in range(subsets):
            reacting = 0 if braking == 0 else 2 if braking == 3 else 1
            both = chance * chances[1, beside, reacting]
            if both == 0.0:
                continue
            brakes = _subset(near, braking)
            braked = braked_motion(motion, bit, brakes)
            same = -1
            for each in range(count):
                if (
                    keys[each, 0] == motion.right
                    and keys[each, 1] == motion.left
                    and keys[each, 2] == motion.came_right
                    and keys[each, 3] == motion.came_left
                    and keys[each, 4] == braked.right
                    and keys[each, 5] == braked.left
                    and keys[each, 6] == braked.came_right
                    and keys[each, 7] == braked.came_left
                ):
                    same = each
                    break
            if same >= 0:
                found_shares[same] += both
                continue
            keys[count, 0], keys[count, 1] = motion.right, motion.left
            keys[count, 2], keys[count, 3] = motion.came_right, motion.came_left
            keys[count, 4], keys[count, 5] = braked.right, braked.left
            keys[count, 6], keys[count, 7] = braked.came_right, braked.came_left
            found[count, 0], found[count, 1] = yields, brakes
            found_shares[count] = both
            count += 1
    return count


@compiled
def expand(tree, grown, planner, number, chances, seen):
    """Grow the edges of a node, unless that was done."""
    facts = tree[2]
    if facts[number, FIRST_EDGE] >= 0:
        return
    totals, edges, shares, found, found_shares = grown
    if number == 0 and seen[0] != _ZERO:
        found[0, 0], found[0, 1], found_shares[0] = seen[1], seen[2], 1.0
        count = 1
    else:
        count = _ways_on(tree, number, chances, found, found_shares)
    facts[number, FIRST_EDGE], facts[number, EDGES] = totals[2], count
    totals[1] += count > 1
    for each in range(count):
        at = totals[2]
        totals[2] += 1
        totals[0] += 1
        shares[at] = found_shares[each]
        edges[at] = _grown(tree, planner, number, found[each, 0], found[each, 1])
