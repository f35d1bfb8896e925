"""The API key of a service, compared in constant time.

It comes as `Authorization: Bearer ...`, never in a URL: those are logged, kept and sent on.
"""

from __future__ import annotations

import hashlib
import hmac

from pydantic import SecretStr


class Key:
    """The key of one service, if it has one."""

    def __init__(self, secret: SecretStr | None) -> None:
        value = "" if secret is None else secret.get_secret_value()
        self._digest = _digest(value) if value else None

    @property
    def required(self) -> bool:
        """Whether there is a key."""
        return self._digest is not None

    def matches(self, value: str) -> bool:
        """Whether a value is the key. Compares digests, so that not even its length can be timed."""
        return self._digest is None or hmac.compare_digest(self._digest, _digest(value))

    def admits(self, authorization: str | None) -> bool:
        """Whether a request with this header may come in."""
        if self._digest is None:
            return True
        scheme, _, value = (authorization or "").partition(" ")
        return scheme.lower() == "bearer" and self.matches(value.strip())


def _digest(value: str) -> bytes:
    return hashlib.sha256(value.encode("utf-8", "surrogatepass")).digest()
