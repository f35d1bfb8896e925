"""The short way for what is said and done, against the long one: the same answer to whatever is sent."""

from __future__ import annotations

import json

import fastapi.routing
import httpx
import pytest

from tests.support.service import Service

JSON = "application/json"
FIVE = {"actions": [{"do": "set_count", "kind": "pothole", "count": 5}]}
CALLS = [
    ("commands", {"text": "add five potholes"}),
    ("commands", {"text": "add five potholes", "dry_run": True}),
    ("commands", {"text": "add five potholes and a wobbly thing"}),
    ("commands", {"text": "x" * 501}),
    ("commands", {"text": "pause", "language": "xx"}),
    ("commands", {"text": "pause", "language": 5}),
    ("commands", {"text": 5}),
    ("commands", {"txt": "pause"}),
    ("commands", ["pause"]),
    ("actions", FIVE),
    ("actions", {**FIVE, "dry_run": True}),
    ("actions", {"actions": []}),
    ("actions", {"actions": [{"do": "set_count", "kind": "pothole", "count": "5"}]}),
    ("actions", {"actions": [{"do": "fly"}]}),
    ("actions", {"actions": [{"do": "undo"}]}),
    ("actions", {"actions": [{"do": "teach", "phrase": "boo", "meaning": [{"do": "pause"}]}] * 2}),
    ("step", {"ticks": 3}),
    ("step", {}),
    ("step", {"ticks": 0}),
    ("ask", {"question": "add five potholes"}),
    ("ask", {"question": "why?"}),
]
HEADERS = [
    {},
    {"content-type": "text/plain"},
    {"content-type": "application/json; charset=utf-8"},
    {"if-match": '"0"'},
    {"if-match": '"9"'},
    {"if-match": "nonsense"},
    {"idempotency-key": "one"},
    {"idempotency-key": "not one"},
]


def told(answer: httpx.Response) -> tuple[int, bytes, list[tuple[str, str]]]:
    """All of an answer that is not about this request alone."""
    del answer.headers["x-request-id"]
    return answer.status_code, answer.content, sorted(answer.headers.items())


async def both(
    service: Service, name: str, body: bytes, headers: dict[str, str]
) -> tuple[httpx.Response, httpx.Response]:
    """A call by the short way, and (having an empty question in its address) by the long one."""
    answers = []
    for question in ("", "?&"):
        path = await service.session(paused=True)
        sent = {"content-type": JSON, **headers}
        if "idempotency-key" in sent:
            sent["idempotency-key"] += path[-8:]
        answer = await service.client.post(f"{path}/{name}{question}", content=body, headers=sent)
        answer._content = answer.content.replace(path.rpartition("/")[2].encode(), b"the session")
        answers.append(answer)
    return answers[0], answers[1]


@pytest.mark.parametrize("headers", HEADERS, ids=str)
async def test_it_answers_as_the_long_way_does(service: Service, headers: dict[str, str]) -> None:
    statuses = set()
    for name, said in CALLS:
        short, long = await both(service, name, json.dumps(said).encode(), headers)
        statuses.add(short.status_code)
        assert told(short) == told(long), (name, said)
    assert 200 in statuses or statuses <= {412, 415, 422}


@pytest.mark.parametrize("body", [b"", b"{", b"\xff", b'{"text":NaN}', b'{"text":"\\ud800"}', b"[" * 3_000])
async def test_what_is_no_json_is_told_the_same(service: Service, body: bytes) -> None:
    short, long = await both(service, "commands", body, {})
    assert short.status_code in (400, 422)
    assert told(short) == told(long)


@pytest.mark.parametrize("where", ["nothing/commands", "/commands", "a/b/commands", "nothing/nowhere"])
async def test_what_is_no_session_is_told_the_same(service: Service, where: str) -> None:
    said = {"text": "pause"}
    short = await service.client.post(f"/api/v1/sessions/{where}", json=said)
    long = await service.client.post(f"/api/v1/sessions/{where}?&", json=said)
    assert short.status_code == 404
    assert told(short) == told(long)


async def test_no_dependencies_are_solved_for_it(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    path = await service.session()

    async def solved(**_: object) -> None:
        raise AssertionError("it went the long way")

    monkeypatch.setattr(fastapi.routing, "solve_dependencies", solved)
    assert (await service.say(path, "add five potholes")).status_code == 200
    assert (await service.act(path, {"do": "undo"})).status_code == 200
    assert (await service.client.post(f"{path}/step", json={})).status_code == 200
    with pytest.raises(AssertionError, match="the long way"):
        await service.client.post(f"{path}/step?&", json={})


async def test_under_a_key_it_is_done_once_whichever_way_it_is_sent(service: Service) -> None:
    path = await service.session()
    key = {"idempotency-key": "once", "content-type": JSON}
    first = await service.client.post(f"{path}/actions", json=FIVE, headers=key)
    plain = json.dumps(FIVE, separators=(",", ":")).encode()
    odd = {**key, "content-type": "application/json; charset=utf-8"}  # which the short way does not take
    second = await service.client.post(f"{path}/actions", content=plain, headers=odd)
    assert (second.status_code, second.content) == (200, first.content)
    assert second.headers["idempotency-replayed"] == "true"
    other = await service.client.post(f"{path}/actions", json={**FIVE, "dry_run": True}, headers=key)
    assert (other.status_code, other.json()["type"]) == (422, "/problems/key-reused")
    assert (await service.state(path))["sequence"] == 1


async def test_a_deleted_session_is_gone_for_it_as_well(service: Service) -> None:
    path = await service.session()
    assert (await service.say(path, "pause")).status_code == 200
    await service.client.delete(path)
    assert (await service.say(path, "pause")).status_code == 404
