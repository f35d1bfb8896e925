"""The compiled look, against the same look in arrays: equal to the last bit."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from random import Random
from threading import Thread

import numpy as np
import pytest

from sim.compilation import cache_folder
from sim.config import Config
from sim.perceive import NO_BELIEF, perceive
from sim.perceive.belief import GridBelief
from sim.perceive.grid_sensor import gather, show
from sim.perceive.kernel import run as kernel
from sim.perceive.kernel.tables import suite_tables
from sim.perceive.log_odds import LIMIT
from sim.perceive.occlusion import shadow
from sim.perceive.parameters import SUITES
from sim.perceive.percept import Percept
from sim.perceive.sensor_model import tuning_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import KINDS, Kind, Outcome
from sim.world.grid import cells_of
from tests.support.two_egos import drawn

WEATHER = ("clear", "rain", "fog", "snow")
LIGHT = ("day", "dusk", "night", "dawn")


@pytest.fixture(autouse=True, scope="module")
def loaded() -> None:
    kernel.load()


def both(state: SimState) -> list[tuple[Percept, GridBelief]]:
    """One look in arrays and one compiled."""
    world, config = state.world, state.config
    belief = state.belief if isinstance(state.belief, GridBelief) else None
    suite = SUITES[config.sensor]
    slow = show(world, config, 0, belief, gather(world, config, 0, belief, suite))
    return [slow, kernel.sense_tick(world, config, 0, belief, suite)]


def assert_equal(state: SimState) -> None:
    (percept, belief), (fast_percept, fast_belief) = both(state)
    for field in fields(Percept):
        assert getattr(percept, field.name) == getattr(fast_percept, field.name), field.name
    for field in fields(GridBelief):
        assert getattr(belief, field.name) == getattr(fast_belief, field.name), field.name
    assert np.abs(np.frombuffer(belief.layers, "<i2")).max() <= LIMIT
    for table in ("movers", "hazards", "likelihoods"):  # in the same order too
        assert list(getattr(percept, table)) == list(getattr(fast_percept, table))


@pytest.mark.parametrize("sensor", SUITES)
@pytest.mark.parametrize("seed", range(4))
def test_every_tick_of_a_drive_is_seen_alike(sensor: str, seed: int) -> None:
    config = Config(
        seed=2**53 - 1 - seed,
        sensor=sensor,
        weather=WEATHER[seed],  # type: ignore[arg-type]
        time_of_day=LIGHT[seed],  # type: ignore[arg-type]
        potholes=(None, 25, 10, 0)[seed],
        pedestrians=(0, 6)[seed % 2],
        barriers=(8, 0)[seed % 2],
        detection_sensitivity=(0.5, 0.8, 0.95, 0.05)[seed],
        attentive=(0.0, 1.0)[seed % 2],
        courtesy=(0.0, 0.5)[seed // 2],
        sensor_range_m=(150.0, 40.0, 150.0, 80.0)[seed],
        sensor_noise=(0.0, 0.0, 0.2, 0.1)[seed],
        false_positive_rate=(0.0, 0.5, 0.0, 0.2)[seed],
    )
    state, ticks = SimState.start(config), 0
    while state.world.outcome is Outcome.RUNNING and ticks < 40:
        assert_equal(state)
        state, ticks = step(state).state, ticks + 1
    assert ticks > 2


@pytest.mark.parametrize(
    ("columns", "rows", "cell_m"), [(3, 4, 5.0), (13, 9, 0.5), (64, 40, 20.0), (5, 90, 2.0)]
)
def test_roads_of_other_sizes_are_seen_alike(columns: int, rows: int, cell_m: float) -> None:
    config = Config(columns=columns, rows=rows, cell_m=cell_m, sensor="fusion", weather="rain", potholes=3)
    state = SimState.start(config)
    for _ in range(6):
        if state.world.outcome is Outcome.RUNNING:
            assert_equal(state)
            state = step(state).state


def test_changes_of_weather_and_of_what_is_there_are_seen_alike() -> None:
    timeline = Timeline(Config(seed=6, sensor="fusion", potholes=15, pedestrians=4))
    for tick in range(16):
        state = timeline.state
        if tick % 4 == 3:
            weather = WEATHER[tick // 4]
            config = state.config.with_parts(
                weather=weather, sensor=("camera", "lidar", "radar", "fusion")[tick // 4]
            )
            gone = {name for name in state.world.hazards.values() if name.endswith("3")}
            state = timeline.state = replace(state, config=config, world=state.world.without(gone))
        assert_equal(state)
        timeline.advance()


def test_several_vehicles_see_alike() -> None:
    drawn_state = drawn(Random("seen"), "rules", 3)
    config = drawn_state.config.with_parts(sensor="fusion", weather="rain")
    state = SimState.start(config, drawn_state.world, ["rules", "rules", "rules"])
    for _ in range(8):
        for number, id in enumerate(state.egos):
            world, belief = state.world, state.egos[id].belief
            known = belief if isinstance(belief, GridBelief) else None
            suite = SUITES[config.sensor]
            slow = show(world, config, number, known, gather(world, config, number, known, suite))
            assert kernel.sense_tick(world, config, number, known, suite) == slow
        state = step(state).state


def test_shadows_are_those_of_every_body_and_in_one_piece() -> None:
    columns, reach = 6, 8
    suite, nothing = (
        SUITES["fusion"],
        Config(columns=columns, rows=12, sensor="fusion", cell_m=20.0, vehicles=0),
    )
    kernel.sense_tick(SimState.start(nothing).world, nothing, 0, None, suite)
    tables = suite_tables(suite, "clear", "day", 20.0, columns, tuning_of(nothing))
    assert tables.shadows.shape[2] == reach + 1
    for number, kind in enumerate((*kernel.NUMBER, Kind.AV)):
        for place in range(2 * columns - 1):
            across = place - columns + 1
            column = max(0, -across)
            for ahead in range(reach + 1):
                if across == ahead == 0 or not KINDS[kind].occludes:
                    continue
                wanted = np.zeros((reach + 1, columns), bool)
                for cell in cells_of(shadow(columns, column, reach, kind, across, ahead)):
                    wanted[reach - cell // columns, cell % columns] = True
                for row in range(reach + 1):
                    first, last = tables.shadows[number, place, ahead, row]
                    there = [first <= other - column <= last for other in range(columns)]
                    assert there == wanted[row].tolist(), (kind, across, ahead, row)


def test_the_kernel_is_loaded_in_the_background_after_many_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[str] = []
    monkeypatch.setattr(kernel, "_kernel", None)
    monkeypatch.setattr(kernel, "_looks", 0)
    monkeypatch.setattr(Thread, "start", lambda thread: begun.append(thread.name))
    state = SimState.start(Config(seed=1, sensor="camera"))
    seen = [perceive(state.world, state.config, 0, NO_BELIEF) for _ in range(kernel.WORTHWHILE + 3)]
    assert begun == ["look-kernel"]
    kernel.load()
    assert kernel.ready()
    assert perceive(state.world, state.config, 0, NO_BELIEF) == seen[0] == seen[-1]


def test_every_source_of_the_kernel_counts_for_what_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    folders = set()
    for suffix in (b"", b"\n"):
        read = Path.read_bytes
        monkeypatch.setattr(
            Path,
            "read_bytes",
            lambda path, read=read, suffix=suffix: read(path) + suffix * (path.name == "show.py"),
        )
        cache_folder.cache_clear()
        folders.add(cache_folder())
        monkeypatch.undo()
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    cache_folder.cache_clear()
    assert len(folders) == 2
