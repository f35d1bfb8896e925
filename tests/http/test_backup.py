"""`/backup`: everything as one file; sessions come back from it as they were."""

from __future__ import annotations

import asyncio
from pathlib import Path

import httpx
import pytest

from service.app import create_app
from service.client import AsyncClient, NotAllowed, Refused
from service.client.errors import UnexpectedAnswer
from service.settings import Settings
from service.store import StoreError
from service.store.restore import restore_database
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service, service, settings

__all__ = ["service", "settings"]
KEY = "a-key-that-is-only-for-this"


def at(database: Path, **more: object) -> Settings:
    return Settings(database=f"sqlite:///{database}", **more)  # type: ignore[arg-type]


def names_in(folder: Path) -> list[str]:
    return [each.name for each in folder.iterdir()]


async def digests(settings: Settings, sessions: list[str]) -> list[object]:
    """Each session's tick, sequence and digest, by a service that has just started."""
    app = create_app(settings, language=FewSentences(), clock=HandClock())
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        states = [(await client.get(f"{path}/state")).json() for path in sessions]
    return [(each["tick"], each["sequence"], each["digest"]) for each in states]


async def test_all_sessions_come_back_from_a_backup_to_their_digests(tmp_path: Path) -> None:
    meant = at(tmp_path / "roads.db")
    app = create_app(meant, language=FewSentences(), clock=HandClock())
    async with (
        app.router.lifespan_context(app),
        AsyncClient("http://service", transport=httpx.ASGITransport(app)) as client,
    ):
        made = [await client.create(seed=seed, paused=True) for seed in (7, 11, 13)]
        for session in made:
            await session.step(5)
            await session.act({"do": "add", "kind": "barrier", "count": 2})
        made.append(await made[0].fork(at_tick=3))
        paths = [f"/api/v1/sessions/{each.id}" for each in made]
        expected = [(s.tick, s.sequence, s.digest) for s in [await each.state() for each in made]]
        backup = await client.backup(tmp_path / "copy.db")
        await made[0].act({"do": "add", "kind": "barrier", "count": 1})
        text = (await client._http.get("/metrics")).text
    assert backup.path == tmp_path / "copy.db"
    assert 'roadtalk_backups_total{fate="made"} 1.0' in text
    await restore_database(tmp_path / "copy.db", f"sqlite:///{tmp_path}/other.db", replace=False)
    found = await digests(at(tmp_path / "other.db"), paths)
    assert [each[1:] for each in found] == [each[1:] for each in expected]  # type: ignore[index]


async def test_one_is_made_at_a_time_and_nothing_is_left(service: Service) -> None:
    await service.session()
    begun, go_on = asyncio.Event(), asyncio.Event()
    copy = service.store.backup

    async def slow(target: Path) -> None:
        begun.set()
        await go_on.wait()
        await copy(target)

    service.store.backup = slow  # type: ignore[method-assign]
    first = asyncio.create_task(service.client.get("/api/v1/backup"))
    await begun.wait()
    second = await service.client.get("/api/v1/backup")
    assert (second.status_code, second.json()["type"]) == (409, "/problems/backup-under-way")
    go_on.set()
    answer = await first
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "application/octet-stream"
    assert len(answer.content) == int(answer.headers["content-length"])
    assert (await service.client.get("/api/v1/backup")).status_code == 200


async def test_a_failure_is_told_and_the_next_one_may_be_made(service: Service) -> None:
    copy = service.store.backup

    full = True

    async def fails(target: Path) -> None:
        if full:
            raise StoreError("the disk is full")
        await copy(target)

    service.store.backup = fails  # type: ignore[method-assign]
    refused = await service.client.get("/api/v1/backup")
    assert (refused.status_code, refused.json()["type"]) == (503, "/problems/backup-failed")
    assert 'roadtalk_backups_total{fate="failed"} 1.0' in (await service.client.get("/metrics")).text
    full = False
    assert (await service.client.get("/api/v1/backup")).status_code == 200


async def test_it_needs_the_key_and_no_page_of_another_site_gets_it(tmp_path: Path) -> None:
    app = create_app(Settings(database="memory:", api_key=KEY), language=FewSentences(), clock=HandClock())  # type: ignore[arg-type]
    transport = httpx.ASGITransport(app)
    async with app.router.lifespan_context(app):
        async with AsyncClient("http://service", transport=transport) as client:
            with pytest.raises(NotAllowed):
                await client.backup(tmp_path / "copy.db")
        async with AsyncClient("http://service", transport=transport, api_key=KEY) as client:
            await client.backup(tmp_path / "copy.db")
            evil = await client._http.get("/api/v1/backup", headers={"Origin": "http://evil.example"})
    assert evil.status_code == 403


async def test_a_client_leaves_no_file_where_it_is_refused_or_cut_off(tmp_path: Path) -> None:
    def answer(request: httpx.Request) -> httpx.Response:
        if "refuse" in str(request.url.host):
            return httpx.Response(409, json={"detail": "later", "type": "/problems/backup-under-way"})
        return httpx.Response(200, text="hello")

    for host, error in (("refuse", Refused), ("other", UnexpectedAnswer)):
        async with AsyncClient(f"http://{host}", transport=httpx.MockTransport(answer)) as client:
            with pytest.raises(error):
                await client.backup(tmp_path / "copy.db")
    assert names_in(tmp_path) == []
