"""The transport to the model's server: one address, few headers, a bounded answer reduced to its text.

Whatever library makes the request, this decides what leaves and what comes back. Out go the body and the key:
no cookies, no description of this machine. Back comes the text of the answer in a fresh, well-formed body;
tool calls, other fields and headers are dropped.
"""

from __future__ import annotations

from typing import Annotated, Final

import httpx2
from annotated_types import MinLen
from pydantic import BaseModel, SecretStr, ValidationError
from pydantic_core import to_json

from service.llm.failures import ModelFailure
from service.rate_limit import TokenBucket

MAX_ANSWER_BYTES: Final = 262_144
"""Largest response, in bytes; an answer takes a hundredth of it."""
PATH: Final = "/chat/completions"


class _Message(BaseModel):
    content: str | None = None


class _Choice(BaseModel):
    message: _Message
    finish_reason: str | None = None


class _Completion(BaseModel):
    """As little of a completion as is needed: servers leave out much of the rest."""

    choices: Annotated[list[_Choice], MinLen(1)]


class GuardedTransport(httpx2.AsyncBaseTransport):
    """Requests one address. Raises `ModelFailure` for anything that is no answer."""

    def __init__(
        self,
        base_url: str,
        key: SecretStr | None,
        bucket: TokenBucket,
        inner: httpx2.AsyncBaseTransport | None = None,
    ) -> None:
        """`inner` makes the request; by default one that ignores proxy settings of the environment."""
        self._url = f"{base_url}{PATH}"
        self._key = key
        self._bucket = bucket
        self._inner = inner or httpx2.AsyncHTTPTransport(trust_env=False)

    async def handle_async_request(self, request: httpx2.Request) -> httpx2.Response:
        """Send the request's body; return the answer's text in a new body."""
        wait_s = self._bucket.take()
        if wait_s:
            raise ModelFailure("too_often", wait=wait_s)
        sent = httpx2.Request(
            "POST",
            self._url,
            headers=self._headers(),
            content=await request.aread(),
            extensions=request.extensions,
        )
        try:
            answer = await self._inner.handle_async_request(sent)
            try:
                _check_head(answer)
                body = await _read_bounded(answer)
            finally:
                await answer.aclose()
        except (httpx2.ConnectError, httpx2.ConnectTimeout, httpx2.UnsupportedProtocol) as error:
            raise ModelFailure("unreachable") from error
        except httpx2.TransportError as error:
            raise ModelFailure("broke_off") from error
        return httpx2.Response(200, headers={"content-type": "application/json"}, content=_plain(body))

    async def aclose(self) -> None:
        """Close the connections."""
        await self._inner.aclose()

    def _headers(self) -> dict[str, str]:
        headers = {
            "accept": "application/json",
            "accept-encoding": "identity",
            "content-type": "application/json",
            "user-agent": "roadtalk",
        }
        if self._key is not None and self._key.get_secret_value():
            headers["authorization"] = f"Bearer {self._key.get_secret_value()}"
        return headers


def _check_head(answer: httpx2.Response) -> None:
    status = answer.status_code
    if 300 <= status < 400:
        raise ModelFailure("redirected")
    if status in (401, 403):
        raise ModelFailure("key_refused")
    if status == 429:
        raise ModelFailure("server_busy")
    if status != 200:
        raise ModelFailure("server_failed", status=status)
    media_type = answer.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type != "application/json":
        raise ModelFailure("no_answer")


async def _read_bounded(answer: httpx2.Response) -> bytes:
    """The body as sent, unless it is too large; compressed bodies are not unpacked and so are no JSON."""
    body = bytearray()
    async for chunk in answer.aiter_raw():
        body += chunk
        if len(body) > MAX_ANSWER_BYTES:
            raise ModelFailure("too_long")
    return bytes(body)


def _plain(body: bytes) -> bytes:
    """The same answer with only its text."""
    try:
        choice = _Completion.model_validate_json(body).choices[0]
    except ValidationError as error:
        raise ModelFailure("no_answer") from error
    if choice.finish_reason == "length":
        raise ModelFailure("too_long")
    message = {"role": "assistant", "content": choice.message.content or ""}
    return to_json(
        {
            "id": "answer",
            "object": "chat.completion",
            "created": 0,
            "model": "model",
            "choices": [{"index": 0, "finish_reason": "stop", "message": message}],
        }
    )
