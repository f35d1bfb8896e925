"""Tests that share something run in one worker; versions of pytest and pytest-xdist may not go together."""

from __future__ import annotations

import os

import pytest


@pytest.mark.parametrize("number", range(6))
def test_the_tests_of_a_file_run_in_one_worker(number: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    worker, folder = os.environ.get("PYTEST_XDIST_WORKER"), tmp_path_factory.getbasetemp()
    told = (folder if worker is None else folder.parent) / "workers of a file"
    with told.open("a", encoding="utf-8") as file:
        file.write(f"{worker}\n")
    assert set(told.read_text(encoding="utf-8").split()) == {str(worker)}, number
