"""What the vehicle sees, beside what is there."""

from __future__ import annotations

import pytest

from tests.support.service import Service


async def test_the_perfect_sensor_sees_what_is_there(service: Service) -> None:
    path = await service.session(paused=True, config={"weather": "fog"})
    told = (await service.client.get(f"{path}/percept")).json()
    state = await service.state(path)
    assert (told["sensor"], told["weather"], told["time_of_day"], told["missed"]) == (
        "perfect",
        "fog",
        "day",
        [],
    )
    assert (state["sensor"], state["weather"], state["time_of_day"]) == ("perfect", "fog", "day")
    there = {thing["id"]: thing["cell"] for thing in (*state["movers"], *state["hazards"])}
    assert {thing["id"]: thing["cell"] for thing in told["seen"]} == there
    assert all(thing["likelihood"] == 1.0 and thing["real"] for thing in told["seen"])


async def test_a_sensor_is_not_sure_and_misses_things_at_any_tick(service: Service) -> None:
    parts = {"sensor": "fusion", "weather": "rain", "potholes": 20, "vehicles": 20}
    path = await service.session(seed=4, paused=True, config=parts)
    looks = []
    for tick in range(6):
        told = (await service.client.get(f"{path}/percept")).json()
        state = await service.state(path)
        assert told["tick"] == tick
        there = {thing["id"]: thing["cell"] for thing in (*state["movers"], *state["hazards"])}
        for thing in told["seen"]:
            assert thing["real"] is (there.get(thing["id"]) == thing["cell"])
            assert 0.5 <= thing["likelihood"] <= 1.0
            assert set(thing["sensors"]) <= {"camera", "lidar", "radar"}
        right = {thing["id"] for thing in told["seen"] if thing["real"]}
        assert set(told["missed"]) == set(there) - right
        looks.append(told)
        await service.client.post(f"{path}/step", json={"ticks": 1})
    assert any(len(thing["sensors"]) > 1 for told in looks for thing in told["seen"])
    for told in looks:
        again = await service.client.get(f"{path}/percept", params={"tick": told["tick"]})
        assert again.json() == told


@pytest.mark.parametrize("query", [{"tick": 99}, {"tick": -1}, {"ticks": 1}])
async def test_what_cannot_be_asked_is_refused(service: Service, query: dict[str, int]) -> None:
    path = await service.session(paused=True)
    assert (await service.client.get(f"{path}/percept", params=query)).status_code in (404, 422)
