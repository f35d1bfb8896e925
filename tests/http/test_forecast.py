"""What is expected happens, what is judged is what was decided, and nothing is changed by asking."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.service import Json, Service


async def asked(service: Service, path: str, **query: object) -> Json:
    answer = await service.client.get(path, params={key.rstrip("_"): value for key, value in query.items()})  # type: ignore[misc]
    assert answer.status_code == 200, answer.text
    told: dict[str, Any] = answer.json()
    return told


async def stepped(service: Service, ticks: int) -> str:
    path = await service.session(paused=True)
    if ticks:
        await service.client.post(f"{path}/step", json={"ticks": ticks})
    return path


async def test_what_is_foretold_happens(service: Service) -> None:
    path = await service.session(paused=True, config={"attentive": 0.0})
    await service.client.post(f"{path}/step", json={"ticks": 3})
    told = await asked(service, f"{path}/forecast", ticks=4)
    assert (told["tick"], told["exact"], len(told["ahead"])) == (3, True, 4)
    for expected in told["ahead"]:
        await service.client.post(f"{path}/step", json={"ticks": 1})
        state = await service.state(path)
        assert expected["tick"] == state["tick"]
        assert expected["movers"] == {mover["id"]: mover["cell"] for mover in state["movers"]}


async def test_what_is_about_to_be_decided_is_decided(service: Service) -> None:
    path = await stepped(service, 3)
    for tick in range(3, 12):
        told = await asked(service, f"{path}/forecast")
        await service.client.post(f"{path}/step", json={"ticks": 1})
        assert told["decision"] == await asked(service, f"{path}/decisions/{tick}")
    assert await asked(service, f"{path}/forecast", tick=11) == told
    await service.client.post(f"{path}/step", json={"ticks": 100})
    states = [await asked(service, f"{path}/state", tick=tick) for tick in range(12, 112)]
    ended = next(state["tick"] for state in states if state["status"] != "running")
    assert (await asked(service, f"{path}/forecast", tick=ended))["decision"] is None


async def test_the_path_is_the_one_that_is_driven(service: Service) -> None:
    path = await service.session(seed=9, paused=True)
    assert "path" not in await asked(service, f"{path}/forecast")
    told = await asked(service, f"{path}/forecast", path_=16)
    for cell in told["path"]:
        await service.client.post(f"{path}/step", json={"ticks": 1})
        assert (await service.state(path))["vehicles"][0]["cell"] == cell
    assert await asked(service, f"{path}/forecast", path_=16, tick=0) == told
    assert (await service.state(path))["status"] == "running"


async def test_a_path_ends_with_its_episode(service: Service) -> None:
    path = await service.session(seed=9, paused=True, config={"rows": 12})
    for _ in range(30):
        told = await asked(service, f"{path}/forecast", path_=4)
        if len(told["path"]) < 4:
            break
        await service.client.post(f"{path}/step", json={"ticks": 1})
    await service.client.post(f"{path}/step", json={"ticks": len(told["path"])})
    state = await service.state(path)
    assert state["status"] != "running"
    assert state["vehicles"][0]["cell"] == told["path"][-1]
    assert (await asked(service, f"{path}/forecast", path_=4))["path"] == []


async def test_a_path_of_too_many_ticks_is_refused(service: Service) -> None:
    path = await service.session(paused=True)
    answer = await service.client.get(f"{path}/forecast", params={"path": 17})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["field"] == "path"


async def test_what_is_left_to_chance_is_not_called_exact(service: Service) -> None:
    path = await service.session(paused=True, config={"attentive": 0.0})
    await service.client.post(f"{path}/step", json={"ticks": 1})
    assert (await asked(service, f"{path}/forecast", ticks=2))["exact"] is True
    await service.act(path, {"do": "set", "parameter": "attentive", "value": 1})
    assert (await asked(service, f"{path}/forecast", ticks=2))["exact"] is False
    await service.act(path, {"do": "set", "parameter": "attentive", "value": 0})
    await service.act(path, {"do": "set", "parameter": "courtesy", "value": 0.5})
    assert (await asked(service, f"{path}/forecast", ticks=1))["exact"] is True
    assert (await asked(service, f"{path}/forecast", ticks=2))["exact"] is False


async def test_decisions_are_judged_as_they_were_taken(service: Service) -> None:
    path = await stepped(service, 50)
    before = await service.state(path)
    told = await asked(service, f"{path}/regret")
    decisions = (await asked(service, f"{path}/decisions", after=-1, limit=200))["items"]
    assert [(each["tick"], each["move"]) for each in told["items"]] == [
        (each["tick"], each["move"]) for each in decisions
    ]
    for judged, decision in zip(told["items"], decisions, strict=True):
        options = decision["options"]
        assert judged["blocked"] == sum(option["verdict"] != "free" for option in options)
        assert judged["ticks"] is None or judged["ticks"] >= 0
    assert any(judged["blocked"] for judged in told["items"])
    assert await service.state(path) == before


async def test_pages_together_are_the_whole(service: Service) -> None:
    path = await stepped(service, 40)
    whole = await asked(service, f"{path}/regret")
    assert (whole["from"], whole["now"], whole["more"]) == (0, 40, False)
    pages = [await asked(service, f"{path}/regret", from_=first, limit=15) for first in (0, 15, 30)]
    assert [page["more"] for page in pages] == [True, True, False]
    assert [each for page in pages for each in page["items"]] == whole["items"]


async def test_a_move_that_closes_the_road_is_told_as_lost(service: Service) -> None:
    path = await stepped(service, 0)
    column, row = (await service.state(path))["vehicles"][0]["cell"]
    await service.act(path, {"do": "remove", "kind": "everything", "count": "all"})
    await service.act(path, {"do": "mode", "mode": "manual"})
    await service.act(
        path, {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}}
    )
    await service.act(path, {"do": "drive", "move": "left"})
    await service.client.post(f"{path}/step", json={"ticks": 1})
    (judged,) = (await asked(service, f"{path}/regret"))["items"]
    assert (judged["move"], judged["lost"], judged["ticks"]) == ("left", False, 1)
    assert judged["clearance_m"] == 5.0


@pytest.mark.parametrize(
    ("route", "query"),
    [
        ("forecast", {"ticks": 0}),
        ("forecast", {"ticks": 17}),
        ("forecast", {"tick": 3}),
        ("regret", {"from": 99}),
        ("regret", {"from": -1}),
        ("regret", {"limit": 201}),
    ],
)
async def test_what_cannot_be_asked_is_refused(service: Service, route: str, query: Json) -> None:
    path = await stepped(service, 2)
    answer = await service.client.get(f"{path}/{route}", params=query)
    assert answer.status_code == 422
    assert answer.json()["type"] == "/problems/invalid"
    assert (await service.client.get(f"/api/v1/sessions/none/{route}")).status_code == 404
