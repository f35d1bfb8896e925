"""A real service process with a file, killed by the system. Its clock is real: its sessions stand still."""

from __future__ import annotations

import asyncio
import signal
import tempfile
from pathlib import Path

import httpx

from tests.model.following import Follower
from tools.kill import Service

ASKED = 2_000
"""How often is asked for a line that is told of a little later."""


class Outside:
    """One process after the other, on one file."""

    by_hand = False
    log_events = 400

    async def __aenter__(self) -> Outside:
        self._folder = tempfile.TemporaryDirectory(prefix="roadtalk-")
        self._database = f"sqlite:///{Path(self._folder.name)}/roads.db"
        await self._start()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._end(signal.SIGTERM)
        self._folder.cleanup()

    async def _start(self) -> None:
        self._service = await asyncio.to_thread(Service, self._database)
        self.http = httpx.AsyncClient(verify=False, base_url=self._service.url, timeout=60)

    async def _end(self, how: signal.Signals) -> None:
        await self.http.aclose()
        await asyncio.to_thread(self._service.kill, how)

    async def stop(self) -> None:
        """Gracefully, and begin anew."""
        await self._end(signal.SIGTERM)
        await self._start()

    async def kill(self) -> None:
        """Without a word, and begin anew."""
        await self._end(signal.SIGKILL)
        await self._start()

    def now(self, _path: str) -> int | None:
        """Nothing moves by itself here."""
        return None

    async def watch(self, path: str) -> None:
        """Only inside is it known when all there is has been heard."""

    async def settled(self, path: str, lines: int) -> None:
        """Wait for as many lines; that there are no more or other ones is compared later."""
        for _ in range(ASKED):
            newest = (await self.http.get(f"{path}/events", params={"limit": 1})).json()["items"]
            if lines <= (newest[-1]["number"] if newest else 0):
                return
        raise TimeoutError(f"{lines} lines of the log")

    async def heard(self, _path: str) -> list[Follower]:
        return []

    async def let_go(self, path: str) -> None:
        pass
