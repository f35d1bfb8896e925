"""Makes the reference of the REST API from the service's OpenAPI document."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from running_service import app

_METHODS = ("get", "post", "put", "patch", "delete")
_EVERYWHERE = {"401", "403", "421", "429"}
"""Refusals that every call shares; the page describes them once."""


def operations() -> str:
    """Returns a section for each call, grouped by tag: parameters, body, examples, answers."""
    groups: dict[str, list[str]] = {}
    for path, item in app().openapi()["paths"].items():
        for method in (each for each in _METHODS if each in item):
            operation = item[method]
            groups.setdefault(operation["tags"][0], []).append(_operation(method, path, operation))
    return "\n\n".join(f"## {tag.capitalize()}\n\n" + "\n\n".join(parts) for tag, parts in groups.items())


def schemas() -> str:
    """Returns a section for each schema: its fields, their types and meanings."""
    found: dict[str, Any] = app().openapi()["components"]["schemas"]
    return "\n\n".join(_schema(name, schema) for name, schema in sorted(found.items()))


def _operation(method: str, path: str, operation: dict[str, Any]) -> str:
    parts = [
        f"### {operation['summary']}",
        f"`{method.upper()} {path}` · `{operation['operationId']}`",
        operation.get("description", ""),
        _parameters(operation.get("parameters", [])),
        _body(operation.get("requestBody", {})),
        _answers(operation["responses"]),
    ]
    return "\n\n".join(part for part in parts if part)


def _parameters(parameters: list[dict[str, Any]]) -> str:
    if not parameters:
        return ""
    rows = ["| parameter | in | type | meaning |", "| --- | --- | --- | --- |"]
    for each in parameters:
        need = "" if not each.get("required") or each["in"] == "path" else "Required. "
        meaning = each.get("description", "") or each["schema"].get("description", "")
        rows.append(f"| `{each['name']}` | {each['in']} | {_type(each['schema'])} | {need}{_cell(meaning)} |")
    return "\n".join(rows)


def _body(body: dict[str, Any]) -> str:
    if not body:
        return ""
    kind, content = next(iter(body["content"].items()))
    parts = [f"Body: {_type(content['schema'])} (`{kind}`)."]
    for example in content.get("examples", {}).values():
        value = json.dumps(example["value"], ensure_ascii=False)
        if len(value) <= 400:
            parts.append(f"{example.get('summary', 'For example')}:\n\n```json\n{value}\n```")
    return "\n\n".join(parts)


def _answers(responses: dict[str, Any]) -> str:
    rows = ["| status | answer |", "| --- | --- |"]
    for status, response in sorted(responses.items()):
        if status in _EVERYWHERE:
            continue
        rows.append(f"| {status} | {_cell(_answer(status, response))} |")
    return "\n".join(rows)


def _answer(status: str, response: dict[str, Any]) -> str:
    content = next(iter(response.get("content", {}).items()), None)
    if status >= "4" and content is not None:
        slugs = ", ".join(f"`{slug}`" for slug in content[1].get("examples", {}))
        return f"{response['description']}{f' ({slugs})' if slugs else ''}"
    if content is None:
        return "" if response["description"] == "Successful Response" else response["description"]
    kind, body = content
    named = _type(body["schema"]) if body.get("schema") else ""
    kinds = " or ".join(f"`{each}`" for each in response["content"])
    return named if kind == "application/json" and named else kinds


def _schema(name: str, schema: dict[str, Any]) -> str:
    parts = [f"## {name}", schema.get("description", "")]
    if "enum" in schema:
        parts.append("One of " + ", ".join(f"`{each}`" for each in schema["enum"]) + ".")
    required = set(schema.get("required", []))
    rows = [
        f"| `{field}`{'' if field in required else ' ?'} | {_type(of)} | {_cell(of.get('description', ''))} |"
        for field, of in schema.get("properties", {}).items()
    ]
    if rows:
        parts.append("\n".join(["| field | type | meaning |", "| --- | --- | --- |", *rows]))
    elif "enum" not in schema:
        parts.append(_type(schema))
    return "\n\n".join(part for part in parts if part)


def _type(schema: dict[str, Any]) -> str:
    """A schema in a few words, with links to the schemas it names."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](schemas.md#{name.lower()})"
    for key in ("anyOf", "oneOf"):
        if key in schema:
            return " or ".join(dict.fromkeys(_type(each) for each in schema[key]))
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{each}`" for each in schema["enum"])
    if schema.get("type") == "array":
        inside = schema.get("items") or {}
        return f"list of {_type(inside)}" if inside else "list"
    return " ".join([str(schema.get("type", "any value")), *_limits(schema)])


def _limits(schema: dict[str, Any]) -> Iterator[str]:
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and high is not None and high < 2**53 - 1:
        yield f"{low} … {high}"
    elif low is not None:
        yield f"≥ {low}"


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
