"""The command `serve` with a heartbeat in its event loop: `python -m tests.faults.watched_process serve …`.

A task in the service's own loop wakes every millisecond and notes how late it was. Machines are shared,
and one that works for somebody else makes everybody late: what the loop's thread waited for a core counts
for nothing, and a long stall only where the process was at work during it, or where a look from another
thread found the loop in the midst of something (waiting for a disk, say) and not waiting for work.
`GET /beats` answers the worst since the last time it was asked.
"""

from __future__ import annotations

import asyncio
import os
import sys
import threading
import time
import traceback
from contextlib import suppress
from typing import Any

from fastapi import FastAPI

from service.cli import main, serve

EVERY_S = 0.001
LONG_S = 0.02


class Heart:
    """Beats in the loop it was started in."""

    def __init__(self) -> None:
        self.worst_s = 0.0
        self.stacks: list[str] = []
        self._task: asyncio.Task[None] | None = None
        self._last = 0.0
        self._seen = ""
        self._schedule: int | None = None

    def start(self) -> None:
        """Begin to beat; once."""
        if self._task is None:
            with suppress(OSError):
                self._schedule = os.open("/proc/thread-self/schedstat", os.O_RDONLY)
            self._task = asyncio.get_running_loop().create_task(self._beat())
            threading.Thread(target=self._look, args=(threading.get_ident(),), daemon=True).start()

    def take(self) -> dict[str, Any]:
        """What was worst since the last time."""
        told = {"worst_s": self.worst_s, "stacks": self.stacks}
        self.worst_s, self.stacks = 0.0, []
        return told

    async def _beat(self) -> None:
        while True:
            self._seen, worked, queued = "", time.process_time(), self._queued()
            self._last = time.monotonic()
            await asyncio.sleep(EVERY_S)
            late = time.monotonic() - self._last - EVERY_S - (self._queued() - queued)
            if late > LONG_S:
                worked = time.process_time() - worked
                if not self._seen and worked < late / 2:
                    continue
                self.stacks.append(f"{late * 1000:.0f} ms, {worked * 1000:.0f} at work: {self._seen}")
            self.worst_s = max(self.worst_s, late)

    def _queued(self) -> float:
        """How long this thread has waited for a core so far; 0 where the system does not tell."""
        if self._schedule is None:
            return 0.0
        return int(os.pread(self._schedule, 100, 0).split()[1]) / 1e9

    def _look(self, loop: int) -> None:
        """From a thread beside it: where the loop is when a beat is long overdue."""
        while True:
            time.sleep(EVERY_S * 5)
            if self._last and time.monotonic() - self._last > LONG_S:
                stack = traceback.extract_stack(sys._current_frames().get(loop))
                # In the loop itself it waits for work; here, it beats.
                if not stack[-1].filename.endswith(("runners.py", "watched.py")):
                    self._seen = "".join(traceback.format_list(stack[-4:]))


def with_heart(make: Any) -> Any:
    """The application with a heart."""

    def made(*args: Any, **named: Any) -> FastAPI:
        app: FastAPI = make(*args, **named)
        heart = Heart()

        async def beats() -> dict[str, Any]:
            heart.start()
            return heart.take()

        app.add_api_route("/beats", beats, tags=["testing"], include_in_schema=False)
        return app

    return made


if __name__ == "__main__":
    serve.create_app = with_heart(serve.create_app)
    main.main()
