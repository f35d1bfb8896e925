from __future__ import annotations

import os
from pathlib import Path

import pytest

from service.cache_files import FOLDER_VARIABLE, cache_folder, digest_of, read_cached, write_cached

SOURCES = digest_of(b"what it is made of")
VALUE = {"nodes": [({"add": 1}, None, ("a", 2.0))], 3: frozenset("ab")}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_what_was_written_is_read(folder: Path) -> None:
    assert read_cached("it", SOURCES) is None
    write_cached("it", SOURCES, VALUE)
    assert read_cached("it", SOURCES) == VALUE
    assert [path.name for path in folder.iterdir()] == ["it"]


@pytest.mark.usefixtures("folder")
def test_other_sources_have_nothing() -> None:
    write_cached("it", SOURCES, VALUE)
    assert read_cached("it", digest_of(b"what it is made of", b"")) is None
    assert digest_of(b"ab", b"c") != digest_of(b"a", b"bc")


@pytest.mark.parametrize("cut", [0, 10, 63, 64, 70, -1])
def test_a_cut_file_counts_as_not_there(folder: Path, cut: int) -> None:
    write_cached("it", SOURCES, VALUE)
    whole = (folder / "it").read_bytes()
    (folder / "it").write_bytes(whole[:cut])
    assert read_cached("it", SOURCES) is None


def test_a_file_with_one_other_byte_counts_as_not_there(folder: Path) -> None:
    write_cached("it", SOURCES, VALUE)
    whole = (folder / "it").read_bytes()
    for at in range(len(whole)):
        (folder / "it").write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
        assert read_cached("it", SOURCES) is None


@pytest.mark.skipif(os.name == "nt", reason="no such permissions")
def test_a_file_that_others_may_write_is_not_believed(folder: Path) -> None:
    write_cached("it", SOURCES, VALUE)
    (folder / "it").chmod(0o666)
    assert read_cached("it", SOURCES) is None
    (folder / "it").chmod(0o600)
    (folder / "it").rename(folder / "that")
    (folder / "it").symlink_to(folder / "that")
    assert read_cached("it", SOURCES) is None


def test_no_folder_to_write_to_is_no_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path / "file" / "below"))
    write_cached("it", SOURCES, VALUE)
    assert read_cached("it", SOURCES) is None
    monkeypatch.setenv(FOLDER_VARIABLE, "")
    write_cached("it", SOURCES, VALUE)
    assert read_cached("it", SOURCES) is None


def test_the_folder_is_the_users_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(FOLDER_VARIABLE, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() == tmp_path / "roadtalk"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache_folder() == tmp_path / ".cache" / "roadtalk"
