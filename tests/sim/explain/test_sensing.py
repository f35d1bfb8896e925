"""How far a sensor detects, against its own table of chances, and what it misses."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain.sensing import reach, sensing
from sim.perceive.detection import detection_chance
from sim.session.timeline import Timeline
from sim.types import Kind


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar", "fusion"])
@pytest.mark.parametrize("weather", ["clear", "fog", "snow"])
def test_nothing_is_detected_beyond_the_range_and_something_within_it(sensor: str, weather: str) -> None:
    config = Config().with_parts(sensor=sensor, weather=weather, cell_m=5.0)
    found = reach(config)
    assert found is not None
    assert all(
        detection_chance(config, kind, found.metres + 0.001) == 0.0
        for kind in (Kind.VEHICLE, Kind.POTHOLE, Kind.BARRIER)
    )
    assert (detection_chance(config, Kind.VEHICLE, found.metres) or 0.0) > 0.0
    for kind, cells in found.half.items():
        assert cells <= found.cells
        if cells:
            assert (detection_chance(config, kind, cells * 5.0) or 0.0) >= 0.5
        assert (detection_chance(config, kind, (cells + 1) * 5.0) or 0.0) < 0.5 or cells == found.cells


def test_a_set_range_shortens_what_a_device_sees() -> None:
    found = reach(Config().with_parts(sensor="radar", sensor_range_m=12.0))
    assert found is not None
    assert (found.metres, found.cells) == (12.0, 2)


def test_a_perfect_sensor_misses_nothing_and_fog_hides_what_is_far() -> None:
    clear = sensing(Timeline(Config(seed=3)).state)
    assert (clear.faithful, clear.blind, clear.wrong.missed) == (True, False, ())
    foggy = sensing(Timeline(Config(seed=3, sensor="camera", weather="fog")).state)
    assert foggy.wrong.missed
    assert 0 < foggy.out_of_range <= len(foggy.wrong.missed)
    assert foggy.things == sum(foggy.state.world.counts().values())
