"""A real service process, for what only a process shows."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import httpx

ROOT = Path(__file__).parents[2]
START_S = 180


class NotStartedError(Exception):
    """The service ended instead of starting; the message is what it said."""


class Watched:
    """A service whose event loop is watched. What it writes goes to a file, so that it never waits for us."""

    def __init__(
        self,
        database: str,
        *,
        before: Sequence[str] = (),
        environment: Mapping[str, str] | None = None,
        errors: Path | None = None,
    ) -> None:
        """`before` is put before the command; `errors` is where its log goes. Raises `NotStartedError`."""
        self._folder = tempfile.TemporaryDirectory(prefix="roadtalk-")
        out, self.errors = Path(self._folder.name) / "out", errors or Path(self._folder.name) / "errors"
        command = [*before, sys.executable, "-m", "tests.faults.watched_process"]
        with out.open("w") as stdout, self.errors.open("w") as stderr:
            self.process = subprocess.Popen(
                [*command, "serve", "--port", "0", "--database", database],
                cwd=ROOT,
                stdout=stdout,
                stderr=stderr,
                env=os.environ | dict(environment or {}),
            )
        try:
            self.url = self._address(out)
            self.http = httpx.Client(verify=False, base_url=self.url, timeout=60)
            self.beats()
        except BaseException:
            self._end(signal.SIGKILL)
            raise

    def _address(self, out: Path) -> str:
        until = time.monotonic() + START_S
        while time.monotonic() < until:
            found = re.search(r"http://\S+", out.read_text())
            if found is not None:
                return found.group()
            if self.process.poll() is not None:
                raise NotStartedError(self.errors.read_text())
            time.sleep(0.02)
        raise NotStartedError(f"not within {START_S} s")

    def beats(self) -> float:
        """The longest that the loop was held since the last time, in seconds."""
        told: dict[str, Any] = self.http.get("/beats").json()
        self.stacks: list[str] = told["stacks"]
        return float(told["worst_s"])

    def stop(self) -> None:
        """Gracefully."""
        self._end(signal.SIGTERM)

    def kill(self) -> None:
        """At once."""
        self._end(signal.SIGKILL)

    def _end(self, how: signal.Signals) -> None:
        if hasattr(self, "http"):
            self.http.close()
        self.process.send_signal(how)
        self.process.wait(60)
        self._folder.cleanup()
