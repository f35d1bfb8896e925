"""A key makes a request happen once: sent again, at once or after a crash, it is answered the same."""

from __future__ import annotations

import asyncio
import uuid
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.http.conditional.answers import KEPT_S, KeptAnswers
from service.settings import Settings
from service.store import EntryRecord, MemoryStore, PhraseRecord, SqlStore, Store, StoredResponse, StoreError
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service
from tests.support.service_process import ServiceProcess

ADD = {"actions": [{"do": "add", "kind": "pothole", "count": 2}]}
TAUGHT = {
    "actions": [
        {"do": "teach", "phrase": "rush hour", "meaning": [{"do": "add", "kind": "vehicle", "count": 1}]}
    ]
}
CALLS: list[tuple[str, dict[str, Any]]] = [
    ("commands", {"text": "add five potholes"}),
    ("commands", {"text": "add five potholes", "dry_run": True}),
    ("commands", {"text": "where are you?"}),
    ("actions", ADD),
    ("actions", {"actions": [{"do": "undo"}]}),
    ("actions", TAUGHT),
    ("step", {"ticks": 3}),
]


def keyed(key: str = "one") -> dict[str, str]:
    return {"Idempotency-Key": key}


@pytest.mark.parametrize(("call", "body"), CALLS)
async def test_a_call_is_done_once_and_answered_the_same(
    service: Service, call: str, body: dict[str, Any]
) -> None:
    path = await service.session(paused=True)
    await service.say(path, "add two cars")
    first = await service.client.post(f"{path}/{call}", json=body, headers=keyed())
    after = await service.state(path)
    again = await service.client.post(f"{path}/{call}", json=body, headers=keyed())

    assert first.status_code == 200, first.text
    assert (again.status_code, again.content) == (200, first.content)
    assert again.headers.get("etag") == first.headers.get("etag")
    assert (first.headers.get("idempotency-replayed"), again.headers["idempotency-replayed"]) == (
        None,
        "true",
    )
    assert await service.state(path) == after


async def test_without_a_key_it_is_done_as_often_as_it_is_asked(service: Service) -> None:
    path = await service.session(paused=True)
    for _ in range(2):
        await service.client.post(f"{path}/actions", json=ADD)
    assert (await service.state(path))["sequence"] == 2


async def test_a_session_is_made_once(service: Service) -> None:
    made = [await service.client.post("/api/v1/sessions", json={}, headers=keyed()) for _ in range(3)]
    listed = (await service.client.get("/api/v1/sessions")).json()["items"]

    assert [each.status_code for each in made] == [201, 201, 201]
    assert len({each.headers["location"] for each in made}) == len(listed) == 1
    assert made[0].json()["paused"] is False
    assert made[0].content == made[2].content


