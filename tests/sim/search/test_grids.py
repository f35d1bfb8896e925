"""The same search on other people's grids: 4- and 8-connected, with waiting or without; an outside oracle."""

from __future__ import annotations

import networkx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.search.astar import cheapest, no_heuristic
from sim.search.step_costs import MoveSet
from tests.sim.search.grid_map import FOUR, WAIT, Grid, eight

MAPS = st.integers(2, 9).flatmap(
    lambda width: st.lists(
        st.lists(st.sampled_from("..@"), min_size=width, max_size=width).map("".join), min_size=2, max_size=9
    )
)


def graph(rows: list[str], moves: MoveSet, *, corners: bool) -> networkx.DiGraph:
    """The same map as somebody else's graph."""
    width, made = len(rows[0]), networkx.DiGraph()
    free = {(c, r) for r, row in enumerate(rows) for c, sign in enumerate(row) if sign == "."}
    for column, row in free:
        for step in moves:
            there = (column + step.columns, row + step.rows)
            cut = {(column + step.columns, row), (column, row + step.rows)}
            if there in free and (corners or not (step.columns and step.rows) or cut <= free):
                made.add_edge(row * width + column, there[1] * width + there[0], weight=step.cost)
    made.add_nodes_from(r * width + c for c, r in free)
    return made


@settings(max_examples=150)
@given(MAPS, st.sampled_from([FOUR, (*FOUR, WAIT), eight(), eight(10, 14)]), st.booleans(), st.data())
def test_costs_are_those_of_another_library(
    rows: list[str], moves: MoveSet, corners: bool, data: st.DataObject
) -> None:
    free = [r * len(rows[0]) + c for r, row in enumerate(rows) for c, sign in enumerate(row) if sign == "."]
    if not free:
        return
    start, goal = data.draw(st.sampled_from(free)), data.draw(st.sampled_from(free))
    terrain = Grid(rows, goal, moves, corners=corners)
    found = cheapest(terrain, start)
    try:
        expected = networkx.dijkstra_path_length(graph(rows, moves, corners=corners), start, goal)
    except networkx.NetworkXNoPath:
        assert found is None
        return
    assert found is not None
    assert found.cost == expected
    assert found.states[0] == start
    assert found.states[-1] == goal
    assert sum(moves[move].cost for move in found.moves) == found.cost
    blind = cheapest(terrain, start, heuristic=no_heuristic)
    assert blind is not None
    assert blind.cost == found.cost
    assert blind.expanded >= found.expanded


def test_known_counts() -> None:
    rows = ["....", ".@@.", "...."]
    assert cheapest(Grid(rows, 11, FOUR), 0).cost == 5
    assert cheapest(Grid(rows, 11, eight()), 0).cost == 4
    assert cheapest(Grid(rows, 11, eight(), corners=False), 0).cost == 5
    assert cheapest(Grid(["..", "@@", ".."], 4, FOUR), 0) is None


@pytest.mark.parametrize("rows", [[], ["..", "."]])
def test_a_map_is_a_rectangle(rows: list[str]) -> None:
    with pytest.raises(ValueError, match="one length"):
        Grid(rows, 0, FOUR)
