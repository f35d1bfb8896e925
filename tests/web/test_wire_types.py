"""The page's types of the wire: written from the service's models, and up to date."""

from __future__ import annotations

from tools.wire_types import FILE, service_schemas, wire_types


def test_the_types_of_the_page_are_those_of_the_service() -> None:
    assert FILE.read_text(encoding="utf-8") == wire_types(service_schemas()), "run `make types-page`"


def test_schemas_become_types() -> None:
    text = wire_types(
        {
            "Cell": {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2},
            "Thing": {
                "type": "object",
                "description": "A thing\non the road.",
                "required": ["cell"],
                "properties": {
                    "cell": {"anyOf": [{"$ref": "#/components/schemas/Cell"}, {"type": "null"}]},
                    "kind": {"enum": ["pothole", "barrier"]},
                    "ids": {"type": "array", "items": {"anyOf": [{"type": "string"}, {"type": "integer"}]}},
                    "config": {"type": "object", "additionalProperties": True},
                },
            },
        }
    )
    assert "export type Cell = [number, number];" in text
    assert "/** A thing on the road. */\nexport interface Thing {" in text
    assert "  cell: Cell | null;" in text
    assert '  kind?: "pothole" | "barrier";' in text
    assert "  ids?: (string | number)[];" in text
    assert "  config?: { [key: string]: unknown };" in text


def test_actions_are_one_union() -> None:
    union = {
        "discriminator": {"propertyName": "do"},
        "oneOf": [{"$ref": "#/components/schemas/Ask"}, {"$ref": "#/components/schemas/Undo"}],
    }
    ask = {
        "type": "object",
        "properties": {"do": {"const": "ask"}, "change": {"type": "array", "items": union}},
    }
    undo = {"type": "object", "properties": {"do": {"const": "undo", "default": "undo"}}}
    text = wire_types({"Ask": ask, "Undo": undo})
    assert text.count("export interface Ask {") == 1
    assert '  do: "undo";' in text
    assert "  change?: Action[];" in text
    assert "export type Action = Ask | Undo;" in text
