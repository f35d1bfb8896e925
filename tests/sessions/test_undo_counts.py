"""A state tells how many changes can be taken back and made again, and that many can."""

from __future__ import annotations

import pytest

from tests.support.service import Service

SAID = [
    ("add two cars", (1, 0)),
    ("pause", (1, 0)),
    ("add two cars", (2, 0)),
    ("undo", (1, 1)),
    ("redo", (2, 0)),
    ("undo", (1, 1)),
    ("add two cars", (2, 0)),
]


async def test_states_count_what_can_be_undone(service: Service) -> None:
    path = await service.session()
    assert await counts(service, path) == (0, 0)
    for text, (undo, redo) in SAID:
        await service.say(path, text)
        assert await counts(service, path) == (undo, redo), text


@pytest.mark.parametrize("extra", [0, 1])
async def test_that_many_can_be_undone_and_not_one_more(service: Service, extra: int) -> None:
    path = await service.session()
    for text, _ in SAID:
        await service.say(path, text)
    undo, _ = await counts(service, path)
    actions = [{"do": "undo"}] * (undo + extra)
    answer = await service.client.post(f"{path}/actions", json={"actions": actions})
    assert answer.is_success == (extra == 0)
    assert await counts(service, path) == ((0, undo) if extra == 0 else (undo, 0))


async def test_an_undo_that_lets_time_go_on_says_so(service: Service) -> None:
    """A pause that came with a change is given back with it."""
    path = await service.session()
    await service.say(path, "pause and add two cars")
    undone = (await service.say(path, "undo")).json()
    assert {"path": "paused", "before": True, "after": False} in undone["changes"]
    assert undone["reply"].endswith(" Running.")
    assert "True" not in undone["reply"]
    assert (await service.state(path))["paused"] is False
    again = (await service.say(path, "redo")).json()
    assert {"path": "paused", "before": False, "after": True} in again["changes"]


async def test_an_undo_that_leaves_the_clock_alone_does_not(service: Service) -> None:
    path = await service.session()
    await service.say(path, "add two cars")
    undone = (await service.say(path, "undo")).json()
    assert [each["path"] for each in undone["changes"]] == ["vehicles"]
    assert "unning" not in undone["reply"]


async def counts(service: Service, path: str) -> tuple[int, int]:
    state = await service.state(path)
    return state["undo"], state["redo"]
