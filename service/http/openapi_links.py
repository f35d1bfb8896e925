"""What an answer leads to, as links of the OpenAPI document: the id that was made is the id to ask about.

Generated clients and testing tools walk by these from call to call, as a person would.
"""

from __future__ import annotations

from typing import Any

MADE = ("sessions_make", "time_fork")
"""Calls that answer a new session."""

_SAME = "$request.path.session_id"
_ONWARD: dict[str, dict[str, dict[str, Any]]] = {
    "sessions_newest": {"sessions_look": {"parameters": {"session_id": "$response.body#/items/0/id"}}},
    "talking_step": {
        "watching_decision": {
            "parameters": {"session_id": _SAME, "tick": "$response.body#/decisions/0/tick"},
        },
        "watching_state": {"parameters": {"session_id": _SAME, "tick": "$response.body#/decisions/0/tick"}},
        "time_rewind": {
            "parameters": {"session_id": _SAME},
            "requestBody": {"tick": "$response.body#/decisions/0/tick"},
        },
        "time_fork": {
            "parameters": {"session_id": _SAME},
            "requestBody": {"at_tick": "$response.body#/decisions/0/tick"},
        },
    },
    "time_link": {"sessions_make": {"requestBody": {"link": "$response.body#/link"}}},
    "watching_recording": {"sessions_make": {"requestBody": {"recording": "$response.body"}}},
}


def document(paths: dict[str, Any]) -> None:
    """Put the links where they belong."""
    operations = {
        operation["operationId"]: (path, operation)
        for path, item in paths.items()
        for operation in item.values()
    }
    of_a_session = [name for name, (path, _) in operations.items() if "{session_id}" in path]
    own = {name: {"parameters": {"session_id": "$response.body#/id"}} for name in of_a_session}
    for name, (_, operation) in operations.items():
        onward = own if name in MADE else _ONWARD.get(name)
        if onward is None:
            continue
        success = next(answer for status, answer in operation["responses"].items() if status < "3")
        success["links"] = {
            target: {"operationId": target, "description": operations[target][1]["summary"], **how}
            for target, how in onward.items()
            if target in operations
        }
