"""`ETag`, `If-Match`, `If-None-Match`: who changes a session may say what it was when last seen.

A tag begins with the session's sequence. What is looked at (a GET) goes on with a digest of the answer,
since time passes and no change is counted for that. A change asks for the sequence alone, so the tag of
any answer about a session serves as `If-Match`.

`If-Match` is looked at after all that a request must be by its form, and before anything is done (RFC 9110,
13.2.1): a bad body is 422 whatever the tag says.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Awaitable, Callable, Mapping
from contextvars import ContextVar
from functools import wraps
from typing import Annotated, Any, ParamSpec, TypeVar

from fastapi import Depends, Request, Response

from service.http.conditional.idempotency import UNDER_KEY, Once
from service.problems import FieldProblem, Invalid
from service.sessions.preconditions import Terms
from service.sessions.utterance import Outcome
from service.store import KeptAnswer

_TAG = re.compile(r'(W/)?"([\x21\x23-\x7e]*)"')
_BLANK = " \t"
"""What HTTP calls white space: less than a text does."""
_TAGS = re.compile(rf"[ \t]*{_TAG.pattern}([ \t]*,[ \t]*{_TAG.pattern})*[ \t]*")
_DOCUMENTED = r'^[ \t]*(\*|(W/)?"[!#-~]*"([ \t]*,[ \t]*(W/)?"[!#-~]*")*)[ \t]*$'
"""What may stand in `If-Match`, in words that every reader of schemas knows."""
_SEQUENCE = re.compile(r"([0-9]{1,15})(-[0-9a-f]+)?")

OnTerms = Callable[[Callable[[Outcome], Response]], Terms]
"""Given how an outcome is answered, the terms of a request."""


def matched(request: Request) -> frozenset[int] | None:
    """The sequences a session may stand at for this request; None for any. Raises `Invalid`."""
    said = _listed(request, "if-match")
    if said is None or said.strip(_BLANK) == "*":
        return None
    if not _TAGS.fullmatch(said):
        message = 'must be the ETag of an answer about this session, such as "3", or *'
        raise Invalid(f"If-Match {message}.", errors=[FieldProblem("If-Match", message)])
    # A weak tag never matches here, and neither does one that is not ours.
    strong = (tag for weak, tag in _TAG.findall(said) if not weak)
    found = (_SEQUENCE.fullmatch(tag) for tag in strong)
    return frozenset(int(each[1]) for each in found if each)


def _listed(request: Request, header: str) -> str | None:
    """A header that is a list: said on several lines, it is one (RFC 9110, 5.3)."""
    lines = request.headers.getlist(header)
    return ", ".join(lines) if lines else None


def checked(request: Request, sequence: int) -> None:
    """Raise `Stale` where this is not the session that the request was meant for."""
    Terms(matched(request)).check(sequence)


Check = Callable[[Mapping[str, Any]], Awaitable[None]]
"""Given what an endpoint is called with."""

_BEFORE: ContextVar[Check | None] = ContextVar("before", default=None)
"""What is to be looked at between a request's form and what it asks for."""

Given = ParamSpec("Given")
Made = TypeVar("Made")


def before(check: Check | None) -> None:
    """What is looked at once the request that is being handled is known to be well formed; None: nothing."""
    _BEFORE.set(check)


def checked_first(endpoint: Callable[Given, Awaitable[Made]]) -> Callable[Given, Awaitable[Made]]:
    """An endpoint that is reached only if what was asked for by `before` holds."""

    @wraps(endpoint)
    async def meant(*args: Given.args, **given: Given.kwargs) -> Made:
        check = _BEFORE.get()
        if check is not None:
            await check(given)
        return await endpoint(*args, **given)

    return meant


Told = TypeVar("Told")


def made_once(told: Callable[[Told], Response]) -> Callable[[Told], Response]:
    """An answer that is made the first time it is asked for: what is kept is what is sent."""
    made: list[Response] = []

    def again(of: Told) -> Response:
        if not made:
            made.append(told(of))
        return made[0]

    return again


def kept_answer(request: Request, told: Callable[[Told], Response]) -> Callable[[Told], KeptAnswer] | None:
    """What is to be kept with what a request does, if it came under a key."""
    once: Once | None = request.scope.get(UNDER_KEY)
    return None if once is None else lambda of: once.keeping(told(of))


async def terms_of(request: Request) -> OnTerms:
    """The terms a request comes on. Raises `Invalid`."""
    sequences = matched(request)
    return lambda told: Terms(sequences, kept_answer(request, told))


TheTerms = Annotated[OnTerms, Depends(terms_of)]


def tagged(request: Request, response: Response, sequence: int) -> Response:
    """An answer about a session under its own tag, or a 304 where the caller has it already."""
    digest = hashlib.blake2b(response.body, digest_size=8).hexdigest()
    tag = f"{sequence}-{digest}"
    said = _listed(request, "if-none-match")
    if said is not None and (said.strip(_BLANK) == "*" or any(tag == own for _, own in _TAG.findall(said))):
        return Response(status_code=304, headers={"ETag": f'"{tag}"'})
    response.headers["ETag"] = f'"{tag}"'
    return response


def document(method: str, path: str, operation: dict[str, Any], problem: Callable[..., Any]) -> None:
    """Tell of these headers in the documentation of a call; `problem` makes an error's documentation."""
    responses = operation["responses"]
    if "201" in responses:
        where = {"Location": _told("Where what was made is."), "ETag": _told("Its version, for `If-Match`.")}
        responses["201"]["headers"] = where
    if "{session_id}" not in path or path.endswith("/events/stream"):
        if method not in ("get", "head"):
            operation["description"] += "\n\n`If-Match` is not looked at: this changes no session."
        return
    parameters = operation.setdefault("parameters", [])
    if method == "get":
        told = "The ETag of an answer that is at hand: 304 if it still is so; anything else is ignored."
        parameters.append(_header("If-None-Match", told, {"type": "string"}))
        responses["304"] = {"description": "As it was: the answer at hand still holds"}
    else:
        told = "An ETag of this session, or several: done only if nothing was changed since; otherwise 412."
        schema = {"type": "string", "pattern": _DOCUMENTED, "examples": ["*"]}
        parameters.append(_header("If-Match", told, schema))
        problem(operation, "stale", "invalid")
        responses["412"]["headers"] = {"ETag": _told("Where the session stands.")}
    if "200" in responses:
        responses["200"]["headers"] = {"ETag": _told("The session's version, for `If-Match`.")}


def _header(name: str, description: str, schema: dict[str, Any]) -> dict[str, Any]:
    return {"name": name, "in": "header", "required": False, "schema": schema, "description": description}


def _told(description: str) -> dict[str, Any]:
    """A header of an answer."""
    return {"description": description, "required": True, "schema": {"type": "string", "minLength": 1}}
