"""Validation errors: pydantic's list of what is wrong, as fields and messages of a problem document."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from fastapi.exceptions import RequestValidationError

from service.http.suggestions import keys, suggest, suggest_quoted
from service.problems import FieldProblem, Invalid, Malformed, ProblemError

ErrorDetails = Sequence[Any]
"""pydantic's list of what is wrong: dictionaries with `loc` and `msg`."""

_UNKNOWN_KEY = ("extra_forbidden", "unexpected_keyword_argument")

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


def invalid(errors: Iterable[FieldProblem]) -> Invalid:
    """The problem of some bad fields."""
    listed = list(errors)
    text = "; ".join(
        f"{error.field}: {error.message}" if error.field else error.message for error in listed[:3]
    )
    more = f" and {len(listed) - 3} more" if len(listed) > 3 else ""
    return Invalid(f"{text}{more}.", errors=listed)


def field_problems(details: ErrorDetails, sent: Any, kind: Any = None) -> list[FieldProblem]:
    """pydantic's errors as fields and messages, one for each field; what was sent is not repeated.

    `kind` is the type that was validated: with it, an unknown key comes with the nearest known one.
    """
    by_field: dict[str, list[str]] = {}
    for detail in details:
        path = _path(detail, sent)
        message = _message(detail)
        if kind is not None and path and detail["type"] in _UNKNOWN_KEY:
            message += suggest(path[-1], keys(kind, sent, path[:-1]))
        by_field.setdefault(".".join(map(str, path)), []).append(message)
    return [FieldProblem(name, " or ".join(dict.fromkeys(messages))) for name, messages in by_field.items()]


def request_problem(error: RequestValidationError, kind: Any) -> ProblemError:
    """FastAPI's validation error as a problem; `kind` is the type of the body."""
    details = error.errors()
    if any(detail["type"] == "json_invalid" for detail in details):
        message = details[0]["ctx"]["error"]
        # The parser speaks of the text that it made of the bytes.
        why = "it is not written in UTF-8" if message.startswith("str is not valid UTF-8") else message
        return Malformed(f"The body cannot be read as JSON: {why}.")
    if details[0]["loc"] == ("body",):  # the whole of it; there is no field to name
        missing = details[0]["type"] == "missing"
        message = "is missing; send a JSON object, {} at least" if missing else _message(details[0])
        return Invalid(f"The body {message}.", errors=[FieldProblem("", message)])
    # FastAPI begins each place with where the value was: in the body, the query or the path.
    inside = [{**detail, "loc": detail["loc"][1:]} for detail in details]
    in_body = all(detail["loc"][0] == "body" for detail in details)
    sent = error.body if in_body else {detail["loc"][0]: None for detail in inside if detail["loc"]}
    return invalid(field_problems(inside, sent, kind if in_body else None))


def _path(detail: Any, sent: Any) -> list[str | int]:
    """The place in what was sent: pydantic's also has the types that it tried, which nobody sent."""
    path: list[str | int] = []
    for part in detail["loc"]:
        inside = isinstance(sent, list) and isinstance(part, int) and part < len(sent)
        if inside or (isinstance(sent, dict) and part in sent):
            path.append(part)
            sent = sent[part]
    if detail["type"] == "missing" and detail["loc"]:
        path.append(str(detail["loc"][-1]))
    return path


def _message(detail: Any) -> str:
    ours = _MESSAGES.get(detail["type"])
    context: dict[str, Any] = detail.get("ctx", {})
    if detail["type"] == "union_tag_not_found":
        context = {"discriminator": str(context["discriminator"]).replace("'", "`")}
    if ours is not None:
        listed = str(context.get("expected") or context.get("expected_tags") or "")
        one = context.get("min_length") == 1
        text = (ours[:-1] if one else ours).format(**context)
        return text + suggest_quoted(context.get("tag", detail["input"]), listed)
    message = str(detail["msg"])
    return message[:1].lower() + message[1:]
