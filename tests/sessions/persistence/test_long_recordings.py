"""A service takes the recordings that it made itself, however long; those of others have a limit."""

from __future__ import annotations

import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

TICKS = 30


@asynccontextmanager
async def serving(store: MemoryStore | None = None) -> AsyncIterator[Service]:
    """A service that replays no more ticks than few for others."""
    clock, store = HandClock(), store or MemoryStore()
    settings = Settings(database="memory:", max_recording_ticks=TICKS)
    app = create_app(settings, store=store, language=FewSentences(), clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


async def recorded(service: Service, ticks: int) -> tuple[str, dict[str, Any]]:
    path = await service.session(paused=True)
    await service.act(path, {"do": "add", "kind": "pothole", "count": 2})
    await service.client.post(f"{path}/step", json={"ticks": ticks})
    await service.act(path, {"do": "set", "parameter": "courtesy", "value": 0.3})
    return path, (await service.client.get(f"{path}/recording")).json()


async def test_what_a_service_exports_it_takes_also_after_a_restart() -> None:
    store = MemoryStore()
    async with serving(store) as service:
        path, recording = await recorded(service, TICKS + 20)
        assert len(recording["seal"]) == 64
        before = await service.state(path)
    async with serving(store) as service:
        copy = await service.session(seed=None, recording=json.loads(json.dumps(recording)))
        after = await service.state(copy)
    assert (after["tick"], after["digest"]) == (before["tick"], before["digest"])


async def test_a_short_one_needs_no_seal() -> None:
    async with serving() as service:
        _, recording = await recorded(service, TICKS - 5)
        assert "seal" not in recording


@pytest.mark.parametrize(
    "change", ["other service", "no seal", "config", "entry", "tick", "digest", "language"]
)
async def test_what_others_made_or_changed_has_the_limit(change: str) -> None:
    async with serving() as service:
        _, recording = await recorded(service, TICKS + 20)
        match change:
            case "no seal":
                del recording["seal"]
            case "config":
                recording["config"]["seed"] += 1
            case "entry":
                recording["entries"][0]["actions"][0]["count"] = 3
            case "tick":
                recording["tick"] += 1
            case "digest":
                recording["digest"] = "0" * 32
            case "language":
                recording["language"] = "en-x"
        if change == "other service":
            async with serving() as other:
                answer = await other.client.post("/api/v1/sessions", json={"recording": recording})
        else:
            answer = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert answer.status_code == 422
    if change != "language":
        (error,) = answer.json()["errors"]
        assert error["field"] == "recording.tick"
        assert f"is more than {TICKS} (ROADTALK_MAX_RECORDING_TICKS)" in error["message"]


async def test_a_fork_keeps_its_numbers_in_its_recording() -> None:
    async with serving() as service:
        path = await service.session(paused=True)
        for number in range(3):
            await service.act(path, {"do": "add", "kind": "pothole", "count": number + 1})
        await service.act(path, {"do": "undo"})
        forked = await service.client.post(f"{path}/forks", json={})
        fork = forked.headers["location"]
        await service.act(fork, {"do": "add", "kind": "barrier", "count": 1})
        recording = (await service.client.get(f"{fork}/recording")).json()
        state = await service.state(fork)
        assert [each["sequence"] for each in recording["entries"]] == [1, 2, 3]
        assert recording["entries"][-1]["sequence"] == state["sequence"]
        # Where a change was taken back in the parent, its number is left out.
        await service.act(path, {"do": "add", "kind": "barrier", "count": 1})
        forked = await service.client.post(f"{path}/forks", json={})
        recording = (await service.client.get(f"{forked.headers['location']}/recording")).json()
        assert [each["sequence"] for each in recording["entries"]] == [1, 2, 5]
        copy = await service.session(seed=None, recording=recording)
        assert (await service.state(copy))["digest"] == recording["digest"]
        assert (await service.state(copy))["sequence"] == 3


async def test_entries_in_no_order_are_refused() -> None:
    async with serving() as service:
        _, recording = await recorded(service, 5)
        recording["entries"].reverse()
        for entry in recording["entries"]:
            entry["tick"] = 0
        answer = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["field"] == "recording.entries.0"
