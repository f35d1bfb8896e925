"""A run at a glance: what is told in letters and marks is what the decisions and the worlds say."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from tests.support.service import Json, Service

LETTERS = {
    "forward": "F",
    "left": "L",
    "right": "R",
    "forward_left": "l",
    "forward_right": "r",
    "stay": "s",
}


async def asked(service: Service, path: str, **query: object) -> dict[str, Any]:
    answer = await service.client.get(path, params={key.rstrip("_"): value for key, value in query.items()})  # type: ignore[misc]
    assert answer.status_code == 200, answer.text
    told: dict[str, Any] = answer.json()
    return told


async def stepped(service: Service, ticks: int, *said: tuple[int, Json]) -> str:
    """A session's path, after so many ticks, something having been done at some of them."""
    path = await service.session(paused=True)
    now = 0
    for tick, action in said:
        if tick > now:
            await service.client.post(f"{path}/step", json={"ticks": tick - now})
        now = tick
        assert (await service.act(path, action)).status_code == 200
    await service.client.post(f"{path}/step", json={"ticks": ticks - now})
    return path


async def test_each_letter_is_the_decision_of_its_tick(service: Service) -> None:
    path = await stepped(
        service, 260, (40, {"do": "reset"}), (41, {"do": "set_count", "kind": "vehicle", "count": 9})
    )
    told = await asked(service, f"{path}/timeline")
    assert (told["from"], told["now"], told["more"], len(told["moves"])) == (0, 260, False, 260)
    decisions = (await asked(service, f"{path}/decisions", after=-1, limit=200))["items"]
    decisions += (await asked(service, f"{path}/decisions", after=199, limit=200))["items"]
    expected = ["-"] * 260
    for decision in decisions:
        expected[decision["tick"]] = LETTERS[decision["move"]]
    assert told["moves"] == "".join(expected)
    assert {"F", "-"} < set(told["moves"])


async def test_pages_together_are_the_whole(service: Service) -> None:
    path = await stepped(service, 300, (100, {"do": "add", "kind": "vehicle", "count": 5}))
    whole = await asked(service, f"{path}/timeline")
    pages = [await asked(service, f"{path}/timeline", from_=first, limit=70) for first in range(0, 300, 70)]
    assert "".join(page["moves"] for page in pages) == whole["moves"]
    assert [mark for page in pages for mark in page["marks"]] == whole["marks"]
    assert [page["more"] for page in pages] == [True, True, True, True, False]
    empty = await asked(service, f"{path}/timeline", from_=300)
    assert (empty["moves"], empty["more"]) == ("", False)


async def test_marks_are_where_the_worlds_say(service: Service) -> None:
    path = await stepped(service, 400, (0, {"do": "add", "kind": "vehicle", "count": 6}))
    told = await asked(service, f"{path}/timeline")
    worlds = []
    for first in range(0, 401, 64):
        worlds += [
            each["state"]
            for each in (await asked(service, f"{path}/moments", from_=first, limit=64))["items"]
        ]
    assert [world["tick"] for world in worlds] == list(range(401))
    ends, near, begins = [], [], [0]
    for before, after in pairwise(worlds):
        if before["episode"] != after["episode"]:
            begins.append(after["tick"])
            continue
        if before["status"] != "running":
            continue
        if after["status"] != "running":
            ends.append((after["tick"], after["status"]))
        left, came = before["vehicles"][0]["cell"], after["vehicles"][0]["cell"]
        if left != came:
            near += [(after["tick"], [mover["id"]]) for mover in after["movers"] if mover["cell"] == left]
    marks = told["marks"]
    assert [
        (mark["tick"], mark["kind"]) for mark in marks if mark["kind"] in ("crash", "success", "stuck")
    ] == ends
    assert [(mark["tick"], mark["ids"]) for mark in marks if mark["kind"] == "near_miss"] == near
    assert [mark["tick"] for mark in marks if mark["kind"] == "episode"] == begins
    assert len(near) > 3
    assert len(ends) > 3


async def test_moments_are_what_state_and_decisions_tell(service: Service) -> None:
    path = await stepped(service, 30, (9, {"do": "add", "kind": "barrier", "count": 1}))
    items = (await asked(service, f"{path}/moments", from_=8, limit=4))["items"]
    for item in items:
        tick = item["state"]["tick"]
        assert item["state"] == await asked(service, f"{path}/state", tick=tick)
        assert item["decision"] == await asked(service, f"{path}/decisions/{tick - 1}")
    assert [item["state"]["tick"] for item in items] == [8, 9, 10, 11]
    first = (await asked(service, f"{path}/moments", from_=0, limit=1))["items"]
    assert first[0]["decision"] is None
    last = await asked(service, f"{path}/moments", from_=28, limit=64)
    assert [item["state"]["tick"] for item in last["items"]] == [28, 29, 30]


async def test_changes_are_those_that_stand(service: Service) -> None:
    path = await stepped(service, 12, (3, {"do": "add", "kind": "pothole", "count": 2}))
    assert (await service.say(path, "add five potholes")).status_code == 200
    told = (await asked(service, f"{path}/changes"))["items"]
    assert [(each["tick"], each["said"]) for each in told] == [(3, False), (12, True)]
    assert told[1]["text"] == "add five potholes"
    assert "pothole" in told[0]["text"] or told[0]["text"] == "add"
    assert (await service.act(path, {"do": "undo"})).status_code == 200
    assert (await asked(service, f"{path}/changes"))["items"] == told[:1]
    assert await asked(service, f"{path}/changes", limit=1) == {"items": told[:1], "more": False}


@pytest.mark.parametrize("part", ["timeline", "moments"])
async def test_what_has_not_come_yet_is_not_told(service: Service, part: str) -> None:
    path = await service.session(paused=True)
    answer = await service.client.get(f"{path}/{part}", params={"from": 1})
    assert answer.status_code == 422
    assert answer.json()["errors"] == [{"field": "from", "message": "has not come yet: it is tick 0"}]
    answer = await service.client.get(f"{path}/{part}", params={"limit": 5_000})
    assert answer.status_code == 422
