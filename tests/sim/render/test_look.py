"""Colours and marks of the road view: chosen by who looks, and the same road under them."""

from __future__ import annotations

from typing import Any

import numpy as np

from sim.config import Config
from sim.decide import decide
from sim.render import Look, pixels, render
from sim.render.intent import expected_cells
from sim.render.look import PLAIN
from sim.render.video import render_video, video_frames
from sim.state import SimState
from sim.transition import step

STATE = SimState.start(Config(seed=9, vehicles=12))
SIZE = (480, 480)


def drawn(look: Look = PLAIN, **given: Any) -> np.ndarray:
    return pixels(render("road", STATE, size=SIZE, look=look, **given))


def differing(one: np.ndarray, other: np.ndarray) -> float:
    """The share of pixels that differ."""
    return float((one != other).any(axis=2).mean())


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


def test_the_result_stands_across_the_middle_with_the_figures_alone() -> None:
    state = SimState.start(Config(seed=9, vehicles=0, potholes=0, rows=10))
    while state.world.outcome == "running":
        state = step(state).state
    pictures = [pixels(render("road", state, size=SIZE, look=Look(figures=on))) for on in (True, False)]
    middle = slice(SIZE[1] * 2 // 5, SIZE[1] * 3 // 5)
    assert differing(pictures[0][middle], pictures[1][middle]) > 0.3


def test_the_forecast_is_drawn_where_movers_are_expected() -> None:
    with_it, plain = drawn(Look(forecast=True)), drawn()
    assert 0.002 < differing(with_it, plain) < 0.15
    told, after = expected_cells(STATE), step(STATE).state
    assert len(told) == 3
    assert told[0] == {thing.id: thing.cell for thing in after.world.things() if thing.kind.moves}


def test_the_way_behind_and_the_next_move_are_drawn() -> None:
    column, row = STATE.world.road.cell(STATE.world.avs[0])
    trail = [(column, row - 3), (column, row - 2), (column, row - 1)]
    assert 0 < differing(drawn(trail=trail), drawn()) < 0.01
    coming = decide(STATE)
    assert coming is not None
    assert 0 < differing(drawn(coming=coming), drawn()) < 0.02
    hidden = Look(path=False)
    assert differing(drawn(hidden, trail=trail, coming=coming), drawn(hidden)) == 0


def test_the_move_under_way_is_drawn_and_fades() -> None:
    decision, after = decide(STATE), step(STATE).state

    def shown(phase: float, *, path: bool) -> np.ndarray:
        return pixels(
            render(
                "road",
                after,
                before=STATE.world,
                decision=decision,
                phase=phase,
                size=SIZE,
                look=Look(path=path),
            )
        )

    assert differing(shown(0.3, path=True), shown(0.3, path=False)) > 0
    assert differing(shown(1.0, path=True), shown(1.0, path=False)) == 0


def test_frames_of_a_film_know_the_way_behind_the_vehicle() -> None:
    runs = [STATE]
    for _ in range(4):
        runs.append(step(runs[-1]).state)
    frames = list(video_frames(runs, 2))
    cells = [state.world.road.cell(state.world.avs[0]) for state in runs]
    assert frames[0].trail == ()
    assert list(frames[-1].trail) == list(dict.fromkeys(cells[:-1]))
    one, other = (
        render_video("road", runs, "gif", fps=4, size=(160, 160), look=Look(path=path))
        for path in (True, False)
    )
    assert one != other
