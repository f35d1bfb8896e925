"""WebSockets as the server below speaks them, with what it leaves open: nobody is left without an answer.

A handshake that its parser gives up (a body, a line that is too long) is never answered by it, and the line
held for ever; one that is refused is answered in plain text. Pongs are written however many wait already, so
that whoever asks for them and never reads would fill the memory.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from websockets.frames import Frame
from websockets.http11 import Request

from service.http.middleware.header_limits import Problem, answered
from service.http.realtime.direct_write import StraightProtocol

MOST_FRAGMENTS = 10_000
"""Parts that one message may come in; their bytes are counted below."""

_VERSION = "13"


class StrictSocket(StraightProtocol):
    """One socket."""

    async def run_asgi(self) -> None:
        """What the application makes of it."""
        application = self.app

        async def whole(scope: Any, receive: Any, send: Any) -> None:
            await application(scope, receive, send)
            if self.initial_response is not None and self.close_sent:
                self.handshake_complete = True  # refused to the end, which is no failure to be logged

        self.app = whole
        await super().run_asgi()

    def data_received(self, data: bytes) -> None:
        """Some bytes, the handshake's first."""
        super().data_received(data)
        if not self.handshake_initiated and self.conn.handshake_exc is not None:
            self._refuse(HTTPStatus.BAD_REQUEST, str(self.conn.handshake_exc))

    def handle_connect(self, event: Request) -> None:
        """The handshake is whole."""
        response = self.conn.accept(event)
        if response.status_code == HTTPStatus.SWITCHING_PROTOCOLS:
            super().handle_connect(event)
            return
        self.handshake_initiated = True
        if event.headers.get_all("Sec-WebSocket-Version") != [_VERSION]:
            said = f"Speak version {_VERSION} of WebSocket, and say so in Sec-WebSocket-Version"
            self._refuse(HTTPStatus.UPGRADE_REQUIRED, said, Sec_WebSocket_Version=_VERSION)
        else:
            said = (response.body or b"").decode().strip().rstrip(".")
            self._refuse(HTTPStatus(response.status_code), said)

    def handle_cont(self, event: Frame) -> None:
        """A further part of a message."""
        if len(self.frames) < MOST_FRAGMENTS:
            super().handle_cont(event)
        else:
            self._fail(1009, f"more than {MOST_FRAGMENTS} fragments")

    def handle_ping(self) -> None:
        """It is answered, unless answers wait to be read (RFC 6455, 5.5.3: not every one need be)."""
        if self.writable.is_set():
            super().handle_ping()
        else:
            self.conn.data_to_send()

    def send_receive_event_to_app(self) -> None:
        """A message is whole."""
        if self.curr_msg_data_type == "text":
            try:
                b"".join(self.frames).decode()
            except UnicodeDecodeError:
                self._fail(1007, "not written in UTF-8")
                return
        super().send_receive_event_to_app()

    def _fail(self, code: int, reason: str) -> None:
        self.frames = []
        self.conn.fail(code, reason)
        self.handle_parser_exception()

    def _refuse(self, status: HTTPStatus, said: str, **headers: str) -> None:
        self.handshake_complete = True
        self.close_sent = True
        self.transport.write(answered(Problem(status.value, status.phrase, f"{said}."), **headers))
        self.transport.close()
