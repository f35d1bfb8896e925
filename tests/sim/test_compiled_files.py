"""What was compiled from one copy of the sources is not taken to be compiled from another."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim import compiled_files

SIM = compiled_files._SIM
COMPILED_IN = compiled_files._COMPILED_IN


@pytest.fixture(autouse=True)
def forgotten() -> Iterator[None]:
    """What was found out about the sources is found out anew."""
    yield
    compiled_files.cache_folder.cache_clear()
    compiled_files._copy.cache_clear()


def mark_of(sources: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(compiled_files, "_SIM", sources)
    monkeypatch.setattr(
        compiled_files,
        "_COMPILED_IN",
        tuple(sources / each.relative_to(SIM) for each in COMPILED_IN),
    )
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    compiled_files.cache_folder.cache_clear()
    compiled_files._copy.cache_clear()
    mark = compiled_files.ready_mark("kernels")
    assert mark is not None
    return mark


def test_each_copy_of_the_sources_has_its_own_mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = (Path(shutil.copytree(SIM, tmp_path / name)) for name in ("first", "second"))
    one, two = (mark_of(each, tmp_path, monkeypatch) for each in (first, second))
    assert one.parent == two.parent
    assert one != two
    assert mark_of(first, tmp_path, monkeypatch) == one


def test_sources_that_were_written_anew_are_compiled_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy = Path(shutil.copytree(SIM, tmp_path / "copy"))
    before = mark_of(copy, tmp_path, monkeypatch)
    os.utime(next((copy / "batch").glob("*.py")), (0, 0))
    assert mark_of(copy, tmp_path, monkeypatch) != before
