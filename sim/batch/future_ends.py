"""The ends of the futures of a moment, in compiled words: all of them where that is little work, else drawn.

Guarantee: the shares of `sim.explain.futures`, to the last bit. Array arguments, besides those of
`sim.batch.future_tree`:

- `ends` (ends, 2; int64) with `masses` (ends; float64): outcome and ticks from now of each end that was met,
  in the order in which they were first met;
- `hopeful` (ticks, rows; uint64): the columns from which the goal may still be reached (`hopeful_rows`).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER
from sim.batch.future_tree import (
    AHEAD,
    CELL,
    EDGES,
    FIRST_EDGE,
    MOST_WAYS,
    OUTCOME,
    RUNNING,
    SHUT_OFF,
    expand,
)
from sim.batch.row_costs import cost_scratch, no_scratch
from sim.batch.row_motion import FIELDS, LEFT, RIGHT, hopeful_rows, roll_rows
from sim.batch.row_rules import BY_COST, RULES, find_ways
from sim.compilation import compiled, fraction, word_at

_ONE: Final = np.uint64(1)
_PATIENT: Final = 2.0 / 3.0
"""How much of the work goes into walking the whole tree before futures are drawn instead."""


@compiled
def _end_of(tree, number, totals, hopeful, quick_until):
    """How the future of a node ends here, or `RUNNING`."""
    (counts, _, facts, _, rolled, fixed, holes, _, _, place) = tree
    columns, last_bit, episode_tick, max_ticks, _, start_row = place
    if facts[number, OUTCOME] != RUNNING:
        return facts[number, OUTCOME]
    if totals[0] < quick_until:
        return RUNNING
    limit = max_ticks + 1 - episode_tick
    if not counts[2]:
        roll_rows(rolled, counts[1], limit, start_row, fixed, holes, episode_tick, last_bit)
        counts[1], counts[2] = max(counts[1], limit), 1
        hopeful_rows(hopeful, rolled, limit, start_row + 1, fixed, last_bit)
    cell = facts[number, CELL]
    if hopeful[facts[number, AHEAD], cell // columns] >> np.uint64(cell % columns) & _ONE:
        return RUNNING
    return SHUT_OFF


@compiled
def _count_end(ends, masses, count, outcome, ahead, mass):
    """Add to the mass of an end; how many ends there are."""
    for each in range(count):
        if ends[each, 0] == outcome and ends[each, 1] == ahead:
            masses[each] += mass
            return count
    ends[count, 0], ends[count, 1], masses[count] = outcome, ahead, mass
    return count + 1


@compiled
def _walk(tree, grown, planner, chances, seen, hopeful, quick_until, most, ends, masses):
    """Walk the whole tree; how many ends there are, or −1 where that is too much work."""
    facts, totals = tree[2], grown[0]
    edges, shares = grown[1], grown[2]
    size = facts.shape[0]
    layer, after = np.empty(size, np.int32), np.empty(size, np.int32)
    mass, mass_after = np.empty(size, np.float64), np.empty(size, np.float64)
    place = np.full(size, -1, np.int32)
    shut = _end_of(tree, 0, totals, hopeful, quick_until)
    if shut != RUNNING:
        return _count_end(ends, masses, 0, shut, 0, 1.0)
    layer[0], mass[0], length, count = 0, 1.0, 1, 0
    while length:
        following = 0
        for index in range(length):
            number = layer[index]
            if totals[1] and totals[0] >= _PATIENT * most:
                return -1
            expand(tree, grown, planner, number, chances, seen)
            first = facts[number, FIRST_EDGE]
            for edge in range(first, first + facts[number, EDGES]):
                there, share = edges[edge], mass[index] * shares[edge]
                end = _end_of(tree, there, totals, hopeful, quick_until)
                if end != RUNNING:
                    count = _count_end(ends, masses, count, end, facts[there, AHEAD], share)
                elif place[there] >= 0:
                    mass_after[place[there]] += share
                else:
                    place[there] = following
                    after[following], mass_after[following] = there, share
                    following += 1
        layer, after = after, layer
        mass, mass_after = mass_after, mass
        length = following
    return count


@compiled
def _draw(tree, grown, planner, chances, seen, hopeful, quick_until, most, key, most_futures, ends, masses):
    """Draw futures while there is work left; how many ends there are."""
    facts, totals = tree[2], grown[0]
    edges, shares = grown[1], grown[2]
    limit, count = totals[0] + (1.0 - _PATIENT) * most, 0
    for future in range(most_futures):
        if totals[0] >= limit:
            break
        draws, number, step = word_at(key, future), 0, 0
        end = _end_of(tree, number, totals, hopeful, quick_until)
        while end == RUNNING:
            expand(tree, grown, planner, number, chances, seen)
            first, stop = facts[number, FIRST_EDGE], facts[number, FIRST_EDGE] + facts[number, EDGES]
            draw = fraction(word_at(draws, step))
            step += 1
            number = edges[stop - 1]
            for edge in range(first, stop):
                if draw < shares[edge]:
                    number = edges[edge]
                    break
                draw -= shares[edge]
            end = _end_of(tree, number, totals, hopeful, quick_until)
        count = _count_end(ends, masses, count, end, facts[number, AHEAD], 1.0)
    return count


@compiled
def grow_futures(
    rows_now, fixed, holes, place, cell, planner, weights, chances, seen, bounds, key, ends, masses, out
):
    """Write the ends of the futures of a moment; `out` gets (ends, whether drawn, work, branched).

    `rows_now` (rows, 3; uint64): the movers of all rows. `place`: (columns, last bit, episode tick, most
    ticks, `swept`). `bounds`: the work before which nothing is proved, the work allowed, and the most futures
    that are drawn. `key`: of the draws.
    """
    quick_until, most, most_futures = bounds
    columns, last_bit, episode_tick, max_ticks, swept = place
    row, rows = cell // columns, fixed.size
    limit = max(1, max_ticks + 1 - episode_tick)
    room = most + MOST_WAYS * (limit + 4) + 64
    slots_count = 1024
    while slots_count < 2 * room:
        slots_count *= 2
    behind = weights[BUFFER] if planner == BY_COST else 0
    nodes, facts = np.zeros((room, 3 * (1 + behind)), np.uint64), np.empty((room, 5), np.int64)
    slots = np.full(slots_count, -1, np.int32)
    rolled = np.empty((limit + 2, row + 1, FIELDS), np.uint64)
    ways = np.empty((3, row + 1, columns), np.int16)
    for each in range(row + 1):
        rolled[0, each, :3] = rows_now[each]
    if planner == RULES:
        find_ways(ways, rows_now[:, RIGHT] | rows_now[:, LEFT], fixed, row + 1, columns, last_bit)
    if planner == BY_COST:
        scratch, size = cost_scratch(rows, columns, max_ticks, weights, 1)
    else:
        scratch, size = no_scratch()
    counts = np.zeros(3, np.int64)
    counts[0] = 1
    for each in range(row, min(row + behind + 1, rows)):
        nodes[0, 3 * (each - row) : 3 * (each - row) + 3] = rows_now[each]
    facts[0, AHEAD], facts[0, OUTCOME], facts[0, FIRST_EDGE], facts[0, CELL] = 0, RUNNING, -1, cell
    tree = (
        counts,
        nodes,
        facts,
        slots,
        rolled,
        fixed,
        holes,
        ways,
        (scratch, size, weights),
        (columns, last_bit, episode_tick, max_ticks, swept, row),
    )
    totals = np.zeros(3, np.int64)
    grown = (
        totals,
        np.empty(room, np.int32),
        np.empty(room, np.float64),
        np.empty((MOST_WAYS, 2), np.uint64),
        np.empty(MOST_WAYS, np.float64),
    )
    hopeful = np.empty((limit + 1, row + 1), np.uint64)
    found = _walk(tree, grown, planner, chances, seen, hopeful, quick_until, most, ends, masses)
    out[1] = found < 0
    if found < 0:
        found = _draw(
            tree, grown, planner, chances, seen, hopeful, quick_until, most, key, most_futures, ends, masses
        )
    out[0], out[2], out[3] = found, totals[0], totals[1]
