"""Undo and redo of several steps at once: as if they were taken back one by one."""

from __future__ import annotations

from typing import Any

import pytest

from service import actions as contract
from service.sessions.transaction import Transaction
from service.sessions.undo_stack import UndoStack
from sim.config import Config
from sim.session.timeline import Timeline
from tests.support.service import Service

Json = dict[str, Any]

POTHOLE: Json = {"do": "add", "kind": "pothole", "count": 2}
CONE: Json = {"do": "add", "kind": "barrier", "count": 1}
FASTER: Json = {"do": "set", "parameter": "playback_speed", "value": 4}

HISTORIES: dict[str, list[Json]] = {
    "world": [POTHOLE, CONE, POTHOLE],
    "ticks": [POTHOLE, {"do": "step", "ticks": 3}, CONE, {"do": "step", "ticks": 2}, POTHOLE],
    "speed": [POTHOLE, FASTER, CONE],
    "rewound": [POTHOLE, {"do": "step", "ticks": 4}, CONE, {"do": "rewind", "ticks": 3}, POTHOLE],
    "loaded": [POTHOLE, {"do": "save", "name": "a"}, CONE, {"do": "load", "name": "a"}, CONE, FASTER],
}


async def standing(service: Service, path: str) -> Json:
    state = await service.state(path)
    return {key: state[key] for key in ("digest", "tick", "playback_speed", "undo", "redo", "paused")}


@pytest.mark.parametrize("history", HISTORIES.values(), ids=HISTORIES)
async def test_several_steps_at_once_are_the_same_as_one_by_one(
    service: Service, history: list[Json]
) -> None:
    together, apart = await service.session(), await service.session()
    for action in history:
        for path in (together, apart):
            assert (await service.act(path, action)).is_success
    before, steps = await standing(service, together), (await standing(service, together))["undo"]
    assert steps >= 3
    assert (await service.act(together, {"do": "undo", "steps": steps})).is_success
    for _ in range(steps):
        assert (await service.act(apart, {"do": "undo"})).is_success
    assert await standing(service, together) == await standing(service, apart)
    assert (await service.act(together, {"do": "redo", "steps": "all"})).is_success
    assert await standing(service, together) == before


async def test_more_steps_than_there_are_change_nothing(service: Service) -> None:
    path = await service.session()
    await service.act(path, POTHOLE)
    before = await standing(service, path)
    refused = await service.act(path, {"do": "undo", "steps": 3})
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["field"] == "actions.0.steps"
    assert await standing(service, path) == before


async def test_undo_everything_is_one_utterance_that_is_redone_step_by_step(service: Service) -> None:
    path = await service.session()
    for action in (POTHOLE, CONE, FASTER):
        await service.act(path, action)
    undone = (await service.act(path, {"do": "undo", "steps": "all"})).json()
    assert {change["path"] for change in undone["changes"]} == {"potholes", "barriers", "playback_speed"}
    assert (await standing(service, path))["redo"] == 3
    await service.act(path, {"do": "redo"})
    assert (await standing(service, path))["undo"] == 1


def test_undo_of_an_old_log_passes_over_the_playback_speed() -> None:
    timeline = Timeline(Config(seed=7))
    transaction = Transaction(timeline, True, UndoStack(), stored=True)
    for sequence, action in enumerate((POTHOLE, FASTER, {"do": "undo"}), start=1):
        transaction.perform(sequence, contract.load([action]))
    assert transaction.timeline.state.world.digest() == timeline.state.world.digest()
    assert transaction.playback_speed == 4
    transaction.perform(4, contract.load([{"do": "redo"}]))
    assert transaction.timeline.state.world.digest() != timeline.state.world.digest()
    transaction.perform(5, contract.load([{"do": "undo", "steps": 2}]))
    assert transaction.playback_speed == 1.0
