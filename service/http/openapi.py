"""`/openapi.json`: the OpenAPI document, corrected where FastAPI's says what this service does not do.

FastAPI documents a 422 of its own shape for every call with a parameter, and errors as plain JSON; here every
error is a problem document, and a call answers the statuses it names and no others. The languages, which only
the running service knows, are added.

It takes seconds to make, so it is made at the first request, on a thread: sessions and streams go on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from threading import Lock
from typing import Any

from fastapi import FastAPI
from fastapi.routing import APIRoute
from starlette.requests import Request
from starlette.responses import JSONResponse

from service.contract.problem import ProblemDocument
from service.http import access_control, openapi_links
from service.http.conditional import etag, idempotency
from service.http.errors import problem_responses
from service.http.route import ApiRoute, GuardedRoute
from service.http.route_policy import policy_of
from service.problems import KINDS, MEDIA_TYPE

PATH = "/openapi.json"
_PROBLEM = {"$ref": "#/components/schemas/ProblemDocument"}
_FRAMEWORK_ERRORS = ("HTTPValidationError", "ValidationError")


def install(app: FastAPI) -> None:
    """Serves the corrected document; it is made once.

    Precondition: `app` was made with `openapi_url=None`, since FastAPI's own route makes the document on the
    event loop.
    """
    generate: Callable[[], dict[str, Any]] = app.openapi
    languages: Sequence[str] = app.state.context.interpreter.languages.codes
    made: list[dict[str, Any]] = []
    making = Lock()

    def openapi() -> dict[str, Any]:
        with making:
            if not made:
                ProblemDocument.model_rebuild()  # once, rather than for each of the hundreds documented
                document = generate()
                _correct(document, [each for each in app.routes if isinstance(each, APIRoute)], languages)
                made.append(document)
        return made[0]

    def serve(_: Request) -> JSONResponse:
        return JSONResponse(openapi())

    app.openapi = openapi  # type: ignore[method-assign]
    app.add_route(PATH, serve, methods=["GET"], include_in_schema=False)  # a plain function runs on a thread


def _correct(document: dict[str, Any], routes: Sequence[APIRoute], languages: Sequence[str]) -> None:
    for route, method, operation in _operations(document, routes):
        operation["responses"] = {
            status: _as_problem(response) if status >= "4" else response
            for status, response in operation["responses"].items()
            if not _is_of_the_framework(response)
        }
        _document_route(route, method, operation)
    openapi_links.document(document["paths"])
    _name_languages(document, languages)
    _list_constants(document["components"]["schemas"])
    document["components"]["securitySchemes"] = {"key": {"type": "http", "scheme": "bearer"}}
    for name in _FRAMEWORK_ERRORS:
        document["components"]["schemas"].pop(name, None)


def _operations(
    document: dict[str, Any], routes: Sequence[APIRoute]
) -> Iterator[tuple[APIRoute, str, dict[str, Any]]]:
    """Each documented operation with its route."""
    by_call = {
        (route.path_format, method.lower()): route for route in routes for method in route.methods or ()
    }
    for path, item in document["paths"].items():
        for method, operation in item.items():
            yield by_call[path, method], method, operation


def _document_route(route: APIRoute, method: str, operation: dict[str, Any]) -> None:
    """Adds what holds for every call alike."""
    guarded = isinstance(route, GuardedRoute)
    policy = policy_of(route.endpoint)
    if isinstance(route, ApiRoute):
        _add_problems(operation, "invalid")  # parameters in the URL
        if "/sessions" in route.path_format:
            _add_problems(operation, "too-much-work", "too-much-at-once", "stopped")
    idempotency.document(method, policy.idempotency_key, operation, _add_problems)
    etag.document(method, route.path_format, policy.entity_tag, operation, _add_problems)
    access_control.document(method, guarded, operation, _add_problems)


def _name_languages(document: dict[str, Any], languages: Sequence[str]) -> None:
    """Names the languages wherever one is chosen."""
    schemas = document["components"]["schemas"].values()
    chosen = [schema.get("properties", {}).get("language") for schema in schemas]
    for item in document["paths"].values():
        for operation in item.values():
            named = (each for each in operation.get("parameters", []) if each["name"] == "language")
            chosen += [parameter["schema"] for parameter in named]
    for schema in chosen:
        for each in (
            [schema, *schema.get("anyOf", ())] if schema else ()
        ):  # one that may be null is one of two
            if each.pop("maxLength", None):  # in answers it has none
                each["enum"] = list(languages)


def _list_constants(schema: Any) -> None:
    """Writes a text that is one of several kinds of value as a list of one.

    It means the same, but generators of clients read a constant there as the only value.
    """
    parts = schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ()
    for each in parts:
        _list_constants(each)
    for each in schema.get("anyOf", ()) if isinstance(schema, dict) else ():
        if isinstance(each, dict) and isinstance(each.get("const"), str):
            each["enum"] = [each.pop("const")]


def _add_problems(operation: dict[str, Any], *slugs: str) -> None:
    """Adds problems that a call can answer beside its own."""
    kinds = {kind.slug: kind for kind in KINDS}
    for status, new in problem_responses(*(kinds[slug] for slug in slugs)).items():
        new["content"][MEDIA_TYPE]["schema"] = _PROBLEM
        del new["model"]
        entry = operation["responses"].setdefault(str(status), new)
        for slug, example in new["content"][MEDIA_TYPE]["examples"].items():
            if slug not in entry["content"][MEDIA_TYPE]["examples"]:
                entry["content"][MEDIA_TYPE]["examples"][slug] = example
                entry["description"] += f" · {kinds[slug].title}"


def _is_of_the_framework(response: dict[str, Any]) -> bool:
    schema = response.get("content", {}).get("application/json", {}).get("schema", {})
    return str(schema.get("$ref", "")).endswith("/HTTPValidationError")


def _as_problem(response: dict[str, Any]) -> dict[str, Any]:
    content = response["content"]
    schema = content.pop("application/json")["schema"]
    return {**response, "content": {MEDIA_TYPE: {"schema": schema, **content[MEDIA_TYPE]}}}
