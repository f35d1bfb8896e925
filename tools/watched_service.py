"""`roadtalk serve`, with a route that tells how long the event loop was held: `GET /loop`.

Processor time of the loop's thread, so that other programs on the machine have no say in it. For
`tools.dear_requests`; never part of a service that others use.
"""

from __future__ import annotations

import asyncio
import time
from typing import Any

from fastapi import FastAPI

from service.cli import main as command
from service.cli import serve

LOOK_EVERY_S = 0.001


class LoopWatch:
    """The longest processor time between two turns of the loop since it was last asked, in seconds."""

    def __init__(self) -> None:
        self._longest_s = 0.0
        self._task: asyncio.Task[None] | None = None

    async def taken(self) -> float:
        """The figure; the first call begins to watch."""
        if self._task is None:
            self._task = asyncio.create_task(self._watch())
        longest, self._longest_s = self._longest_s, 0.0
        return longest

    async def _watch(self) -> None:
        last = time.thread_time()
        while True:
            await asyncio.sleep(LOOK_EVERY_S)
            now = time.thread_time()
            self._longest_s = max(self._longest_s, now - last)
            last = now


def watched(*args: Any, **named: Any) -> FastAPI:
    """The service's application with that route."""
    app = create_app(*args, **named)
    app.add_api_route("/loop", LoopWatch().taken, include_in_schema=False)
    app.router.routes.insert(0, app.router.routes.pop())
    return app


create_app = serve.create_app

if __name__ == "__main__":
    serve.create_app = watched
    command.main()
