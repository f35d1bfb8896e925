"""The one key of a service that strangers can reach, compared in constant time.

It comes as `Authorization: Bearer ...`, never in a URL: those are logged, kept and sent on.
"""

from __future__ import annotations

import hashlib
import hmac

from pydantic import SecretStr


class Key:
    """The key that is asked for, if any is."""

    def __init__(self, secret: SecretStr | None) -> None:
        value = "" if secret is None else secret.get_secret_value()
        self._digest = _digest(value) if value else None

    @property
    def asked(self) -> bool:
        """Whether a key is asked for at all."""
        return self._digest is not None

    def right(self, said: str) -> bool:
        """Whether this is the key. Digests are compared, so that not even its length can be timed."""
        return self._digest is None or hmac.compare_digest(self._digest, _digest(said))

    def admits(self, authorization: str | None) -> bool:
        """Whether a request with this header may come in."""
        if self._digest is None:
            return True
        scheme, _, said = (authorization or "").partition(" ")
        return scheme.lower() == "bearer" and self.right(said.strip())


def _digest(value: str) -> bytes:
    return hashlib.sha256(value.encode("utf-8", "surrogatepass")).digest()
