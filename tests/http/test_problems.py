"""Every way to go wrong answers one shape, and none tells of the inside."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from service import problems
from service.app import create_app
from service.settings import Settings
from service.store import EntryRecord, MemoryStore, SessionRecord, StoreError
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

JSON = {"content-type": "application/json"}
SESSIONS = "/api/v1/sessions"


def assert_problem(answer: httpx.Response, status: int, slug: str) -> dict[str, Any]:
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    document: dict[str, Any] = answer.json()
    assert document["type"] == f"/problems/{slug}"
    assert document["status"] == status
    assert document["title"]
    assert document["detail"]
    assert isinstance(document["errors"], list)
    return document


@pytest.mark.parametrize(
    ("method", "path", "content", "headers", "status", "slug"),
    [
        ("GET", "/nowhere", None, {}, 404, "not-found"),
        ("POST", "/nowhere", b"{}", JSON, 404, "not-found"),
        ("GET", "/api/v1/nowhere", None, {}, 404, "not-found"),
        ("GET", "/api/v1/sessions/", None, {}, 404, "not-found"),
        ("GET", "/src/nowhere.js", None, {}, 404, "not-found"),
        ("GET", "/src/..%2f..%2fpyproject.toml", None, {}, 404, "not-found"),
        ("GET", f"{SESSIONS}/%00%ff", None, {}, 404, "unknown-session"),
        ("GET", f"{SESSIONS}/{'x' * 5_000}", None, {}, 404, "unknown-session"),
        ("PUT", SESSIONS, b"{}", JSON, 405, "method-not-allowed"),
        ("DELETE", "/healthz", None, {}, 405, "method-not-allowed"),
        ("POST", SESSIONS, b"{", JSON, 400, "malformed"),
        ("POST", SESSIONS, b'{"seed": NaN}', JSON, 400, "malformed"),
        ("POST", SESSIONS, b'{"name": "\\ud800"}', JSON, 400, "malformed"),
        ("POST", SESSIONS, b"\xff\xfe", JSON, 400, "malformed"),
        ("POST", SESSIONS, b"[" * 50_000, JSON, 400, "malformed"),
        ("POST", SESSIONS, b"", JSON, 422, "invalid"),
        ("POST", SESSIONS, b"[]", JSON, 422, "invalid"),
        ("POST", SESSIONS, b'{"seed": 1e400}', JSON, 400, "malformed"),
        ("POST", SESSIONS, b'{"seed": 123456789012345678901234567890}', JSON, 422, "invalid"),
        ("POST", SESSIONS, b"{}", {}, 415, "not-json"),
        ("POST", SESSIONS, b"a=1", {"content-type": "application/x-www-form-urlencoded"}, 415, "not-json"),
        ("GET", f"{SESSIONS}?limit=0", None, {}, 422, "invalid"),
        ("GET", f"{SESSIONS}?after=x", None, {}, 422, "invalid"),
    ],
)
async def test_each_producer(
    service: Service,
    method: str,
    path: str,
    content: bytes | None,
    headers: dict[str, str],
    status: int,
    slug: str,
) -> None:
    answer = await service.client.request(method, path, content=content, headers=headers)
    document = assert_problem(answer, status, slug)
    if status == 405:
        assert answer.headers["allow"] == f"GET, HEAD, OPTIONS{', POST' if path == SESSIONS else ''}"
    if status == 422:
        assert document["errors"]


class Broken(MemoryStore):
    """A store that fails while it is used."""

    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.error = error

    async def create(self, record: SessionRecord, entries: Any = ()) -> SessionRecord:
        if record.name == "unlucky":
            raise self.error
        return await super().create(record, entries)

    async def newest(self, limit: int, before: int | None = None) -> Any:
        if limit:
            raise self.error
        return await super().newest(limit, before)

    async def append(self, session_id: str, entry: EntryRecord) -> None:  # noqa: ARG002 - it fails for all
        raise self.error


async def broken_client(error: Exception) -> httpx.AsyncClient:
    app = create_app(
        Settings(database="memory:"), store=Broken(error), language=FewSentences(), clock=HandClock()
    )
    transport = httpx.ASGITransport(app, raise_app_exceptions=False)
    return httpx.AsyncClient(transport=transport, base_url="http://service")


async def test_a_failing_store_is_told_and_nothing_is_changed() -> None:
    async with await broken_client(StoreError("disk full at /secret/place")) as client:
        path = (await client.post(SESSIONS, json={})).headers["location"]
        before = (await client.get(f"{path}/state")).json()
        for answer in (
            await client.post(f"{path}/commands", json={"text": "add five potholes"}),
            await client.post(SESSIONS, json={"name": "unlucky"}),
            await client.get(SESSIONS),
            await client.get("/readyz"),
        ):
            assert_problem(answer, 503, "not-saved")
            assert "secret" not in answer.text
        assert (await client.get(f"{path}/state")).json() == before
        assert (await client.get("/healthz")).status_code == 200


async def test_a_defect_says_nothing_of_the_inside() -> None:
    async with await broken_client(ZeroDivisionError("secret")) as client:
        answer = await client.get(SESSIONS)
        assert_problem(answer, 500, "internal")
        assert "secret" not in answer.text
        assert "ZeroDivision" not in answer.text
        assert answer.headers["x-content-type-options"] == "nosniff"


def test_the_tree_in_the_docstring_is_the_tree() -> None:
    drawn = [line.split("──")[1].split()[0] for line in (problems.__doc__ or "").splitlines() if "──" in line]
    assert drawn == [kind.__name__ for kind in problems.KINDS]
    assert len({kind.slug for kind in problems.KINDS}) == len(problems.KINDS)
    for kind in problems.KINDS:
        line = next(
            each for each in (problems.__doc__ or "").splitlines() if f"── {kind.__name__} " in f"{each} "
        )
        own_status = "status" in vars(kind)
        assert (str(kind.status) in line) == own_status or kind is problems.Internal


async def test_a_list_that_is_too_short_inside_a_list_is_named_by_its_place() -> None:
    action = {"do": "ask", "about": "what_if", "change": []}
    app = create_app(
        Settings(database="memory:"), store=MemoryStore(), language=FewSentences(), clock=HandClock()
    )
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        location = (await client.post("/api/v1/sessions", json={"seed": 1})).headers["location"]
        answer = await client.post(f"{location}/actions", json={"actions": [action]})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["field"].startswith("actions.0")
