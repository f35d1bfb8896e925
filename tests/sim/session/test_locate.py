"""Where a `Where` is: every part, every pair of parts that is said together, and the road's ends."""

from __future__ import annotations

from typing import Any

import pytest

from sim.actions import Where
from sim.session.errors import EditError
from sim.session.locate import (
    Place,
    cells_away,
    lane_columns,
    nearest_first,
    place_for_adding,
    place_for_finding,
)
from sim.types import Cell
from sim.world.grid import Road, bits
from tests.support.roads import road

# Seven lanes, the vehicle in lane 4; cells of 5 m.
WORLD = road(
    ".......",
    ".......",
    ".......",
    ".......",
    "...A...",
    ".......",
)
COLUMNS, ROWS = 7, 6
AV = (3, 4)


def cells(place: Place) -> set[Cell]:
    return {WORLD.road.cell(index) for index in bits(place.cells)}


def adding(count: int = 1, **parts: Any) -> set[Cell]:
    return cells(place_for_adding(Where(**parts), count, WORLD, 5.0))


def finding(**parts: Any) -> set[Cell]:
    return cells(place_for_finding(Where(**parts), WORLD, 5.0))


def block(columns: range, rows: range) -> set[Cell]:
    return {(column, row) for column in columns for row in rows}


ALL, FURNISHED = block(range(COLUMNS), range(ROWS)), block(range(COLUMNS), range(1, ROWS - 1))


def lane(column: int) -> set[Cell]:
    return {(column, row) for row in range(ROWS)}


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ({"lane": "left"}, lane(0) & FURNISHED),
        ({"lane": "right"}, lane(6) & FURNISHED),
        ({"lane": "middle"}, lane(3) & FURNISHED),
        ({"lane": 2}, lane(1) & FURNISHED),
        ({"row": 2}, block(range(7), range(2, 3))),
        ({"row": 0}, block(range(7), range(1))),
        ({"cell": (5, 1)}, {(5, 1)}),
        ({"lane": 2, "row": 3}, {(1, 3)}),
        ({"lane": 2, "cell": (5, 1)}, set()),
        ({"side": "ahead"}, {(3, 0), (3, 1), (3, 2), (3, 3)}),
        ({"side": "behind"}, {(3, 5)}),
        ({"side": "left"}, {(0, 4), (1, 4), (2, 4)}),
        ({"side": "right"}, {(4, 4), (5, 4), (6, 4)}),
        ({"side": "ahead", "cells": 2}, {(3, 2)}),
        ({"side": "ahead", "distance_m": 15.0}, {(3, 1)}),
        ({"side": "behind", "cells": 1}, {(3, 5)}),
        ({"side": "left", "cells": 3}, {(0, 4)}),
        ({"side": "right", "distance_m": 5.0}, {(4, 4)}),
        # A bare distance is one ahead.
        ({"cells": 3}, {(3, 1)}),
        ({"distance_m": 10.0}, {(3, 2)}),
        ({"distance_m": 0.5}, {(3, 3)}),
        # With a lane, the distance is along the road and the lane says which column.
        ({"lane": "left", "side": "ahead", "distance_m": 15.0}, {(0, 1)}),
        ({"lane": "right", "cells": 2}, {(6, 2)}),
        ({"lane": "left", "side": "ahead"}, {(0, 0), (0, 1), (0, 2), (0, 3)}),
        ({"lane": "left", "side": "behind"}, {(0, 5)}),
        ({"lane": "left", "side": "left"}, lane(0)),
        ({"lane": "left", "side": "right"}, set()),
        ({"row": 2, "side": "left"}, {(0, 2), (1, 2), (2, 2)}),
        ({"row": 2, "side": "right", "cells": 2}, {(5, 2)}),
        ({"row": 5, "side": "ahead"}, set()),
    ],
)
def test_where_one_new_thing_may_be_put(parts: dict[str, Any], expected: set[Cell]) -> None:
    assert adding(**parts) == expected


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        # Several at a distance spread along that row …
        ({"side": "ahead", "cells": 2}, block(range(7), range(2, 3))),
        ({"side": "behind", "cells": 1}, block(range(7), range(5, 6))),
        # … or on along the lane if one was named.
        ({"side": "ahead", "cells": 2, "lane": "left"}, {(0, 0), (0, 1), (0, 2)}),
        ({"side": "left", "cells": 2}, {(0, 4), (1, 4)}),
    ],
)
def test_where_several_new_things_may_be_put(parts: dict[str, Any], expected: set[Cell]) -> None:
    assert adding(count=3, **parts) == expected


def test_without_a_place_new_things_go_anywhere_between_start_and_goal() -> None:
    assert place_for_adding(None, 4, WORLD, 5.0) == Place(WORLD.road.between, ordered=False)
    assert place_for_adding(Where(nearest=True), 1, WORLD, 5.0) == Place(WORLD.road.between, ordered=True)


