"""Killed at random moments under load, nothing acknowledged is lost; the long version is `kill` itself."""

from __future__ import annotations

from pathlib import Path

from tests.support.postgres import Server
from tools import kill


def test_killed_it_loses_nothing(tmp_path: Path) -> None:
    report = kill.run(f"sqlite:///{tmp_path}/roads.db", rounds=3, clients=3, least=6)
    assert report.acknowledged > 10


def test_killed_over_a_server_it_loses_nothing(postgres: Server) -> None:
    report = kill.run(postgres.new_database(), rounds=2, clients=3, least=6)
    assert report.acknowledged > 10
