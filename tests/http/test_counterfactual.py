"""Another run beside the real one: the same as a fork would drive, and nothing here is touched by it."""

from __future__ import annotations

from typing import Any

from tests.support.service import Service

Json = dict[str, Any]
MOVES = ("forward", "left", "right", "forward_left", "forward_right", "stay")


async def otherwise(service: Service, path: str, **body: object) -> Json:
    answer = await service.client.post(f"{path}/counterfactual", json=body)
    assert answer.status_code == 200, answer.text
    return answer.json()  # type: ignore[no-any-return]


def last_cell(side: Json) -> list[int]:
    return side["ticks"][-1]["vehicles"]["av-1"]  # type: ignore[no-any-return]


async def test_the_real_side_is_what_happens(service: Service) -> None:
    path = await service.session(paused=True)
    found = await otherwise(service, path, actions=[{"do": "remove", "kind": "everything", "count": "all"}])
    driven = found["real"]["end"]["driven"]
    await service.client.post(f"{path}/step", json={"ticks": driven})
    state = await service.state(path)
    assert state["digest"] == found["real"]["end"]["digest"]
    assert state["tick"] == found["real"]["end"]["tick"] == found["real"]["ticks"][-1]["tick"]
    assert state["status"] == found["real"]["end"]["outcome"]
    assert [list(each["cell"]) for each in state["vehicles"]] == [last_cell(found["real"])]  # type: ignore[attr-defined]


async def test_the_other_side_is_what_a_fork_drives(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 6})
    change = [{"do": "remove", "kind": "everything", "count": "all"}]
    found = await otherwise(service, path, at_tick=3, actions=change)
    fork = await service.client.post(f"{path}/forks", json={"at_tick": 3, "actions": change})
    there = fork.headers["location"]
    await service.client.post(f"{there}/step", json={"ticks": found["changed"]["end"]["driven"]})
    assert (await service.state(there))["digest"] == found["changed"]["end"]["digest"]
    assert found["changed"]["state"]["hazards"] == found["changed"]["state"]["movers"] == []
    assert found["real"]["state"]["tick"] == found["at_tick"] == 3


async def test_a_rejected_move_is_driven_whatever_it_meets(service: Service) -> None:
    path = await service.session(paused=True)
    cell = (await service.state(path))["vehicles"][0]["cell"]  # type: ignore[index]
    ahead = [cell[0], cell[1] - 1]
    await service.act(path, {"do": "remove", "kind": "everything", "count": "all"})
    await service.act(path, {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": ahead}})
    await service.client.post(f"{path}/step", json={"ticks": 2})
    found = await otherwise(service, path, at_tick=0, move="forward")
    assert found["instead_of"] != "forward"
    assert found["changed"]["end"]["outcome"] == "crash"
    assert found["changed"]["end"]["cause"]["kind"] == "barrier"
    assert [tick["status"] for tick in found["changed"]["ticks"]] == ["crash"]
    assert found["changed"]["ticks"][0]["decision"]["move"] == "forward"
    assert found["real"]["end"]["outcome"] == "success"
    assert found["real"]["ticks"][0]["decision"]["move"] == found["instead_of"]


async def test_nothing_is_changed_and_nothing_is_made(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 4})
    before = await service.state(path)
    decided = (await service.client.get(f"{path}/decisions/3")).json()["move"]
    for move in MOVES:
        await service.client.post(f"{path}/counterfactual", json={"at_tick": 3, "move": move})
    assert await service.state(path) == before
    sessions = (await service.client.get("/api/v1/sessions")).json()["items"]
    assert len(sessions) == 1
    assert decided in MOVES


async def test_only_so_many_ticks_are_told(service: Service) -> None:
    path = await service.session(paused=True)
    change = [{"do": "mode", "mode": "auto"}]
    found = await otherwise(service, path, actions=change, ticks=3)
    assert [len(found[side]["ticks"]) for side in ("real", "changed")] == [3, 3]
    assert found["real"]["end"]["outcome"] == "success"
    assert found["real"]["end"]["driven"] > 3


async def test_what_was_said_since_is_left_out_and_told(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 2})
    await service.act(path, {"do": "add", "kind": "pothole", "count": 3})
    change = [{"do": "remove", "kind": "everything", "count": "all"}]
    assert (await otherwise(service, path, at_tick=1, actions=change))["said_since"] == 1
    assert (await otherwise(service, path, at_tick=2, actions=change))["said_since"] == 0


