"""One language for all tests: loading is what takes time, and a loaded language never changes."""

from __future__ import annotations

import pytest

from service.grammar import Language


@pytest.fixture(scope="session")
def language() -> Language:
    return Language.load()
