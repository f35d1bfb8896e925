"""The reference of the client, run line by line against a service of its own."""

from __future__ import annotations

import doctest
from pathlib import Path

from tests.support.service_process import ROOT, ServiceProcess

README = ROOT / "docs" / "reference" / "client.md"


def test_the_examples_are_so(process: ServiceProcess, tmp_path: Path) -> None:
    text = README.read_text(encoding="utf-8")
    assert text.count("http://127.0.0.1:8000") == 1
    local = tmp_path / "README.md"
    local.write_text(text.replace("http://127.0.0.1:8000", process.url), encoding="utf-8")
    results = doctest.testfile(str(local), module_relative=False, encoding="utf-8")
    assert results.failed == 0
    assert results.attempted > 15
