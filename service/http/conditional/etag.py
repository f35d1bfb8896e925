"""`ETag`, `If-Match`, `If-None-Match`: a change may name the version of a session it was made for.

A tag begins with the session's sequence. The tag of a GET continues with a digest of the answer, since time
passes without a change being counted. `If-Match` compares sequences alone, so the tag of any answer about a
session will do.

`If-Match` is checked after the form of a request and before anything is done (RFC 9110, 13.2.1): a bad body
is 422 whatever the tag.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Awaitable, Callable, Mapping
from contextvars import ContextVar
from functools import wraps
from typing import Annotated, Any, ParamSpec, TypeVar

from fastapi import Depends, Request, Response

from service.http.conditional.idempotency import keyed_request
from service.problems import FieldProblem, Invalid
from service.sessions.preconditions import Preconditions
from service.sessions.utterance import Outcome
from service.store import StoredResponse

_TAG = re.compile(r'(W/)?"([\x21\x23-\x7e]*)"')
_BLANK = " \t"
"""White space in HTTP, which is less than in text."""
_TAGS = re.compile(rf"[ \t]*{_TAG.pattern}([ \t]*,[ \t]*{_TAG.pattern})*[ \t]*")
_SCHEMA_PATTERN = r'^[ \t]*(\*|(W/)?"[!#-~]*"([ \t]*,[ \t]*(W/)?"[!#-~]*")*)[ \t]*$'
"""`If-Match` as a pattern that every reader of JSON schema knows."""
_SEQUENCE = re.compile(r"([0-9]{1,15})(-[0-9a-f]+)?")

Conditions = Callable[[Callable[[Outcome], Response]], Preconditions]
"""Given how an outcome is answered, the preconditions under which a request changes a session."""


def if_match(request: Request) -> frozenset[int] | None:
    """The sequences that `If-Match` allows; None for any. Raises `Invalid`."""
    value = _list_header(request, "if-match")
    if value is None or value.strip(_BLANK) == "*":
        return None
    if not _TAGS.fullmatch(value):
        message = 'must be the ETag of an answer about this session, such as "3", or *'
        raise Invalid(f"If-Match {message}.", errors=[FieldProblem("If-Match", message)])
    # A weak tag never matches here, and neither does one that is not ours.
    strong = (tag for weak, tag in _TAG.findall(value) if not weak)
    found = (_SEQUENCE.fullmatch(tag) for tag in strong)
    return frozenset(int(each[1]) for each in found if each)


def check_if_match(request: Request, sequence: int) -> None:
    """Raises `Stale` if the session is not at a version that `If-Match` allows."""
    Preconditions(if_match(request)).check(sequence)


def _list_header(request: Request, header: str) -> str | None:
    """A header that is a list: sent on several lines, it is one (RFC 9110, 5.3)."""
    lines = request.headers.getlist(header)
    return ", ".join(lines) if lines else None


Check = Callable[[Mapping[str, Any]], Awaitable[None]]
"""Given the arguments of an endpoint, raises a problem or does nothing."""

_CHECK: ContextVar[Check | None] = ContextVar("check", default=None)
"""The check between the validation of a request and its endpoint."""

Given = ParamSpec("Given")
Made = TypeVar("Made")


def set_check(check: Check | None) -> None:
    """Sets what is checked once the request under way is known to be well formed."""
    _CHECK.set(check)


def check_before_call(endpoint: Callable[Given, Awaitable[Made]]) -> Callable[Given, Awaitable[Made]]:
    """Wraps an endpoint so that the check of `set_check` comes first."""

    @wraps(endpoint)
    async def call(*args: Given.args, **given: Given.kwargs) -> Made:
        check = _CHECK.get()
        if check is not None:
            await check(given)
        return await endpoint(*args, **given)

    return call


Subject = TypeVar("Subject")


def respond_once(respond: Callable[[Subject], Response]) -> Callable[[Subject], Response]:
    """A response that is made the first time it is asked for: what is stored is what is sent."""
    made: list[Response] = []

    def respond_again(subject: Subject) -> Response:
        if not made:
            made.append(respond(subject))
        return made[0]

    return respond_again


def answer_to_keep(
    request: Request, respond: Callable[[Subject], Response]
) -> Callable[[Subject], StoredResponse] | None:
    """What has to be stored with what a request does, if it came under an idempotency key."""
    keyed = keyed_request(request)
    return None if keyed is None else lambda subject: keyed.keep(respond(subject))


async def conditions_of(request: Request) -> Conditions:
    """The conditions of a request. Raises `Invalid`."""
    sequences = if_match(request)
    return lambda respond: Preconditions(sequences, answer_to_keep(request, respond))


TheConditions = Annotated[Conditions, Depends(conditions_of)]


def add_tag(request: Request, response: Response, sequence: int) -> Response:
    """The response under its own tag, or a 304 if the client has it already."""
    digest = hashlib.blake2b(response.body, digest_size=8).hexdigest()
    tag = f"{sequence}-{digest}"
    known = _list_header(request, "if-none-match")
    if known is not None and (
        known.strip(_BLANK) == "*" or any(tag == own for _, own in _TAG.findall(known))
    ):
        return Response(status_code=304, headers={"ETag": f'"{tag}"'})
    response.headers["ETag"] = f'"{tag}"'
    return response


def document(
    method: str, path: str, tagged: bool, operation: dict[str, Any], add_problems: Callable[..., Any]
) -> None:
    """Adds these headers to the documentation of a call; `tagged` is its route's policy."""
    responses = operation["responses"]
    if "201" in responses:
        location, tag = "Where what was made is.", "Its version, for `If-Match`."
        responses["201"]["headers"] = {"Location": _response_header(location), "ETag": _response_header(tag)}
    if "{session_id}" not in path or not tagged:
        if method not in ("get", "head"):
            operation["description"] += "\n\n`If-Match` is not looked at: this changes no session."
        return
    parameters = operation.setdefault("parameters", [])
    if method == "get":
        text = "The ETag of an answer that is at hand: 304 if it still is so; anything else is ignored."
        parameters.append(_request_header("If-None-Match", text, {"type": "string"}))
        responses["304"] = {"description": "As it was: the answer at hand still holds"}
    else:
        text = "An ETag of this session, or several: done only if nothing was changed since; otherwise 412."
        schema = {"type": "string", "pattern": _SCHEMA_PATTERN, "examples": ["*"]}
        parameters.append(_request_header("If-Match", text, schema))
        add_problems(operation, "stale", "invalid")
        responses["412"]["headers"] = {"ETag": _response_header("Where the session stands.")}
    if "200" in responses:
        responses["200"]["headers"] = {"ETag": _response_header("The session's version, for `If-Match`.")}


def _request_header(name: str, description: str, schema: dict[str, Any]) -> dict[str, Any]:
    """A header of a request."""
    return {"name": name, "in": "header", "required": False, "schema": schema, "description": description}


def _response_header(description: str) -> dict[str, Any]:
    """A header of a response."""
    return {"description": description, "required": True, "schema": {"type": "string", "minLength": 1}}
