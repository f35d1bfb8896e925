"""The OpenAPI document is the contract: complete, true, and kept under any input."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import AsyncIterator, Iterator
from typing import Any

import httpx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from service import problems
from service.contract import requests as bodies
from tests.contract.document import Json, asked, document, operations

APP = asked()
DOCUMENT = document()
OPERATIONS = operations(DOCUMENT)
POSTS = sorted(path for path, item in DOCUMENT["paths"].items() if "post" in item)
WITH_BODY = ("post", "patch")
ROUTES = {
    "POST /api/v1/sessions",
    "GET /api/v1/sessions",
    "GET /api/v1/sessions/{session_id}",
    "PATCH /api/v1/sessions/{session_id}",
    "DELETE /api/v1/sessions/{session_id}",
    "PATCH /api/v1/sessions/{session_id}/config",
    "POST /api/v1/sessions/{session_id}/commands",
    "POST /api/v1/sessions/{session_id}/actions",
    "POST /api/v1/sessions/{session_id}/step",
    "POST /api/v1/sessions/{session_id}/ask",
    "GET /api/v1/sessions/{session_id}/state",
    "GET /api/v1/sessions/{session_id}/decisions",
    "GET /api/v1/sessions/{session_id}/decisions/{tick}",
    "GET /api/v1/sessions/{session_id}/events",
    "GET /api/v1/sessions/{session_id}/events/stream",
    "GET /api/v1/sessions/{session_id}/recording",
    "POST /api/v1/sessions/{session_id}/forks",
    "POST /api/v1/sessions/{session_id}/rewind",
    "GET /api/v1/sessions/{session_id}/saved",
    "GET /api/v1/saved",
    "POST /api/v1/sessions/{session_id}/counterfactual",
    "GET /api/v1/sessions/{session_id}/link",
    "GET /api/v1/sessions/{session_id}/forecast",
    "GET /api/v1/sessions/{session_id}/percept",
    "GET /api/v1/sessions/{session_id}/regret",
    "GET /api/v1/sessions/{session_id}/timeline",
    "GET /api/v1/sessions/{session_id}/changes",
    "GET /api/v1/sessions/{session_id}/moments",
    "GET /api/v1/sessions/{session_id}/frame",
    "GET /api/v1/sessions/{session_id}/film",
    "GET /api/v1/sessions/{session_id}/answers/{answer_id}",
    "GET /api/v1/sessions/{session_id}/answers/{answer_id}/result",
    "DELETE /api/v1/sessions/{session_id}/answers/{answer_id}",
    "POST /api/v1/evaluations",
    "GET /api/v1/evaluations",
    "GET /api/v1/evaluations/{evaluation_id}",
    "DELETE /api/v1/evaluations/{evaluation_id}",
    "GET /api/v1/evaluations/{evaluation_id}/report",
    "POST /api/v1/parse",
    "POST /api/v1/advice",
    "GET /api/v1/language",
    "GET /healthz",
    "GET /readyz",
    "GET /metrics",
    "GET /api/v1/backup",
    "POST /api/v1/tickets",
}


def validator(schema: Json) -> Draft202012Validator:
    """Checks values against a schema of the document."""
    return Draft202012Validator({**schema, "components": DOCUMENT["components"]})


PROBLEM = validator({"$ref": "#/components/schemas/ProblemDocument"})


@pytest.fixture
async def client() -> AsyncIterator[httpx.AsyncClient]:
    transport = httpx.ASGITransport(APP, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        yield client
        jobs = APP.state.context.jobs
        for job in await jobs.newest(200):
            await jobs.wait(job.id)


async def new_session(client: httpx.AsyncClient) -> str:
    answer = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    identity = str(answer.json()["id"])
    await client.post(f"/api/v1/sessions/{identity}/step", json={"ticks": 5})
    return identity


def resolved(schema: Json) -> Json:
    while "$ref" in schema:
        schema = DOCUMENT["components"]["schemas"][schema["$ref"].rsplit("/", 1)[1]]
    return schema


async def test_the_document_is_made_beside_the_event_loop() -> None:
    async with httpx.AsyncClient(transport=httpx.ASGITransport(asked()), base_url="http://test") as client:
        asked_for = asyncio.create_task(client.get("/openapi.json"))
        turns = 0
        while not asked_for.done():
            turns += 1
            await asyncio.sleep(0)
    assert asked_for.result().status_code == 200
    assert turns > 200  # on the loop there are as many as there are awaits on the way: a few dozen


def test_it_is_the_whole_interface_and_nothing_else() -> None:
    assert DOCUMENT["openapi"].startswith("3.1")
    assert {f"{p.values[1].upper()} {p.values[0]}" for p in OPERATIONS} == ROUTES
    operation_ids = [p.values[2]["operationId"] for p in OPERATIONS]
    assert len(set(operation_ids)) == len(operation_ids)


@pytest.mark.parametrize(("path", "method", "operation"), OPERATIONS)
def test_every_call_is_described(path: str, method: str, operation: Json) -> None:
    assert operation["summary"]
    assert operation["description"]
    assert operation["tags"]
    for parameter in operation.get("parameters", []):
        assert parameter["schema"]
    body = operation.get("requestBody")
    assert (body is not None) == (method in WITH_BODY), path
    if body:
        assert body["required"]
        assert body["content"]["application/json"]["examples"]


@pytest.mark.parametrize(("path", "method", "operation"), OPERATIONS)
def test_every_status_says_what_comes_with_it(path: str, method: str, operation: Json) -> None:
    responses = operation["responses"]
    assert any(status.startswith("2") for status in responses)
    expected = set()
    if "{session_id}" in path:
        expected |= {"404", "503"}
    if method in WITH_BODY:
        expected |= {"400", "413", "415", "422"}
    assert expected <= set(responses)
    for status, response in responses.items():
        assert response["description"]
        if status in ("204", "304"):
            continue
        for kind, content in response["content"].items():
            if status.startswith("2"):
                assert "schema" in content, (status, kind)
            else:
                assert kind == "application/problem+json"
                assert resolved(content["schema"])["title"] == "ProblemDocument"
        if not status.startswith("2"):
            examples = response["content"]["application/problem+json"]["examples"]
            known = {kind.slug: kind for kind in problems.KINDS}
            for slug, example in examples.items():
                assert example["value"]["status"] == known[slug].status == int(status)
                PROBLEM.validate(example["value"])


def request_examples() -> Iterator[Any]:
    for parameter in OPERATIONS:
        path, method, operation = parameter.values
        if method != "post":  # the others are sent in test_examples
            continue
        for name, example in operation["requestBody"]["content"]["application/json"]["examples"].items():
            yield pytest.param(path, operation, example["value"], id=f"{path} {name}")


@pytest.mark.parametrize(("path", "operation", "body"), list(request_examples()))
async def test_every_example_runs(client: httpx.AsyncClient, path: str, operation: Json, body: Json) -> None:
    identity = await new_session(client)
    answer = await client.post(path.format(evaluation_id="e", session_id=identity), json=body)
    assert answer.is_success, answer.text
    assert str(answer.status_code) in operation["responses"]


@pytest.mark.parametrize(("path", "method", "operation"), OPERATIONS)
async def test_answers_have_the_documented_shape(
    client: httpx.AsyncClient, path: str, method: str, operation: Json, monkeypatch: pytest.MonkeyPatch
) -> None:
    if path.endswith("/events/stream"):
        return  # it has no end; see test_sse
    identity = await new_session(client)
    body = None
    if method in WITH_BODY:
        body = next(iter(operation["requestBody"]["content"]["application/json"]["examples"].values()))[
            "value"
        ]
    parts = {"session_id": identity, "tick": 2}
    if "{evaluation_id}" in path:
        parts["evaluation_id"] = (await client.post("/api/v1/evaluations", json={"runs": 1})).json()["id"]
    if "{answer_id}" in path:
        monkeypatch.setattr("service.http.prefer.LONG_UNITS", 0)
        parts["answer_id"] = await long_answer(client, identity)
    answer = await client.request(method, path.format(**parts), json=body)
    assert str(answer.status_code) in operation["responses"]
    assert answer.is_success
    documented = operation["responses"][str(answer.status_code)].get("content", {})
    if answer.content:
        assert answer.headers["content-type"].partition(";")[0] in documented
    if answer.headers.get("content-type") == "application/json":
        schema = documented["application/json"]["schema"]
        assert "$ref" in schema
        validator(schema).validate(answer.json())


async def long_answer(client: httpx.AsyncClient, session: str) -> str:
    """One that is there, since judging a moment takes no waiting."""
    path = f"/api/v1/sessions/{session}/regret?limit=1"
    told = (await client.get(path, headers={"Prefer": "respond-async"})).json()
    while told["state"] == "running":
        told = (await client.get(told["links"]["self"])).json()
        await asyncio.sleep(0)
    return str(told["id"])


@pytest.mark.parametrize("path", POSTS)
async def test_unknown_keys_are_refused_everywhere(client: httpx.AsyncClient, path: str) -> None:
    identity = await new_session(client)
    operation = DOCUMENT["paths"][path]["post"]
    for example in operation["requestBody"]["content"]["application/json"]["examples"].values():
        body = {**example["value"], "surprise": 1}
        answer = await client.post(
            path.format(answer_id="e", evaluation_id="e", session_id=identity), json=body
        )
        assert answer.status_code == 422
        assert answer.json()["errors"] == [{"field": "surprise", "message": "is not a known key"}]


@pytest.mark.parametrize("path", [path for path in DOCUMENT["paths"] if "{session_id}" in path])
async def test_an_unknown_session_is_unknown_everywhere(client: httpx.AsyncClient, path: str) -> None:
    for method, operation in DOCUMENT["paths"][path].items():
        body = None
        if method in WITH_BODY:
            body = next(iter(operation["requestBody"]["content"]["application/json"]["examples"].values()))[
                "value"
            ]
        answer = await client.request(
            method, path.format(answer_id="e", evaluation_id="e", session_id="nobody", tick=1), json=body
        )
        assert (answer.status_code, answer.json()["type"]) == (404, "/problems/unknown-session")
        assert answer.headers["content-type"] == "application/problem+json"


# Anything at all

SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**70), 2**70),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=40),
    st.sampled_from(["pothole", "av", "all", "left", "highway", "priority", "forward", "add five potholes"]),
)
KEYS = st.one_of(
    st.sampled_from(
        sorted(
            {
                key
                for model in (
                    bodies.NewSession,
                    bodies.Said,
                    bodies.TypedActions,
                    bodies.Recording,
                    bodies.AdviceQuestion,
                )
                for key in model.model_fields
            }
            | {
                "do",
                "kind",
                "count",
                "where",
                "cell",
                "lane",
                "row",
                "side",
                "distance_m",
                "ticks",
                "question",
            }
            | {
                "about",
                "move",
                "mode",
                "rows",
                "columns",
                "seed",
                "change",
                "meaning",
                "phrase",
                "id",
                "value",
            }
        )
    ),
    st.text(max_size=10),
)
ANYTHING = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=5),
    max_leaves=12,
)
VERBS = [
    "add", "remove", "set_count", "scenario", "reset", "mode", "drive", "set", "adjust", "prefer", "pause",
    "resume", "undo", "redo", "step", "rewind", "show", "ask", "evaluate", "teach", "load",
]  # fmt: skip
WHERE = st.fixed_dictionaries(
    {},
    optional={
        "lane": st.sampled_from(["left", "middle", "right", 1, 8, 9, 0]),
        "row": st.integers(-1, 31),
        "cell": st.tuples(st.integers(-1, 9), st.integers(-1, 31)),
        "side": st.sampled_from(["ahead", "behind", "left", "right"]),
        "distance_m": st.floats(-1, 1e6),
        "cells": st.integers(0, 40),
        "nearest": st.just(True),
        "id": st.sampled_from(["pothole-1", "vehicle-2", "av-1", "ghost"]),
    },
)
ACTIONS = st.fixed_dictionaries(
    {"do": st.sampled_from(VERBS)},
    optional={
        "kind": st.sampled_from(["pothole", "vehicle", "barrier", "pedestrian", "av", "everything"]),
        "count": st.one_of(st.integers(-1, 250), st.just("all")),
        "where": WHERE,
        "ticks": st.integers(0, 40),
        "move": st.sampled_from(["forward", "left", "stay", "up"]),
        "mode": st.sampled_from(["auto", "manual"]),
        "about": st.sampled_from(["why", "why_not", "status", "help", "scene"]),
        "tick": st.integers(-1, 60),
        "road": st.sampled_from(["highway", "city", "rural"]),
        "potholes": st.integers(0, 300),
        "avs": st.integers(0, 3),
    },
)
FUZZ = settings(max_examples=120, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def assert_in_contract(path: str, answer: httpx.Response) -> None:
    responses = DOCUMENT["paths"][path]["post"]["responses"]
    assert answer.status_code < 500, answer.text
    assert str(answer.status_code) in responses, (answer.status_code, answer.text)
    if not answer.is_success:
        assert answer.headers["content-type"] == "application/problem+json"
        PROBLEM.validate(answer.json())
        assert answer.json()["detail"]
        assert answer.json()["status"] == answer.status_code


async def post(path: str, content: bytes) -> None:
    transport = httpx.ASGITransport(APP, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        identity = await new_session(client)
        target = f"/api/v1/sessions/{identity}"
        before = (await client.get(f"{target}/state")).json()
        headers = {"content-type": "application/json"}
        answer = await client.post(
            path.format(answer_id="e", evaluation_id="e", session_id=identity),
            content=content,
            headers=headers,
        )
        assert_in_contract(path, answer)
        if not answer.is_success:
            assert (await client.get(f"{target}/state")).json() == before
        elif answer.status_code == 201:
            await client.delete(answer.headers["location"])
        await client.delete(target)


@pytest.mark.parametrize("path", POSTS)
def test_any_json_is_answered_and_a_refusal_changes_nothing(path: str) -> None:
    @FUZZ
    @given(body=st.one_of(st.dictionaries(KEYS, ANYTHING, max_size=4), ANYTHING))
    def anything(body: Any) -> None:
        asyncio.run(post(path, json.dumps(body).encode()))

    anything()


def test_any_actions_are_done_or_refused() -> None:
    path = "/api/v1/sessions/{session_id}/actions"

    @FUZZ
    @given(actions=st.lists(ACTIONS, max_size=4))
    def actions(actions: list[Json]) -> None:
        fitting = [
            {key: value for key, value in action.items() if _belongs(action["do"], key)} for action in actions
        ]
        asyncio.run(post(path, json.dumps({"actions": fitting}).encode()))

    actions()


def _belongs(verb: str, key: str) -> bool:
    """Whether the contract gives this verb this key, so that most of what is tried gets past its shape."""
    keys = {
        "add": "kind count where", "remove": "kind count where", "set_count": "kind count", "step": "ticks",
        "rewind": "ticks", "drive": "move", "mode": "mode", "ask": "about move tick",
        "scenario": "road potholes avs",
    }  # fmt: skip
    return key == "do" or key in keys.get(verb, "").split()


@FUZZ
@given(body=st.binary(max_size=200))
def test_any_bytes_are_answered(body: bytes) -> None:
    asyncio.run(post("/api/v1/parse", body))


def test_problem_types_are_written_alike() -> None:
    for kind in problems.KINDS:
        assert re.fullmatch(r"[a-z]+(-[a-z]+)*", kind.slug)
        assert 400 <= kind.status < 600
