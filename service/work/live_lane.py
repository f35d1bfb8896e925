"""The live lane: decisions of live sessions whose tick is dear, taken in a process of their own.

One process for all of them, so that they delay each other and nobody else: a session whose decision is not
there yet does not tick, and everything else goes on.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, Final

from service.problems import Stopped
from service.work.codec import pack_call, unpack_result
from service.work.worker import Worker, WorkerLostError

MOST_DECISION_S: Final = 30.0
"""Time limit of one decision of a live session, in seconds."""


class NoDecisionError(Exception):
    """A decision was not taken: it took too long, or its process ended."""


class LiveLane:
    """One worker, one decision at a time, in the order in which they were asked for."""

    def __init__(self, worker: Worker) -> None:
        self._worker = worker
        self._turn = asyncio.Lock()
        self._stopped = False

    async def run(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """The result of a function. Raises `NoDecisionError`, or `Stopped` when the service stops."""
        packed = pack_call(function, arguments)
        async with self._turn:
            if self._stopped:
                raise Stopped
            try:
                async with asyncio.timeout(MOST_DECISION_S):
                    answer = await self._worker.call(packed)
            except TimeoutError:
                raise NoDecisionError(f"did not answer within {MOST_DECISION_S:g} s") from None
            except WorkerLostError as error:
                if self._stopped:
                    raise Stopped from error
                raise NoDecisionError("ended without an answer") from error
        return unpack_result(answer)

    def stop(self) -> None:
        """End the decision under way; no more are taken."""
        self._stopped = True
        self._worker.kill()
