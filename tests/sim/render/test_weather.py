"""Weather and what is not seen, drawn over the road."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.render import pixels, render
from sim.render.sensed_marks import NOTHING, marks_of
from sim.state import SimState
from sim.transition import step

SIZE = (240, 240)


def drawn(**parts: object) -> bytes:
    state = SimState.start(Config(seed=3).with_parts(**parts))
    return pixels(render("road", state, size=SIZE)).tobytes()


CONDITIONS = [
    *({"weather": each} for each in ("rain", "fog", "snow")),
    *({"time_of_day": each} for each in ("dusk", "dawn", "night")),
]


@pytest.mark.parametrize("parts", CONDITIONS, ids=str)
def test_conditions_show_and_the_same_moment_looks_the_same(parts: dict[str, str]) -> None:
    assert drawn(**parts) == drawn(**parts) != drawn()


def test_night_is_darker_and_fog_is_lighter() -> None:
    dark, plain, light = (sum(drawn(**parts)) for parts in ({"time_of_day": "night"}, {}, {"weather": "fog"}))
    assert dark < plain < light


def test_rain_falls() -> None:
    state = SimState.start(Config(seed=3, weather="rain"))
    frames = {pixels(render("road", state, size=SIZE, phase=phase)).tobytes() for phase in (0.0, 0.3, 0.6)}
    assert len(frames) == 3


def test_what_is_marked_is_what_the_sensor_gets_wrong() -> None:
    state = SimState.start(Config(seed=3, sensor="radar", potholes=20))
    unseen = 0
    for _ in range(6):
        row = state.world.road.cell(state.world.av)[1]
        marks = marks_of(state)
        there = {thing.cell for thing in state.world.things() if thing.cell[1] <= row}
        assert set(marks.unseen) <= there
        assert not {cell for cell in marks.made_up if cell[1] > row}
        assert marks_of(state) is marks
        unseen += len(marks.unseen)
        state = step(state).state
    assert unseen > 20
    assert marks_of(SimState.start(Config(seed=3))) == NOTHING
