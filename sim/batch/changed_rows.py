"""One decision by cost where a few rows are otherwise, by sweeping only what they change.

Movers keep to their rows. So a thing that goes, or comes, makes other only the movers of its own row and the
charges of the rows next to it. Of one road (the *base*) the cost of entering each cell, with the cheapest way
on, is kept. Where a row is otherwise, the rows before it (nearer to the destination) keep their costs; the
sweep begins at that row and goes on towards the vehicle. Behind the last row that is otherwise, the new costs
are compared with the old ones: if no way through a cell that costs otherwise was, or is, as cheap as the
cheapest, the move is the same, and the sweep ends.

Where no way leads to the destination, what lies beyond the vehicle's reach has no part in the move. If only
rows behind one that shuts the road are otherwise, there still is no way; then the move is one after which
the vehicle can keep clear longest, and a cell that no mover ever gets to is clear for ever.

Guarantee: the move of `sim.batch.one_decision.made_move`, which is taken wherever this does not answer.

Array arguments, besides those of `sim.batch.one_decision` (*known* rows: those up to the vehicle's, and as
many behind it as movers are kept clear of; *slots*: twice as many, of which the first half holds the base and
the second half what is otherwise):

- `slots` (2, known; int64): the slot of each row, for what is in it and for its costs;
- `lines` (slots, ticks, 3; uint64): a row's movers after each tick, see `STANDING`;
- `fixed` (slots; uint64): what never moves in a row;
- `entering` (slots, ticks + 1, columns + 2; int32): what entering each cell with a tick costs, and the way on
  from there; the outer columns are `FAR`;
- `getting` (known, ticks, columns + 2; int32): of the base, the least cost of getting to each cell with a
  tick, without what is charged for being there.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import (
    BUFFER,
    DIAGONAL,
    FAR,
    NEAR_FIXED,
    NEAR_MOVER,
    SIDEWAYS,
    TICK,
    WAITING,
    cheaper,
    make_scratch,
    totals_of_way,
)
from sim.batch.compiled import (
    beside,
    brake,
    cut_off,
    followed_board,
    max_ticks,
    move_movers,
    pedestrians_walk,
    spread_back,
)
from sim.batch.one_decision import made_move, take
from sim.batch.reachability import (
    ALL_FIXED,
    BLOCKED,
    BRAKES,
    CAME_LEFT,
    CAME_RIGHT,
    CUT_LEFT,
    CUT_RIGHT,
    MOVERS,
    NEEDED,
    NOW_LEFT,
    NOW_RIGHT,
    NOW_WALKERS,
    REACHED,
    RESTING_IN_HOLES,
    STAY,
    VEHICLE,
    YIELDS,
    expand,
    first_step,
    longest_survival,
    roll,
    search,
    someone_brakes,
)
from sim.batch.seen_otherwise import see
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)

STANDING, FROM_LEFT, FROM_RIGHT = range(3)
"""Of a row after a tick: the cells of its movers, and those entered by a step to the right, to the left."""

GOING, STANDING_STILL = range(2)
"""Rows of what is kept of a base: of every move as the movers go on; and of staying where a mover brakes for a
vehicle that stays."""
LEAST, MOVE, REACHED_ROW, SHUT_ROW, BRAKED = range(5)
"""Of the base (its columns): the least cost to the destination (`FAR`: no way) and the move, of the whole
decision in the second row. Where there is no way: the foremost row that the vehicle gets to, and the foremost
one from which nothing leads to the destination. In the first row, whether a mover brakes."""
FACTS: Final = 5
SPARE_TICKS: Final = 3
"""Ticks that are swept beyond what the cheapest way of the base can take, for ways that become dearer."""


@compiled
def _charged_rows(weights):
    """Rows to either side of a thing in which it is charged for."""
    return max(weights[BUFFER], 1 if weights[NEAR_FIXED] > 0 else 0)


@compiled
def _roll_row(line, fixed, slot, seen, row, ticks, episode_tick, columns, vehicle, stands):
    """Roll out the movers of one row; whether one brakes in the first tick for a vehicle that stays.

    `vehicle`: the vehicle's column, as a bit, in its own row; else none.
    """
    rows_per_word = 64 // columns
    w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
    right_edge = _ONE << np.uint64(columns - 1)
    mask = (right_edge << _ONE) - _ONE
    right, left = seen[NOW_RIGHT, w] >> shift & mask, seen[NOW_LEFT, w] >> shift & mask
    walkers, held = seen[NOW_WALKERS, w] >> shift & mask, seen[RESTING_IN_HOLES, w] >> shift & mask
    yielding, attentive = seen[YIELDS, w] >> shift & mask, seen[BRAKES, w] >> shift & mask
    stuck = seen[ALL_FIXED, w] >> shift & mask
    fixed[slot] = stuck
    brakes = False
    for ahead in range(ticks):
        resting = held
        if walkers and not pedestrians_walk(episode_tick + ahead):
            resting |= walkers
        there = vehicle if ahead == 0 else _ZERO
        motion = move_movers(right, left, resting, stuck, yielding, there, _ONE, right_edge)
        if there:
            braked = brake(motion, there, attentive)
            brakes = braked.came_right != motion.came_right or braked.came_left != motion.came_left
            if stands:
                motion = braked
        if walkers:
            walkers = followed_board(walkers, motion)
        right, left = motion.right, motion.left
        line[ahead, STANDING] = right | left
        line[ahead, FROM_LEFT] = motion.came_right
        line[ahead, FROM_RIGHT] = motion.came_left
    return brakes


@compiled
def _near_fixed(fixed, slots, row, columns):
    """The cells of a row with something fixed in or around them."""
    around = fixed[slots[0, row]] | fixed[slots[0, row + 1]]
    if row > 0:
        around |= fixed[slots[0, row - 1]]
    return beside(around, _ONE, _ONE << np.uint64(columns - 1))


@compiled
def _near_movers(lines, slots, row, ahead, distance, columns):
    """The cells of a row within so many cells of a mover after a tick."""
    movers = lines[slots[0, row], ahead, STANDING]
    for beyond in range(1, distance + 1):
        movers |= lines[slots[0, row + beyond], ahead, STANDING]
        if row >= beyond:
            movers |= lines[slots[0, row - beyond], ahead, STANDING]
    for _ in range(distance):
        movers = beside(movers, _ONE, _ONE << np.uint64(columns - 1))
    return movers


@compiled
def _charge(costs, slot, place, ahead, lines, slots, row, taken, near_fixed, weights, columns):
    """Add what is charged for being in each cell of a row after a tick; `FAR` where it is taken.

    `costs` (slots, places, columns + 2), of which one slot and place are meant.
    """
    by_fixed, by_mover = np.int32(weights[NEAR_FIXED]), np.int32(weights[NEAR_MOVER])
    near = _near_movers(lines, slots, row, ahead, 1, columns) if weights[BUFFER] > 0 else _ZERO
    for column in range(columns):
        at = np.uint64(column)
        cost = costs[slot, place, column + 1]
        cost += by_fixed if near_fixed >> at & _ONE else np.int32(0)
        cost += by_mover if near >> at & _ONE else np.int32(0)
        costs[slot, place, column + 1] = FAR if taken >> at & _ONE else min(cost, FAR)
    for distance in range(2, weights[BUFFER] + 1):
        near = _near_movers(lines, slots, row, ahead, distance, columns)
        for column in range(columns):
            cost = costs[slot, place, column + 1]
            cost += by_mover if near >> np.uint64(column) & _ONE else np.int32(0)
            costs[slot, place, column + 1] = min(cost, FAR)


@compiled
def _sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept):
    """Write what entering the cells of a row costs, in the ticks in which the vehicle can be on time there.

    The row before it has been swept.
    """
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    before = max(row - 1, 0)
    line, into, stuck = slots[0, row], slots[1, row], fixed[slots[0, row]]
    line_on, on = slots[0, before], slots[1, before]
    if row > 0:
        for column in range(1, columns + 1):
            entering[into, horizon - row, column] = FAR  # too late to arrive
    near_fixed = _near_fixed(fixed, slots, row, columns)
    for ahead in range(horizon - row - 1, max(0, start_row - row - 1) - 1, -1):
        if row == 0:
            for column in range(1, columns + 1):
                entering[into, ahead, column] = np.int32(0)
        else:
            then = ahead + 1
            from_left, from_right = lines[line, then, FROM_LEFT], lines[line, then, FROM_RIGHT]
            cut_left, cut_right = cut_off(
                lines[line_on, then, FROM_LEFT] & swept,
                lines[line_on, then, FROM_RIGHT] & swept,
                from_left & swept,
                from_right & swept,
            )
            for column in range(1, columns + 1):
                at = np.uint64(column - 1)
                to_left = FAR if from_left >> at & _ONE else entering[into, then, column - 1]
                to_right = FAR if from_right >> at & _ONE else entering[into, then, column + 1]
                best = min(entering[on, then, column] + tick, min(to_left, to_right) + side)
                to_left = FAR if cut_left >> at & _ONE else entering[on, then, column - 1]
                to_right = FAR if cut_right >> at & _ONE else entering[on, then, column + 1]
                best = min(best, min(to_left, to_right) + slant)
                entering[into, ahead, column] = min(best, entering[into, then, column] + wait)
        taken = lines[line, ahead, STANDING] | stuck
        _charge(entering, into, ahead, ahead, lines, slots, row, taken, near_fixed, weights, columns)


@compiled
def _write_totals(totals, entering, lines, slots, cell, weights, columns, swept):
    """Write the totals of the six moves now."""
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    row, column, at = cell // columns, cell % columns + 1, np.uint64(cell % columns)
    here, on = entering[slots[1, row], 0], entering[slots[1, row - 1], 0]
    line, line_on = lines[slots[0, row], 0], lines[slots[0, row - 1], 0]
    from_left, from_right = line[FROM_LEFT], line[FROM_RIGHT]
    cut_left, cut_right = cut_off(
        line_on[FROM_LEFT] & swept, line_on[FROM_RIGHT] & swept, from_left & swept, from_right & swept
    )
    totals[0] = on[column] + tick
    totals[1] = FAR if from_left >> at & _ONE else here[column - 1] + side
    totals[2] = FAR if from_right >> at & _ONE else here[column + 1] + side
    totals[3] = FAR if cut_left >> at & _ONE else on[column - 1] + slant
    totals[4] = FAR if cut_right >> at & _ONE else on[column + 1] + slant
    totals[STAY] = here[column] + wait


@compiled
def _sweep_forward(getting, lines, fixed, slots, cell, horizon, weights, columns, swept, stands):
    """Write the least cost of getting to every cell of the base with each tick.

    With `stands` the vehicle stays in the first one.
    """
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    start_row = cell // columns
    been = np.full((1, start_row + 2, columns + 2), FAR, np.int32)
    been[0, start_row, cell % columns + 1] = 0
    for ahead in range(horizon):
        first = max(0, start_row - ahead - 1)
        for row in range(first, start_row + 1):
            line, line_behind = lines[row, ahead], lines[row + 1, ahead]
            from_left, from_right = line[FROM_LEFT], line[FROM_RIGHT]
            cut_left, cut_right = cut_off(
                from_left & swept,
                from_right & swept,
                line_behind[FROM_LEFT] & swept,
                line_behind[FROM_RIGHT] & swept,
            )
            there, behind, into = been[0, row], been[0, row + 1], getting[row, ahead]
            for column in range(1, columns + 1):
                if stands and ahead == 0:
                    into[column] = min(there[column] + wait, FAR)
                    continue
                best = min(behind[column] + tick, there[column] + wait)
                if column < columns:  # from the cell on the right
                    start = np.uint64(column)
                    best = min(best, FAR if from_left >> start & _ONE else there[column + 1] + side)
                    best = min(best, FAR if cut_left >> start & _ONE else behind[column + 1] + slant)
                if column > 1:
                    start = np.uint64(column - 2)
                    best = min(best, FAR if from_right >> start & _ONE else there[column - 1] + side)
                    best = min(best, FAR if cut_right >> start & _ONE else behind[column - 1] + slant)
                into[column] = min(best, FAR)
        for row in range(first, start_row + 1):
            been[0, row, 1 : columns + 1] = getting[row, ahead, 1 : columns + 1]
            near_fixed = _near_fixed(fixed, slots, row, columns)
            taken = lines[row, ahead, STANDING] | fixed[row]
            _charge(been, 0, row, ahead, lines, slots, row, taken, near_fixed, weights, columns)


@compiled
def decide_base(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, facts
):
    """Take the decision of the base, and write what is known of it (`facts`: 2, 5; int64)."""
    scratch = make_scratch(seen.shape[1], rows, columns, max_ticks(rows), weights[BUFFER], 1)
    now, layers, totals = scratch[0], scratch[1], scratch[5]
    size, row = (columns, left_edge, right_edge), cell // columns
    for stands in (False, True):
        if stands and not facts[GOING, BRAKED]:
            facts[STANDING_STILL, MOVE] = facts[GOING, MOVE]
            break
        take(now, seen, cell, columns)
        ticks, rolled, _ = search(
            now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
        )
        known = facts[STANDING_STILL if stands else GOING]
        if not stands:
            known[BRAKED] = 1 if someone_brakes(now, layers, last) else 0
        if ticks >= 0:
            totals_of_way(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept)
            known[LEAST], known[MOVE] = cheaper(scratch, stands, FAR, np.intp(STAY))
            continue
        known[LEAST] = FAR
        known[REACHED_ROW] = _foremost_reached(layers, rolled, row, columns)
        for ahead in range(rolled, limit):
            roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands)
        known[SHUT_ROW] = _shut_row(layers, limit, row, last, columns, left_edge, right_edge)
        if not stands:
            known[MOVE] = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)[0]
    if facts[GOING, BRAKED]:
        facts[STANDING_STILL, MOVE] = made_move(
            scratch, seen, cell, episode_tick, limit, size, swept, last, weights
        )[0]


@compiled
def _foremost_reached(layers, rolled, start_row, columns):
    """The foremost row that the vehicle gets to in the ticks rolled."""
    rows_per_word = 64 // columns
    mask = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    row = start_row
    for ahead in range(1, rolled + 1):
        w, shift = (row - 1) // rows_per_word, np.uint64((row - 1) % rows_per_word * columns)
        # It gains a row a tick at most: further on nothing is written yet.
        if row > start_row - ahead and layers[ahead, REACHED, w] >> shift & mask:
            row -= 1
    return row


@compiled
def _shut_row(layers, limit, start_row, last, columns, left_edge, right_edge):
    """The foremost row from which nothing leads to the destination within the limit."""
    rows_per_word = 64 // columns
    down, most = np.uint64(64 - columns - 64 % columns), np.uint64(columns - 1)
    goal = (_ONE << most << _ONE) - _ONE
    leading = np.zeros(last + 1, np.uint64)
    for w in range(last + 1):
        layers[limit, NEEDED, w] = _ZERO
    layers[limit, NEEDED, 0] = goal
    for ahead in range(limit - 1, -1, -1):
        on_before = _ZERO  # of the word before: its last row leads to the first of the next
        for w in range(last + 1):
            end = layers[ahead + 1, NEEDED, w]
            level, on = spread_back(
                end ^ end & layers[ahead, BLOCKED, w],
                layers[ahead, CAME_RIGHT, w],
                layers[ahead, CAME_LEFT, w],
                layers[ahead, CUT_LEFT, w],
                layers[ahead, CUT_RIGHT, w],
                left_edge,
                right_edge,
            )
            kept = level | on << most << _ONE | on_before >> down
            if w == 0:
                kept |= goal
            layers[ahead, NEEDED, w] = kept
            leading[w] |= kept
            on_before = on
    for row in range(1, start_row + 1):
        if not leading[row // rows_per_word] >> np.uint64(row % rows_per_word * columns) & goal:
            return row
    return start_row + 1


@compiled
def keep_costs(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, kept, stands
):
    """Keep the costs of a base with a way; `kept`: (slots, lines, fixed, entering, getting).

    The ticks of `getting` are those that are swept. With `stands` the vehicle stays in the first one.
    """
    slots, lines, fixed, entering, getting = kept
    known, horizon = slots.shape[1], getting.shape[1]
    scratch = make_scratch(seen.shape[1], rows, columns, horizon, 0, 1)
    now, layers = scratch[0], scratch[1]
    take(now, seen, cell, columns)
    for ahead in range(horizon):
        roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands)
    rows_per_word = 64 // columns
    mask = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    for row in range(known):
        slots[:, row] = row
        w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
        there = row < rows
        fixed[row] = now[ALL_FIXED, w] >> shift & mask if there else _ZERO
        for ahead in range(horizon):
            lines[row, ahead, STANDING] = layers[ahead, MOVERS, w] >> shift & mask if there else _ZERO
            lines[row, ahead, FROM_LEFT] = layers[ahead, CAME_RIGHT, w] >> shift & mask if there else _ZERO
            lines[row, ahead, FROM_RIGHT] = layers[ahead, CAME_LEFT, w] >> shift & mask if there else _ZERO
    start_row = cell // columns
    entering[:] = FAR
    for row in range(start_row + 1):
        _sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept)
    getting[:] = FAR
    _sweep_forward(getting, lines, fixed, slots, cell, horizon, weights, columns, swept, stands)


@compiled
def _changed_rows(changed, seen, base, columns):
    """Write the known rows in which two things that are seen differ, in order; returns their number."""
    rows_per_word = 64 // columns
    mask = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    count = 0
    for w in range(seen.shape[1]):
        differing = _ZERO
        for plane in range(VEHICLE):
            differing |= seen[plane, w] ^ base[plane, w]
        if differing:
            for row in range(w * rows_per_word, min((w + 1) * rows_per_word, changed.shape[0])):
                if differing >> np.uint64((row - w * rows_per_word) * columns) & mask:
                    changed[count] = row
                    count += 1
    return count


@compiled
def _some_way_changes(entering, getting, slots, row, horizon, start_row, least, columns):
    """Whether a way through a row, where its costs are otherwise, was or is as cheap as the cheapest."""
    new, old, got = entering[slots[1, row]], entering[row], getting[row]
    for ahead in range(max(0, start_row - row - 1), horizon - row):
        for column in range(1, columns + 1):
            one, other = new[ahead, column], old[ahead, column]
            if one != other and got[ahead, column] + min(one, other) <= least:
                return True
    return False


@compiled
def _decided(scratch, changed, cell, columns, limit, swept, weights, known, kept, stands):
    """The least cost where these rows are otherwise, which are rolled out, and its move.

    The move is −1 where it is not known here. `known`: the row of the facts; `kept`: what is kept beside it.
    """
    slots, lines, fixed, entering, getting = kept
    count, horizon, start_row = slots.shape[1], getting.shape[1], cell // columns
    for row in changed:
        slots[0, row] = count + row
    beyond = _charged_rows(weights)
    first, behind = max(0, changed[0] - beyond), changed[-1] + beyond + 1
    least, move = known[LEAST], np.int64(-1)
    for row in range(first, start_row + 1):
        slots[1, row] = count + row
        _sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept)
        if row == behind < start_row and not _some_way_changes(
            entering, getting, slots, row, horizon, start_row, least, columns
        ):
            move = known[MOVE]
            break
    if move < 0:
        totals = scratch[5]
        _write_totals(totals, entering, lines, slots, cell, weights, columns, swept)
        cheapest, at = cheaper(scratch, stands, FAR, np.intp(STAY))
        # A way of more ticks than were swept costs at least so many ticks.
        if cheapest < FAR and (cheapest // weights[TICK] <= horizon or horizon >= limit):
            least, move = np.int64(cheapest), np.int64(at)
    for row in range(first, start_row + 1):
        slots[:, row] = row
    for row in changed:
        slots[0, row] = row
    return least, move


@compiled
def _roll_changed(kept, seen, changed, cell, columns, episode_tick, stands):
    """Roll out the rows that are otherwise; whether a mover brakes for a vehicle that stays in one of them."""
    slots, lines, fixed, _, getting = kept
    count, horizon, start_row = slots.shape[1], getting.shape[1], cell // columns
    brakes = False
    for row in changed:
        vehicle = _ONE << np.uint64(cell % columns) if row == start_row else _ZERO
        brakes |= _roll_row(
            lines[count + row], fixed, count + row, seen, row, horizon, episode_tick, columns, vehicle, stands
        )
    return brakes


@compiled
def _never_visited(seen, safe, last, columns, left_edge, right_edge):
    """Write the cells that no mover gets to: between two fixed things, or the edges, without one."""
    for w in range(last + 1):
        stuck = seen[ALL_FIXED, w]
        visited = seen[NOW_RIGHT, w] | seen[NOW_LEFT, w]
        for _ in range(columns - 1):
            beyond = beside(visited, left_edge, right_edge)
            visited |= beyond ^ beyond & stuck
        safe[w] = ~(visited | stuck)


@compiled
def _longest_without_a_way(scratch, seen, safe, cell, episode_tick, limit, size, swept, last):
    """The move after which one keeps clear longest where no way leads to the destination, and its ticks."""
    now, layers = scratch[0], scratch[1]
    columns, left_edge, right_edge = size
    _never_visited(seen, safe, last, columns, left_edge, right_edge)
    take(now, seen, cell, columns)
    roll(now, layers, 0, last, episode_tick, columns, left_edge, right_edge, swept, False)
    rolled, best, best_ticks = 1, np.int64(STAY), 0
    for move in range(6):
        alive = first_step(now, layers, move, last, columns, left_edge, right_edge)
        ticks = 1 if alive else 0
        while alive and ticks < limit:
            settled = _ZERO
            for w in range(last + 1):
                settled |= layers[ticks, REACHED, w] & safe[w]
            if settled:
                ticks = limit
                break
            if ticks >= rolled:
                roll(now, layers, ticks, last, episode_tick, columns, left_edge, right_edge, swept, False)
                rolled = ticks + 1
            alive = expand(layers, ticks, 0, last, columns, left_edge, right_edge)
            if alive:
                ticks += 1
        if ticks > best_ticks:
            best, best_ticks = np.int64(move), ticks
        if best_ticks >= limit:
            break
    return best, best_ticks


@compiled
def _brakes_if_changed(now, layers, seen, cell, columns, last, episode_tick, left_edge, right_edge, swept):
    """Whether a mover brakes for a vehicle that stays where this is seen."""
    take(now, seen, cell, columns)
    roll(now, layers, 0, last, episode_tick, columns, left_edge, right_edge, swept, False)
    return someone_brakes(now, layers, last)


@compiled
def _move_where_changed(
    scratch, seen, changed, safe, cell, episode_tick, limit, size, swept, last, weights, facts, going, standing
):
    """The move where these rows are otherwise; −1 where it is not known here.

    `going`, `standing`: what is kept of the base, as `keep_costs` takes it, where there is a way.
    """
    columns, left_edge, right_edge = size
    known, brakes = facts[GOING], facts[GOING, BRAKED] == 1
    least, move = np.int64(FAR), np.int64(-1)
    if known[LEAST] < FAR:
        own_row = _roll_changed(going, seen, changed, cell, columns, episode_tick, False)
        if (changed == cell // columns).any():
            brakes = own_row
        if brakes and not known[BRAKED]:
            return np.int64(-1)
        least, move = _decided(scratch, changed, cell, columns, limit, swept, weights, known, going, False)
        if move < 0 or not brakes:
            return move
    else:
        return _changed_without_a_way(
            scratch, seen, changed, safe, cell, episode_tick, limit, size, swept, last, facts
        )
    stays = facts[STANDING_STILL]
    if stays[LEAST] < FAR:
        _roll_changed(standing, seen, changed, cell, columns, episode_tick, True)
        stayed, found = _decided(scratch, changed, cell, columns, limit, swept, weights, stays, standing, True)
        if found < 0:
            return np.int64(-1)
        return np.int64(STAY) if stayed < least else move
    return move if _still_no_way(changed, stays) else np.int64(-1)


@compiled
def _still_no_way(changed, known):
    """Whether there surely is no way where these rows are otherwise, as there is none of the base."""
    return changed[-1] < known[REACHED_ROW] - 1 or changed[0] > known[SHUT_ROW]


@compiled
def _changed_without_a_way(
    scratch, seen, changed, safe, cell, episode_tick, limit, size, swept, last, facts
):
    """The move where these rows of a base without a way are otherwise; −1 where it is not known here."""
    columns, left_edge, right_edge = size
    going, stays = facts[GOING], facts[STANDING_STILL]
    beyond_reach = changed[-1] < going[REACHED_ROW] - 1
    if beyond_reach and (not going[BRAKED] or changed[-1] < stays[REACHED_ROW] - 1):
        return stays[MOVE]
    if changed[0] <= going[SHUT_ROW]:
        return np.int64(-1)
    brakes = _brakes_if_changed(
        scratch[0], scratch[1], seen, cell, columns, last, episode_tick, left_edge, right_edge, swept
    )
    if brakes and not (going[BRAKED] and stays[LEAST] == FAR and changed[0] > stays[SHUT_ROW]):
        return np.int64(-1)
    move, ticks = _longest_without_a_way(
        scratch, seen, safe, cell, episode_tick, limit, size, swept, last
    )
    # Staying would have to keep clear for longer yet.
    return move if not brakes or ticks >= limit else np.int64(-1)


@compiled
def moves_of_changed(
    planes,
    parts,
    chosen,
    cell,
    columns,
    rows,
    left_edge,
    right_edge,
    episode_tick,
    limit,
    swept,
    last,
    weights,
    base,
    other_base,
    moves,
):
    """Write the move that is made after each change (`chosen`: changes, parts of each).

    `planes`, `parts`: as in `sim.batch.seen_otherwise`; `weights` (7; int64): the charges of all. A base is
    (what is seen; `facts`, 2, 5; what is kept, as `keep_costs` takes it, as movers go on, and as they brake).
    """
    scratch = make_scratch(planes.shape[1], rows, columns, max_ticks(rows), weights[BUFFER], 1)
    seen = np.empty((VEHICLE, planes.shape[1]), np.uint64)
    size, known = (columns, left_edge, right_edge), cell // columns + 1 + max(1, weights[BUFFER])
    changed, elsewhere = np.empty(known, np.int64), np.empty(known, np.int64)
    safe = np.empty(last + 1, np.uint64)
    for number in range(chosen.shape[0]):
        see(seen, planes, parts, chosen[number])
        from_base, alike = base, changed[: _changed_rows(changed, seen, base[0], columns)]
        if 2 * alike.size > known:
            others = elsewhere[: _changed_rows(elsewhere, seen, other_base[0], columns)]
            if others.size < alike.size:
                from_base, alike = other_base, others
        _, facts, going, standing = from_base
        if alike.size == 0:
            moves[number] = facts[STANDING_STILL, MOVE]
            continue
        move = _move_where_changed(
            scratch,
            seen,
            alike,
            safe,
            cell,
            episode_tick,
            limit,
            size,
            swept,
            last,
            weights,
            facts,
            going,
            standing,
        )
        if move < 0:
            move = np.int64(
                made_move(scratch, seen, cell, episode_tick, limit, size, swept, last, weights)[0]
            )
        moves[number] = move