async def test_a_person_who_drives_is_followed_by_the_planner(service: Service) -> None:
    path = await service.session(paused=True)
    await service.act(path, {"do": "mode", "mode": "manual"}, {"do": "drive", "move": "forward"})
    await service.client.post(f"{path}/step", json={"ticks": 1})
    found = await otherwise(service, path, at_tick=0, move="stay")
    assert found["instead_of"] == "forward"
    assert found["changed"]["end"]["driven"] < 100
    assert not found["changed"]["end"]["by_hand"]


async def test_what_cannot_be_is_refused_with_the_reason(service: Service) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 2})
    made = (await service.client.get(f"{path}/decisions/1")).json()["move"]
    column = (await service.state(path))["vehicles"][0]["cell"]  # type: ignore[index]
    refused = {
        "already made": ({"at_tick": 1, "move": made}, "That is the move that was made."),
        "to come": ({"at_tick": 99, "move": "stay"}, "Tick 99 has not come yet: it is tick 2."),
        "both": (
            {"move": "stay", "actions": [{"do": "reset"}]},
            "say either a move, actions or two planners",
        ),
        "neither": ({}, "actions or two planners"),
        "no change": ({"actions": [{"do": "pause"}]}, "changes nothing on the road"),
        "not there": (
            {"actions": [{"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "pothole-99"}}]},
            "There is no pothole-99 on the road.",
        ),
        "taken": (
            {"actions": [{"do": "add", "kind": "barrier", "count": 1, "where": {"cell": column}}]},
            "is taken by the autonomous vehicle",
        ),
    }
    for name, (body, words) in refused.items():
        answer = await service.client.post(f"{path}/counterfactual", json=body)
        assert answer.status_code == 422, name
        assert words in answer.text, name


async def test_two_planners_drive_the_same_road_from_where_its_episode_began(service: Service) -> None:
    path = await service.session(paused=True, seed=16, config={"vehicles": 24})
    await service.client.post(f"{path}/step", json={"ticks": 6})
    before = (await service.state(path))["digest"]
    found = await otherwise(service, path, planners=["rules", "dijkstra"])
    assert found["at_tick"] == 0
    for side, planner in (("real", "rules"), ("changed", "dijkstra")):
        assert {tick["decision"]["planner"] for tick in found[side]["ticks"]} == {planner}
    assert found["real"]["state"]["movers"] == found["changed"]["state"]["movers"]
    part = found["parting"]
    moves = {
        side: [tick["decision"]["move"] for tick in found[side]["ticks"]] for side in ("real", "changed")
    }
    assert moves["real"][: part["tick"]] == moves["changed"][: part["tick"]]
    assert part["real"]["move"] == moves["real"][part["tick"]]
    assert part["changed"]["move"] == moves["changed"][part["tick"]]
    assert part["real"]["move"] != part["changed"]["move"]
    assert part["real"]["text"] != part["changed"]["text"]
    assert (await otherwise(service, path, planners=["bfs", "bfs"]))["parting"] is None
    assert (await service.state(path))["digest"] == before


async def test_a_planner_that_there_is_not_is_refused_by_name(service: Service) -> None:
    path = await service.session(paused=True)
    bodies: list[Json] = [
        {"planners": ["rules", "flibber"]},
        {"planners": ["rules"]},
        {"planners": ["rules", "bfs"], "move": "stay"},
    ]
    for body in bodies:
        answer = await service.client.post(f"{path}/counterfactual", json=body)
        assert answer.status_code in (409, 422), answer.text
