"""Windows and images: the same road, cut and painted."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from gymnasium import spaces

from sim.env import RoadEnv, RoadVectorEnv
from sim.env.observation import MIN_IMAGE_PX, OFF_ROAD
from sim.perceive.observe import PLANES, STEPPING, VEHICLE

pytestmark = pytest.mark.xdist_group("compiled")

PARTS = {"rows": 12, "columns": 6, "potholes": 10, "barriers": 4, "pedestrians": 6}


def states(count: int, **arguments: Any) -> Any:
    """The same moments seen in several ways."""
    whole, other = RoadEnv(PARTS), RoadEnv(PARTS, **arguments)
    draw = np.random.default_rng(0)
    for seed in range(count):
        planes, _ = whole.reset(seed=seed)
        seen, _ = other.reset(seed=seed)
        ended = False
        while not ended:
            yield planes, seen, other
            action = int(draw.integers(6))
            planes, _, one, two, _ = whole.step(action)
            seen = other.step(action)[0]
            ended = one or two


@pytest.mark.parametrize("window", [(3, 1, 2), (0, 0, 0), (15, 15, 9), [4, 0, 1]])
def test_a_window_is_what_is_around_the_vehicle(window: Any) -> None:
    ahead, behind, side = window
    moments = 0
    for planes, seen, env in states(6, window=window):
        assert seen in env.observation_space
        assert seen.shape == (PLANES + 1, ahead + behind + 1, 2 * side + 1)
        row, column = np.argwhere(planes[VEHICLE])[0]
        for down in range(seen.shape[1]):
            for along in range(seen.shape[2]):
                there, beside = row - ahead + down, column - side + along
                on_road = 0 <= there < PARTS["rows"] and 0 <= beside < PARTS["columns"]
                assert seen[OFF_ROAD, down, along] == (not on_road)
                expected = (
                    planes[:, there, beside]
                    if on_road
                    else np.eye(PLANES, dtype=int)[STEPPING] * planes[STEPPING, 0, 0]
                )
                assert (seen[:PLANES, down, along] == expected).all()
        assert seen[VEHICLE, ahead, side] == 1
        moments += 1
    assert moments > 10


@pytest.mark.parametrize("arguments", [{}, {"window": (4, 1, 2)}])
def test_an_image_tells_all_that_planes_tell(arguments: dict[str, Any]) -> None:
    """Two cells of the same colours are two cells of the same planes, and the other way round."""
    planes_of: dict[bytes, bytes] = {}
    colours_of: dict[bytes, bytes] = {}
    cells = RoadEnv(PARTS, **arguments)
    for _, image, env in states(10, observation="image", **arguments):
        assert image in env.observation_space
        cells.set_state(env.get_state())
        planes, _ = cells.set_state(env.get_state())
        block = image.shape[0] // planes.shape[1]
        assert image.shape == (planes.shape[1] * block, planes.shape[2] * block, 3)
        colours = image[::block, ::block]
        assert (image == colours.repeat(block, 0).repeat(block, 1)).all()
        assert planes[STEPPING].min() == planes[STEPPING].max()
        for row in range(colours.shape[0]):
            for column in range(colours.shape[1]):
                told = planes[:, row, column].copy()
                if not told[4] and not told[VEHICLE]:
                    told[STEPPING] = 0  # which is told where it matters: at pedestrians and at the vehicle
                colour, plane = colours[row, column].tobytes(), told.tobytes()
                assert planes_of.setdefault(colour, plane) == plane
                assert colours_of.setdefault(plane, colour) == colour
    assert len(planes_of) >= 9


@pytest.mark.parametrize(
    "shape", [{}, {"rows": 4, "columns": 3, "vehicles": 0, "potholes": 0}, {"rows": 300, "columns": 64}]
)
@pytest.mark.parametrize("window", [None, (2, 0, 1), (40, 2, 20)])
@pytest.mark.parametrize("kind", ["image", "image_first"])
def test_images_are_what_stable_baselines3_takes_for_one(shape: Any, window: Any, kind: str) -> None:
    """The checks of `is_image_space` and of its checker: type, bounds, three channels, 36 pixels a side."""
    space = RoadEnv(shape, observation=kind, window=window).observation_space
    assert isinstance(space, spaces.Box)
    assert space.dtype == np.uint8
    assert (space.low == 0).all()
    assert (space.high == 255).all()
    channels_first = int(np.argmin(space.shape)) == 0
    assert channels_first is (kind == "image_first")
    sides = space.shape[1:] if channels_first else space.shape[:2]
    assert space.shape[0 if channels_first else 2] == 3
    assert min(sides) >= MIN_IMAGE_PX


def test_channels_first_is_the_same_image() -> None:
    last, first = RoadEnv(PARTS, observation="image"), RoadEnv(PARTS, observation="image_first")
    assert (last.reset(seed=3)[0].transpose(2, 0, 1) == first.reset(seed=3)[0]).all()


@pytest.mark.parametrize("kind", ["planes", "image", "image_first"])
@pytest.mark.parametrize("window", [None, (3, 1, 2)])
def test_many_are_shown_as_one_is(kind: str, window: Any) -> None:
    many = RoadVectorEnv(3, PARTS, observation=kind, window=window)
    seen, _ = many.reset(seed=5)
    assert seen in many.observation_space
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for lane in range(3):
            one = RoadEnv(PARTS, observation=kind, window=window)
            assert one.observation_space == many.single_observation_space
            assert (one.reset(seed=5 + lane)[0] == seen[lane]).all()
