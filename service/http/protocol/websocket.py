"""WebSocket handshakes that always get an answer, and limits on fragments and pongs.

uvicorn never answers a handshake that its parser gives up (a body, a line that is too long) and keeps the
connection; a refused one it answers in plain text. It writes pongs however many are unread, so that a client
that pings and never reads would fill the memory.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from websockets.frames import Frame
from websockets.http11 import Request

from service.http.protocol.direct_write import DirectWriteProtocol
from service.http.protocol.header_limits import ProtocolProblem, raw_response

MAX_FRAGMENTS = 10_000
"""Fragments of one message; `ws_max_size` limits their bytes."""

_VERSION = "13"


class StrictWebSocketProtocol(DirectWriteProtocol):
    """One WebSocket connection."""

    async def run_asgi(self) -> None:
        """Runs the application; a handshake that it has refused is no failure to be logged."""
        application = self.app

        async def run(scope: Any, receive: Any, send: Any) -> None:
            await application(scope, receive, send)
            if self.initial_response is not None and self.close_sent:
                self.handshake_complete = True

        self.app = run
        await super().run_asgi()

    def data_received(self, data: bytes) -> None:
        """Answers a handshake that the parser gave up."""
        super().data_received(data)
        if not self.handshake_initiated and self.conn.handshake_exc is not None:
            self._refuse(HTTPStatus.BAD_REQUEST, str(self.conn.handshake_exc))

    def handle_connect(self, event: Request) -> None:
        """Accepts a complete handshake, or refuses it with a problem document."""
        response = self.conn.accept(event)
        if response.status_code == HTTPStatus.SWITCHING_PROTOCOLS:
            super().handle_connect(event)
            return
        self.handshake_initiated = True
        if event.headers.get_all("Sec-WebSocket-Version") != [_VERSION]:
            detail = f"Speak version {_VERSION} of WebSocket, and say so in Sec-WebSocket-Version"
            self._refuse(HTTPStatus.UPGRADE_REQUIRED, detail, Sec_WebSocket_Version=_VERSION)
        else:
            detail = (response.body or b"").decode().strip().rstrip(".")
            self._refuse(HTTPStatus(response.status_code), detail)

    def handle_cont(self, event: Frame) -> None:
        """Limits the fragments of a message."""
        if len(self.frames) < MAX_FRAGMENTS:
            super().handle_cont(event)
        else:
            self._fail(1009, f"more than {MAX_FRAGMENTS} fragments")

    def handle_ping(self) -> None:
        """Answers a ping unless answers wait to be read (RFC 6455, 5.5.3: not every one need be)."""
        if self.writable.is_set():
            super().handle_ping()
        else:
            self.conn.data_to_send()

    def send_receive_event_to_app(self) -> None:
        """Checks that a text message is UTF-8, also where it came in fragments."""
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

    def _refuse(self, status: HTTPStatus, detail: str, **headers: str) -> None:
        self.handshake_complete = True
        self.close_sent = True
        problem = ProtocolProblem(status.value, status.phrase, f"{detail}.")
        self.transport.write(raw_response(problem, **headers))
        self.transport.close()
