"""Sensors that err can be named in a configuration while these tests run."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.rides import SENSORS
from tests.support.sensors import NAMES, registered


@pytest.fixture(autouse=True, scope="package")
def sensors() -> Iterator[None]:
    """All of them can be named in a configuration."""
    assert tuple(sensor.name for sensor in SENSORS) == NAMES
    with registered(*SENSORS):
        yield
