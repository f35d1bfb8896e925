"""The hostile list: what strangers try by HTTP, and what each of them is told. None gets anything.

`python -m tests.service.test_hostile_list` prints it.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field

import httpx
import pytest

from tests.service.test_security import BEARER, KEY, SESSIONS, asked

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


if __name__ == "__main__":
    asyncio.run(_print())
