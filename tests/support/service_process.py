"""The real service as a process of its own, that a test can kill and start again."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import httpx

from tests.support.ports import lasting_port

ROOT = Path(__file__).parents[2]
PATIENCE_S = 60
"""How long an answer may take on a busy machine."""


class ServiceProcess:
    """`roadtalk serve` on a free port, and always on that port."""

    def __init__(self, database: Path) -> None:
        self._database = database
        self._port = lasting_port()
        self._process: subprocess.Popen[str] | None = None
        self.url = ""

    def start(self) -> None:
        """Returns once it says that it is ready."""
        command = [sys.executable, "-m", "service", "serve", "--host", "127.0.0.1", "--port", str(self._port)]
        self._process = subprocess.Popen(
            [*command, "--database", f"sqlite:///{self._database}"],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout is not None
        ready = self._process.stdout.readline()
        self.url = ready.rsplit(" ", 1)[-1].strip().rstrip("/")
        if not self.url.startswith("http://"):
            self.kill()
            raise RuntimeError(f"the service did not start; it said {ready!r} and, above, why")

    def session(self, **wishes: Any) -> str:
        """A new session's id."""
        made = httpx.post(f"{self.url}/api/v1/sessions", json=wishes, timeout=PATIENCE_S)
        identity: str = made.raise_for_status().json()["id"]
        return identity

    def kill(self) -> None:
        """At once, as by a crash."""
        if self._process is None:
            return
        self._process.kill()
        self._process.wait()
        if self._process.stdout is not None:
            self._process.stdout.close()
        self._process = None


class Script:
    """What a script beside the page can do to the page's session."""

    def __init__(self, url: str, session: str) -> None:
        self._http = httpx.Client(base_url=f"{url}/api/v1/sessions/{session}", timeout=PATIENCE_S)

    def state(self) -> dict[str, Any]:
        """The world now."""
        values: dict[str, Any] = self._http.get("/state").raise_for_status().json()
        return values

    def count(self, kind: str) -> int:
        """How many things of a kind are on the road."""
        state = self.state()
        return sum(thing["kind"] == kind for thing in [*state["movers"], *state["hazards"]])

    def act(self, *actions: dict[str, Any]) -> dict[str, Any]:
        """Do typed actions."""
        answer = self._http.post("/actions", json={"actions": list(actions)})
        values: dict[str, Any] = answer.raise_for_status().json()
        return values

    def delete(self) -> None:
        """End the session."""
        self._http.delete(str(self._http.base_url).rstrip("/")).raise_for_status()

    def close(self) -> None:
        """Let go of the connection."""
        self._http.close()
