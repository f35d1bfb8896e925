"""Shards: which of several processes a session or a job lives in, computed from its id alone.

Rendezvous hashing: every shard has a weight for an id, and the heaviest one has it. With one shard more, only
the ids that move to the new one change their place. Nothing is stored or looked up: an id is drawn until it
belongs to the shard that draws it.
"""

from __future__ import annotations

import secrets
from dataclasses import dataclass
from hashlib import blake2b
from typing import Final

SESSION_ID_BYTES: Final = 16


def shard_of(key: str, shards: int) -> int:
    """The number of the shard, of so many, that has a key."""
    if shards == 1:
        return 0
    encoded = key.encode("utf-8", "surrogatepass")
    return max(range(shards), key=lambda shard: (_weight(encoded, shard), shard))


def _weight(key: bytes, shard: int) -> bytes:
    return blake2b(key, digest_size=8, salt=shard.to_bytes(8)).digest()


@dataclass(frozen=True, slots=True)
class Shard:
    """One of `count` processes that share a database; each has its share of the sessions."""

    number: int = 0
    count: int = 1

    def owns(self, key: str) -> bool:
        """Whether a session or a job with this id lives here."""
        return shard_of(key, self.count) == self.number

    def new_id(self, size: int = SESSION_ID_BYTES) -> str:
        """An unguessable id of so many random bytes that belongs here."""
        while not self.owns(drawn := secrets.token_urlsafe(size)):
            pass
        return drawn

    def share(self, amount: int) -> int:
        """A limit for all shards together, divided among them; at least 1."""
        return -(-amount // self.count)


SINGLE: Final = Shard()
"""The only process there is: the default."""
