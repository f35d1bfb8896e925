"""For all tests: nothing is timed, since machines differ and share; speed is for the benchmarks."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache

import pytest
from hypothesis import settings

from service.narrate import Narrator
from service.talk.languages import Languages
from tests.service.postgres import Server, binaries, serving

settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")


@pytest.fixture(scope="session", autouse=True)
def words_read_once() -> Iterator[None]:
    """Grammars and sayings never change, and reading them is most of what making an application takes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Languages, "load", cache(Languages.load))
        patch.setattr(Narrator, "load", cache(Narrator.load))
        yield


@pytest.fixture(scope="session")
def postgres() -> Iterator[Server]:
    """A PostgreSQL server for the tests that want one; on a machine without one they are skipped."""
    programs = binaries()
    if programs is None:
        if os.environ.get("CI"):
            pytest.fail("no PostgreSQL server is installed, and CI must have one")
        pytest.skip("no PostgreSQL server is installed (Debian: apt-get install postgresql)")
    with serving(programs) as server:
        yield server