def test_places_seen_from_the_vehicle_are_filled_from_the_nearest_on() -> None:
    assert place_for_adding(Where(side="ahead"), 2, WORLD, 5.0).ordered
    assert not place_for_adding(Where(lane="left"), 2, WORLD, 5.0).ordered


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ({}, ALL),
        ({"nearest": True}, ALL),
        ({"lane": "left"}, lane(0)),
        ({"lane": 7}, lane(6)),
        ({"row": 5}, block(range(7), range(5, 6))),
        ({"cell": (0, 0)}, {(0, 0)}),
        # "The pothole on the left" need not be straight to the left.
        ({"side": "ahead"}, block(range(7), range(4))),
        ({"side": "behind"}, block(range(7), range(5, 6))),
        ({"side": "left"}, block(range(3), range(6))),
        ({"side": "right"}, block(range(4, 7), range(6))),
        # "The pothole 10 m ahead" is.
        ({"side": "ahead", "distance_m": 10.0}, {(3, 2)}),
        ({"cells": 4}, {(3, 0)}),
        ({"side": "left", "cells": 1}, {(2, 4)}),
        ({"side": "ahead", "distance_m": 10.0, "lane": "left"}, {(0, 2)}),
        ({"side": "ahead", "lane": "left"}, {(0, 0), (0, 1), (0, 2), (0, 3)}),
        ({"side": "right", "row": 1}, {(4, 1), (5, 1), (6, 1)}),
    ],
)
def test_where_things_that_are_meant_may_be(parts: dict[str, Any], expected: set[Cell]) -> None:
    assert finding(**parts) == expected
    assert place_for_finding(Where(**parts), WORLD, 5.0).ordered


def test_no_place_is_everywhere_for_finding() -> None:
    assert cells(place_for_finding(None, WORLD, 5.0)) == ALL


@pytest.mark.parametrize(
    ("parts", "code", "facts"),
    [
        ({"lane": 8}, "no_such_lane", {"lane": 8, "lanes": 7}),
        ({"lane": 0}, "no_such_lane", {"lane": 0, "lanes": 7}),
        ({"row": 6}, "no_such_row", {"row": 6, "last_row": 5}),
        ({"row": -1}, "no_such_row", {"row": -1, "last_row": 5}),
        ({"cell": (7, 0)}, "cell_off_road", {"column": 7, "row": 0, "last_column": 6, "last_row": 5}),
        ({"cell": (0, -1)}, "cell_off_road", {"column": 0, "row": -1, "last_column": 6, "last_row": 5}),
        ({"side": "ahead", "cells": 5}, "too_far", {"left": 4, "side": "ahead", "away": 5}),
        ({"side": "ahead", "distance_m": 500.0}, "too_far", {"left": 4, "side": "ahead", "away": 100}),
        ({"side": "behind", "cells": 2}, "too_far", {"left": 1, "side": "behind", "away": 2}),
        ({"side": "left", "cells": 4}, "too_far", {"left": 3, "side": "left", "away": 4}),
        ({"lane": "left", "cells": 9}, "too_far", {"left": 4, "side": "ahead", "away": 9}),
    ],
)
def test_what_is_not_on_the_road_is_refused_with_its_facts(
    parts: dict[str, Any], code: str, facts: dict[str, Any]
) -> None:
    for place in (adding, finding):
        with pytest.raises(EditError) as refused:
            place(**parts)
        assert (refused.value.code, refused.value.field, refused.value.facts) == (code, "where", facts)


@pytest.mark.parametrize(
    ("distance_m", "away"),
    [(0.1, 1), (2.4, 1), (5.0, 1), (7.4, 1), (7.6, 2), (10.0, 2), (17.5, 4), (12.5, 3)],
)
def test_metres_are_rounded_to_cells_halves_up(distance_m: float, away: int) -> None:
    assert cells_away(Where(distance_m=distance_m), 5.0) == away


def test_cells_said_are_not_rounded() -> None:
    assert cells_away(Where(cells=3, distance_m=50.0), 5.0) == 3
    assert cells_away(Where(), 5.0) is None


@pytest.mark.parametrize(
    ("columns", "lane_said", "expected"),
    [
        (8, "middle", [3, 4]),
        (7, "middle", [3]),
        (3, "middle", [1]),
        (8, "left", [0]),
        (8, "right", [7]),
        (8, 1, [0]),
        (8, 8, [7]),
    ],
)
def test_lanes(columns: int, lane_said: str | int, expected: list[int]) -> None:
    assert lane_columns(Road.of(columns, 5), lane_said) == expected


def test_nearest_first_prefers_its_own_lane_and_then_what_is_ahead() -> None:
    """Distance in moves: a diagonal step is one."""
    near = [(3, 3), (3, 5), (2, 3), (4, 4), (3, 2), (1, 4), (3, 0)]
    indices = [WORLD.road.index(cell) for cell in near]
    told = [WORLD.road.cell(index) for index in nearest_first(reversed(indices), WORLD)]
    assert told == [(3, 3), (3, 5), (2, 3), (4, 4), (3, 2), (1, 4), (3, 0)]
