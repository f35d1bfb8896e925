"""Writes the page's types of the wire, `web/src/core/wire.d.ts`, from the service's own models.

    python -m tools.wire_types

A test compares the file with what would be written, so that a change of the contract shows in the page.
The sources are the OpenAPI document of the service and the schema of its stream: each model becomes a type
of the same name. A model that differs between requests and answers only in its defaults goes by one name.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from service.app import create_app
from service.contract.schema import stream_schema

Schema = Mapping[str, Any]

FILE = Path(__file__).parents[1] / "web" / "src" / "core" / "wire.d.ts"
_HEAD = "// Written by `make types-page` from the service's models; a change by hand is lost."
_PRIMITIVES = {
    "string": "string",
    "integer": "number",
    "number": "number",
    "boolean": "boolean",
    "null": "null",
}


def wire_types(schemas: Mapping[str, Schema]) -> str:
    """TypeScript declarations of schemas, by name."""
    actions = next((found for schema in schemas.values() for found in _action_unions(schema)), None)
    declarations = [_declaration(name, schema) for name, schema in sorted(schemas.items())]
    if actions is not None:
        declarations.append(
            f"/** One action of the language contract. */\nexport type Action = {_union(actions)};"
        )
    return "\n\n".join([_HEAD, *declarations]) + "\n"


def _action_unions(schema: Any) -> Iterator[Schema]:
    """Unions of all actions, which are told apart by what they do."""
    if isinstance(schema, Mapping):
        if _is_action(schema):
            yield schema
        for value in schema.values():
            yield from _action_unions(value)
    elif isinstance(schema, list):
        for each in schema:
            yield from _action_unions(each)


def _is_action(schema: Schema) -> bool:
    discriminator = schema.get("discriminator")
    return isinstance(discriminator, Mapping) and discriminator.get("propertyName") == "do"


def _declaration(name: str, schema: Schema) -> str:
    comment = _comment(schema, "")
    if schema.get("type") == "object" and schema.get("properties"):
        return f"{comment}export interface {name} {_object(schema, '')}"
    return f"{comment}export type {name} = {_type(schema, '')};"


def _comment(schema: Schema, indent: str) -> str:
    told = " ".join(str(schema.get("description", "")).split()).replace("*/", "")
    return f"{indent}/** {told} */\n" if told else ""


def _object(schema: Schema, indent: str) -> str:
    deeper = indent + "  "
    required = set(schema.get("required", ()))
    lines = []
    for name, value in schema["properties"].items():
        # What is always the same value is always sent, though a request may leave it out.
        mark = "" if name in required or "const" in value else "?"
        lines.append(f"{_comment(value, deeper)}{deeper}{_key(name)}{mark}: {_type(value, deeper)};")
    if schema.get("additionalProperties") is True:
        lines.append(f"{deeper}[key: string]: unknown;")
    return "{\n" + "\n".join(lines) + f"\n{indent}}}"


def _key(name: str) -> str:
    return name if name.isidentifier() else json.dumps(name)


def _type(schema: Any, indent: str) -> str:
    """A schema as a type expression; what says nothing is unknown."""
    if not isinstance(schema, Mapping):
        return "unknown"
    if "$ref" in schema:
        return str(schema["$ref"].rpartition("/")[2])
    if _is_action(schema):
        return "Action"
    if "anyOf" in schema or "oneOf" in schema:
        return _union(schema, indent)
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " | ".join(json.dumps(each) for each in schema["enum"])
    match schema.get("type"):
        case "array":
            return _array(schema, indent)
        case "object" if schema.get("properties"):
            return _object(schema, indent)
        case "object":
            return f"{{ [key: string]: {_type(schema.get('additionalProperties'), indent)} }}"
        case list() as several:
            return " | ".join(_PRIMITIVES.get(each, "unknown") for each in several)
        case kind:
            return _PRIMITIVES.get(str(kind), "unknown")


def _union(schema: Schema, indent: str = "") -> str:
    members = schema.get("anyOf") or schema.get("oneOf") or ()
    return " | ".join(dict.fromkeys(_type(each, indent) for each in members))


def _array(schema: Schema, indent: str) -> str:
    if "prefixItems" in schema:
        return "[" + ", ".join(_type(each, indent) for each in schema["prefixItems"]) + "]"
    item = _type(schema.get("items"), indent)
    length = schema.get("maxItems")
    if length is not None and length == schema.get("minItems") and length <= 4:
        return "[" + ", ".join([item] * length) + "]"
    return f"({item})[]" if " " in item else f"{item}[]"


def service_schemas() -> dict[str, Schema]:
    """The models of the service by name: those of its OpenAPI document, and the messages of the stream."""
    schemas: dict[str, Schema] = create_app().openapi()["components"]["schemas"]
    return {**stream_schema()["$defs"], **schemas}


def main() -> None:
    """Write the file."""
    FILE.write_text(wire_types(service_schemas()), encoding="utf-8")


if __name__ == "__main__":
    main()
