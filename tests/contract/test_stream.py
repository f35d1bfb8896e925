"""The stream's messages against their schema: every kind there is, as a real socket receives them."""

from __future__ import annotations

import json
from typing import Any

from jsonschema import Draft202012Validator
from starlette.testclient import TestClient, WebSocketTestSession

from service.contract.encode.json import encoded
from service.contract.encode.state import state_json
from service.contract.schema import stream_schema
from service.contract.state import State
from service.sessions.messages import state_message, tick_message
from service.sessions.subscribers import MissedTicks, add_event_id
from sim.config import Config
from sim.state import SimState
from sim.transition import step
from tests.contract.document import asked
from tests.http.test_tick_stream import NOWHERE
from tests.sessions.test_tick_message import TICKS, roads

SCHEMA = stream_schema()
SENT = Draft202012Validator({**SCHEMA, "$ref": "#/$defs/StreamMessage"})
RECEIVED = Draft202012Validator({**SCHEMA, "$ref": "#/$defs/StreamRequest"})
KINDS = {SCHEMA["$defs"][each["$ref"].rsplit("/", 1)[1]]["properties"]["type"]["const"]
         for each in SCHEMA["$defs"]["StreamMessage"]["oneOf"]}  # fmt: skip
REQUESTS: list[dict[str, Any]] = [
    {"type": "ping"},
    {"type": "subscribe", "frames": "jpeg", "side": 64},
    {"type": "unsubscribe"},
    {"type": "command", "id": "a", "text": "add five potholes"},
    {"type": "command", "id": "b", "text": "order pizza"},
    {"type": "actions", "id": "c", "actions": [{"do": "step", "ticks": 2}]},
    {"type": "actions", "id": "d", "actions": [{"do": "ask", "about": "status"}], "dry_run": True},
    {"type": "actions", "id": "e", "actions": [{"do": "show", "view": "plan"}]},
    {"type": "command", "id": "f", "text": "add five potholes", "key": "once"},
    {"type": "command", "id": "g", "text": "add five potholes", "key": "once"},
]


def next_text(socket: WebSocketTestSession) -> dict[str, Any]:
    """The next message that is no picture."""
    while True:
        received = socket.receive()
        if received.get("text") is not None:
            message: dict[str, Any] = json.loads(received["text"])
            return message


def until(socket: WebSocketTestSession, kind: str) -> list[dict[str, Any]]:
    """All messages up to the first of a kind."""
    messages = [next_text(socket)]
    while messages[-1]["type"] != kind:
        messages.append(next_text(socket))
    return messages


def test_every_message_is_as_its_schema_says() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    messages: list[dict[str, Any]] = []
    with TestClient(asked()) as client:
        path = client.post("/api/v1/sessions", json={"seed": 5, "paused": True}).headers["location"]
        with client.websocket_connect(f"{path}/stream") as socket:
            messages += until(socket, "hello")
            for request in REQUESTS:
                RECEIVED.validate(request)
                socket.send_json(request)
                answer = {"command": "result", "actions": "result", "ping": "pong"}.get(request["type"])
                kind = "problem" if request.get("id") == "b" else answer or f"{request['type']}d"
                messages += until(socket, kind)
            socket.send_text("{")
            messages += until(socket, "error")
            client.delete(path)
            messages += until(socket, "gone")
    run = SimState.start(Config(seed=5))
    messages.append(
        json.loads(add_event_id(state_message(encoded(state_json(NOWHERE, run)), MissedTicks(3, 8)), "e.1"))
    )
    for message in messages:
        SENT.validate(message)
    # The last one is sent to readers of events alone, when the service stops.
    assert {message["type"] for message in messages} == KINDS - {"stopping"}
    SENT.validate({"type": "stopping", "code": 1012})


def test_ticks_of_all_sorts_of_roads_are_as_their_schema_says() -> None:
    begun = 0
    for config in roads():
        run = SimState.start(config)
        for _ in range(TICKS):
            tick = step(run)
            data = tick_message(0, lambda: NOWHERE, run, tick.state, tick.decision, None, ())
            message = json.loads(add_event_id(data, "e.1"))
            SENT.validate(message)
            assert ("state" in message) != ("moved" in message)
            begun += "state" in message
            run = tick.state
    assert begun > 3


def test_the_schema_allows_nothing_else() -> None:
    properties = set(SCHEMA["$defs"]["State"]["properties"])
    assert properties == set(State.__dataclass_fields__)
    assert not SENT.is_valid({"type": "gone", "why": "deleted"})
    assert not SENT.is_valid({"type": "tick"})
