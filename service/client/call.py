"""A request with the reader of its answer, and the exceptions for what goes wrong. Nothing here is sent."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar

import httpx

from service.client.errors import Ambiguous, NotReachable, Refused, TimedOut, UnexpectedAnswer, refusal

DEFAULT_URL = "http://127.0.0.1:8000"
TIMEOUT_S = 30.0
PATIENCE_S = 30.0
"""How long a watcher tries to connect again."""
KEY_VARIABLE = "ROADTALK_API_KEY"
"""The environment variable that holds the key where none is given; an empty key means none."""
T = TypeVar("T")
U = TypeVar("U")
Json = Mapping[str, Any]

LOST = (httpx.NetworkError, httpx.RemoteProtocolError)
"""The connection was lost: nobody knows whether the call was done."""


@dataclass(frozen=True)
class Call(Generic[T]):
    """One request and the reader of its answer.

    `said` names the key of the body that holds a sentence, for calls that can be ambiguous.
    A call that changes something has a `key`, by which the service recognises a second try.
    """

    method: str
    path: str
    read: Callable[[httpx.Response], T]
    body: Json | None = None
    params: Json = field(default_factory=dict)
    said: str | None = None
    key: str | None = None
    long: bool = False
    """whether the service may make the answer in the background: then it is waited for"""

    def request(self) -> dict[str, Any]:
        """What httpx is given."""
        headers = {"Idempotency-Key": self.key} if self.key else {}
        if self.long:
            headers["Prefer"] = "respond-async"
        params = {name: value for name, value in self.params.items() if value is not None}
        given = {"json": self.body} if self.body is not None else {}
        return {"method": self.method, "url": self.path, "headers": headers, "params": params, **given}

    def with_text(self, text: str) -> Call[T]:
        """The same with another sentence, which is another change."""
        return replace(self, body={**(self.body or {}), str(self.said): text}, key=new_key())

    def then(self, made: Callable[[T], U]) -> Call[U]:
        """The same with something made of its answer."""
        return Call(
            self.method,
            self.path,
            lambda response: made(self.read(response)),
            self.body,
            self.params,
            self.said,
            self.key,
            self.long,
        )


Progress = Callable[[float], None]
"""Told the share of a long answer that is done, from 0 to 1."""


def read_answer(
    call: Call[T], response: httpx.Response, again: Callable[[Call[T]], Any], *, second: bool
) -> T:
    """The answer as its type. Raises `Refused` for a problem, `UnexpectedAnswer` for anything else."""
    if response.is_success:
        return call.read(response)
    refused = read_problem(response)
    if second and call.method == "DELETE" and response.status_code == 404:
        return call.read(response)  # the first try, whose answer was lost, has done it
    if isinstance(refused, Ambiguous) and call.said is not None:
        refused.again = lambda text: again(call.with_text(text))
    raise refused


def unreachable(url: str, error: Exception) -> NotReachable:
    """The exception for a call that had no answer."""
    if isinstance(error, httpx.TimeoutException) and not isinstance(error, httpx.ConnectTimeout):
        return TimedOut(f"{url} did not answer in time. Whether it was done is not known.")
    said = str(error) or type(error).__name__
    return NotReachable(
        f"There is no answer from {url} ({said}). Is the service running? Start it with: roadtalk serve"
    )


def read_json(response: httpx.Response) -> Any:
    """The JSON of an answer. Raises `UnexpectedAnswer` where it is none."""
    try:
        return response.json()
    except ValueError:
        raise UnexpectedAnswer(f"What answers at {response.url.host} is not this service.") from None


def read_problem(response: httpx.Response) -> Refused:
    """What was refused. Raises `UnexpectedAnswer` where that is no problem document."""
    document = read_json(response)
    if not isinstance(document, dict) or "detail" not in document:
        raise UnexpectedAnswer(f"What answers at {response.url.host} is not this service.")
    return refusal(document, response.status_code, response.headers)


def new_key() -> str:
    """An `Idempotency-Key`, by which the service recognises a second try."""
    return secrets.token_urlsafe(16)


def check_url(url: str) -> str:
    """The address of a service without a slash at its end. Raises `ValueError` where it is none."""
    try:
        given = httpx.URL(url)
    except httpx.InvalidURL as error:
        raise ValueError(f"{url!r} is no address: {error}") from None
    if given.scheme not in ("http", "https") or not given.host:
        raise ValueError(f"{url!r} is no address; it begins with http:// or https://")
    return url.rstrip("/")


def auth_headers(api_key: str | None) -> dict[str, str]:
    """The key as a header, never in an address; where none is given, that of `ROADTALK_API_KEY`."""
    api_key = os.environ.get(KEY_VARIABLE) if api_key is None else api_key
    return {"Authorization": f"Bearer {api_key}"} if api_key else {}
