"""What holds for every call that may change something, taken from the document and not from a list.

Keys do once, tags hold back what is stale, what is too large, of another kind or by another method is
refused with nothing changed; and a header that a call does not heed is said not to be heeded.
"""

from __future__ import annotations

import json
from collections.abc import AsyncIterator
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.contract.document import document
from tests.support.fakes import HandClock

Json = dict[str, Any]
MOST_BYTES = 65_536


def service(**settings: Any) -> Any:
    made = Settings(database="memory:", max_recording_bytes=MOST_BYTES, **settings)
    return create_app(made, store=MemoryStore(), clock=HandClock())


APP = service()
DOCUMENT = document()
METHODS = ("get", "put", "post", "patch", "delete")
CHANGING = [
    pytest.param(method, path, operation, id=f"{method} {path}")
    for path, item in DOCUMENT["paths"].items()
    for method, operation in item.items()
    if method != "get"
]
WITH_BODY = [each for each in CHANGING if "requestBody" in each.values[2]]


def headers_of(operation: Json) -> set[str]:
    return {each["name"] for each in operation.get("parameters", []) if each["in"] == "header"}


KEYED = [each for each in CHANGING if "Idempotency-Key" in headers_of(each.values[2])]
TAGGED = [each for each in CHANGING if "If-Match" in headers_of(each.values[2])]
MAKING = [each for each in CHANGING if "201" in each.values[2]["responses"]]


def body_of(operation: Json) -> Json | None:
    """The first example, and nothing for a call without a body."""
    if "requestBody" not in operation:
        return None
    examples = operation["requestBody"]["content"]["application/json"]["examples"]
    value: Json = next(iter(examples.values()))["value"]
    return value


def schema_of(operation: Json) -> str:
    """The name of what a call is sent, where it has one."""
    schema = operation["requestBody"]["content"]["application/json"]["schema"]
    return str(schema.get("$ref", "")).rsplit("/", 1)[-1]


@pytest.fixture
async def client() -> AsyncIterator[httpx.AsyncClient]:
    async with httpx.AsyncClient(transport=httpx.ASGITransport(APP), base_url="http://localhost") as client:
        yield client


async def new_session(client: httpx.AsyncClient) -> str:
    made = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    identity = str(made.json()["id"])
    await client.post(f"/api/v1/sessions/{identity}/step", json={"ticks": 5})
    return identity


async def standing(client: httpx.AsyncClient, identity: str) -> tuple[Json, int]:
    """All that a call could change: the session, and how many there are."""
    state = (await client.get(f"/api/v1/sessions/{identity}/state")).json()
    listed = (await client.get("/api/v1/sessions", params={"limit": 200})).json()
    return state, len(listed["items"])


@pytest.fixture(autouse=True)
async def few_sessions() -> AsyncIterator[None]:
    yield
    async with httpx.AsyncClient(transport=httpx.ASGITransport(APP), base_url="http://localhost") as client:
        for each in (await client.get("/api/v1/sessions", params={"limit": 200})).json()["items"]:
            await client.delete(each["links"]["self"])


def problem(answer: httpx.Response, status: int, slug: str) -> Json:
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")
    document: Json = answer.json()
    assert document["type"] == f"/problems/{slug}", document
    assert document["detail"]
    return document


def test_there_is_enough_to_check() -> None:
    assert len(CHANGING) > 10
    assert len(KEYED) > 6
    assert len(TAGGED) > 6
    assert len(MAKING) == 2


@pytest.mark.parametrize(("method", "path", "operation"), CHANGING)
def test_a_header_is_heeded_or_said_not_to_be(method: str, path: str, operation: Json) -> None:
    for name in ("Idempotency-Key", "If-Match"):
        heeded = name in headers_of(operation)
        assert heeded != (f"`{name}` is not looked at" in operation["description"]), (method, path, name)


