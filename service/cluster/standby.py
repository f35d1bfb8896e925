"""Processes that have loaded everything and can become a shard: how many there are, and which one is next."""

from __future__ import annotations

import asyncio
import math
from collections import Counter


def processes_of_node(workers: int, nodes: int) -> int:
    """How many processes to start for each of several nodes: its part of the shards, and of a dead node's."""
    share = math.ceil(workers / nodes)
    return share + math.ceil(share / (nodes - 1))


class Standby:
    """The processes that are ready. All methods are for the event loop's thread."""

    def __init__(self, first: int) -> None:
        """None is taken before `first` were ready: else those of the fastest node would get all shards."""
        self._missing = first
        self._ready: dict[int, str] = {}
        self._taken: dict[int, str] = {}
        self._doubted: set[str] = set()
        """nodes where a process has died and none has started since: they may be dead"""
        self._changed = asyncio.Condition()

    async def add(self, process: int, node: str) -> None:
        """A process on this node is ready, for the first time or again."""
        async with self._changed:
            self._ready[process] = node
            self._doubted.discard(node)
            self._missing -= 1
            self._changed.notify_all()

    async def take(self) -> int:
        """Wait for a process, and take one on a node that lives and has the fewest shards."""
        async with self._changed:
            await self._changed.wait_for(lambda: self._missing <= 0 and self._ready)
            shards = Counter(self._taken.values())
            process = min(
                self._ready, key=lambda each: (self._ready[each] in self._doubted, shards[self._ready[each]])
            )
            self._taken[process] = self._ready.pop(process)
            return process

    def leave(self, process: int) -> None:
        """A process that was taken has died."""
        self._doubted.add(self._taken.pop(process))
