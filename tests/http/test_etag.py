"""Tags say what was seen; a change asked for on the ground of something older is not made."""

from __future__ import annotations

import asyncio

import httpx
import pytest

from tests.support.service import Service

ADD = {"actions": [{"do": "add", "kind": "pothole", "count": 1}]}
LOOKED_AT = ["", "/state", "/state?tick=1", "/decisions", "/decisions/1", "/events", "/recording", "/frame"]


async def ready(service: Service) -> str:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 3})
    return path


@pytest.mark.parametrize("what", LOOKED_AT)
async def test_what_is_at_hand_is_not_sent_again(service: Service, what: str) -> None:
    path = await ready(service)
    first = await service.client.get(f"{path}{what}")
    tag = first.headers["etag"]
    assert tag.startswith('"1-')
    for said in (tag, f'"x", W/{tag}', "*"):
        same = await service.client.get(f"{path}{what}", headers={"If-None-Match": said})
        assert (same.status_code, same.content, same.headers["etag"]) == (304, b"", tag)
    other = await service.client.get(f"{path}{what}", headers={"If-None-Match": '"1"'})
    assert (other.status_code, other.content) == (200, first.content)


async def test_time_alone_makes_another_answer(service: Service) -> None:
    path = await service.session()
    tag = (await service.client.get(f"{path}/state")).headers["etag"]
    service.clock.tick()
    moved = await service.client.get(f"{path}/state", headers={"If-None-Match": tag})
    assert (moved.status_code, moved.json()["tick"]) == (200, 1)
    assert moved.headers["etag"] != tag


@pytest.mark.parametrize(
    ("call", "body"),
    [
        ("actions", ADD),
        ("commands", {"text": "add five potholes"}),
        ("commands", {"text": "add five potholes", "dry_run": True}),
        ("step", {"ticks": 1}),
        ("ask", {"question": "where are you?"}),
    ],
)
async def test_a_stale_call_is_refused_with_where_the_session_stands(
    service: Service, call: str, body: dict[str, object]
) -> None:
    path = await ready(service)
    seen = (await service.client.get(path)).headers["etag"]
    before = await service.state(path)
    for stale in ('"0"', '"7", W/"1"', '"elsewhere"', '"0-ff"'):
        refused = await service.client.post(f"{path}/{call}", json=body, headers={"If-Match": stale})
        document = refused.json()
        assert (refused.status_code, document["type"], document["sequence"]) == (412, "/problems/stale", 1)
        assert await service.state(path) == before
    for held in (seen, '"1"', '"0", "1"', "*"):
        done = await service.client.post(
            f"{path}/{call}", json={**body}, headers={"If-Match": held if call != "x" else ""}
        )
        assert done.status_code == 200, (held, done.text)
        if (await service.state(path))["sequence"] != 1:
            break


async def test_of_two_on_the_same_ground_one_is_done(service: Service) -> None:
    path = await ready(service)
    calls = [service.client.post(f"{path}/actions", json=ADD, headers={"If-Match": '"1"'}) for _ in range(6)]
    answers = await asyncio.gather(*calls)
    assert sorted(answer.status_code for answer in answers) == [200] + [412] * 5
    assert (await service.state(path))["sequence"] == 2


async def test_a_session_that_was_changed_is_not_deleted(service: Service) -> None:
    path = await ready(service)
    refused = await service.client.delete(path, headers={"If-Match": '"0"'})
    assert refused.status_code == 412
    assert (await service.client.get(path)).status_code == 200
    gone = await service.client.delete(path, headers={"If-Match": '"1"'})
    assert gone.status_code == 204
    assert (await service.client.get(path)).status_code == 404


@pytest.mark.parametrize("said", ["3", '"3', "", '"a" "b"', "W/3"])
async def test_what_is_no_tag_is_refused(service: Service, said: str) -> None:
    path = await ready(service)
    refused = await service.client.post(f"{path}/actions", json=ADD, headers={"If-Match": said})
    assert (refused.status_code, refused.json()["errors"][0]["field"]) == (422, "If-Match")
    assert (await service.state(path))["sequence"] == 1


async def test_a_request_that_was_done_is_answered_though_the_session_went_on(service: Service) -> None:
    path = await ready(service)
    headers = {"If-Match": '"1"', "Idempotency-Key": "once"}
    answers: list[httpx.Response] = [
        await service.client.post(f"{path}/actions", json=ADD, headers=headers) for _ in range(2)
    ]
    assert [answer.status_code for answer in answers] == [200, 200]
    assert answers[0].content == answers[1].content
    assert (await service.state(path))["sequence"] == 2
