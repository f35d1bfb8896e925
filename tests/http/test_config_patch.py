"""A patch of the configuration is a change like any other, and names each field it cannot change."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import httpx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from service.app import create_app
from service.http.routes.config import SETTABLE
from service.settings import Settings
from service.store import MemoryStore
from sim.config import Config
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

Json = dict[str, Any]


async def patched(service: Service, path: str, **parts: Any) -> httpx.Response:
    return await service.client.patch(f"{path}/config", json=parts)


async def config(service: Service, path: str) -> Json:
    return (await service.client.get(path)).json()["config"]  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    "parts",
    [
        {"courtesy": 0.5},
        {"planner": "astar"},
        {"traffic": "heavy"},
        {"spawn_probability": 0.2, "pothole_probability": 0.4},
        {"preferences": ["smooth_ride", "avoid_potholes"]},
        {"step_seconds": 0.25, "safety_buffer": 2},
        {"rows": 20, "columns": 6, "seed": 99, "courtesy": 1},
        {"rows": 20.0},
    ],
)
async def test_what_can_be_changed_is_and_is_told(service: Service, parts: Json) -> None:
    path = await service.session(paused=True)
    before = await config(service, path)
    answer = await patched(service, path, **parts)
    assert answer.status_code == 200, answer.text
    told, after = answer.json(), await config(service, path)
    assert {name: after[name] for name in parts} == parts
    assert told["sequence"] == (await service.state(path))["sequence"] == 1
    assert answer.headers["etag"] == '"1"'
    assert told["reply"]
    assert set(parts) & {change["path"].removeprefix("config.") for change in told["changes"]}
    undone = await service.act(path, {"do": "undo"})
    assert undone.status_code == 200
    assert await config(service, path) == before


async def test_it_is_logged_and_replays(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 3})
    await patched(service, path, planner="astar", traffic="light", preferences=["fastest"])
    await service.client.post(f"{path}/step", json={"ticks": 20})
    recording = (await service.client.get(f"{path}/recording")).json()
    dos = [action["do"] for action in recording["entries"][1]["actions"]]
    assert sorted(set(dos)) == ["prefer", "set"]
    again = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert again.status_code == 201, again.text
    assert again.json()["config"] == await config(service, path)


async def test_a_whole_configuration_may_be_sent_back(service: Service) -> None:
    path = await service.session(paused=True)
    whole = await config(service, path)
    same = await patched(service, path, **whole)
    assert (same.status_code, same.json()["changes"], same.json()["sequence"]) == (200, [], 0)
    other = await patched(service, path, **{**whole, "courtesy": 0.75})
    assert other.status_code == 200
    assert await config(service, path) == {**whole, "courtesy": 0.75}


async def test_null_asks_for_the_default(service: Service) -> None:
    path = await service.session(paused=True)
    await patched(service, path, courtesy=0.5, preferences=["fastest"])
    answer = await patched(service, path, courtesy=None, preferences=None)
    assert answer.status_code == 200, answer.text
    after = await config(service, path)
    assert (after["courtesy"], after["preferences"]) == (0.0, [])


async def test_each_field_that_cannot_be_changed_is_named(service: Service) -> None:
    path = await service.session(paused=True)
    before = await service.state(path)
    parts = {
        "cell_m": 3, "potholes": 4, "solvable": True, "sensor": "sonar", "courtesy": 7, "traffic": "wild",
        "wings": 2,
        "planner": ["astar"], "preferences": ["fastest", "cautious"], "rows": True,
    }  # fmt: skip
    refused = await patched(service, path, **parts)
    document = refused.json()
    assert (refused.status_code, document["type"]) == (422, "/problems/invalid")
    assert {error["field"] for error in document["errors"]} == set(parts)
    assert all(error["message"] for error in document["errors"])
    assert await service.state(path) == before


@pytest.mark.parametrize(
    ("parts", "fields"),
    [
        ({"traffic": "heavy", "spawn_probability": 0.1}, {"traffic"}),
        ({"columns": 64, "rows": 512}, {"columns", "rows"}),
        ({"planner": "rl", "courtesy": 0.5}, {"planner"}),
        ({"preferences": [["fastest"]]}, {"preferences"}),
    ],
)
async def test_what_cannot_be_together_is_refused(service: Service, parts: Json, fields: set[str]) -> None:
    path = await service.session(paused=True)
    refused = await patched(service, path, **parts)
    assert refused.status_code == 422, refused.text
    assert {error["field"] for error in refused.json()["errors"]} == fields
    assert (await service.state(path))["sequence"] == 0


async def test_it_takes_both_kinds_of_json_and_nothing_else(service: Service) -> None:
    path = f"{await service.session(paused=True)}/config"
    content = b'{"courtesy": 0.5}'
    for kind, status in (
        ("application/merge-patch+json", 200),
        ("application/json; charset=utf-8", 200),
        ("text/plain", 415),
        ("application/x-www-form-urlencoded", 415),
    ):
        answer = await service.client.patch(path, content=content, headers={"content-type": kind})
        assert answer.status_code == status, kind
    for content, status in ((b"[]", 422), (b"{", 400), (b"null", 422), (b'{"courtesy": NaN}', 400)):
        answer = await service.client.patch(
            path, content=content, headers={"content-type": "application/json"}
        )
        assert answer.status_code == status, content


async def test_keys_and_tags_hold_here_too(service: Service) -> None:
    path = await service.session(paused=True)
    headers = {"Idempotency-Key": "k", "If-Match": '"0"'}
    first, again = [
        await service.client.patch(f"{path}/config", json={"rows": 12}, headers=headers) for _ in range(2)
    ]
    assert (first.status_code, again.content) == (200, first.content)
    for parts in ({"rows": 14}, {"rows": 12}):
        stale = await service.client.patch(f"{path}/config", json=parts, headers={"If-Match": '"0"'})
        assert stale.status_code == 412
    assert (await config(service, path))["rows"] == 12


VALUES = st.one_of(
    st.none(), st.booleans(), st.integers(-5, 600), st.floats(-2, 2), st.integers(),
    st.sampled_from(["astar", "heavy", "fastest", "lidar", ""]), st.text(max_size=8),
    st.lists(st.sampled_from(["fastest", "cautious", "smooth_ride", 3]), max_size=3),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=1),
)  # fmt: skip
NAMES = st.sampled_from([*Config.__dataclass_fields__, *SETTABLE, "preferences", "wings"])


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(parts=st.dictionaries(NAMES, VALUES, max_size=4))
def test_any_patch_is_done_or_refused_whole(parts: Json) -> None:
    async def tried() -> None:
        app = APP
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
            path = (await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})).headers[
                "location"
            ]
            before = (await client.get(f"{path}/state")).json()
            answer = await client.patch(
                f"{path}/config", content=json.dumps(parts), headers={"content-type": "application/json"}
            )
            assert answer.status_code in (200, 400, 422), answer.text
            if answer.status_code != 200:
                assert (await client.get(f"{path}/state")).json() == before
            if answer.status_code == 422:
                assert {error["field"] for error in answer.json()["errors"]} <= {
                    *parts,
                    *Config.__dataclass_fields__,
                }
            await client.delete(path)

    asyncio.run(tried())


APP = create_app(
    Settings(database="memory:"), store=MemoryStore(), language=FewSentences(), clock=HandClock()
)