async def test_a_key_of_another_request_is_refused(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/actions", json=ADD, headers=keyed())
    before = await service.state(path)
    for call, body in (("actions", {**ADD, "dry_run": True}), ("step", {"ticks": 1})):
        refused = await service.client.post(f"{path}/{call}", json=body, headers=keyed())
        assert (refused.status_code, refused.json()["type"]) == (422, "/problems/key-reused")
        assert refused.json()["errors"][0]["field"] == "Idempotency-Key"
    assert await service.state(path) == before


@pytest.mark.parametrize("key", ["", "two words", "x" * 256])
async def test_a_key_that_is_none_is_refused(service: Service, key: str) -> None:
    path = await service.session(paused=True)
    refused = await service.client.post(f"{path}/actions", json=ADD, headers=keyed(key))
    assert (refused.status_code, refused.json()["type"]) == (422, "/problems/invalid")
    assert (await service.state(path))["sequence"] == 0


async def test_a_refusal_may_be_tried_again_under_its_key(service: Service) -> None:
    path = await service.session(paused=True)
    undo = {"actions": [{"do": "undo"}]}
    refused = await service.client.post(f"{path}/actions", json=undo, headers=keyed())
    await service.client.post(f"{path}/actions", json=ADD)
    done = await service.client.post(f"{path}/actions", json=undo, headers=keyed())
    assert (refused.status_code, done.status_code) == (422, 200)


async def test_whoever_sends_it_while_it_is_under_way_waits(settings: Settings) -> None:
    held, begun = asyncio.Event(), asyncio.Event()

    class Slow(MemoryStore):
        async def append(
            self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None
        ) -> None:
            begun.set()
            await held.wait()
            await super().append(session_id, entry, answer)

    app = create_app(settings, store=Slow(), language=FewSentences(), clock=HandClock())
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        path = (await client.post("/api/v1/sessions", json={"paused": True})).headers["location"]
        calls = [
            asyncio.create_task(client.post(f"{path}/actions", json=ADD, headers=keyed())) for _ in range(5)
        ]
        await begun.wait()
        held.set()
        answers = await asyncio.gather(*calls)
        assert {answer.content for answer in answers} == {answers[0].content}
        assert sum("idempotency-replayed" in answer.headers for answer in answers) == 4
        assert (await client.get(f"{path}/state")).json()["sequence"] == 1


@pytest.mark.parametrize("kind", ["memory", "sqlite"])
async def test_an_answer_is_stored_with_its_change_or_not_at_all(kind: str, tmp_path: Path) -> None:
    store: Store = MemoryStore() if kind == "memory" else SqlStore(f"sqlite:///{tmp_path}/keys.db")
    settings = Settings(database="memory:")
    app = create_app(settings, store=store, language=FewSentences(), clock=HandClock())
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        path = (await client.post("/api/v1/sessions", json={"paused": True})).headers["location"]
        identity = path.rsplit("/", 1)[1]
        answer = StoredResponse(
            key="one", request="r", at=5, status=200, headers={"etag": '"1"'}, body=b"\x00"
        )
        entry = EntryRecord(sequence=1, tick=0, text=None, actions=[])
        await store.append(identity, entry, answer)
        assert await store.get_response("one") == answer
        with pytest.raises(StoreError):
            await store.append(identity, EntryRecord(sequence=2, tick=0, text=None, actions=[]), answer)
        assert [each.sequence for each in await store.entries(identity)] == [1]
        with pytest.raises(StoreError):
            await store.save_response(answer)


def test_after_a_kill_the_answer_is_still_there(tmp_path: Path) -> None:
    process = ServiceProcess(tmp_path / "killed.db")
    process.start()
    try:
        keys = [str(uuid.uuid4()) for _ in range(3)]

        def asked() -> list[httpx.Response]:
            with httpx.Client(base_url=process.url, timeout=60) as client:
                made = client.post("/api/v1/sessions", json={"paused": True}, headers=keyed(keys[0]))
                path = made.headers["location"]
                step = client.post(f"{path}/step", json={"ticks": 4}, headers=keyed(keys[1]))
                act = client.post(f"{path}/actions", json=ADD, headers=keyed(keys[2]))
                return [made, step, act, client.get(f"{path}/state")]

        first = asked()
        process.kill()
        process.start()
        again = asked()
    finally:
        process.kill()
    assert [each.status_code for each in first] == [201, 200, 200, 200]
    assert [each.content for each in again] == [each.content for each in first]
    assert first[3].json()["sequence"] == 2


# Time


class Clocks:
    """A wall clock that can be set, and one that cannot."""

    def __init__(self) -> None:
        self.wall, self.steady = 1_000_000_000.0, 50.0

    def pass_(self, seconds: float) -> None:
        self.wall += seconds
        self.steady += seconds

    def answers(self, store: MemoryStore) -> KeptAnswers:
        return KeptAnswers(store, lambda: self.wall, lambda: self.steady)


def answer(key: str, at: int) -> StoredResponse:
    return StoredResponse(key=key, request="r", at=at, status=200, headers={}, body=b"")


async def test_an_answer_is_forgotten_after_a_day() -> None:
    clocks, store = Clocks(), MemoryStore()
    answers = clocks.answers(store)
    await answers.open()
    await answers.keep(answer("one", answers.now))
    clocks.pass_(KEPT_S - 1)
    assert await answers.find("one") is not None
    clocks.pass_(2)
    assert await answers.find("one") is None
    await answers.keep(answer("one", answers.now))
    assert await answers.find("one") is not None


@pytest.mark.parametrize("days", [3, -400])
@pytest.mark.parametrize("restarted", [False, True])
async def test_a_jump_of_the_wall_clock_is_no_matter(days: int, restarted: bool) -> None:
    clocks, store = Clocks(), MemoryStore()
    answers = clocks.answers(store)
    await answers.open()
    await answers.keep(answer("old", answers.now))
    clocks.pass_(KEPT_S / 2)
    await answers.keep(answer("new", answers.now))
    clocks.wall += days * 24 * 3_600
    if restarted:
        answers = clocks.answers(store)
        await answers.open()
    assert await answers.find("old") is not None
    assert await answers.find("new") is not None
    clocks.pass_(KEPT_S / 2 + 1)
    assert await answers.find("old") is None
    assert await answers.find("new") is not None
    clocks.pass_(KEPT_S / 2)
    assert await answers.find("new") is None


async def test_the_file_moves_its_answers_in_time_together(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/keys.db")
    await store.open()
    for key, at in (("a", 100), ("b", 400)):
        await store.save_response(answer(key, at))
    await store.shift_responses(10_400)
    await store.delete_responses(10_200)
    kept = await store.get_response("b")
    assert kept is not None
    assert kept.at == 10_400
    assert await store.get_response("a") is None
    await store.close()


@pytest.mark.parametrize("kind", ["memory", "sqlite"])
async def test_a_phrase_and_its_answer_are_kept_together_or_not_at_all(kind: str, tmp_path: Path) -> None:
    store: Store = MemoryStore() if kind == "memory" else SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    answer = StoredResponse(key="one", request="r", at=1, status=200, headers={}, body=b"{}")
    phrase = PhraseRecord(owner="o", language="en", key="x", phrase="x", meaning=[{"do": "pause"}])
    await store.save_phrase(phrase, answer)
    assert await store.get_response("one") == answer
    with pytest.raises(StoreError):
        await store.delete_phrase("o", "en", "x", answer)
    assert await store.phrases("o") == [phrase], "not forgotten where its answer cannot be kept"
    with pytest.raises(StoreError):
        await store.save_phrase(replace(phrase, key="y", phrase="y"), answer)
    assert await store.phrases("o") == [phrase]
    assert await store.delete_phrase("o", "en", "x", replace(answer, key="two"))
    assert (await store.phrases("o"), (await store.get_response("two")) is None) == ([], False)
    await store.close()


async def test_a_phrase_is_taught_with_its_answer_in_one_go(service: Service) -> None:
    """And not where it was asked for in a session that has gone on meanwhile."""
    kept: list[StoredResponse | None] = []
    teach = service.store.save_phrase

    async def noted(record: PhraseRecord, answer: StoredResponse | None = None) -> None:
        kept.append(answer)
        await teach(record, answer)

    service.store.save_phrase = noted  # type: ignore[method-assign]
    path = await service.session(paused=True)
    stale = {"If-Match": '"7"'}
    refused = await service.client.post(f"{path}/actions", json=TAUGHT, headers=keyed() | stale)
    assert (refused.status_code, kept) == (412, [])
    first = await service.client.post(f"{path}/actions", json=TAUGHT, headers=keyed())
    assert [answer.body for answer in kept if answer is not None] == [first.content]
