"""Where movers may be is what they may do, enumerated; and no rule of theirs leads beyond it."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.commit import commit
from sim.forecast import ReachableSets
from sim.perceive import perceive_truth
from sim.world import World
from sim.world.grid import board_of
from tests.support.any_movers import histories
from tests.support.roads import road, run_on, worlds

TICKS = 9


def sets_of(world: World) -> ReachableSets:
    return ReachableSets(perceive_truth(world, run_on(world).config))


def check_sets(world: World, ticks: int = TICKS) -> None:
    """The sets are the union over all outcomes, to the cell."""
    sets = sets_of(world)
    for ahead, steps in enumerate(histories(world, ticks)):
        pairs = {pair for before, after in steps for pair in zip(before, after, strict=True)}
        occupied, came_right, came_left = sets[ahead]
        assert occupied == board_of({end for _, end in pairs}), ahead
        assert came_right == board_of({end for start, end in pairs if end == start + 1}), ahead
        assert came_left == board_of({end for start, end in pairs if end == start - 1}), ahead


@pytest.mark.parametrize(
    "row",
    [
        ">.....",
        "..<...",
        "><....",
        ">.)...",
        ".>).<.",
        ").>..(",
        ">#.<..",
        "o>.)o.",
        "}>...)",
        ").}..<",
        ">>><..",
    ],
)
@pytest.mark.parametrize("tick", [0, 1])
def test_they_are_the_union_of_all_outcomes(row: str, tick: int) -> None:
    check_sets(road("......", row, "......", "...A..", tick=tick))


def test_they_are_the_union_of_all_outcomes_on_drawn_rows() -> None:
    draw = random.Random(11)
    for _ in range(40):
        columns = draw.randint(3, 6)
        things = [*draw.sample(">><<)(", draw.randint(1, 3)), *draw.sample("o#}[", draw.randint(0, 1))]
        cells = (things + ["."] * columns)[:columns]
        draw.shuffle(cells)
        empty = "." * columns
        check_sets(road(empty, "".join(cells), empty, "A" + empty[1:], tick=draw.randint(0, 1)), 8)


def test_rows_do_not_mix() -> None:
    sets = sets_of(road("....", "...>", "<...", "A..."))
    assert [sets[ahead].occupied for ahead in (0, 2, 30)] == [
        board_of([6, 7, 8, 9]),
        board_of(range(4, 12)),
        board_of(range(4, 12)),
    ]


@settings(max_examples=60, deadline=None)
@given(worlds(max_columns=6, max_rows=5), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.randoms())
def test_no_draw_and_no_vehicle_leads_out_of_them(
    world: World, courtesy: float, attentive: float, choose: random.Random
) -> None:
    """Also long after they have settled. Vehicles are where they like, since crashes end no movers' way."""
    config = run_on(world, courtesy=courtesy, attentive=attentive, seed=5).config
    sets, before = sets_of(world), world
    for ahead in range(40):
        moves = config.ego_dynamics(world.road).actions(before.av)
        after = commit(before, (choose.choice(moves),), config)
        occupied, came_right, came_left = sets[ahead]
        moving = after.right | after.left
        where = {name: cell for cell, name in before.movers.items()}
        steps = {(where[name], cell) for cell, name in after.movers.items() if name in where}
        assert not moving & ~occupied
        assert not board_of({end for start, end in steps if end == start + 1}) & ~came_right
        assert not board_of({end for start, end in steps if end == start - 1}) & ~came_left
        before = replace(after, avs=(choose.randrange(world.road.columns * world.road.rows),))


def test_they_repeat_once_they_have_settled() -> None:
    sets = sets_of(road("......", ">...).", "......", "...A.."))
    first = [sets[ahead] for ahead in range(40)]
    assert sets.settled is not None
    assert first[-1].occupied == first[-1 - sets.period].occupied
    assert sets[39] == sets[39 + 1_000 * sets.period]


def test_there_is_no_tick_before_the_coming_one() -> None:
    with pytest.raises(IndexError):
        sets_of(road("......", ">.....", "......", "...A.."))[-1]
