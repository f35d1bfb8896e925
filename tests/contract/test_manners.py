"""Manners of HTTP that every call has: HEAD as GET, OPTIONS and 405 with Allow, no question passed over."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.contract.document import Json, asked, document, operations
from tests.support.live_server import running

APP = asked()
DOCUMENT = document()
OPERATIONS = operations(DOCUMENT)
ENDLESS = "/api/v1/sessions/{session_id}/events/stream"
READING = [each for each in OPERATIONS if each.values[1] == "get"]
SECOND = re.compile(r"\d{8}T\d{6}Z")
"""In the name of a backup."""
PAGES = ("/", "/embed", "/docs", "/docs/start.js", "/openapi.json", "/favicon.svg", "/src/main.js")


@pytest.fixture
async def client() -> AsyncIterator[httpx.AsyncClient]:
    transport = httpx.ASGITransport(APP, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        yield client


@pytest.fixture
async def identity(client: httpx.AsyncClient) -> str:
    answer = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    found = str(answer.json()["id"])
    await client.post(f"/api/v1/sessions/{found}/step", json={"ticks": 5})
    return found


def example(operation: Json) -> Json:
    """What is to be sent."""
    if "requestBody" not in operation:
        return {}
    examples = operation["requestBody"]["content"]["application/json"]["examples"]
    return {"json": next(iter(examples.values()))["value"]}


def told(answer: httpx.Response) -> dict[str, str]:
    """The headers, without what tells one answer, or its second, from the next."""
    own = ("x-request-id", "date")
    return {name: SECOND.sub("", value) for name, value in answer.headers.items() if name not in own}


@pytest.mark.parametrize(("path", "method", "operation"), READING)
async def test_head_is_get_without_the_body(
    client: httpx.AsyncClient, identity: str, path: str, method: str, operation: Json
) -> None:
    if path == ENDLESS:
        return  # below
    assert (method, bool(operation)) == ("get", True)
    address = path.format(answer_id="e", evaluation_id="e", session_id=identity, tick=2)
    got, head = await client.get(address), await client.head(address)
    assert (head.status_code, head.content) == (got.status_code, b"")
    if path not in ("/metrics", "/healthz"):  # which tell of what was just asked
        assert told(head) == told(got)


@pytest.mark.parametrize("path", [*PAGES, "/api/v1/sessions/nobody", "/nowhere"])
async def test_head_of_pages_and_of_what_is_not_there(client: httpx.AsyncClient, path: str) -> None:
    got, head = await client.get(path), await client.head(path)
    assert (head.status_code, head.content, told(head)) == (got.status_code, b"", told(got))


async def test_head_of_what_has_no_end_ends() -> None:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore())
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        made = await client.post("/api/v1/sessions", json={"seed": 7})
        path = f"{made.headers['location']}/events/stream"
        head = await asyncio.wait_for(client.head(path), 60)
        assert (head.status_code, head.content) == (200, b"")
        assert head.headers["content-type"].startswith("text/event-stream")
        # The same connection serves what comes next, and nobody was left behind.
        assert (await client.get("/healthz")).json()["watchers"] == 0


async def test_head_is_refused_as_get_is(client: httpx.AsyncClient, identity: str) -> None:
    answer = await client.head(f"/api/v1/sessions/{identity}/state?tick=99")
    assert (answer.status_code, answer.content) == (422, b"")
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("path", list(DOCUMENT["paths"]))
async def test_options_and_wrong_methods_tell_what_is_allowed(
    client: httpx.AsyncClient, identity: str, path: str
) -> None:
    address = path.format(answer_id="e", evaluation_id="e", session_id=identity, tick=2)
    methods = {method.upper() for method in DOCUMENT["paths"][path]} | {"OPTIONS"}
    methods |= {"HEAD"} if "GET" in methods else set()
    options = await client.options(address)
    assert (options.status_code, options.content) == (204, b"")
    wrong = await client.put(address, json={})
    assert wrong.status_code == 405
    for answer in (options, wrong):
        assert set(answer.headers["allow"].split(", ")) == methods


async def test_options_of_what_is_not_there(client: httpx.AsyncClient) -> None:
    answer = await client.options("/nowhere")
    assert (answer.status_code, answer.json()["type"]) == (404, "/problems/not-found")


@pytest.mark.parametrize(
    ("path", "method", "operation"), [each for each in OPERATIONS if each.values[0].startswith("/api/")]
)
async def test_a_parameter_that_a_call_does_not_have_is_refused(
    client: httpx.AsyncClient, identity: str, path: str, method: str, operation: Json
) -> None:
    address = path.format(answer_id="e", evaluation_id="e", session_id=identity, tick=2)
    before = (await client.get(f"/api/v1/sessions/{identity}/state")).content
    answer = await client.request(method, address, params={"surprise": "1"}, **example(operation))
    assert (answer.status_code, answer.json()["type"]) == (422, "/problems/invalid")
    assert answer.headers["content-type"] == "application/problem+json"
    assert [error["field"] for error in answer.json()["errors"]] == ["surprise"]
    assert "invalid" in operation["responses"]["422"]["content"]["application/problem+json"]["examples"]
    assert (await client.get(f"/api/v1/sessions/{identity}/state")).content == before


@pytest.mark.parametrize(("path", "method", "operation"), OPERATIONS)
async def test_every_parameter_of_the_document_is_known_and_a_slip_is_told(
    client: httpx.AsyncClient, identity: str, path: str, method: str, operation: Json
) -> None:
    address = path.format(answer_id="e", evaluation_id="e", session_id=identity, tick=2)
    for parameter in operation.get("parameters", []):
        if parameter["in"] != "query":
            continue
        name = parameter["name"]
        slip = f"{name}x"
        answer = await client.request(method, address, params={slip: "1"}, **example(operation))
        assert answer.json()["errors"][0]["field"] == slip
        assert answer.json()["errors"][0]["message"].endswith(f"did you mean {name}")
        if path != ENDLESS:
            known = await client.request(method, address, params={name: "1"}, **example(operation))
            assert "known here" not in known.text


async def test_what_is_said_of_parameters_that_are_not_known(
    client: httpx.AsyncClient, identity: str
) -> None:
    own = f"/api/v1/sessions/{identity}"
    state = (await client.get(f"{own}/state?tik=5")).json()
    assert state["detail"] == "Of the parameters in the URL: tik is not known here; did you mean tick."
    twice = (await client.get(f"{own}/state?tick=1&tick=2")).json()
    assert twice["errors"] == [{"field": "tick", "message": "is there more than once"}]
    none = (await client.get(f"{own}?tick=5")).json()
    assert none["errors"][0]["message"] == "is not known here, where there are none"
    nameless = (await client.get(f"{own}/decisions?=5")).json()
    assert nameless["detail"] == (
        "Of the parameters in the URL: a nameless one is not known here, where there are after, limit."
    )
    many = (await client.get(f"{own}?" + "&".join(f"{'x' * 500}{n}" for n in range(50)))).json()
    assert len(str(many)) < 2_000


async def test_the_page_its_files_and_the_signs_of_life_take_what_comes(client: httpx.AsyncClient) -> None:
    for path in (*PAGES, "/healthz", "/readyz", "/metrics"):
        assert (await client.get(f"{path}?surprise=1")).status_code == 200, path


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("/api/v1/sessions/", "Did you mean /api/v1/sessions?"),
        ("/api/v1/session", "Did you mean /api/v1/sessions?"),
        ("/sessions", "Did you mean /api/v1/sessions?"),
        ("/health", "Did you mean /healthz?"),
        ("/api/v1/sessions/abc/stat", "Did you mean /api/v1/sessions/abc/state?"),
        ("/sessions/abc", "Did you mean /api/v1/sessions/abc?"),
        (
            "/api/v1/sessions/abc/stream",
            "This is a WebSocket; by plain HTTP, the same can be read at …/events/stream.",
        ),
        ("/nowhere", "The calls there are stand at /docs."),
        (f"/api/v1/sessions/{'x' * 5_000}/stat", "The calls there are stand at /docs."),
    ],
)
async def test_a_slip_in_an_address_is_told(client: httpx.AsyncClient, asked: str, told: str) -> None:
    answer = await client.get(asked)
    assert answer.status_code == 404
    assert answer.json()["detail"] == f"There is nothing at GET {asked}. {told}"


@pytest.mark.parametrize(
    ("body", "kind", "status", "detail"),
    [
        (b"", "application/json", 422, "The body is missing; send a JSON object, {} at least."),
        (b'"pause"', "application/json", 422, "The body must be an object."),
        (
            b"{}",
            None,
            415,
            "Send the body as application/json, and say so in Content-Type. With curl: --json '{}'.",
        ),
        (
            b"{}",
            "text/plain; charset=utf-8",
            415,
            "Send the body as application/json, not as text/plain. With curl: --json '{}'.",
        ),
    ],
)
async def test_a_body_that_is_none_is_told_how_it_is_meant(
    client: httpx.AsyncClient, body: bytes, kind: str | None, status: int, detail: str
) -> None:
    headers = {} if kind is None else {"content-type": kind}
    answer = await client.post("/api/v1/sessions", content=body, headers=headers)
    assert (answer.status_code, answer.json()["detail"]) == (status, detail)


@pytest.mark.parametrize("tag", [b"*\xa0", b"\xa0*", b'"0"\xa0', b'"0"\x85', b'"0",\xa0"1"'])
async def test_white_space_is_what_http_says_it_is(
    client: httpx.AsyncClient, identity: str, tag: bytes
) -> None:
    answer = await client.post(
        f"/api/v1/sessions/{identity}/actions",
        content=b'{"actions":[{"do":"pause"}]}',
        headers=[(b"content-type", b"application/json"), (b"if-match", tag)],
    )
    assert (answer.status_code, answer.json()["errors"][0]["field"]) == (422, "If-Match")


@pytest.mark.parametrize("number", ["1.0", "1_0", "+1", "%201", "1e0", "0x1", "\u0663", "", "true"])
@pytest.mark.parametrize(
    "part", ["state?tick=", "decisions?after=", "decisions?limit=", "film?from=", "decisions/"]
)
async def test_a_whole_number_is_written_as_one(
    client: httpx.AsyncClient, identity: str, part: str, number: str
) -> None:
    answer = await client.get(f"/api/v1/sessions/{identity}/{part}{number}")
    if part == "decisions/" and number == "":
        assert answer.status_code == 404
        return
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["field"] in part or (part, error["field"]) == ("decisions/", "tick")
    assert error["message"] == "must be a whole number"


@pytest.mark.parametrize("path", ["/api/v1/sessions", "/api/v1/saved"])
async def test_a_cursor_that_is_none_is_told_what_it_is(client: httpx.AsyncClient, path: str) -> None:
    answer = await client.get(f"{path}?after=x")
    assert answer.json()["detail"] == "after: must be `after` of the page before."
