"""OpenAPI links: which part of an answer is which parameter of another call.

Testing tools and generated clients walk by them from call to call, as a person would.
"""

from __future__ import annotations

from typing import Any

CREATING = ("create_session", "fork_session")
"""Calls that answer a new session."""

_SAME = "$request.path.session_id"
_LONG_ANSWER = {"parameters": {"session_id": _SAME, "answer_id": "$response.body#/id"}}
_LONG_ANSWERS = dict.fromkeys(
    ("read_long_answer", "read_long_answer_result", "delete_long_answer"), _LONG_ANSWER
)
"""What follows where a call of a session is answered 202."""
_ONWARD: dict[str, dict[str, dict[str, Any]]] = {
    "list_sessions": {"read_session": {"parameters": {"session_id": "$response.body#/items/0/id"}}},
    "step_session": {
        "read_decision": {
            "parameters": {"session_id": _SAME, "tick": "$response.body#/decisions/0/tick"},
        },
        "read_state": {"parameters": {"session_id": _SAME, "tick": "$response.body#/decisions/0/tick"}},
        "rewind_session": {
            "parameters": {"session_id": _SAME},
            "requestBody": {"tick": "$response.body#/decisions/0/tick"},
        },
        "fork_session": {
            "parameters": {"session_id": _SAME},
            "requestBody": {"at_tick": "$response.body#/decisions/0/tick"},
        },
    },
    "read_link": {"create_session": {"requestBody": {"link": "$response.body#/link"}}},
    "read_recording": {"create_session": {"requestBody": {"recording": "$response.body"}}},
}


def document(paths: dict[str, Any]) -> None:
    """Adds the links to the answers."""
    operations = {
        operation["operationId"]: (path, operation)
        for path, item in paths.items()
        for operation in item.values()
    }
    of_a_session = [
        name
        for name, (path, _) in operations.items()
        if "{session_id}" in path and name not in _LONG_ANSWERS  # a new session has none
    ]
    own = {name: {"parameters": {"session_id": "$response.body#/id"}} for name in of_a_session}
    for name, (path, operation) in operations.items():
        if "{session_id}" in path and "202" in operation["responses"]:
            _add(operation["responses"]["202"], _LONG_ANSWERS, operations)
        onward = own if name in CREATING else _ONWARD.get(name)
        if onward is None:
            continue
        success = next(answer for status, answer in operation["responses"].items() if status < "3")
        _add(success, onward, operations)


def _add(answer: dict[str, Any], onward: dict[str, Any], operations: dict[str, Any]) -> None:
    answer["links"] = {
        target: {"operationId": target, "description": operations[target][1]["summary"], **how}
        for target, how in onward.items()
        if target in operations
    }
