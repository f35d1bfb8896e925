"""Where the shards are: kept up to date by `ray_shards`, read by the entry."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count


class ShardsNotStartedError(Exception):
    """The shards cannot be started; the message says why."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a running shard listens for the entry."""

    host: str
    port: int
    process: int
    version: str

    @property
    def address(self) -> str:
        """Host and port as one text."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"


class Places:
    """The shards of one service. All methods are for the event loop's thread."""

    def __init__(self, shards: int) -> None:
        self._places: list[Place | None] = [None] * shards
        self.restarts = [0] * shards
        """how often each shard was replaced"""
        self._turns = count()

    def __len__(self) -> int:
        return len(self._places)

    def __getitem__(self, shard: int) -> Place | None:
        """Where a shard is; None while it is being replaced."""
        return self._places[shard]

    def __iter__(self) -> Iterator[Place | None]:
        return iter(self._places)

    def set(self, shard: int, place: Place | None) -> None:
        """A shard is there now, or is not."""
        self._places[shard] = place

    def any_up(self) -> int:
        """The number of a shard that is up, each in its turn; of any if none is."""
        first = next(self._turns)
        turns = [(first + each) % len(self) for each in range(len(self))]
        return next((shard for shard in turns if self._places[shard] is not None), turns[0])
