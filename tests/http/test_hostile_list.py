"""The hostile list: what strangers try by HTTP, and what each of them is told. None gets anything.

`python -m tests.http.test_hostile_list` prints it.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import httpx
import pytest

from service.app import create_app
from service.http.protocol import MAX_HEADER_BYTES
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running
from tests.support.strangers import BEARER, KEY, SESSIONS, asked

HEADERS = ("content-security-policy", "x-content-type-options", "referrer-policy", "x-request-id")


@dataclass(frozen=True)
class Attempt:
    """One attempt, and the status and problem it gets; `{id}` is a session's."""

    name: str
    method: str
    path: str
    told: tuple[int, str]
    headers: dict[str, str] = field(default_factory=lambda: dict(BEARER))
    body: object = None

    def __str__(self) -> str:
        return self.name


ADD = {"text": "add two cars"}
TRAVERSALS = (
    ("dots", "/src/../../pyproject.toml"),
    ("encoded dots", "/src/%2e%2e/%2e%2e/pyproject.toml"),
    ("encoded slashes", "/src/..%2f..%2fpyproject.toml"),
    ("twice encoded", "/src/%252e%252e/%252e%252e/pyproject.toml"),
    ("backslashes", "/src/..%5c..%5cpyproject.toml"),
    ("NUL", "/src/main.js%00.html"),
    ("a name too long", f"/src/{'a' * 300}.js"),
    ("an absolute path", "/src//etc/passwd"),
    ("overlong dots", "/src/%c0%ae%c0%ae/pyproject.toml"),
)
ATTEMPTS = (
    Attempt("no key", "GET", SESSIONS, (401, "key-needed"), {}),
    Attempt("wrong key", "GET", SESSIONS, (401, "key-needed"), {"Authorization": "Bearer no"}),
    Attempt("key in the URL", "GET", f"{SESSIONS}?key={KEY}", (401, "key-needed"), {}),
    Attempt("key in a cookie", "GET", SESSIONS, (401, "key-needed"), {"Cookie": f"key={KEY}"}),
    Attempt("key as basic", "GET", SESSIONS, (401, "key-needed"), {"Authorization": f"Basic {KEY}"}),
    Attempt("figures without a key", "GET", "/metrics", (401, "key-needed"), {}),
    Attempt("rebinding host", "GET", SESSIONS, (421, "foreign-host"), BEARER | {"Host": "evil.example"}),
    Attempt("rebinding host, page", "GET", "/", (421, "foreign-host"), {"Host": "evil.example"}),
    Attempt(
        "cross-site change",
        "POST",
        SESSIONS + "/{id}/commands",
        (403, "cross-site"),
        BEARER | {"Origin": "http://evil.example"},
        ADD,
    ),
    Attempt("sandboxed page", "POST", SESSIONS, (403, "cross-site"), BEARER | {"Origin": "null"}, {}),
    Attempt(
        "a cross-site picture",
        "GET",
        SESSIONS + "/{id}/frame",
        (403, "cross-site"),
        BEARER | {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors"},
    ),
    Attempt(
        "a long sentence to complete, from another port",
        "GET",
        "/api/v1/language?prefix=add%20two%20cars,%20I%20mean%20three",
        (403, "cross-site"),
        BEARER | {"Sec-Fetch-Site": "same-site"},
    ),
    Attempt(
        "a stream for another page",
        "GET",
        SESSIONS + "/{id}/events/stream",
        (403, "cross-site"),
        BEARER | {"Origin": "http://evil.example"},
    ),
    Attempt("a session guessed", "GET", f"{SESSIONS}/1/state", (404, "unknown-session")),
    Attempt("traversal in an id", "GET", f"{SESSIONS}/..%2f..%2fetc/state", (404, "not-found")),
    Attempt(
        "line feed in an id", "GET", f"{SESSIONS}/x%0d%0aSet-Cookie:%20a=b/state", (404, "unknown-session")
    ),
    Attempt("quotes in an id", "GET", f"{SESSIONS}/x'%20OR%20'1'='1/state", (404, "unknown-session")),
    Attempt(
        "SSRF by a field",
        "POST",
        SESSIONS + "/{id}/commands",
        (422, "invalid"),
        body={**ADD, "llm_base_url": "http://169.254.169.254/"},
    ),
    Attempt(
        "SSRF by a new session",
        "POST",
        SESSIONS,
        (422, "invalid"),
        body={"llm_base_url": "http://127.0.0.1/"},
    ),
    Attempt(
        "key of a request that is none",
        "POST",
        SESSIONS + "/{id}/commands",
        (422, "invalid"),
        BEARER | {"Idempotency-Key": "a b"},
        ADD,
    ),
    Attempt("a method that is none", "TRACE", SESSIONS, (405, "method-not-allowed")),
    *(Attempt(f"traversal by {name}", "GET", path, (404, "not-found")) for name, path in TRAVERSALS),
)


GET = b"GET /api/v1/sessions HTTP/1.1\r\nHost: 127.0.0.1\r\n"
POST = b"POST /api/v1/sessions HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
CHUNKS = b"2\r\n{}\r\n0\r\n\r\n"
RAW: dict[str, tuple[bytes, int]] = {
    "two lengths": (POST + b"Content-Length: 2\r\nContent-Length: 9\r\n\r\n{}", 400),
    "the same length twice": (POST + b"Content-Length: 2\r\nContent-Length: 2\r\n\r\n{}", 400),
    "a list of lengths": (POST + b"Content-Length: 2, 2\r\n\r\n{}", 400),
    "a length below nothing": (POST + b"Content-Length: -1\r\n\r\n{}", 400),
    "a length and chunks": (
        POST + b"Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n" + CHUNKS,
        400,
    ),
    "chunks and a length": (
        POST + b"Transfer-Encoding: chunked\r\nContent-Length: 2\r\n\r\n" + CHUNKS,
        400,
    ),
    "an encoding that is none": (POST + b"Transfer-Encoding: xchunked\r\n\r\n" + CHUNKS, 400),
    "chunks of no size": (POST + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n{}\r\n0\r\n\r\n", 400),
    "a space before a colon": (POST + b"Content-Length : 2\r\n\r\n{}", 400),
    "CR in a header": (POST + b"Idempotency-Key: a\rSet-Cookie: b\r\nContent-Length: 2\r\n\r\n{}", 400),
    "LF in a header": (GET + b"X-Request-ID: a\nSet-Cookie: b\r\n\r\n", 400),
    "NUL in a header": (GET + b"X-Request-ID: a\0b\r\n\r\n", 400),
    "a header on two lines": (GET + b"X-Request-ID: a\r\n b\r\n\r\n", 400),
    "two hosts": (GET + b"Host: evil.example\r\n\r\n", 400),
    "no host": (b"GET /api/v1/sessions HTTP/1.1\r\n\r\n", 400),
    "a long header": (GET + b"X: " + b"a" * MAX_HEADER_BYTES + b"\r\n\r\n", 431),
    "many headers": (GET + b"X-Header: 1\r\n" * 8_000 + b"\r\n", 431),
    "a long address": (b"GET /" + b"a" * MAX_HEADER_BYTES + b" HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", 431),
}
"""What only bytes on a line can try, and the status it gets."""


@dataclass(frozen=True)
class Told:
    """What came back on a line, to its end; a status of 0: it was cut without an answer."""

    status: int = 0
    headers: httpx.Headers = field(default_factory=httpx.Headers)
    body: bytes = b""


async def sent(port: int, content: bytes) -> Told:
    """Send bytes, more than one request it may be, and read until the service ends the line."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        writer.write(content)
        await writer.drain()
        answer = await asyncio.wait_for(reader.read(), 60)
    except ConnectionError:
        return Told()
    finally:
        writer.close()
        with suppress(ConnectionError):
            await writer.wait_closed()
    head, _, body = answer.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    return Told(int(lines[0].split()[1]), httpx.Headers([line.split(": ", 1) for line in lines[1:]]), body)


@pytest.fixture
async def live() -> AsyncIterator[Running]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as at:
        yield at


@pytest.mark.parametrize("name", RAW)
async def test_what_is_no_request_is_refused_and_the_line_ended(name: str, live: Running) -> None:
    """Also what follows it on the line, which another server before us may have taken for a request."""
    content, status = RAW[name]
    told = await sent(live.port, content + GET + b"\r\n")
    assert told.status == status
    assert told.headers["content-type"] == "application/problem+json"
    assert told.headers["x-content-type-options"] == "nosniff"
    assert "set-cookie" not in told.headers
    assert json.loads(told.body)["status"] == status  # one document, and nothing after it
    async with httpx.AsyncClient(base_url=live.http, timeout=60) as client:
        assert (await client.get(SESSIONS)).json()["items"] == []


async def test_a_head_that_never_ends_is_cut(live: Running) -> None:
    told = await sent(live.port, GET + b"X: " + b"a" * 5_000_000)
    assert told.status in (0, 431)
    async with httpx.AsyncClient(base_url=live.http, timeout=60) as client:
        assert (await client.get("/healthz")).status_code == 200


async def test_no_link_leads_out_of_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    web, outside = tmp_path / "web", tmp_path / "outside"
    (web / "src").mkdir(parents=True)
    outside.mkdir()
    (outside / "secret.js").write_text("secret")
    (web / "index.html").write_text("<p>the page</p>")
    (web / "src" / "own.js").write_text("own")
    (web / "src" / "again.js").symlink_to(web / "src" / "own.js")
    (web / "src" / "out.js").symlink_to(outside / "secret.js")
    (web / "src" / "folder").symlink_to(outside)
    (web / "out.js").symlink_to(outside / "secret.js")
    (web / "all").symlink_to(outside)
    monkeypatch.setattr("service.http.routes.pages.web_folder", lambda: web)
    async with asked() as client:
        for path, status in (
            ("/", 200),
            ("/src/own.js", 200),
            ("/src/again.js", 200),
            ("/src/out.js", 404),
            ("/src/folder/secret.js", 404),
            ("/out.js", 404),
            ("/all/secret.js", 404),
        ):
            answer = await client.get(path)
            assert answer.status_code == status, path
            assert "secret" not in answer.text.replace(path, "")


async def tried(client: httpx.AsyncClient, attempt: Attempt, session: str) -> httpx.Response:
    """One attempt."""
    return await client.request(
        attempt.method,
        attempt.path.replace("{id}", session),
        json=attempt.body,
        headers=attempt.headers,
    )


@pytest.mark.parametrize("attempt", ATTEMPTS, ids=str)
async def test_it_gets_nothing_and_changes_nothing(attempt: Attempt) -> None:
    async with asked(api_key=KEY) as client:
        made = (await client.post(SESSIONS, json={"seed": 1, "paused": True}, headers=BEARER)).json()
        state = f"{SESSIONS}/{made['id']}/state"
        before = (await client.get(state, headers=BEARER)).json()
        answer = await tried(client, attempt, made["id"])
        assert answer.headers["content-type"] == "application/problem+json"
        assert (answer.status_code, answer.json()["type"]) == (
            attempt.told[0],
            f"/problems/{attempt.told[1]}",
        )
        assert all(answer.headers.get(name) for name in HEADERS), answer.headers
        assert "set-cookie" not in answer.headers
        assert KEY not in answer.text
        assert (await client.get(state, headers=BEARER)).json() == before
        assert len((await client.get(SESSIONS, headers=BEARER)).json()["items"]) == 1


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/", 200),
        ("/docs", 200),
        ("/docs/swagger-ui-bundle.js", 200),
        ("/openapi.json", 200),
        ("/healthz", 200),
        ("/metrics", 200),
        (SESSIONS, 200),
        (f"{SESSIONS}/none", 404),
        (f"{SESSIONS}?limit=0", 422),
        ("/nowhere", 404),
    ],
)
async def test_every_kind_of_answer_keeps_a_browser_safe(path: str, status: int) -> None:
    async with asked() as client:
        answer = await client.get(path)
        assert answer.status_code == status
        policy = answer.headers["content-security-policy"]
        assert "default-src 'self'" in policy
        assert "frame-ancestors 'none'" in policy
        assert "unsafe" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["x-request-id"]


async def _print() -> None:
    print("| what is tried | what is told |\n| --- | --- |")
    async with asked(api_key=KEY) as client:
        made = (await client.post(SESSIONS, json={"seed": 1}, headers=BEARER)).json()
        for attempt in ATTEMPTS:
            answer = await tried(client, attempt, made["id"])
            kind = answer.json()["type"].removeprefix("/problems/")
            print(f"| {attempt.name} | {answer.status_code} {kind} |")
    settings = Settings(database="memory:")
    async with running(create_app(settings), settings) as at:
        for name, (content, _) in RAW.items():
            print(f"| {name} | {(await sent(at.port, content)).status}, and the line is ended |")


if __name__ == "__main__":
    asyncio.run(_print())
