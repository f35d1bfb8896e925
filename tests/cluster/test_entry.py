"""The entry over two real services: everything a client can see, except that Ray starts them."""

from __future__ import annotations

import asyncio
import json

import httpx
import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from service.http import prefer
from tests.cluster.shards import cluster

API = "/api/v1"


async def closed_with(stream: ClientConnection) -> int | None:
    """The code with which a stream ends, after what it still sends."""
    try:
        while True:
            await stream.recv()
    except ConnectionClosed as closed:
        return None if closed.rcvd is None else closed.rcvd.code


async def test_a_session_lives_in_one_shard_and_new_ones_take_turns() -> None:
    async with cluster() as service:
        paths = dict([await service.create() for _ in range(4)])
        assert sorted(paths.values()) == [0, 0, 1, 1]
        for path, shard in paths.items():
            answer = await service.client.post(f"{path}/commands", json={"text": "add two potholes"})
            assert (answer.status_code, answer.headers["roadtalk-shard"]) == (200, str(shard))
        forked, lives = await service.create(0)
        fork = await service.client.post(f"{forked}/forks", json={})
        assert fork.headers["roadtalk-shard"] == str(lives)
        assert (await service.client.get(fork.headers["location"])).headers["roadtalk-shard"] == str(lives)


async def test_answers_come_as_they_were_sent() -> None:
    async with cluster() as service:
        path, _ = await service.create()
        state = await service.client.get(f"{path}/state")
        assert state.headers["content-type"] == "application/json"
        assert len([name for name, _ in state.headers.raw if name.lower() == b"date"]) == 1
        same = await service.client.get(f"{path}/state", headers={"If-None-Match": state.headers["etag"]})
        assert (same.status_code, same.content) == (304, b"")
        head = await service.client.head(f"{path}/state")
        assert (head.headers["content-length"], head.content) == (str(len(state.content)), b"")
        missing = await service.client.get(f"{API}/sessions/none/state")
        assert (missing.status_code, missing.json()["type"]) == (404, "/problems/unknown-session")
        page = await service.client.get("/")
        assert (page.status_code, page.headers["content-type"][:9]) == (200, "text/html")


async def test_lists_and_health_are_those_of_all_shards() -> None:
    async with cluster() as service:
        made = [await service.create(number) for number in (0, 1, 0)]
        await service.client.post(f"{made[1][0]}/step", json={"ticks": 3})
        found = (await service.client.get(f"{API}/sessions")).json()
        assert {each["id"] for each in found["items"]} >= {path.rpartition("/")[2] for path, _ in made}
        assert all(each["live"] for each in found["items"])
        ticks = {each["links"]["self"]: each["tick"] for each in found["items"]}
        assert [ticks[path] for path, _ in made] == [0, 3, 0]
        health = (await service.client.get("/healthz")).json()
        assert health["sessions"] == len(found["items"]) == sum(each["sessions"] for each in health["shards"])
        assert [(each["shard"], each["state"]) for each in health["shards"]] == [(0, "up"), (1, "up")]
        assert (await service.client.head("/healthz")).content == b""
        assert (await service.client.get("/readyz")).json() == {"status": "ready"}
        metrics = (await service.client.get("/metrics")).text
        for shard in health["shards"]:
            assert f'roadtalk_sessions{{shard="{shard["shard"]}"}} {shard["sessions"]}.0' in metrics
        assert metrics.count("# TYPE roadtalk_sessions gauge") == 1
        assert "roadtalk_sleeping_sessions" not in metrics


async def test_a_request_that_names_another_session_is_sent_to_its_shard() -> None:
    async with cluster() as service:
        for number in (0, 1):
            path, _ = await service.create(number)
            named = path.rpartition("/")[2]
            made = [
                await service.client.post(f"{API}/sessions", json={"link": f"#/s/{named}/0"})
                for _ in range(2)
            ]
            assert [(each.status_code, each.headers["roadtalk-shard"]) for each in made] == [
                (201, str(number))
            ] * 2
            answers = [
                await service.client.get(f"{API}/language", params={"prefix": "add", "session": named})
                for _ in range(2)
            ]
            assert {(each.status_code, each.headers["roadtalk-shard"]) for each in answers} == {
                (200, str(number))
            }


async def test_under_a_key_a_session_is_made_once() -> None:
    async with cluster() as service:
        for key in ("one", "two", "three"):
            made = await asyncio.gather(
                *(
                    service.client.post(f"{API}/sessions", json={"seed": 5}, headers={"Idempotency-Key": key})
                    for _ in range(4)
                )
            )
            assert len({each.headers["location"] for each in made}) == 1
        assert len((await service.client.get(f"{API}/sessions")).json()["items"]) == 3


async def test_a_stream_goes_both_ways_and_its_end_is_told() -> None:
    async with cluster() as service:
        path, _ = await service.create()
        async with connect(f"{service.url.replace('http', 'ws')}{path}/stream") as stream:
            assert json.loads(await stream.recv())["type"] == "hello"
            await stream.send(json.dumps({"type": "command", "id": "7", "text": "add a pothole"}))
            while (said := json.loads(await stream.recv()))["type"] != "result":
                assert said["type"] == "changed"
            assert said["id"] == "7"
            assert (await service.client.delete(path)).status_code == 204
            assert await closed_with(stream) == 1000


