"""What is said is only ever text: nothing in it is run, followed or sent back as anything else."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from service.settings import Settings
from tests.support.injections import PAYLOADS, SENTENCES
from tests.support.strangers import SESSIONS, asked, assert_refused


@pytest.mark.parametrize(
    "url",
    [
        "file:///etc/passwd",
        "gopher://127.0.0.1:6379/_X",
        "ftp://x/",
        "http://u:p@10.0.0.1/",
        "http://169.254.169.254/?x=1",
        "javascript:alert(1)",
        "http://x/#y",
    ],
)
def test_the_models_address_is_a_plain_one_and_only_the_environments(url: str) -> None:
    with pytest.raises(ValidationError):
        Settings(llm_base_url=url)


async def test_no_call_takes_an_address() -> None:
    async with asked() as client:
        path = (await client.post(SESSIONS, json={"seed": 1})).headers["location"]
        for field in ("llm_base_url", "base_url", "url", "model"):
            for target, body in (
                (SESSIONS, {}),
                (f"{path}/commands", {"text": "pause"}),
                ("/api/v1/parse", {"text": "pause"}),
            ):
                answer = await client.post(target, json={**body, field: "http://169.254.169.254/"})
                assert_refused(answer, 422, "invalid")


@pytest.mark.parametrize(
    "path",
    [
        "/src/..%2f..%2fpyproject.toml",
        "/src/%2e%2e/%2e%2e/pyproject.toml",
        "/..%2fREADME.md",
        "/src//etc/passwd",
        "/docs/..%2f__init__.py",
        "/docs/%2e%2e%5csettings.py",
        f"{SESSIONS}/..%2f..%2froadtalk.db/state",
        f"{SESSIONS}/%2e%2e/recording",
        f"{SESSIONS}/%00/frame",
        "/src/main.js%00.png",
        "/src/....//....//README.md",
    ],
)
async def test_no_path_leads_out(path: str) -> None:
    async with asked() as client:
        answer = await client.get(path)
        assert answer.status_code == 404
        assert answer.headers["content-type"] == "application/problem+json"


async def test_no_injection_gets_through() -> None:
    async with asked(grammar=True) as client:
        path = (await client.post(SESSIONS, json={"seed": 1, "paused": True})).headers["location"]
        before = (await client.get(path)).json(), (await client.get(f"{path}/state")).json()
        tried = 0
        for sentence in SENTENCES:
            for target, body in (
                (f"{path}/commands", {"text": sentence}),
                (f"{path}/ask", {"question": sentence}),
                ("/api/v1/parse", {"text": sentence}),
                ("/api/v1/advice", {"text": sentence}),
                (SESSIONS, {"scenario": sentence}),
                (SESSIONS, {"planner": sentence}),
                (f"{path}/actions", {"actions": [{"do": sentence}]}),
                (
                    f"{path}/actions",
                    {"actions": [{"do": "remove", "kind": "pothole", "where": {"id": sentence}}]},
                ),
            ):
                answer = await client.post(target, json=body)
                assert answer.status_code in (409, 422), (target, sentence, answer.text)
                assert answer.headers["content-type"] == "application/problem+json"
                assert {"set-cookie", "refresh"}.isdisjoint(answer.headers)
                tried += 1
        assert tried == 8 * len(set(SENTENCES)) >= 1_600
        assert ((await client.get(path)).json(), (await client.get(f"{path}/state")).json()) == before
        assert len((await client.get(SESSIONS)).json()["items"]) == 1


@pytest.mark.parametrize("name", PAYLOADS)
async def test_a_name_is_only_a_name(name: str) -> None:
    async with asked() as client:
        answer = await client.post(SESSIONS, json={"name": name})
        assert answer.status_code in (201, 422), answer.text
        if answer.status_code == 201:
            assert answer.json()["name"] == name
            assert name not in answer.headers["location"]
        assert answer.headers["content-type"].startswith("application/")
        assert (await client.get(SESSIONS)).status_code == 200


async def test_headers_carry_nothing_in() -> None:
    async with asked() as client:
        for payload in PAYLOADS:
            if any(ord(letter) < 32 or ord(letter) > 126 for letter in payload):
                continue
            for header in ("If-Match", "Idempotency-Key", "X-Request-ID", "X-Forwarded-For", "Authorization"):
                answer = await client.post("/api/v1/parse", json={"text": "pause"}, headers={header: payload})
                assert answer.status_code in (200, 412, 422)
                assert payload not in answer.headers["x-request-id"]
