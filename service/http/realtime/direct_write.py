"""The server's offer, in a connection's scope, to write a message straight to its socket.

`service.http.protocol.direct_write` makes the offer; a server without it loses nothing but time.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

from starlette.types import Scope

EXTENSION: Final = "roadtalk.direct_write"
"""The key in the scope's `extensions`."""

DirectWrite: TypeAlias = Callable[[bytes], bool]
"""Sends a whole text message now, or returns false and sends nothing."""


def direct_write_of(scope: Scope) -> DirectWrite | None:
    """The offer of a connection's server, if there is one."""
    found: DirectWrite | None = (scope.get("extensions") or {}).get(EXTENSION)
    return found
