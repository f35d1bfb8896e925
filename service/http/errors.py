"""Every error as problem+json: ours, the framework's, and the ones nobody foresaw."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import structlog
from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.routing import Match

from service.contract.answers import ProblemDocument
from service.http import suggestions as slips
from service.http.examples import problem_example
from service.http.middleware.body_limit import SECURITY_HEADERS
from service.http.responses import problem_response
from service.log_format import request_header
from service.problems import (
    MEDIA_TYPE,
    FieldProblem,
    Internal,
    Invalid,
    Malformed,
    NotFound,
    NotSaved,
    ProblemError,
    TooLarge,
    WrongMethod,
)
from service.store import StoreError

_LOG = structlog.get_logger(__name__)

ErrorDetails = Sequence[Any]
"""pydantic's list of what is wrong: dictionaries with `loc` and `msg`."""


def install(app: FastAPI) -> None:
    """Answer every error of the application with a problem."""
    for kind in (ProblemError, RequestValidationError, HTTPException, StoreError, Exception):
        app.add_exception_handler(kind, respond)


def respond(request: Request, error: Exception) -> Response:
    """An error as it is told."""
    match error:
        case ProblemError():
            return problem_response(error)
        case RequestValidationError():
            return problem_response(_validation(error, _body_of(request)))
        case HTTPException(status_code=405) if request.method == "OPTIONS":
            return Response(status_code=204, headers={"Allow": _allowed(_methods_of(request))})
        case HTTPException():
            return problem_response(_http(request, error))
        case StoreError():
            _LOG.error("the store failed", error=str(error))
            return problem_response(NotSaved())
        case _:
            _LOG.error("a request failed", path=request.url.path, exc_info=error)
            # Answered outside of every middleware, which therefore cannot add these.
            return problem_response(Internal(headers=SECURITY_HEADERS | request_header()))


def documented(*kinds: type[ProblemError]) -> dict[int | str, dict[str, Any]]:
    """The problems a route can answer, for its documentation, by status."""
    by_status: dict[int | str, dict[str, Any]] = {}
    for kind in kinds:
        new = {"model": ProblemDocument, "description": "", "content": {MEDIA_TYPE: {"examples": {}}}}
        said = by_status.setdefault(kind.status, new)
        said["description"] = " · ".join(filter(None, (said["description"], kind.title)))
        said["content"][MEDIA_TYPE]["examples"][kind.slug] = {"value": problem_example(kind)}
    return by_status


def invalid(errors: Iterable[FieldProblem]) -> Invalid:
    """The problem of some bad fields."""
    listed = list(errors)
    said = "; ".join(
        f"{error.field}: {error.message}" if error.field else error.message for error in listed[:3]
    )
    more = f" and {len(listed) - 3} more" if len(listed) > 3 else ""
    return Invalid(f"{said}{more}.", errors=listed)


def field_problems(details: ErrorDetails, sent: Any, kind: Any = None) -> list[FieldProblem]:
    """pydantic's errors as fields and messages, one for each field; what was sent is not repeated.

    `kind` is the type that it was to be: with it, a slip in a key is told as one.
    """
    by_field: dict[str, list[str]] = {}
    for detail in details:
        path = _path(detail, sent)
        message = _message(detail)
        if kind is not None and path and detail["type"] in _UNKNOWN_KEY:
            message += slips.meant(path[-1], slips.keys(kind, sent, path[:-1]))
        by_field.setdefault(".".join(map(str, path)), []).append(message)
    return [FieldProblem(name, " or ".join(dict.fromkeys(messages))) for name, messages in by_field.items()]


_UNKNOWN_KEY = ("extra_forbidden", "unexpected_keyword_argument")


def _path(detail: Any, sent: Any) -> list[str | int]:
    """Where in what was sent: pydantic also names the types it tried, which nobody wrote."""
    kept: list[str | int] = []
    for part in detail["loc"]:
        inside = isinstance(sent, list) and isinstance(part, int) and part < len(sent)
        if inside or (isinstance(sent, dict) and part in sent):
            kept.append(part)
            sent = sent[part]
    if detail["type"] == "missing" and detail["loc"]:
        kept.append(str(detail["loc"][-1]))
    return kept


