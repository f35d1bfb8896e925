"""The stream's messages as a JSON schema: `python -m service.contract.schema` prints it.

`StreamMessage` is what the service sends, `StreamRequest` what clients send, `Auth` their first message where
the service asks for a key. Other programs make their types from it; the page does.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Final

from pydantic import TypeAdapter

from service.contract.stream import StreamMessage
from service.contract.stream_requests import Auth, StreamRequest

_ROOTS: Mapping[str, Any] = {"StreamMessage": StreamMessage, "StreamRequest": StreamRequest, "Auth": Auth}

_MODE: Final = "validation"  # what may be left out is so in both directions


def stream_schema() -> dict[str, Any]:
    """The schema; every message is one of its `$defs`."""
    roots, schema = TypeAdapter.json_schemas(
        (name, _MODE, TypeAdapter(kind)) for name, kind in _ROOTS.items()
    )
    definitions = schema["$defs"]
    definitions |= {name: root for (name, _), root in roots.items() if name not in definitions}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Roadtalk stream",
        "$defs": {name: _without_titles(each) for name, each in definitions.items()},
    }


def _without_titles(schema: dict[str, Any]) -> dict[str, Any]:
    """A schema whose properties have no titles: generators would name a type after each."""
    for each in schema.get("properties", {}).values():
        each.pop("title", None)
    return schema


if __name__ == "__main__":
    print(json.dumps(stream_schema(), indent=2, sort_keys=True, ensure_ascii=False))
