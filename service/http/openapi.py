"""The OpenAPI document, put right where the framework says what this service does not do.

It documents a 422 of its own shape for every call with a parameter, and errors as plain JSON; here
every error is a problem document, and a call answers the statuses it names and no others. What only the
running service knows, the languages it speaks, is written in as well.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from fastapi import FastAPI

from service.http import openapi_links as leads
from service.http import query_params as queries
from service.http.conditional import etag as preconditions
from service.http.conditional import idempotency
from service.http.errors import documented
from service.http.middleware import access_control as gate
from service.problems import KINDS, MEDIA_TYPE

_PROBLEM = {"$ref": "#/components/schemas/ProblemDocument"}
_FRAMEWORK_ERRORS = ("HTTPValidationError", "ValidationError")


def install(app: FastAPI) -> None:
    """Serve the corrected document; it is made once."""
    generate: Callable[[], dict[str, Any]] = app.openapi
    languages: Sequence[str] = app.state.context.listener.languages.codes
    made: list[dict[str, Any]] = []

    def corrected() -> dict[str, Any]:
        if not made:
            made.append(_corrected(generate(), languages))
        return made[0]

    app.openapi = corrected  # type: ignore[method-assign]


def _corrected(document: dict[str, Any], languages: Sequence[str]) -> dict[str, Any]:
    for path, item in document["paths"].items():
        for method, operation in item.items():
            operation["responses"] = {
                status: _as_problem(response) if status >= "4" else response
                for status, response in operation["responses"].items()
                if not _of_the_framework(response)
            }
            for around in (queries, idempotency, preconditions, gate):
                around.document(method, path, operation, _add_problems)
    leads.document(document["paths"])
    _name_languages(document, languages)
    document["components"]["securitySchemes"] = {"key": {"type": "http", "scheme": "bearer"}}
    for name in _FRAMEWORK_ERRORS:
        document["components"]["schemas"].pop(name, None)
    return document


def _name_languages(document: dict[str, Any], languages: Sequence[str]) -> None:
    """Wherever a language is chosen, which there are."""
    schemas = document["components"]["schemas"].values()
    said = [schema.get("properties", {}).get("language") for schema in schemas]
    for item in document["paths"].values():
        for operation in item.values():
            named = (each for each in operation.get("parameters", []) if each["name"] == "language")
            said += [parameter["schema"] for parameter in named]
    for schema in said:
        if schema and schema.pop("maxLength", None):  # in answers it has none
            schema["enum"] = list(languages)


def _add_problems(operation: dict[str, Any], *slugs: str) -> None:
    """Problems that the headers of a call bring with them, beside its own."""
    kinds = {kind.slug: kind for kind in KINDS}
    for status, new in documented(*(kinds[slug] for slug in slugs)).items():
        new["content"][MEDIA_TYPE]["schema"] = _PROBLEM
        del new["model"]
        said = operation["responses"].setdefault(str(status), new)
        for slug, example in new["content"][MEDIA_TYPE]["examples"].items():
            if slug not in said["content"][MEDIA_TYPE]["examples"]:
                said["content"][MEDIA_TYPE]["examples"][slug] = example
                said["description"] += f" · {kinds[slug].title}"


def _of_the_framework(response: dict[str, Any]) -> bool:
    schema = response.get("content", {}).get("application/json", {}).get("schema", {})
    return str(schema.get("$ref", "")).endswith("/HTTPValidationError")


def _as_problem(response: dict[str, Any]) -> dict[str, Any]:
    content = response["content"]
    schema = content.pop("application/json")["schema"]
    return {**response, "content": {MEDIA_TYPE: {"schema": schema, **content[MEDIA_TYPE]}}}
