"""One decision by cost where a few rows are otherwise, by sweeping only what they change.

A thing that goes, or comes, makes other only the movers of its own row and the charges of the rows next to
it. So of one road (the *base*, `sim.batch.kept_base`) the costs of all rows are kept. The rows before the
first one that is otherwise (nearer to the destination) keep their costs; the sweep begins there and goes on
towards the vehicle. Behind the last row that is otherwise, the new costs are compared with the old ones: if
no way through a cell that costs otherwise was, or is, as cheap as the cheapest, the move is the same, and the
sweep ends.

Where no way leads to the destination, what lies beyond the vehicle's reach has no part in the move. If only
rows behind one that shuts the road are otherwise, there still is no way; then the move is one after which
the vehicle can keep clear longest, and a cell that no mover ever gets to is clear for ever.

Guarantee: the move of `sim.batch.one_decision.made_move`, which is taken wherever this does not answer.

Array arguments: as in `sim.batch.one_decision`, `sim.batch.row_sweep` and `sim.batch.kept_base`; `changed`
(any number; int64): rows that are otherwise, in order.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, FAR, TICK, cheaper, make_scratch
from sim.batch.compiled import beside, max_ticks
from sim.batch.kept_base import BRAKED, GOING, LEAST, MOVE, REACHED_ROW, SHUT_ROW, STANDING_STILL
from sim.batch.one_decision import made_move, take
from sim.batch.reachability import (
    ALL_FIXED,
    NOW_LEFT,
    NOW_RIGHT,
    REACHED,
    STAY,
    VEHICLE,
    expand,
    first_step,
    roll,
    someone_brakes,
)
from sim.batch.row_sweep import charged_rows, roll_row, sweep_row, write_row_totals
from sim.batch.seen_otherwise import see
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


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
    beyond = charged_rows(weights)
    first, behind = max(0, changed[0] - beyond), changed[-1] + beyond + 1
    least, move = known[LEAST], np.int64(-1)
    for row in range(first, start_row + 1):
        slots[1, row] = count + row
        sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept)
        if row == behind < start_row and not _some_way_changes(
            entering, getting, slots, row, horizon, start_row, least, columns
        ):
            move = known[MOVE]
            break
    if move < 0:
        totals = scratch[5]
        write_row_totals(totals, entering, lines, slots, cell, weights, columns, swept)
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
    """Roll out the rows that are otherwise; whether a mover in them brakes for a vehicle that stays."""
    slots, lines, fixed, _, getting = kept
    count, horizon, start_row = slots.shape[1], getting.shape[1], cell // columns
    brakes = False
    for row in changed:
        vehicle = _ONE << np.uint64(cell % columns) if row == start_row else _ZERO
        brakes |= roll_row(
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
    scratch,
    seen,
    changed,
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
):
    """The move where these rows are otherwise; −1 where it is not known here.

    `going`, `standing`: what is kept of the base, as `keep_costs` takes it, where there is a way.
    """
    known, stays, columns = facts[GOING], facts[STANDING_STILL], size[0]
    if known[LEAST] == FAR:
        return _changed_without_a_way(
            scratch, seen, changed, safe, cell, episode_tick, limit, size, swept, last, facts
        )
    brakes = known[BRAKED] == 1
    own_row = _roll_changed(going, seen, changed, cell, columns, episode_tick, False)
    if (changed == cell // columns).any():
        brakes = own_row
    if brakes and not known[BRAKED]:
        return np.int64(-1)
    least, move = _decided(scratch, changed, cell, columns, limit, swept, weights, known, going, False)
    if move < 0 or not brakes:
        return move
    if stays[LEAST] < FAR:
        _roll_changed(standing, seen, changed, cell, columns, episode_tick, True)
        stayed, found = _decided(
            scratch, changed, cell, columns, limit, swept, weights, stays, standing, True
        )
        if found < 0:
            return np.int64(-1)
        return np.int64(STAY) if stayed < least else move
    return move if _still_no_way(changed, stays) else np.int64(-1)


@compiled
def _still_no_way(changed, known):
    """Whether there surely is no way where these rows are otherwise, as there is none of the base."""
    return changed[-1] < known[REACHED_ROW] - 1 or changed[0] > known[SHUT_ROW]


@compiled
def _changed_without_a_way(scratch, seen, changed, safe, cell, episode_tick, limit, size, swept, last, facts):
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
    move, ticks = _longest_without_a_way(scratch, seen, safe, cell, episode_tick, limit, size, swept, last)
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
