"""Answers every error with a problem document (RFC 9457): ours, the framework's, and the unforeseen.

The service's own problems, with their status and slug, are in `service.problems`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import structlog
from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.routing import Match

from service.contract.answers import ProblemDocument
from service.http.examples import problem_example
from service.http.middleware.request_id import request_id_header
from service.http.middleware.security_headers import SECURITY_HEADERS
from service.http.not_found import suggest_address
from service.http.responses import ProblemResponse
from service.http.validation import request_problem
from service.problems import (
    MEDIA_TYPE,
    ContentTooLarge,
    Internal,
    Malformed,
    MethodNotAllowed,
    NotFound,
    NotSaved,
    ProblemError,
)
from service.store import StoreError

_LOG = structlog.get_logger(__name__)


def install(app: FastAPI) -> None:
    """Answers every error of the application with a problem."""
    for kind in (ProblemError, RequestValidationError, HTTPException, StoreError, Exception):
        app.add_exception_handler(kind, respond)


def respond(request: Request, error: Exception) -> Response:
    """The response to an error."""
    match error:
        case ProblemError():
            return ProblemResponse(error)
        case RequestValidationError():
            return ProblemResponse(request_problem(error, _body_type(request)))
        case HTTPException(status_code=405) if request.method == "OPTIONS":
            return Response(status_code=204, headers={"Allow": _allow(_methods_at(request))})
        case HTTPException():
            return ProblemResponse(_framework_problem(request, error))
        case StoreError():
            _LOG.error("the store failed", error=str(error))
            return ProblemResponse(NotSaved())
        case _:
            _LOG.error("a request failed", path=request.url.path, exc_info=error)
            # Answered outside of every middleware, which therefore cannot add these.
            return ProblemResponse(Internal(headers=SECURITY_HEADERS | request_id_header()))


def problem_responses(*kinds: type[ProblemError]) -> dict[int | str, dict[str, Any]]:
    """The problems that a route can answer, by status, for its documentation."""
    by_status: dict[int | str, dict[str, Any]] = {}
    for kind in kinds:
        new = {"model": ProblemDocument, "description": "", "content": {MEDIA_TYPE: {"examples": {}}}}
        entry = by_status.setdefault(kind.status, new)
        entry["description"] = " · ".join(filter(None, (entry["description"], kind.title)))
        entry["content"][MEDIA_TYPE]["examples"][kind.slug] = {"value": problem_example(kind)}
    return by_status


def _framework_problem(request: Request, error: HTTPException) -> ProblemError:
    where = f"{request.method} {request.url.path}"
    match error.status_code:
        case 405:
            offered = _methods_at(request)
            detail = f"{where} is not offered; here one can {' or '.join(offered)}."
            return MethodNotAllowed(detail, headers={"Allow": _allow(offered)})
        case 413:
            return ContentTooLarge("The body is larger than is read here.", headers={"Connection": "close"})
        case 400:
            return Malformed("The body cannot be read.")
        case _:
            near = suggest_address(request.url.path, request.app.router.routes)
            return NotFound(f"There is nothing at {where}. {near or 'The calls there are stand at /docs.'}")


def _body_type(request: Request) -> Any:
    """The type of a route's body; None if it has none."""
    return getattr(request.scope.get("route"), "body_type", None)


def _allow(offered: Sequence[str]) -> str:
    """The value of `Allow`: with GET comes HEAD, and OPTIONS is answered everywhere."""
    more = ("HEAD", "OPTIONS") if "GET" in offered else ("OPTIONS",)
    return ", ".join(sorted((*offered, *more)))


def _methods_at(request: Request) -> list[str]:
    """Every method that some route offers at this path; the router itself knows those of the first."""
    offered: set[str] = set()
    for method in ("DELETE", "GET", "PATCH", "POST", "PUT"):
        scope = {**request.scope, "method": method}
        if any(route.matches(scope)[0] is Match.FULL for route in request.app.router.routes):
            offered.add(method)
    return sorted(offered)
