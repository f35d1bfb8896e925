"""Names for moments: kept with the session, and gone back to as a step that can be undone."""

from __future__ import annotations

import pytest

from service.problems import Invalid, UnknownName
from service.sessions.bookmarks import MAX_BOOKMARKS
from tests.support.service import Service as Http
from tests.support.session_talk import load, save
from tests.support.sessions import ADD, ADD_CARS, UNDO, Service, do, potholes


async def test_saved_and_loaded_and_taken_back() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(5)
    await do(session, ADD)
    assert await do(session, save("monday")) == "Saved as “monday”, at tick 5."
    five = session.run
    service.clock.tick(5)
    await do(session, ADD_CARS)
    ten = session.run
    assert await do(session, load("monday")) == "At “monday” again, tick 5."
    assert session.run == five
    service.clock.tick(1)
    await do(session, UNDO)
    assert session.run == ten
    await do(session, UNDO)
    await do(session, UNDO)
    assert potholes(session) == 4
    await do(session, load("monday"))
    assert session.run == five, "a name outlives what is taken back"


async def test_forward_again_by_name() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(9)
    await do(session, ADD)
    await do(session, save("later"))
    nine = session.run
    await do(session, {"do": "rewind", "ticks": 7})
    await do(session, load("later"))
    assert session.run == nine


async def test_a_name_used_again_is_the_newer_moment_also_after_a_restart() -> None:
    service = Service()
    session = await service.session()
    await do(session, save("here"))
    service.clock.tick(4)
    assert "in place of" in await do(session, save("here"))
    service.clock.tick(4)
    await service.manager.close()
    session = await Service(service.store).manager.get(session.id)
    await do(session, load("here"))
    assert session.timeline.tick == 4


async def test_an_unknown_name_is_told_the_nearest() -> None:
    session = await Service().session()
    with pytest.raises(UnknownName, match="Nothing has been saved here yet"):
        await do(session, load("monday"))
    for name in ("monday", "tuesday", "friday", "easter"):
        await do(session, save(name))
    before = session.run
    with pytest.raises(UnknownName) as raised:
        await do(session, ADD, load("mnday"))
    assert raised.value.errors[0].field == "actions.1.name"
    assert raised.value.more["suggestions"][0] == "monday"
    assert session.run == before


async def test_there_is_a_limit_to_names() -> None:
    session = await Service().session()
    for first in range(0, MAX_BOOKMARKS, 50):
        await do(session, *(save(f"n{number}") for number in range(first, first + 50)))
    with pytest.raises(Invalid, match="the limit"):
        await do(session, save("one more"))
    await do(session, save("n7"))


async def test_names_over_http(service: Http) -> None:
    path = await service.session(paused=True)
    assert (await service.client.get(f"{path}/saved")).json() == {"items": []}
    await service.act(path, {"do": "step", "ticks": 3}, save("b"))
    await service.act(path, {"do": "step", "ticks": 3}, save("a"))
    items = (await service.client.get(f"{path}/saved")).json()["items"]
    assert items == [{"name": "a", "sequence": 2, "tick": 6}, {"name": "b", "sequence": 1, "tick": 3}]
    answer = await service.act(path, load("b"))
    assert (answer.status_code, answer.json()["changes"][0]["after"]) == (200, 3)
    unknown = await service.act(path, load("c"))
    assert (unknown.status_code, unknown.json()["type"]) == (422, "/problems/unknown-name")
    assert unknown.json()["suggestions"] == ["a", "b"] or set(unknown.json()["suggestions"]) == {"a", "b"}
