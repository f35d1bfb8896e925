"""Reads the messages of a stream, and says when to connect again after a connection is lost."""

from __future__ import annotations

import json
import time
from urllib.parse import quote, urlencode

from websockets.exceptions import ConnectionClosed, InvalidStatus, WebSocketException

from service.client.call import Json, unreachable
from service.client.endpoints import PREFIX
from service.client.errors import NotReachable, Refused, RoadtalkError, UnexpectedAnswer, refusal
from service.client.media import Picture, picture
from service.client.messages import Message, read_message

DELETED, NO_KEY, NO_SESSION = 1000, 4401, 4404
FINAL = frozenset((1002, 1003, 1007, 1008, 1009, 1010))
"""Close codes after which a new connection would end like the one before."""

FIRST_DELAY_S, MOST_DELAY_S = 0.1, 2.0
MAX_MESSAGE_BYTES = 16 * 2**20
"""A whole state of the largest road is below this."""


class StreamReader:
    """One reader's place in a stream, kept over lost connections. It opens no connection itself."""

    def __init__(
        self, url: str, session: str, after: str | None, patience_s: float, wanted: Json | None = None
    ) -> None:
        """`wanted`: which pictures are asked for; then nothing else is passed on."""
        self.session = session
        self.after = after
        self.wanted = wanted
        self._url = url
        self._patience_s = patience_s
        self._connected = self._heard = False
        self._problem: Refused | None = None
        self._delay_s = FIRST_DELAY_S
        self._lost_since: float | None = None

    @property
    def address(self) -> str:
        """Where to connect: the last message that was seen is named, never a key."""
        base = "ws" + self._url.removeprefix("http")
        query = "" if self.after is None else "?" + urlencode({"after": self.after})
        return f"{base}{PREFIX}/sessions/{quote(self.session, safe='')}/stream{query}"

    def on_connected(self) -> None:
        """Connected; where nothing was missed no message says so."""
        self._connected, self._lost_since = True, None

    @property
    def greeting(self) -> str | None:
        """What is said first on every connection, if anything."""
        return None if self.wanted is None else json.dumps({"type": "subscribe", **self.wanted})

    def read_picture(self, data: str | bytes) -> Picture | None:
        """The picture that was received. Raises `Refused` for pictures that cannot be had."""
        if isinstance(data, bytes):
            self._delay_s = FIRST_DELAY_S
            return picture(data)
        self.read(data)
        if self._problem is not None:
            raise self._problem
        return None

    def read(self, data: str | bytes) -> Message | None:
        """The message that was received; None for what is not for the caller. Raises `UnexpectedAnswer`."""
        if isinstance(data, bytes):
            return None  # pictures, which nobody asked for here
        try:
            values = json.loads(data)
        except ValueError:
            raise UnexpectedAnswer("The stream sent what is not JSON.") from None
        if not isinstance(values, dict) or not isinstance(values.get("type"), str):
            raise UnexpectedAnswer("The stream sent what is not a message.")
        if values["type"] == "error":
            self._problem = refusal(values.get("problem", {}), values.get("problem", {}).get("status", 0))
            return None
        message = read_message(values, resumed=self._heard)
        self._heard, self._delay_s = True, FIRST_DELAY_S
        self.after = values.get("event", self.after)
        return message

    def retry_delay_s(self, error: Exception) -> float | None:
        """After a failure: seconds to wait before the next try, or None when the stream is over.

        Raises a `RoadtalkError` where another try is of no use, or patience is at its end.
        """
        code = error.rcvd.code if isinstance(error, ConnectionClosed) and error.rcvd else None
        if code == DELETED:
            return None
        if code == NO_KEY:
            document = {
                "type": "/problems/no-key",
                "detail": "The stream asks for a key, or for another one.",
            }
            raise refusal(document, 401) from error
        if code == NO_SESSION:
            document = {"type": "/problems/unknown-session", "detail": "There is no session with this id."}
            raise refusal(document, 404) from error
        if self._problem is not None:
            raise self._problem from error
        if code in FINAL or (code is not None and code >= 4000):
            raise RoadtalkError(f"The stream was closed for good: {error}.") from error
        if isinstance(error, InvalidStatus) and error.response.status_code < 500:
            raise _refused(error) from error
        now = time.monotonic()
        self._lost_since = self._lost_since or now
        if not self._connected or now - self._lost_since > self._patience_s:
            raise unreachable(self._url, error) from error
        delay_s, self._delay_s = self._delay_s, min(MOST_DELAY_S, 2 * self._delay_s)
        return delay_s


FAILURES: tuple[type[Exception], ...] = (WebSocketException, OSError, EOFError)
"""What a connection can end with; time-outs are `OSError`s."""


def _refused(error: InvalidStatus) -> RoadtalkError:
    try:
        document = json.loads(error.response.body or b"")
    except ValueError:
        return NotReachable(f"The stream cannot be opened: {error}.")
    if not isinstance(document, dict):
        return NotReachable(f"The stream cannot be opened: {error}.")
    return refusal(document, error.response.status_code, dict(error.response.headers.raw_items()))
