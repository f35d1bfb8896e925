"""For all tests: nothing is timed, since machines differ and share; speed is for the benchmarks."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")
