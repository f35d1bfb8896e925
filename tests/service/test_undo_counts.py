"""A state tells how many changes can be taken back and made again, and that many can."""

from __future__ import annotations

import pytest

from tests.service.conftest import Service

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


async def counts(service: Service, path: str) -> tuple[int, int]:
    state = await service.state(path)
    return state["undo"], state["redo"]
