"""A timeout for reading a request: 60 seconds from its first byte to its last (slowloris).

uvicorn waits for ever once a first byte has come. The timeout covers reading alone: neither a long answer nor
a WebSocket or event stream is ended by it.

A client that half-closes after sending (`nc -N`) still gets its response; uvicorn takes it for disconnected.
A client that has really gone looks the same, so after `HALF_CLOSED_S` GET and HEAD are given up, and dear
work for other requests is ended (`service.http.asker`): its answer says that nothing was changed.
"""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol, RequestResponseCycle

from service.http.asker import HALF_CLOSED

REQUEST_TIMEOUT_S = 60.0
"""Seconds for a request from its first byte to its last, and for a new connection's first request."""

HALF_CLOSED_S = 2.0
"""Seconds that the answer to a GET of a half-closed connection may take, and dear work for others."""


class TimeoutProtocol(HttpToolsProtocol):
    """One HTTP connection with a timeout for reading requests."""

    request_timeout_s = REQUEST_TIMEOUT_S
    half_closed_s = HALF_CLOSED_S
    _timer: asyncio.TimerHandle | None = None
    _in_request = False
    _is_websocket = False

    def connection_made(self, transport: Any) -> None:
        """Starts the timer of the first request."""
        super().connection_made(transport)
        self._start_timer()

    def data_received(self, data: bytes) -> None:
        """Feeds the parser; starts the timer if a request is under way or none is being answered."""
        super().data_received(data)
        if self.transport.is_closing() or self._is_websocket:
            self._stop_timer()
        elif self._timer is None and (self._in_request or not self._is_answering()):
            self._start_timer()

    def on_message_begin(self) -> None:
        """Handles the first byte of a request."""
        self._stop_timer()
        self._in_request = True
        super().on_message_begin()

    def on_headers_complete(self) -> None:
        """Hands the request on, with an event for when its client seems to have gone."""
        super().on_headers_complete()
        extensions: dict[str, object] = self.scope.setdefault("extensions", {})  # type: ignore[assignment]
        extensions[HALF_CLOSED] = asyncio.Event()

    def on_message_complete(self) -> None:
        """Handles the last byte of a request."""
        self._stop_timer()
        self._in_request = False
        super().on_message_complete()

    def handle_websocket_upgrade(self) -> None:
        """Hands the connection to the WebSocket protocol, which has no such timeout."""
        self._is_websocket = True
        super().handle_websocket_upgrade()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stops the timer."""
        self._stop_timer()
        super().connection_lost(exc)

    def eof_received(self) -> bool:  # type: ignore[override]
        """Returns true, which keeps a half-closed connection open, while an answer is due."""
        if self._in_request or not self._is_answering() or self.cycle.response_started:
            return False
        self.cycle.keep_alive = False  # closes the connection after the answer
        self.loop.call_later(self.half_closed_s, self._give_up, self.cycle)
        return True

    def request_timed_out(self) -> None:
        """Ends a connection whose request is incomplete; subclasses answer first."""
        self.transport.close()

    def _give_up(self, cycle: RequestResponseCycle) -> None:
        if cycle.scope["method"] not in ("GET", "HEAD"):
            cycle.scope["extensions"][HALF_CLOSED].set()  # type: ignore[attr-defined]
        elif not cycle.response_started:
            self.transport.close()

    def _is_answering(self) -> bool:
        """Whether the latest complete request has no complete answer yet."""
        return self.cycle is not None and not self.cycle.response_complete

    def _start_timer(self) -> None:
        self._timer = self.loop.call_later(self.request_timeout_s, self._on_timeout)

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _on_timeout(self) -> None:
        self._timer = None
        if self.transport.is_closing():
            return
        waits_for_us = self.cycle is not None and not self.cycle.more_body and self._is_answering()
        if self.flow.read_paused or waits_for_us:
            self._start_timer()
        elif self._in_request:
            self.request_timed_out()
        else:
            self.transport.close()
