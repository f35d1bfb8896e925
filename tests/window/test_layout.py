"""Everything has its place: inside the window, beside each other, at any size and shape of road."""

from __future__ import annotations

from itertools import combinations

import pygame
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.window.layout import Shape, arrange, body_of, close_of, head_of
from service.window.panels import PANELS

ROAD = Shape(8, 30, 8)
SHAPES = st.builds(Shape, st.integers(3, 64), st.integers(4, 512), st.integers(4, 8))


@given(
    st.tuples(st.integers(320, 4000), st.integers(320, 2200)),
    st.frozensets(st.sampled_from(PANELS)),
    SHAPES,
    st.booleans(),
)
def test_places_are_apart_and_inside(
    size: tuple[int, int], shown: frozenset[str], shape: Shape, large: bool
) -> None:
    one = sorted(shown)[0] if large and shown else None
    places = arrange(size, shown, one, shape)
    assert set(places) == ({one} if one else set(shown)) | {"console"}
    if size[0] >= 800:
        assert all(pygame.Rect((0, 0), size).contains(place) for place in places.values())
        assert not any(a.colliderect(b) for a, b in combinations(places.values(), 2))
    for place in places.values():
        assert place.contains(head_of(place))
        assert min(body_of(place).size) >= 1
        assert close_of(place).right == place.right


@pytest.mark.parametrize(("size", "cell"), [((1440, 900), 78), ((1920, 1080), 96), ((800, 600), 40)])
def test_the_road_is_the_largest(size: tuple[int, int], cell: int) -> None:
    places = arrange(size, frozenset(PANELS), None, ROAD)
    body = body_of(places["road"])
    assert min(body.width / 8.5, body.height / 8) >= cell
    others = [place for name, place in places.items() if name != "road"]
    assert all(body.width * body.height > place.width * place.height for place in others)


def test_what_is_hidden_gives_its_room_to_the_road() -> None:
    some = arrange((800, 600), frozenset(("road", "plan")), None, ROAD)
    every = arrange((800, 600), frozenset(PANELS), None, ROAD)
    assert some["road"].width > every["road"].width
    assert some["console"].width > every["console"].width
