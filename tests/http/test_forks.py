"""Another way from a tick, and a tick as a link: the same to the bit, and nothing here is changed by it."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service import actions as contract
from service.http.routes.links import MOST_CARRIED, Named, open_link
from service.problems import DoesNotFit, Invalid, NotAvailable, NotSaved
from service.sessions.persistence.replay import replay
from service.store import EntryRecord, MemoryStore, StoreError
from tests.support.fork_talk import TALK, talked
from tests.support.service import Service as Http
from tests.support.session_talk import anew
from tests.support.sessions import ADD, ADD_CARS, UNDO, WORDS, Service, do, fingerprint, potholes

Json = dict[str, Any]


@settings(max_examples=100, deadline=None)
@given(said=TALK, share=st.floats(0, 1))
def test_a_fork_is_its_parent_up_to_the_tick(
    said: list[tuple[int, list[dict[str, object]]]], share: float
) -> None:
    async def fork() -> None:
        service, parent = await talked(said)
        tick = round(parent.timeline.tick * share)
        before, there = fingerprint(parent), parent.timeline.at(tick)
        child = await service.manager.fork(parent, tick, contract.load([ADD]))
        assert fingerprint(parent) == before
        assert child.timeline.at(tick).world.digest() != there.world.digest()
        assert child.run == anew(child)
        plain = await service.manager.fork(parent, tick)
        assert plain.run == there == anew(plain)
        service.clock.tick(2)
        await do(plain, ADD_CARS)

        await service.manager.close()
        other = Service(service.store).manager
        for session in (child, plain):
            again = await other.get(session.id)
            assert (again.run, again.sequence) == (session.run, session.sequence)
            assert again.timeline.entries == session.timeline.entries
            assert again.undo_stack.done == session.undo_stack.done

    asyncio.run(fork())


async def test_what_was_undone_is_not_in_a_fork_and_what_stands_can_be_undone() -> None:
    service = Service()
    parent = await service.session()
    await do(parent, ADD)
    service.clock.tick(3)
    await do(parent, ADD, ADD)
    service.clock.tick(3)
    await do(parent, ADD)
    service.clock.tick(3)
    await do(parent, UNDO)
    child = await service.manager.fork(parent, 7)
    assert (potholes(child), child.sequence) == (7, 2)
    await do(child, UNDO)
    assert potholes(child) == 5
    assert potholes(parent) == 7


async def test_a_fork_that_cannot_be_changed_so_is_not_made() -> None:
    service = Service()
    parent = await service.session()
    service.clock.tick(3)
    bad = contract.load([ADD, {"do": "add", "kind": "barrier", "count": 300}])
    with pytest.raises(DoesNotFit):
        await service.manager.fork(parent, 2, bad)
    with pytest.raises(Invalid, match=r"^at_tick: has not come yet: it is tick 3\.$"):
        await service.manager.fork(parent, 4)
    assert (service.manager.live_count, len(await service.store.newest(10))) == (1, 1)


async def test_a_question_to_a_fork_is_no_change_of_it() -> None:
    """As in any session: it is not counted and not kept."""
    service = Service()
    parent = await service.session()
    service.clock.tick(3)
    asked = contract.load([{"do": "ask", "about": "why"}, {"do": "show", "view": "plan"}])
    child = await service.manager.fork(parent, 2, asked)
    assert child.sequence == 0
    assert list(await service.store.entries(child.id)) == []
    unoffered = contract.load([{"do": "ask", "about": "what_if", "change": [{"do": "undo"}]}])
    with pytest.raises(NotAvailable):
        await service.manager.fork(parent, 2, unoffered)


async def test_a_fork_that_is_not_stored_is_not_made() -> None:
    class Full(MemoryStore):
        full = False

        async def create(self, *given: Any) -> Any:
            if self.full:
                raise StoreError("disk full")
            return await super().create(*given)

    store = Full()
    service = Service(store)
    parent = await service.session()
    store.full = True
    with pytest.raises(NotSaved):
        await service.manager.fork(parent, None)
    assert service.manager.live_count == 1


async def test_a_fork_plays_as_its_parent_does() -> None:
    service = Service()
    parent = await service.session()
    await do(parent, {"do": "set", "parameter": "playback_speed", "value": 4})
    child = await service.manager.fork(parent, None)
    assert (child.paused, child.playback_speed) == (False, 4)
    assert not (await service.manager.fork(parent, None, paused=False)).paused
    assert (await service.manager.fork(parent, None, contract.load([{"do": "pause"}]))).paused
    await do(parent, {"do": "pause"})
    assert (await service.manager.fork(parent, None)).paused


async def test_a_fork_over_http(service: Http) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 6})
    there = await service.state(path)
    await service.client.post(f"{path}/step", json={"ticks": 6})
    answer = await service.client.post(f"{path}/forks", json={"at_tick": 6, "name": "other"})
    assert (answer.status_code, answer.json()["name"]) == (201, "other")
    forked = await service.state(answer.headers["location"])
    assert (forked["digest"], forked["tick"], forked["paused"]) == (there["digest"], 6, True)
    refused = await service.client.post(f"{path}/forks", json={"at_tick": 13})
    assert (refused.status_code, refused.json()["errors"][0]["field"]) == (422, "at_tick")


# Links


@settings(max_examples=40, deadline=None)
@given(said=TALK, share=st.floats(0, 1))
def test_a_link_opens_to_the_same_digest(
    said: list[tuple[int, list[dict[str, object]]]], share: float
) -> None:
    from service.http.routes.links import _carry

    async def way() -> None:
        _, session = await talked(said)
        tick = round(session.timeline.tick * share)
        found = open_link(_carry(session.timeline, tick, "en"), 1_000_000)
        assert not isinstance(found, Named)
        assert (found.tick, found.digest) == (tick, session.timeline.at(tick).world.digest())
        entries = [
            EntryRecord(
                sequence=each.sequence,
                tick=each.tick,
                text=each.text,
                actions=contract.dump(tuple(each.actions)),
            )
            for each in found.entries
        ]
        copy = await Service().session(session.timeline.config, paused=True)
        replay(copy, WORDS, entries, found.tick)
        assert copy.run.world.digest() == found.digest

    asyncio.run(way())


async def test_a_short_session_is_carried_and_needs_to_be_kept_nowhere(service: Http) -> None:
    path = await service.session(paused=True)
    await service.say(path, "add five potholes")
    await service.client.post(f"{path}/step", json={"ticks": 8})
    state = await service.state(path)
    await service.client.post(f"{path}/step", json={"ticks": 8})
    link = (await service.client.get(f"{path}/link", params={"tick": 8})).json()
    assert link["carries"]
    assert len(link["link"]) < MOST_CARRIED
    await service.client.delete(path)
    for said in (link["link"], f"http://elsewhere/{link['link']}"):
        answer = await service.client.post("/api/v1/sessions", json={"link": said})
        assert answer.status_code == 201, answer.text
        opened_there = await service.state(answer.headers["location"])
        assert (opened_there["digest"], opened_there["tick"]) == (state["digest"], 8)
        assert opened_there["paused"]


async def test_a_long_session_is_named(service: Http) -> None:
    path = await service.session(paused=True)
    rows = iter(range(400))
    for _ in range(4):
        actions = [{"do": "prefer", "preference": "cautious"}, {"do": "reset"}] * 20
        actions += [{"do": "step", "ticks": 1 + next(rows) % 3}, {"do": "drive", "move": "left"}] * 10
        await service.act(path, *actions)
    for number in range(150):
        await service.act(path, {"do": "step", "ticks": 1 + number * number % 7}, {"do": "set_count",
            "kind": ["pothole", "vehicle", "pedestrian"][number % 3], "count": number * 7 % 11})  # fmt: skip
    state = await service.state(path)
    link = (await service.client.get(f"{path}/link")).json()
    assert not link["carries"]
    assert link["link"] == f"#/s/{path.rsplit('/', 1)[1]}/{state['tick']}"
    answer = await service.client.post("/api/v1/sessions", json={"link": link["link"], "paused": True})
    assert (await service.state(answer.headers["location"]))["digest"] == state["digest"]


@pytest.mark.parametrize(
    "link", ["", "#", "#/r/", "#/r/abc", "#/r/ä", "#/r/!!!", "#/s/", "#/s/a/b", "#/s/../x", "page", "#/r/AwA"]
)
async def test_what_is_no_link_is_refused(service: Http, link: str) -> None:
    answer = await service.client.post("/api/v1/sessions", json={"link": link})
    assert (answer.status_code, answer.json()["errors"][0]["field"]) == (422, "link")


async def test_links_that_cannot_be_opened(service: Http) -> None:
    path = await service.session(paused=True)
    link = (await service.client.get(f"{path}/link")).json()["link"]
    cut = await service.client.post("/api/v1/sessions", json={"link": link[:-9]})
    assert (cut.status_code, cut.json()["errors"][0]["field"]) == (422, "link")
    beside = await service.client.post("/api/v1/sessions", json={"link": link, "seed": 3})
    assert beside.json()["errors"][0]["field"] == "seed"
    gone = await service.client.post("/api/v1/sessions", json={"link": "#/s/nobody/3"})
    assert (gone.status_code, gone.json()["type"]) == (404, "/problems/unknown-session")
    own = path.rsplit("/", 1)[1]
    late = await service.client.post("/api/v1/sessions", json={"link": f"#/s/{own}/3"})
    assert (late.status_code, late.json()["errors"][0]["field"]) == (422, "link")
    future = await service.client.get(f"{path}/link", params={"tick": 1})
    assert (future.status_code, future.json()["errors"][0]["field"]) == (422, "tick")


def test_a_link_that_unpacks_to_too_much_is_not_unpacked() -> None:
    import zlib
    from base64 import urlsafe_b64encode

    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    bomb = deflate.compress(b" " * 2_000_000) + deflate.flush()
    with pytest.raises(Invalid, match="more than is read here"):
        open_link("#/r/" + urlsafe_b64encode(bomb).decode(), 100_000)
