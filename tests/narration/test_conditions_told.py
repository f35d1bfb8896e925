"""That the perfect sensor heeds no weather is said only where it is the one that is used."""

from __future__ import annotations

import pytest

from tests.support.sessions import Service, do

FOG = {"do": "set", "parameter": "weather", "value": "fog"}
CAMERA = {"do": "set", "parameter": "sensor", "value": "camera"}
RANGE = {"do": "set", "parameter": "sensor_range_m", "value": 40}
NOISE = {"do": "set", "parameter": "sensor_noise", "value": 0.0}


@pytest.mark.parametrize(
    ("actions", "told"),
    [
        ((FOG,), True),
        ((FOG, CAMERA), False),
        ((CAMERA, FOG), False),
        ((RANGE,), True),
        ((RANGE, CAMERA), False),
    ],
    ids=str,
)
async def test_the_sensor_at_the_end_of_the_sentence_counts(
    actions: tuple[dict[str, object], ...], told: bool
) -> None:
    reply = await do(await Service().session(paused=True), *actions)
    assert ("the perfect sensor" in reply) is told, reply


async def test_a_setting_of_zero_that_was_so_already_is_told_with_its_value() -> None:
    reply = await do(await Service().session(paused=True), NOISE)
    assert "0 %" in reply
