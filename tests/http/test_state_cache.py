"""The short way to the present state, against the long one: the same answer in every standing."""

from __future__ import annotations

import httpx
import pytest

from tests.support.service import Service


async def both(service: Service, path: str, **headers: str) -> tuple[httpx.Response, httpx.Response]:
    """The state by the short way, and by the long one, which is taken where a tick is named."""
    live = service.app.state.context.manager.live_sessions.get(path.rpartition("/")[2])
    tick = 0 if live is None else live.timeline.tick
    short = await service.client.get(f"{path}/state", headers=headers)
    long = await service.client.get(f"{path}/state?tick={tick}", headers=headers)
    for answer in (short, long):
        del answer.headers["x-request-id"]
    return short, long


def alike(answers: tuple[httpx.Response, httpx.Response]) -> bool:
    short, long = answers
    same = short.status_code == long.status_code and short.content == long.content
    return same and sorted(short.headers.items()) == sorted(long.headers.items())


async def test_it_answers_as_the_long_way_does_whatever_has_happened(service: Service) -> None:
    path = await service.session()
    assert alike(await both(service, path))
    seen = set()
    for text in ("add five potholes", "pause", "undo", "resume", "add two cars"):
        service.clock.tick()
        answers = await both(service, path)
        assert alike(answers)
        assert (await service.say(path, text)).status_code == 200
        answers = await both(service, path)
        assert alike(answers)
        seen.add(answers[0].headers["etag"])
    assert len(seen) == 5


async def test_what_is_at_hand_is_not_sent_again(service: Service) -> None:
    path = await service.session()
    tag = (await both(service, path))[0].headers["etag"]
    answers = await both(service, path, **{"if-none-match": tag})
    assert alike(answers)
    assert answers[0].status_code == 304
    service.clock.tick()
    answers = await both(service, path, **{"if-none-match": tag})
    assert alike(answers)
    assert answers[0].status_code == 200


@pytest.mark.parametrize("name", ["nothing", "a%2Fb", "%00", "..", "x" * 300])
async def test_what_is_no_session_is_told_the_same(service: Service, name: str) -> None:
    assert (await service.client.get(f"/api/v1/sessions/{name}/state")).status_code == 404


async def test_a_deleted_session_is_not_remembered(service: Service) -> None:
    path = await service.session()
    assert (await both(service, path))[0].status_code == 200
    assert (await service.client.delete(path)).status_code == 204
    assert [each.status_code for each in await both(service, path)] == [404, 404]


async def test_other_methods_go_the_long_way(service: Service) -> None:
    path = await service.session()
    answer = await service.client.post(f"{path}/state")
    assert (answer.status_code, answer.headers["allow"]) == (405, "GET, HEAD, OPTIONS")