@pytest.mark.parametrize(("method", "path", "operation"), KEYED)
async def test_the_same_key_is_the_same_answer_and_done_once(
    client: httpx.AsyncClient, method: str, path: str, operation: Json
) -> None:
    identity = await new_session(client)
    target, headers = (
        path.format(answer_id="e", evaluation_id="e", session_id=identity),
        {"Idempotency-Key": f"{method}{path}{identity}"},
    )
    first = await client.request(method, target, json=body_of(operation), headers=headers)
    assert first.is_success, first.text
    after = await standing(client, identity)
    again = await client.request(method, target, json=body_of(operation), headers=headers)
    assert (again.status_code, again.content) == (first.status_code, first.content)
    assert again.headers["idempotency-replayed"] == "true"
    assert "idempotency-replayed" not in first.headers
    for name in ("etag", "location"):
        assert again.headers.get(name) == first.headers.get(name)
    assert await standing(client, identity) == after


@pytest.mark.parametrize(("method", "path", "operation"), KEYED)
async def test_a_key_is_one_requests_own(
    client: httpx.AsyncClient, method: str, path: str, operation: Json
) -> None:
    identity = await new_session(client)
    target, headers = (
        path.format(answer_id="e", evaluation_id="e", session_id=identity),
        {"Idempotency-Key": f"own{method}{path}{identity}"},
    )
    await client.request(method, target, json=body_of(operation), headers=headers)
    before = await standing(client, identity)
    other = {**(body_of(operation) or {}), "surprise": 1}
    problem(await client.request(method, target, json=other, headers=headers), 422, "key-reused")
    elsewhere = "/api/v1/sessions" if "{session_id}" in path else f"/api/v1/sessions/{identity}/step"
    problem(await client.post(elsewhere, json={}, headers=headers), 422, "key-reused")
    assert await standing(client, identity) == before


@pytest.mark.parametrize(("method", "path", "operation"), KEYED)
@pytest.mark.parametrize("key", ["", "with space", "x" * 256])
async def test_what_is_no_key_is_refused(
    client: httpx.AsyncClient, method: str, path: str, operation: Json, key: str
) -> None:
    target = path.format(answer_id="e", evaluation_id="e", session_id=await new_session(client))
    headers = {"Idempotency-Key": key}
    refused = await client.request(method, target, json=body_of(operation), headers=headers)
    assert problem(refused, 422, "invalid")["errors"][0]["field"] == "Idempotency-Key"


@pytest.mark.parametrize(("method", "path", "operation"), TAGGED)
async def test_a_stale_tag_holds_back_everything(
    client: httpx.AsyncClient, method: str, path: str, operation: Json
) -> None:
    identity = await new_session(client)
    target, before = (
        path.format(answer_id="e", evaluation_id="e", session_id=identity),
        await standing(client, identity),
    )
    for stale in ('"0"', '"99"', 'W/"1"', '"another"'):
        headers = {"If-Match": stale}
        refused = await client.request(method, target, json=body_of(operation), headers=headers)
        assert problem(refused, 412, "stale")["sequence"] == 1
        assert refused.headers["etag"] == '"1"'
    assert await standing(client, identity) == before
    headers = {"If-Match": refused.headers["etag"]}
    meant = await client.request(method, target, json=body_of(operation), headers=headers)
    assert meant.is_success, meant.text


@pytest.mark.parametrize(("method", "path", "operation"), TAGGED)
async def test_what_is_wrong_by_its_form_is_told_before_what_is_stale(
    client: httpx.AsyncClient, method: str, path: str, operation: Json
) -> None:
    identity = await new_session(client)
    target, stale = path.format(answer_id="e", evaluation_id="e", session_id=identity), {"If-Match": '"99"'}
    before = await standing(client, identity)
    if "requestBody" in operation:
        bad = {**(body_of(operation) or {}), "surprise": 1}
        if path.endswith("/config"):  # a merge patch is any object; what it may hold the session says
            bad = [1]  # type: ignore[assignment]
        problem(await client.request(method, target, json=bad, headers=stale), 422, "invalid")
        if "language" in str(DOCUMENT["components"]["schemas"].get(schema_of(operation), "")):
            klingon = {**(body_of(operation) or {}), "language": "tlh"}
            problem(await client.request(method, target, json=klingon, headers=stale), 422, "invalid")
        json_type = {"content-type": "application/json"}
        broken = await client.request(method, target, content=b"{", headers=stale | json_type)
        problem(broken, 400, "malformed")
    no_tag = {"If-Match": "1"}
    refused = await client.request(method, target, json=body_of(operation), headers=no_tag)
    assert problem(refused, 422, "invalid")["errors"][0]["field"] == "If-Match"
    nobody = path.format(answer_id="e", evaluation_id="e", session_id="nobody")
    gone = await client.request(method, nobody, json=body_of(operation), headers=stale)
    problem(gone, 404, "unknown-session")
    assert await standing(client, identity) == before


