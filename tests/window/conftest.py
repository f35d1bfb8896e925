"""Windows without a display, closed when a test is over."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from os import environ

environ.setdefault("SDL_VIDEODRIVER", "dummy")

import pytest

from service.window.loading import Loaded, load
from tests.window.driver import Driver

Open = Callable[..., Driver]


@pytest.fixture(scope="session")
def loaded() -> Loaded:
    """The language, read once."""
    return load()


@pytest.fixture
def window(loaded: Loaded) -> Iterator[Open]:
    """Opens windows."""
    drivers: list[Driver] = []

    def open_one(**parts: object) -> Driver:
        drivers.append(Driver(loaded, **parts))  # type: ignore[arg-type]
        return drivers[-1]

    yield open_one
    for driver in drivers:
        driver.close()
