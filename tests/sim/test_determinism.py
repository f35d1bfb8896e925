"""The same configuration and actions give the same states in every process, whatever its hash seed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from tests.support.print_digests import SCRIPT, TICKS, digests

ROOT = Path(__file__).parents[2]


def replayed(hash_seed: str) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-m", "tests.support.print_digests"],
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    return done.stdout.splitlines()


def test_a_recording_replays_to_the_same_digest_at_every_tick() -> None:
    assert len(SCRIPT) == 20
    assert all(tick % 2 for tick in SCRIPT)
    here = digests()
    assert len(here) == len(set(here)) == TICKS
    for hash_seed in ("1", "4242"):
        assert replayed(hash_seed) == here