async def test_a_page_of_another_site_gets_no_stream() -> None:
    async with cluster() as service:
        path, _ = await service.create()
        with pytest.raises(Exception, match="403"):
            async with connect(
                f"{service.url.replace('http', 'ws')}{path}/stream", origin="http://evil.example"
            ):
                pass
        refused = await service.client.post(
            f"{path}/step", json={}, headers={"Origin": "http://evil.example"}
        )
        assert refused.status_code == 403
        foreign = await service.client.get(f"{path}/state", headers={"Host": "evil.example"})
        assert (foreign.status_code, foreign.json()["type"]) == (421, "/problems/foreign-host")


async def test_events_are_passed_on_as_they_happen() -> None:
    async with cluster() as service:
        path, _ = await service.create()
        async with service.client.stream("GET", f"{path}/events/stream") as events:
            lines = events.aiter_lines()
            async for line in lines:
                if "hello" in line:
                    break
            await service.client.post(f"{path}/commands", json={"text": "add a pothole"})
            async for line in lines:
                if "changed" in line:
                    break


async def test_a_shard_that_is_down_is_told_and_the_others_go_on() -> None:
    async with cluster() as service:
        (dead, _), (alive, _) = await service.create(0), await service.create(1)
        async with connect(f"{service.url.replace('http', 'ws')}{dead}/stream") as stream:
            await stream.recv()
            await service.kill(0)
            assert await closed_with(stream) == 1012
        for told in (False, True):  # whether the entry has heard of it yet
            if told:
                service.places.set(0, None)
            refused = await service.client.get(f"{dead}/state")
            assert (refused.status_code, refused.headers["retry-after"]) == (503, "1")
            assert refused.json()["type"] == "/problems/shard-down"
            async with connect(f"{service.url.replace('http', 'ws')}{dead}/stream") as stream:
                assert await closed_with(stream) == 1013
            health = (await service.client.get("/healthz")).json()
            assert [each["state"] for each in health["shards"]] == ["down", "up"]
            assert (await service.client.get("/readyz")).status_code == 503
            assert 'roadtalk_shard_up{shard="0"} 0.0' in (await service.client.get("/metrics")).text
            listed = (await service.client.get(f"{API}/sessions")).json()["items"]
            live = {each["links"]["self"]: each["live"] for each in listed}
            assert (live[dead], live[alive]) == (False, True)
        assert (await service.client.get(f"{alive}/state")).status_code == 200
        assert (await service.create())[1] == 1


async def test_a_shard_answers_to_the_entry_alone() -> None:
    async with cluster() as service:
        path, number = await service.create()
        own = service.shards[number]
        async with httpx.AsyncClient(base_url=own.http) as directly:
            for header in ({}, {"Roadtalk-Forwarded": "wrong http 127.0.0.1 1 127.0.0.1 2 127.0.0.1"}):
                assert (await directly.get(f"{path}/state", headers=header)).status_code == 403
        with pytest.raises(Exception, match="403"):
            async with connect(f"{own.ws}{path}/stream"):
                pass
        # What a client sends under that name is not passed on.
        forged = {"Roadtalk-Forwarded": "wrong http 127.0.0.1 1 127.0.0.1 2 127.0.0.1"}
        assert (await service.client.get(f"{path}/state", headers=forged)).status_code == 200


async def test_a_shard_refuses_what_another_one_has() -> None:
    async with cluster() as service:
        path, number = await service.create()
        service.places.set(number, service.places[1 - number])  # an entry that is wrong about where it is
        for method, body in (("GET", None), ("DELETE", None)):
            answer = await service.client.request(method, path, json=body)
            assert answer.status_code == 503
        assert service.apps[1 - number].state.context.manager.live_count == 0


async def test_a_key_and_its_tickets_hold_in_all_shards() -> None:
    async with cluster(api_key="a key of the tests") as service:
        assert (await service.client.get(f"{API}/sessions")).status_code == 401
        assert (await service.client.get("/metrics")).status_code == 401
        service.client.headers["Authorization"] = "Bearer a key of the tests"
        for number in (0, 1):
            path, _ = await service.create(number)
            for _ in range(2):  # issued by one shard and by the other
                ticket = (await service.client.post(f"{API}/tickets", json={})).json()["ticket"]
                address = f"{service.url.replace('http', 'ws')}{path}/stream"
                async with connect(address) as stream:
                    await stream.send(json.dumps({"type": "auth", "ticket": ticket}))
                    assert json.loads(await stream.recv())["type"] == "hello"
                async with connect(address) as stream:
                    await stream.send(json.dumps({"type": "auth", "ticket": ticket}))
                    assert await closed_with(stream) == 4401


async def test_a_client_is_known_by_its_own_address() -> None:
    async with cluster(max_client_sessions=1, trusted_proxies="127.0.0.1") as service:
        for client in ("10.0.0.1", "10.0.0.2"):
            headers = {"X-Forwarded-For": client}
            made = [await service.client.post(f"{API}/sessions", json={}, headers=headers) for _ in range(3)]
            assert sorted(each.status_code for each in made) == [201, 201, 429]  # one of each shard


async def test_a_body_is_bounded_before_it_is_passed_on() -> None:
    async with cluster(max_body_bytes=2_000, max_recording_bytes=4_000) as service:
        large = await service.client.post(f"{API}/sessions", content=b" " * 5_000)
        assert large.status_code == 413


async def test_a_long_answer_is_found_where_it_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prefer, "LONG_UNITS", 0)
    async with cluster() as service:
        for number in (0, 1):
            path, _ = await service.create(number)
            await service.client.post(f"{path}/step", json={"ticks": 3})
            asked = await service.client.get(f"{path}/regret", headers={"Prefer": "respond-async"})
            own = asked.json()["links"]["self"]
            found = await service.client.get(own)
            assert (asked.status_code, found.status_code) == (202, 200)
            assert found.headers["roadtalk-shard"] == str(number)
