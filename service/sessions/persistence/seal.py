"""Seals: a service knows the recordings that it made itself, and takes them however long they are.

The limit on the ticks of a recording guards against work that others ask for. A session that ran here for
longer than that has cost this work already, so its own recording carries a seal: a keyed digest of all that
is replayed, by a secret that lies in the store. On another service it is worth nothing.
"""

from __future__ import annotations

import hmac
from collections.abc import Sequence
from hashlib import sha256
from typing import Any

import orjson
from pydantic import ValidationError

from service import actions as contract
from service.store import EntryRecord

SECRET = "recordings"
"""The name of the secret in the store."""


class Seal:
    """Makes and checks the seals of one service."""

    def __init__(self, secret: bytes) -> None:
        self._secret = secret

    def of(
        self, config: dict[str, Any], entries: Sequence[EntryRecord], tick: int, digest: str, language: str
    ) -> str | None:
        """The seal of what is replayed; None for a log that can no longer be read."""
        try:
            said = [[entry.tick, contract.dump(contract.load(entry.actions))] for entry in entries]
        except ValidationError:
            return None
        values = orjson.dumps([config, said, tick, digest, language], option=orjson.OPT_SORT_KEYS)
        return hmac.new(self._secret, values, sha256).hexdigest()

    def fits(self, seal: str, *sealed: Any) -> bool:
        """Whether a seal is that of these parts, which are those of `of`."""
        made = self.of(*sealed)
        return made is not None and hmac.compare_digest(made.encode(), seal.encode())
