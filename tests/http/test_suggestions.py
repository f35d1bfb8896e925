"""Slips in names: what may have been meant is told, for every kind of thing that is sent."""

from __future__ import annotations

from typing import Annotated, Any

import pytest
from pydantic import Discriminator, TypeAdapter, ValidationError

from service.contract import requests as bodies
from service.contract.stream_requests import StreamRequest
from service.http.validation import field_problems
from tests.support.service import Service

UNKNOWN = "is not a known key"
SLIP = f"{UNKNOWN}; did you mean "
ADD = {"do": "add", "kind": "pothole", "count": 1}


def told(kind: Any, sent: Any) -> dict[str, str]:
    with pytest.raises(ValidationError) as refused:
        TypeAdapter(
            Annotated[StreamRequest, Discriminator("type")] if kind is StreamRequest else kind
        ).validate_python(sent)
    return {each.field: each.message for each in field_problems(refused.value.errors(), sent, kind)}


@pytest.mark.parametrize(
    ("kind", "sent", "field", "message"),
    [
        (bodies.Said, {"txt": "x"}, "txt", SLIP + "text"),
        (bodies.Said, {"text": "x", "Dry_Run": True}, "Dry_Run", SLIP + "dry_run"),
        (bodies.Said, {"text": "x", "wobble": True}, "wobble", UNKNOWN),
        (bodies.Said, {"text": "x", "": True}, "", UNKNOWN),
        (bodies.Said, {"text": "x", "text" * 400: 1}, "text" * 400, UNKNOWN),
        (bodies.NewSession, {"sede": 1}, "sede", SLIP + "seed"),
        (bodies.NewFork, {"at_tik": 1}, "at_tik", SLIP + "at_tick"),
        (bodies.TypedActions, {"actions": [{**ADD, "knd": 1}]}, "actions.0.knd", SLIP + "kind"),
        (
            bodies.TypedActions,
            {"actions": [ADD, {**ADD, "where": {"cel": [1, 2]}}]},
            "actions.1.where.cel",
            SLIP + "cell",
        ),
        (bodies.TypedActions, {"actions": [{"do": "pause", "kind": 1}]}, "actions.0.kind", UNKNOWN),
        (StreamRequest, {"type": "command", "id": "1", "txt": "x"}, "txt", SLIP + "text"),
        (StreamRequest, {"type": "ping", "text": "x"}, "text", UNKNOWN),
        (
            StreamRequest,
            {"type": "subscribe", "frames": "jpg"},
            "frames",
            "must be 'jpeg' or 'webp'; did you mean jpeg",
        ),
    ],
)
def test_a_slip_in_a_name_is_told(kind: Any, sent: Any, field: str, message: str) -> None:
    assert told(kind, sent)[field] == message


@pytest.mark.parametrize(
    ("sent", "end"),
    [
        ({"actions": [{**ADD, "kind": "potholes"}]}, "; did you mean pothole"),
        ({"actions": [{**ADD, "do": "ad"}]}, "; did you mean add"),
        ({"actions": [{"do": "set", "parameter": "plannr", "value": "astar"}]}, "; did you mean planner"),
    ],
)
def test_a_slip_in_a_word_is_told(sent: Any, end: str) -> None:
    (message,) = told(bodies.TypedActions, sent).values()
    assert message.endswith(end)


def test_nothing_is_meant_where_nothing_is_near() -> None:
    (message,) = told(bodies.TypedActions, {"actions": [{**ADD, "kind": "zzz"}]}).values()
    assert "did you mean" not in message


def test_one_is_one() -> None:
    assert told(bodies.TypedActions, {"actions": []}) == {"actions": "must have at least 1 item"}
    assert told(bodies.NewFork, {"name": ""}) == {"name": "must have at least 1 character"}


@pytest.mark.parametrize(
    ("method", "path", "body", "error"),
    [
        ("POST", "/api/v1/sessions", {"sede": 1}, ("sede", SLIP + "seed")),
        (
            "POST",
            "/api/v1/sessions",
            {"config": {"pothols": 1}},
            ("config.pothols", "is not a setting of a road; did you mean potholes"),
        ),
        (
            "POST",
            "/api/v1/sessions",
            {"config": {"seed": -1}},
            ("config.seed", "must be between 0 and 9007199254740991"),
        ),
        (
            "PATCH",
            "{own}/config",
            {"plannr": "astar"},
            ("plannr", "is not a setting of a road; did you mean planner"),
        ),
        ("POST", "{own}/step", {"tick": 3}, ("tick", SLIP + "ticks")),
        ("POST", "/api/v1/parse", {"test": "x"}, ("test", SLIP + "text")),
        ("POST", "/api/v1/tickets", {"for": "x"}, ("for", UNKNOWN)),
    ],
)
async def test_every_call_tells_of_slips(
    service: Service, method: str, path: str, body: dict[str, Any], error: tuple[str, str]
) -> None:
    made = await service.client.post("/api/v1/sessions", json={"seed": 1, "paused": True})
    answer = await service.client.request(method, path.format(own=made.headers["location"]), json=body)
    assert answer.status_code == 422
    assert error in [(each["field"], each["message"]) for each in answer.json()["errors"]]
