"""Colours and marks of the road view: chosen by who looks, and the same road under them."""

from __future__ import annotations

import numpy as np

from sim.config import Config
from sim.render import Look, pixels, render
from sim.render.look import PLAIN
from sim.state import SimState

STATE = SimState.start(Config(seed=9, vehicles=12))
SIZE = (480, 480)


def drawn(look: Look = PLAIN) -> np.ndarray:
    return pixels(render("road", STATE, size=SIZE, look=look))


def test_by_day_the_road_is_lighter() -> None:
    assert drawn(Look(theme="light")).mean() > drawn().mean() + 20


def test_what_is_left_out_is_left_out_alone() -> None:
    plain = drawn()
    for look in (Look(boxes=False), Look(figures=False)):
        other = drawn(look)
        differ = (plain != other).any(axis=2)
        assert 0 < differ.mean() < 0.2
    strip = (plain != drawn(Look(figures=False))).any(axis=2)
    assert not strip[strip.shape[0] // 5 :].any(), "the figures stand along the upper edge"
