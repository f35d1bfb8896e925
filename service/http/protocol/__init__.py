"""Header limits, read timeouts and WebSocket rules, as protocol classes for uvicorn.

This is the only code that reads undocumented attributes of uvicorn. uvicorn has no options for what these
classes add: limits on headers, a timeout for reading a request, refusals as problem documents, messages
written straight to a WebSocket. `protocol_options` checks at start
that every attribute they need exists. If one is missing (a newer uvicorn), the service runs on uvicorn's own
protocols, with their public options, and logs a warning.

- `header_limits` and `request_timeout` bound the memory and the time that one connection can take. uvicorn
  offers such a limit for h11 alone, which is slower than httptools (`python -m bench.rest`).
- `direct_write` saves processor time in every tick that is watched (`python -m bench.live`).
- `websocket` answers refused handshakes, which uvicorn leaves open, and bounds fragments and pongs."""

from __future__ import annotations

from collections.abc import Collection
from types import FunctionType
from typing import Any

import structlog

_LOG = structlog.get_logger(__name__)

MAX_HEADER_BYTES = 65_536
"""Limit on the address and all headers of a request together."""

HTTP_ATTRIBUTES = frozenset(
    (
        *("transport", "flow", "cycle", "loop", "parser", "scope", "url"),
        *("connection_made", "connection_lost", "data_received", "eof_received"),
        *("on_message_begin", "on_url", "on_header", "on_headers_complete", "on_message_complete"),
        *("handle_websocket_upgrade", "send_400_response"),
    )
)
"""What `StrictHttpProtocol` reads or overrides of uvicorn's `HttpToolsProtocol`."""

CYCLE_ATTRIBUTES = frozenset(("scope", "keep_alive", "more_body", "response_started", "response_complete"))
"""What it reads of uvicorn's `RequestResponseCycle`."""

WEBSOCKET_ATTRIBUTES = frozenset(
    (
        *("app", "scope", "conn", "writable", "transport", "frames", "curr_msg_data_type"),
        *("handshake_initiated", "handshake_complete", "close_sent", "initial_response"),
        *("run_asgi", "data_received", "handle_connect", "handle_cont", "handle_ping"),
        *("send_receive_event_to_app", "handle_parser_exception"),
    )
)
"""What `StrictWebSocketProtocol` reads or overrides of uvicorn's `WebSocketsSansIOProtocol`."""

FALLBACK: dict[str, Any] = {
    "http": "h11",
    "h11_max_incomplete_event_size": MAX_HEADER_BYTES,
    "ws": "auto",
}
"""uvicorn's own protocols: no timeout for requests, and refused handshakes answered in plain text."""


def protocol_options() -> dict[str, Any]:
    """Options of `uvicorn.Config` that choose the protocols: the classes of this package, or `FALLBACK`."""
    try:
        missing = missing_attributes()
    except ImportError as error:
        missing = [str(error)]
    if missing:
        _LOG.warning("uvicorn has changed; its own protocols are used", missing=missing)
        return dict(FALLBACK)
    from service.http.protocol.header_limits import StrictHttpProtocol
    from service.http.protocol.websocket import StrictWebSocketProtocol

    return {"http": StrictHttpProtocol, "ws": StrictWebSocketProtocol}


def missing_attributes() -> list[str]:
    """Lists the attributes that uvicorn's classes lack. Raises `ImportError` if a class has gone."""
    from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol, RequestResponseCycle
    from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

    return [
        *_find_missing(HttpToolsProtocol, HTTP_ATTRIBUTES),
        *_find_missing(RequestResponseCycle, CYCLE_ATTRIBUTES),
        *_find_missing(WebSocketsSansIOProtocol, WEBSOCKET_ATTRIBUTES),
    ]


def _find_missing(cls: type, names: Collection[str]) -> list[str]:
    """Names that a class neither has nor uses in its methods: attributes of instances are set in there."""
    used = {
        name
        for function in vars(cls).values()
        if isinstance(function, FunctionType)
        for name in function.__code__.co_names
    }
    return [f"{cls.__name__}.{name}" for name in sorted(names) if name not in used and not hasattr(cls, name)]
