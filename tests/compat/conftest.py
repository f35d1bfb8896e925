"""A copy of a database that an older version made."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.kept_data import copied


@pytest.fixture
def database(version: str, tmp_path: Path) -> Iterator[Path]:
    """The copy for a test that has a version."""
    with copied(version, tmp_path) as copy:
        yield copy
