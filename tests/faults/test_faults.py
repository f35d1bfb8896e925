"""Faults of disk, file and clock inside one process; `test_cases` does them to a real service."""

from __future__ import annotations

import random
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import datetime, timedelta, tzinfo
from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI

from service.app import create_app
from service.sessions import manager
from service.settings import Settings
from service.store import StoreError

NOT_SAVED = "/problems/not-saved"


@asynccontextmanager
async def serving(database: Path) -> AsyncIterator[tuple[FastAPI, httpx.AsyncClient]]:
    app = create_app(Settings(database=f"sqlite:///{database}"))
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield app, client


async def made(client: httpx.AsyncClient) -> str:
    answer = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    assert answer.status_code == 201
    return str(answer.headers["location"])


async def until_refused(client: httpx.AsyncClient, path: str) -> tuple[list[str], httpx.Response]:
    """What was acknowledged, and the first answer that was not."""
    said: list[str] = []
    while True:
        text = f"set potholes to {1 + len(said) % 9}"
        answer = await client.post(f"{path}/commands", json={"text": text})
        if not answer.is_success:
            return said, answer
        said.append(text)
        assert len(said) < 5_000


async def texts(client: httpx.AsyncClient, path: str) -> list[str]:
    recording = await client.get(f"{path}/recording")
    assert recording.is_success, recording.text
    return [entry["text"] for entry in recording.json()["entries"]]


async def test_a_full_database_refuses_changes_and_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "roads.db"
    async with serving(path) as (app, client):
        session = await made(client)
        await until_warm(client, session)
        store = app.state.context.store
        async with store._transaction() as connection:
            pages = (await connection.exec_driver_sql("PRAGMA page_count")).scalar_one()
            await connection.exec_driver_sql(f"PRAGMA max_page_count={pages + 2}")
        said, refused = await until_refused(client, session)
        assert (refused.status_code, refused.json()["type"]) == (503, NOT_SAVED)
        assert "disk may be full" in refused.json()["detail"]
        before = (await client.get(f"{session}/state")).json()
        assert before["sequence"] == len(said) + 1
        async with store._transaction() as connection:
            await connection.exec_driver_sql("PRAGMA max_page_count=1073741823")
        again = await client.post(f"{session}/commands", json={"text": "set potholes to 4"})
        assert again.is_success
    async with serving(path) as (_, client):
        assert await texts(client, session) == ["add a pothole", *said, "set potholes to 4"]


async def until_warm(client: httpx.AsyncClient, path: str) -> None:
    """The first sentence loads what later ones share; that is no stall of the store's."""
    assert (await client.post(f"{path}/commands", json={"text": "add a pothole"})).is_success


@pytest.mark.parametrize("seed", [2, 4, 5])
async def test_a_damaged_file_is_told_or_was_not_needed(tmp_path: Path, seed: int) -> None:
    """Never an answer from what is damaged: refused at the start, or one session does not come back."""
    path = tmp_path / "roads.db"
    async with serving(path) as (_, client):
        session = await made(client)
        said = [f"set potholes to {n % 9}" for n in range(30)]
        for text in said:
            assert (await client.post(f"{session}/commands", json={"text": text})).is_success
        digest = (await client.get(f"{session}/state")).json()["digest"]
    dice, content = random.Random(seed), bytearray(path.read_bytes())
    for _ in range(3):
        at = dice.randrange(100, len(content) - 64)
        content[at : at + 64] = dice.randbytes(64)
    path.write_bytes(content)
    refusal, answer = "", None
    try:
        async with serving(path) as (_, client):
            answer = await client.get(f"{session}/state")
    except StoreError as error:
        refusal = str(error)
    if answer is None:
        assert str(path) in refusal
        assert path.read_bytes() == bytes(content)
    elif answer.is_success:
        assert answer.json()["digest"] == digest
    else:
        told = (503, "/problems/not-restorable"), (404, "/problems/unknown-session")
        assert (answer.status_code, answer.json()["type"]) in told


@pytest.mark.parametrize("days", [3, -400])
async def test_a_jump_of_the_clock_changes_no_order(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, days: int
) -> None:
    class Jumped(datetime):
        @classmethod
        def now(cls, tz: tzinfo | None = None) -> datetime:
            return datetime.now(tz) + timedelta(days=days)

    path, real = tmp_path / "roads.db", time.time
    async with serving(path) as (_, client):
        before = await made(client)
        await until_warm(client, before)
        monkeypatch.setattr(manager, "datetime", Jumped)
        monkeypatch.setattr(time, "time", lambda: real() + days * 86_400)
        after = await made(client)
        for text in ("add a pothole", "step 3"):
            assert (await client.post(f"{before}/commands", json={"text": text})).is_success
        listed = (await client.get("/api/v1/sessions")).json()
    async with serving(path) as (_, client):
        assert (await client.get("/api/v1/sessions")).json()["items"][0]["id"] in after
        assert await texts(client, before) == ["add a pothole", "add a pothole", "step 3"]
    assert [item["id"] for item in listed["items"]] == [each.rpartition("/")[2] for each in (after, before)]
