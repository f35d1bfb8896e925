"""Taught phrases belong to whoever taught them; those of this machine hold for everyone."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack
from pathlib import Path
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.interpreter import aliases
from service.interpreter.languages import Languages
from service.interpreter.owners import LOCAL, owner_of
from service.settings import Settings
from service.store import PhraseRecord, SqlStore
from tests.support.fakes import HandClock

Json = dict[str, Any]
PAUSE: list[Json] = [{"do": "pause"}]
RESUME: list[Json] = [{"do": "resume"}]


class Someone:
    """A client at an address, with a session of its own."""

    def __init__(self, client: httpx.AsyncClient, path: str) -> None:
        self.client, self.path = client, path

    async def teach(self, phrase: str, meaning: list[Json] = PAUSE) -> httpx.Response:
        action = {"do": "teach", "phrase": phrase, "meaning": meaning}
        return await self.client.post(f"{self.path}/actions", json={"actions": [action]})

    async def forget(self, phrase: str) -> int:
        action = {"do": "forget", "phrase": phrase}
        answer = await self.client.post(f"{self.path}/actions", json={"actions": [action]})
        return answer.status_code

    async def say(self, text: str) -> list[Json] | None:
        """The actions of a sentence; None where it is not understood."""
        answer = await self.client.post(f"{self.path}/commands", json={"text": text})
        return answer.json()["actions"] if answer.status_code == 200 else None

    async def taught(self) -> list[str]:
        answer = await self.client.get("/api/v1/language")
        return [each["phrase"] for each in answer.json()["taught"]]


At = Callable[[str], Any]


@pytest.fixture
async def at(tmp_path: Path, languages: Languages) -> AsyncIterator[At]:
    """Somebody at an address; one service."""
    app = create_app(
        Settings(database=f"sqlite:///{tmp_path}/roads.db"),
        language=languages["en"],
        clock=HandClock(),
    )
    async with AsyncExitStack() as stack:
        await stack.enter_async_context(app.router.lifespan_context(app))

        async def someone(address: str) -> Someone:
            transport = httpx.ASGITransport(app, client=(address, 5_000))
            client = httpx.AsyncClient(transport=transport, base_url="http://service")
            await stack.enter_async_context(client)
            made = await client.post("/api/v1/sessions", json={"seed": 7})
            return Someone(client, made.headers["location"])

        yield someone


@pytest.fixture(scope="module")
def languages() -> Languages:
    return Languages.load()


async def test_what_one_teaches_no_other_has(at: At) -> None:
    one, two = await at("10.0.0.1"), await at("10.0.0.2")
    assert (await one.teach("splunge")).status_code == 200
    assert await one.say("splunge") == PAUSE
    assert await two.say("splunge") is None
    assert (await one.taught(), await two.taught()) == (["splunge"], [])
    assert await two.forget("splunge") == 422
    assert (await two.teach("splunge", RESUME)).status_code == 200
    assert (await one.say("splunge"), await two.say("splunge")) == (PAUSE, RESUME)
    assert await one.forget("splunge") == 200
    assert (await one.say("splunge"), await two.say("splunge")) == (None, RESUME)


async def test_what_this_machine_teaches_holds_for_everyone_but_for_who_knows_better(at: At) -> None:
    here, other = await at("127.0.0.1"), await at("10.0.0.1")
    await here.teach("splunge")
    assert await other.say("splunge") == PAUSE
    await other.teach("splunge", RESUME)
    await other.teach("splange", RESUME)
    assert (await here.say("splunge"), await other.say("splunge")) == (PAUSE, RESUME)
    assert await here.say("splange") is None
    await here.teach("splonge")
    assert await other.say("splonge") == PAUSE
    assert await other.forget("splunge") == 200
    assert await other.say("splunge") == PAUSE
    assert await here.forget("splonge") == 200
    assert await other.say("splonge") is None


async def test_one_owner_fills_its_own_list_only(at: At, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(aliases, "MAX_PHRASES", 2)
    one, two = await at("10.0.0.1"), await at("10.0.0.2")
    for phrase in ("splunge", "splange"):
        assert (await one.teach(phrase)).status_code == 200
    assert (await one.teach("splonge")).json()["type"] == "/problems/not-teachable"
    assert (await two.teach("splonge")).status_code == 200
    monkeypatch.setattr(aliases, "MAX_ALL_PHRASES", 3)
    assert "3 phrases" in (await two.teach("splinge")).json()["detail"]


PIECES = (
    "add",
    "remove",
    "what",
    "car",
    "and",
    "the",
    "please",
    "set the",
    "make it",
    "how many",
    "add three",
)


@pytest.mark.parametrize("phrase", PIECES)
async def test_a_piece_of_what_can_be_said_cannot_be_taught(at: At, phrase: str) -> None:
    one = await at("10.0.0.1")
    answer = await one.teach(phrase)
    assert (answer.status_code, answer.json()["type"]) == (422, "/problems/not-teachable")
    assert await one.taught() == []


async def test_phrases_of_all_owners_survive_a_restart_and_old_ones_are_everyones(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    for owner, key in ((LOCAL, "old"), ("client:10.0.0.1", "own")):
        await store.save_phrase(PhraseRecord(owner=owner, language="en", key=key, phrase=key, meaning=PAUSE))
    assert [each.key for each in await store.phrases()] == ["own", "old"]
    await store.close()
    app = create_app(Settings(database=f"sqlite:///{tmp_path}/roads.db"), clock=HandClock())
    async with app.router.lifespan_context(app):
        found = {}
        for address in ("127.0.0.1", "10.0.0.1", "10.0.0.2"):
            transport = httpx.ASGITransport(app, client=(address, 5_000))
            async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
                found[address] = await Someone(client, "").taught()
    assert found == {"127.0.0.1": ["old"], "10.0.0.1": ["old", "own"], "10.0.0.2": ["old"]}


@pytest.mark.parametrize(
    ("address", "owner"),
    [
        ("127.0.0.1", LOCAL),
        ("127.8.8.8", LOCAL),
        ("::1", LOCAL),
        ("::ffff:127.0.0.1", LOCAL),
        ("", LOCAL),
        ("10.0.0.1", "client:10.0.0.1"),
        ("::ffff:10.0.0.1", "client:10.0.0.1"),
        ("2001:db8:1:2:3:4:5:6", "client:2001:db8:1:2::/64"),
        ("2001:db8:1:2::9", "client:2001:db8:1:2::/64"),
        ("fe80::1%eth0", "client:fe80::/64"),
        ("somebody", "client:somebody"),
        ("x" * 100, "client:" + "x" * 57),
    ],
)
def test_an_owner_is_an_address(address: str, owner: str) -> None:
    assert owner_of(address) == owner
