"""The queue of dear work: a worker for each piece of work, client by client in turn.

A client that asks for much waits behind its own requests and delays those of others by no more than one each.
"""

from __future__ import annotations

import asyncio
import math
from collections import deque
from collections.abc import AsyncIterator, Iterator, Sequence
from contextlib import asynccontextmanager, contextmanager
from typing import Final

from service.problems import Stopped, TooMuchAtOnce
from service.work.units import UNIT_S
from service.work.worker import Worker

MOST_WAITING: Final = 64
"""Pieces of work that wait at most, of all clients together."""

LONGEST_WAIT_S: Final = 60
"""What `Retry-After` says at most."""


class WorkQueue:
    """Hands workers to pieces of work; for the event loop's thread."""

    def __init__(self, workers: Sequence[Worker], per_client: int) -> None:
        """`per_client`: pieces of work that one client may have, running or waiting."""
        self._workers = tuple(workers)
        self._idle = list(workers)
        self._per_client = per_client
        self._waiting: dict[str, deque[asyncio.Future[Worker]]] = {}
        self._pieces: dict[str, int] = {}
        self._units = 0
        self.stopped = False

    @property
    def running(self) -> int:
        """Pieces of work that have a worker."""
        return len(self._workers) - len(self._idle)

    @property
    def waiting(self) -> int:
        """Pieces of work that wait for a worker."""
        return sum(map(len, self._waiting.values()))

    @contextmanager
    def place(self, client: str, units: int) -> Iterator[None]:
        """A place in the queue; `client`: empty for the service. Raises `TooMuchAtOnce` or `Stopped`."""
        if self.stopped:
            raise Stopped
        pieces = self._pieces.get(client, 0)
        if client and pieces >= self._per_client:
            why = f"You have {pieces} dear requests under way, which is the limit (ROADTALK_MAX_CLIENT_WORK)."
            raise TooMuchAtOnce(why, self._wait_s())
        if client and self.waiting >= MOST_WAITING:
            raise TooMuchAtOnce(
                f"{MOST_WAITING} dear requests are waiting, the most there may be.", self._wait_s()
            )
        self._pieces[client] = pieces + 1
        self._units += units
        try:
            yield
        finally:
            self._units -= units
            left = self._pieces[client] - 1
            if left:
                self._pieces[client] = left
            else:
                del self._pieces[client]

    @asynccontextmanager
    async def worker(self, client: str) -> AsyncIterator[Worker]:
        """A worker, when it is this client's turn. Raises `Stopped`."""
        worker = await self._next(client)
        try:
            yield worker
        finally:
            self._hand_on(worker)

    def stop(self) -> None:
        """End all work at once; no more is taken."""
        self.stopped = True
        for worker in self._workers:
            worker.kill()
        for turns in self._waiting.values():
            for turn in turns:
                if not turn.done():
                    turn.set_exception(Stopped())
        self._waiting.clear()

    async def _next(self, client: str) -> Worker:
        if self.stopped:
            raise Stopped
        if self._idle:
            return self._idle.pop()
        turn: asyncio.Future[Worker] = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(client, deque()).append(turn)
        try:
            return await turn
        except asyncio.CancelledError:
            if turn.done() and not turn.cancelled() and turn.exception() is None:
                self._hand_on(turn.result())  # it came in the very moment
            else:
                self._leave(client, turn)
            raise

    def _leave(self, client: str, turn: asyncio.Future[Worker]) -> None:
        turns = self._waiting.get(client)
        if turns is not None and turn in turns:
            turns.remove(turn)
            if not turns:
                del self._waiting[client]

    def _hand_on(self, worker: Worker) -> None:
        """Give a worker to the client that has waited longest since its last turn, or keep it idle."""
        while self._waiting:
            client = next(iter(self._waiting))
            turns = self._waiting.pop(client)
            turn = turns.popleft()
            if turns:
                self._waiting[client] = turns  # behind the others
            if not turn.done():
                turn.set_result(worker)
                return
        self._idle.append(worker)

    def _wait_s(self) -> int:
        seconds = math.ceil(self._units * UNIT_S / len(self._workers))
        return max(1, min(LONGEST_WAIT_S, seconds))
