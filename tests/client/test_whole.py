"""The client against the OpenAPI document: no call, parameter or field is forgotten, and none made up."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from typing import Any

import pytest

from service.client import AsyncClient, BlockedMove, Counterfactual
from service.client import endpoints as calls
from service.client.call import Call
from service.client.sse import EventStreamReader
from tests.contract.document import document

Json = dict[str, Any]
DOCUMENT = document()
OPERATIONS = {
    (method.upper(), path): operation
    for path, item in DOCUMENT["paths"].items()
    for method, operation in item.items()
}
ELSEWHERE = {
    ("GET", "/api/v1/backup"): "`backup` writes it to a file as it comes",
    ("GET", "/metrics"): "for Prometheus, which reads it by itself",
    ("GET", "/api/v1/sessions/{session_id}/events/stream"): "`following` keeps it open",
}
VALUES = {
    "session": "SESSION",
    "evaluation": "EVALUATION",
    "answer": "ANSWER",
    "tick": 7,
    "parts": {"traffic": "heavy"},
    "recording": {"format": "x"},
}
_LOOK = {"theme": "light", "boxes": False, "forecast": True}
LOOKS = {
    "read_frame": {**_LOOK, "figures": False},
    "read_video": {**_LOOK, "format": "gif", "fps": 10, "view": "road", "side": 480, "path": True},
}
"""What pictures are asked with, by call."""


def made() -> Iterator[tuple[str, Call[Any]]]:
    """Every call there is, with a value for everything that can be said."""
    for name, function in inspect.getmembers(calls, inspect.isfunction):
        signature = inspect.signature(function, eval_str=False)
        if function.__module__ != calls.__name__ or not str(signature.return_annotation).startswith("Call["):
            continue
        given: Json = {}
        for parameter in signature.parameters.values():
            if parameter.kind is parameter.VAR_KEYWORD:
                given |= LOOKS[name]
            elif parameter.name == "actions":
                given["actions"] = [{"do": "pause"}]
            else:
                given[parameter.name] = VALUES.get(parameter.name, "1")
        yield name, function(**given)


CALLS = dict(made())


def template(call: Call[Any]) -> tuple[str, str]:
    """As the document writes it."""
    path = call.path.replace("SESSION", "{session_id}").replace("EVALUATION", "{evaluation_id}")
    path = path.replace("ANSWER", "{answer_id}")
    return call.method, path.replace("/decisions/7", "/decisions/{tick}")


def test_every_call_of_the_document_is_there_and_no_other() -> None:
    known = {template(call) for call in CALLS.values()}
    assert known | set(ELSEWHERE) == set(OPERATIONS)
    assert not known & set(ELSEWHERE)
    following = EventStreamReader("http://service", "SESSION", None, 1)
    assert following.request(1)["url"] == "/api/v1/sessions/SESSION/events/stream"


@pytest.mark.parametrize("name", CALLS)
def test_every_parameter_and_field_can_be_said_and_no_other(name: str) -> None:
    call = CALLS[name]
    operation = OPERATIONS[template(call)]
    documented = {each["name"] for each in operation.get("parameters", []) if each["in"] == "query"}
    assert set(call.params) == documented
    content = operation.get("requestBody", {}).get("content", {}).get("application/json")
    if content is None:
        assert call.body is None
        return
    schema = content["schema"]
    if "$ref" in schema:
        schema = DOCUMENT["components"]["schemas"][schema["$ref"].rsplit("/", 1)[1]]
    assert call.body is not None
    fields = set(schema.get("properties", ()))
    if name == "patch_config":  # whatever is given
        assert set(call.body) <= fields
    else:
        assert set(call.body) == fields


@pytest.mark.parametrize("name", CALLS)
def test_a_call_that_can_be_repeated_safely_has_a_key(name: str) -> None:
    operation = OPERATIONS[template(CALLS[name])]
    headers = {each["name"] for each in operation.get("parameters", []) if each["in"] == "header"}
    assert (CALLS[name].key is not None) == ("Idempotency-Key" in headers or CALLS[name].method == "DELETE")


async def test_what_is_told_of_a_run(inside: AsyncClient) -> None:
    session = await inside.create(name="first", seed=11, config={"potholes": 4}, paused=True)
    await session.step(6)
    await session.say("add five potholes")
    await session.save("here")
    fork = await session.fork(at_tick=3)
    info = await fork.info()
    assert info.parent is not None
    assert (info.parent.id, info.parent.tick) == (session.id, 3)
    assert (await session.info()).parent is None
    assert [item.parent and item.parent.id for item in await inside.list()] == [session.id, None]

    saved = await inside.saved()
    assert [(each.name, each.session, each.session_name, each.tick) for each in saved] == [
        ("here", session.id, "first", 6)
    ]
    assert (await inside.ready()).status == "ready"
    timeline = await session.timeline(2)
    assert (timeline.first, timeline.now, len(timeline.moves)) == (2, 6, 4)
    assert (await session.timeline()).marks[0].kind == "episode"
    assert [(each.tick, each.text, each.said) for each in await session.changes()] == [
        (6, "add five potholes", True)
    ]
    moments = await session.moments(5, limit=2)
    assert [each.state.tick for each in moments] == [5, 6]
    assert moments.items[0].decision is not None
    expected = await session.forecast(3, at_tick=2)
    assert (expected.tick, [each.tick for each in expected.ahead]) == (2, [3, 4, 5])
    judged = await session.regret(1, limit=3)
    assert [each.tick for each in judged] == [1, 2, 3]
    assert len((await inside.guide("add five po", session=session.id)).completions) > 0


async def test_what_would_have_been(inside: AsyncClient) -> None:
    session = await inside.create(seed=13, config={"potholes": 4}, paused=True)
    moves = [each.move for each in (await session.step(3)).decisions]
    beside = await session.counterfactual(move="stay", at_tick=1, ticks=5)
    assert isinstance(beside, Counterfactual)
    assert (beside.at_tick, beside.instead_of) == (1, moves[1])
    assert [each.tick for each in beside.real.ticks] == [2, 3, 4, 5, 6]
    first = beside.changed.ticks[0].decision
    assert first is not None
    assert first.move == "stay"
    full = await inside.create(seed=11, config={"potholes": 60, "vehicles": 12}, paused=True)
    ticks = (await full.counterfactual({"do": "reset"}, ticks=5)).real.ticks
    blocked = [each for tick in ticks if tick.decision is not None for each in tick.decision.blocked]
    assert blocked
    assert all(isinstance(each, BlockedMove) and each.reason for each in blocked)
    assert (await session.info()).tick == 3