_MESSAGES = {
    "extra_forbidden": "is not a known key",
    "unexpected_keyword_argument": "is not a known key",
    "missing": "is missing",
    "union_tag_not_found": "has no {discriminator}",
    "union_tag_invalid": "has a {discriminator} that is not known; it can be {expected_tags}",
    "greater_than": "must be more than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "less_than": "must be less than {lt}",
    "less_than_equal": "must be at most {le}",
    "int_type": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_from_float": "must be a whole number",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "finite_number": "must be a finite number",
    "bool_type": "must be true or false",
    "bool_parsing": "must be true or false",
    "string_type": "must be text",
    "string_too_short": "must have at least {min_length} characters",
    "string_too_long": "must have at most {max_length} characters",
    "too_short": "must have at least {min_length} items",
    "too_long": "must have at most {max_length} items",
    "string_pattern_mismatch": "must be `after` of the page before",
    "literal_error": "must be {expected}",
    "enum": "must be {expected}",
    "list_type": "must be a list",
    "tuple_type": "must be a list",
    "dict_type": "must be an object",
    "dataclass_type": "must be an object",
    "model_attributes_type": "must be an object",
    "model_type": "must be an object",
}
"""pydantic's errors in this project's words; the rest keep pydantic's."""


def _message(detail: Any) -> str:
    ours = _MESSAGES.get(detail["type"])
    told: dict[str, Any] = detail.get("ctx", {})
    if detail["type"] == "union_tag_not_found":
        told = {"discriminator": str(told["discriminator"]).replace("'", "`")}
    if ours is not None:
        listed = str(told.get("expected") or told.get("expected_tags") or "")
        one = told.get("min_length") == 1
        return (ours[:-1] if one else ours).format(**told) + slips.meant_of(
            told.get("tag", detail["input"]), listed
        )
    message = str(detail["msg"])
    return message[:1].lower() + message[1:]


def _validation(error: RequestValidationError, kind: Any) -> ProblemError:
    details = error.errors()
    if any(detail["type"] == "json_invalid" for detail in details):
        said = details[0]["ctx"]["error"]
        # The reader's own words are of what the bytes became in it.
        why = "it is not written in UTF-8" if said.startswith("str is not valid UTF-8") else said
        return Malformed(f"The body cannot be read as JSON: {why}.")
    if details[0]["loc"] == ("body",):  # the whole of it; there is no field to name
        missing = details[0]["type"] == "missing"
        said = "is missing; send a JSON object, {} at least" if missing else _message(details[0])
        return Invalid(f"The body {said}.", errors=[FieldProblem("", said)])
    # The framework puts first where a value was: in the body, the query or the path.
    inside = [{**detail, "loc": detail["loc"][1:]} for detail in details]
    in_body = all(detail["loc"][0] == "body" for detail in details)
    sent = error.body if in_body else {detail["loc"][0]: None for detail in inside if detail["loc"]}
    return invalid(field_problems(inside, sent, kind if in_body else None))


def _http(request: Request, error: HTTPException) -> ProblemError:
    where = f"{request.method} {request.url.path}"
    match error.status_code:
        case 405:
            offered = _methods_of(request)
            can = f"{where} is not offered; here one can {' or '.join(offered)}."
            return WrongMethod(can, headers={"Allow": _allowed(offered)})
        case 413:
            return TooLarge("The body is larger than is read here.", headers={"Connection": "close"})
        case 400:
            return Malformed("The body cannot be read.")
        case _:
            near = request.app.state.addresses.near(request.url.path) or "The calls there are stand at /docs."
            return NotFound(f"There is nothing at {where}. {near}")


def _body_of(request: Request) -> Any:
    """The type that a call's body is to be; None where it has none."""
    body = getattr(request.scope.get("route"), "body_field", None)
    return None if body is None else body.field_info.annotation


def _allowed(offered: Sequence[str]) -> str:
    """What stands in `Allow`: with GET comes HEAD, and OPTIONS is answered everywhere."""
    also = ("HEAD", "OPTIONS") if "GET" in offered else ("OPTIONS",)
    return ", ".join(sorted((*offered, *also)))


def _methods_of(request: Request) -> list[str]:
    """Every method that some route offers at this path; the router itself tells only of the first."""
    offered: set[str] = set()
    for method in ("DELETE", "GET", "PATCH", "POST", "PUT"):
        scope = {**request.scope, "method": method}
        if any(route.matches(scope)[0] is Match.FULL for route in request.app.router.routes):
            offered.add(method)
    return sorted(offered)
