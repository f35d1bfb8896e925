"""How long a request may take to come in: whoever sends a byte now and then holds no line for ever.

The server below waits without end once a first byte has come. A request that is whole is never hurried,
however long its answer takes, and neither is a socket or a stream of events.

Whoever has said all and shuts its own half of the line (`nc -N`) is answered: the server below takes that for
having gone away, and what was asked would be done and not acknowledged. One who has really gone looks just
the same, so what changes nothing (a film takes a while) is kept up for a moment only.
"""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol, RequestResponseCycle

WHOLE_S = 60.0
"""Seconds for a request from its first byte to its end, and for a new line to its first request."""


HALF_SHUT_S = 2.0
"""Seconds that an answer is still made for who only reads and has shut its own half."""


class PatientProtocol(HttpToolsProtocol):
    """One connection."""

    patience_s = WHOLE_S
    half_shut_s = HALF_SHUT_S
    _deadline: asyncio.TimerHandle | None = None
    _in_request = False
    _is_socket = False

    def connection_made(self, transport: Any) -> None:
        """A line is open."""
        super().connection_made(transport)
        self._wait()

    def data_received(self, data: bytes) -> None:
        """Some bytes."""
        super().data_received(data)
        if self.transport.is_closing() or self._is_socket:
            self._no_longer()
        elif self._deadline is None and (self._in_request or not self._owed()):
            self._wait()

    def on_message_begin(self) -> None:
        """The first byte of a request."""
        self._no_longer()
        self._in_request = True
        super().on_message_begin()

    def on_message_complete(self) -> None:
        """Its last."""
        self._no_longer()
        self._in_request = False
        super().on_message_complete()

    def handle_websocket_upgrade(self) -> None:
        """From now on another protocol has the line."""
        self._is_socket = True
        super().handle_websocket_upgrade()

    def connection_lost(self, exc: Exception | None) -> None:
        """It has gone."""
        self._no_longer()
        super().connection_lost(exc)

    def eof_received(self) -> bool:  # type: ignore[override]
        """Nothing more will come; true keeps the line open for an answer that is still owed."""
        if self._in_request or not self._owed() or self.cycle.response_started:
            return False
        self.cycle.keep_alive = False  # after which the line is closed
        if self.cycle.scope["method"] in ("GET", "HEAD"):
            self.loop.call_later(self.half_shut_s, self._taken_as_gone, self.cycle)
        return True

    def _taken_as_gone(self, cycle: RequestResponseCycle) -> None:
        if not cycle.response_started:
            self.transport.close()

    def out_of_patience(self) -> None:
        """A request came in part, and its end did not come."""
        self.transport.close()

    def _owed(self) -> bool:
        """Whether the latest request that is whole has not been answered to its end."""
        return self.cycle is not None and not self.cycle.response_complete

    def _wait(self) -> None:
        self._deadline = self.loop.call_later(self.patience_s, self._over)

    def _no_longer(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None

    def _over(self) -> None:
        self._deadline = None
        if self.transport.is_closing():
            return
        waits_for_us = self.cycle is not None and not self.cycle.more_body and self._owed()
        if self.flow.read_paused or waits_for_us:
            self._wait()
        elif self._in_request:
            self.out_of_patience()
        else:
            self.transport.close()