@pytest.mark.parametrize(("method", "path", "operation"), WITH_BODY)
async def test_a_body_that_is_too_large_or_of_another_kind_is_refused(
    client: httpx.AsyncClient, method: str, path: str, operation: Json
) -> None:
    identity = await new_session(client)
    target, before = (
        path.format(answer_id="e", evaluation_id="e", session_id=identity),
        await standing(client, identity),
    )
    whole = json.dumps(body_of(operation)).encode()
    for kind in (
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data",
        "application/xml",
        "",
    ):
        refused = await client.request(method, target, content=whole, headers={"content-type": kind})
        problem(refused, 415, "not-json")
    large = whole + b" " * MOST_BYTES
    for said in ({}, {"transfer-encoding": "chunked"}):
        headers = {"content-type": "application/json", **said}
        refused = await client.request(method, target, content=large, headers=headers)
        problem(refused, 413, "too-large")
    assert await standing(client, identity) == before


@pytest.mark.parametrize("path", DOCUMENT["paths"])
async def test_another_method_is_refused_with_those_there_are(client: httpx.AsyncClient, path: str) -> None:
    identity = await new_session(client)
    target, before = (
        path.format(answer_id="e", evaluation_id="e", session_id=identity, tick=1),
        await standing(client, identity),
    )
    for method in METHODS:
        if method in DOCUMENT["paths"][path]:
            continue
        refused = await client.request(method, target, json={})
        problem(refused, 405, "method-not-allowed")
        allowed = {each.strip().lower() for each in refused.headers["allow"].split(",")}
        implied = {"options"} | ({"head"} if "get" in DOCUMENT["paths"][path] else set())
        assert allowed == implied | set(DOCUMENT["paths"][path]), (method, path)
    assert await standing(client, identity) == before


@pytest.mark.parametrize(("method", "path", "operation"), MAKING)
async def test_nobody_makes_more_than_the_quota(method: str, path: str, operation: Json) -> None:
    app = service(max_client_sessions=1)
    async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://localhost") as client:
        identity = await new_session(client)
        before = await standing(client, identity)
        target = path.format(answer_id="e", evaluation_id="e", session_id=identity)
        problem(await client.request(method, target, json=body_of(operation)), 429, "over-quota")
        assert await standing(client, identity) == before
        assert "429" in operation["responses"]


async def test_a_session_names_every_part_of_it(client: httpx.AsyncClient) -> None:
    identity = await new_session(client)
    links = (await client.get(f"/api/v1/sessions/{identity}")).json()["links"]
    own = f"/api/v1/sessions/{identity}"
    parts = {
        path.format(answer_id="e", evaluation_id="e", session_id=identity)
        for path in DOCUMENT["paths"]
        if "{session_id}" in path and "{tick}" not in path and "{answer_id}" not in path
    }
    assert parts | {f"{own}/stream", f"/#/s/{identity}"} == set(links.values())


def test_links_of_the_document_lead_somewhere() -> None:
    operations = {
        operation["operationId"]: operation
        for item in DOCUMENT["paths"].values()
        for operation in item.values()
    }
    found = 0
    for operation in operations.values():
        for response in operation["responses"].values():
            for link in response.get("links", {}).values():
                target = operations[link["operationId"]]
                names = {each["name"] for each in target.get("parameters", [])}
                assert set(link.get("parameters", {})) <= names
                required = {each["name"] for each in target.get("parameters", []) if each["required"]}
                assert required - {"tick"} <= set(link.get("parameters", {}))
                found += 1
    assert found > 40


@pytest.mark.parametrize("name", ["read_regret", "read_video"])
def test_a_long_answer_is_linked_from_the_call_that_makes_it(name: str) -> None:
    operations = [each for item in DOCUMENT["paths"].values() for each in item.values()]
    making = next(each for each in operations if each["operationId"] == name)
    links = making["responses"]["202"]["links"]
    assert set(links) == {"read_long_answer", "read_long_answer_result", "delete_long_answer"}
