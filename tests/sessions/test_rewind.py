"""Going back in time is a change like any other: stored, replayed, taken back by one undo."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.problems import Invalid, NothingToUndo, ProblemError
from service.sessions.persistence.recording import recording_json
from service.sessions.rewind import rewind_to
from service.store import EntryRecord
from tests.support.service import Service as Http
from tests.support.session_talk import SAID, anew, rewind
from tests.support.sessions import ADD, PAUSE, REDO, UNDO, Service, do, potholes, recorded


async def test_back_and_on_from_there() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(10)
    ten = session.run
    service.clock.tick(5)
    await do(session, ADD)
    service.clock.tick(5)
    assert await do(session, rewind(10)) == "Back at tick 10."
    assert (session.run, session.timeline.entries, session.paused) == (ten, [], False)
    service.clock.tick(2)
    assert (session.timeline.tick, potholes(session)) == (12, 4)


async def test_what_was_said_at_that_tick_stands() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(4)
    await do(session, ADD)
    there = session.run
    service.clock.tick(4)
    await do(session, rewind(4))
    assert session.run == there


async def test_one_undo_brings_it_all_back() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(8)
    await do(session, ADD)
    service.clock.tick(3)
    eleven = session.run
    await do(session, rewind(6))
    service.clock.tick(2)
    seven = session.run
    await do(session, UNDO)
    assert session.run == eleven
    service.clock.tick(4)
    await do(session, REDO)
    assert session.run == seven, "time stands where it stood on the other side"
    await do(session, UNDO)
    assert session.timeline.tick == 15
    await do(session, UNDO)
    assert potholes(session) == 4


async def test_further_than_the_beginning_is_refused() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(3)
    before = session.run
    with pytest.raises(Invalid, match=r"^It is tick 3: .* not 4\.$") as raised:
        await do(session, PAUSE, rewind(4))
    assert raised.value.errors[0].field == "actions.1.ticks"
    assert (session.run, session.sequence) == (before, 0)


async def test_a_jump_is_to_the_tick_that_was_named_however_long_it_waits() -> None:
    service = Service(max_step_ticks=10_000)
    session = await service.session()
    for _ in range(2):
        await do(session, {"do": "step", "ticks": 10_000})
    await do(session, {"do": "step", "ticks": 7}, {"do": "resume"})
    adding = asyncio.create_task(do(session, ADD))
    jumping = asyncio.create_task(session.change(rewind_to(5)))
    await asyncio.sleep(0)
    service.clock.tick(3)
    await adding
    await jumping
    assert session.timeline.tick <= 6, "a tick that came due meanwhile is taken after"
    kept = (await service.store.entries(session.id))[-1].actions
    assert len(kept) == 3, "a longer way than one action goes is several"


async def test_an_old_place_in_time_is_not_run_on_to_after_going_back() -> None:
    """Stopped at 20, restarted, gone back to 5, killed: it stands at 5, and not at 20 again."""
    service = Service()
    session = await service.session()
    service.clock.tick(20)
    await service.manager.close()
    service = Service(service.store)
    session = await service.manager.get(session.id)
    await do(session, rewind(15))
    again = await Service(service.store).manager.get(session.id)
    assert (again.timeline.tick, again.run) == (5, session.run)


@settings(max_examples=150, deadline=None)
@given(said=st.lists(st.tuples(st.integers(0, 6), SAID), max_size=12), restart=st.integers(0, 12))
def test_wherever_time_went_the_log_leads_to_the_same_state(
    said: list[tuple[int, list[dict[str, object]]]], restart: int
) -> None:
    async def talk() -> None:
        service = Service()
        session = await service.session()
        for number, (ticks, actions) in enumerate(said):
            if number == restart:
                paused = session.paused
                await service.manager.close()
                service = Service(service.store)
                session = await service.manager.get(session.id)
                if not paused:
                    await do(session, {"do": "resume"})
            service.clock.tick(ticks)
            before = (session.run, session.sequence)
            try:
                await do(session, *actions)
            except ProblemError:
                assert (session.run, session.sequence) == before
            assert session.run == anew(session)
            for tick in {0, session.timeline.tick // 2, session.timeline.tick}:
                assert session.timeline.at(tick).world.tick == tick

        copy = await Service().manager.create(
            None, session.timeline.config, paused=True, recorded=await recorded(session, service)
        )
        await service.manager.close()
        again = await Service(service.store).manager.get(session.id)
        for other in (again, copy):
            assert other.run == session.run
            assert other.undo_stack == session.undo_stack
            assert (other.sequence, other.timeline.entries) == (session.sequence, session.timeline.entries)

    asyncio.run(talk())


@settings(max_examples=60, deadline=None)
@given(said=st.lists(st.tuples(st.integers(0, 6), SAID), max_size=8))
def test_undoing_everything_leaves_an_empty_log(
    said: list[tuple[int, list[dict[str, object]]]],
) -> None:
    async def talk() -> None:
        service = Service()
        session = await service.session()
        for ticks, actions in said:
            service.clock.tick(ticks)
            try:
                await do(session, *actions)
            except ProblemError:
                continue
        while session.undo_stack.done:
            await do(session, UNDO)
        assert session.timeline.entries == []
        assert session.run == anew(session)
        with pytest.raises(NothingToUndo):
            await do(session, UNDO)

    asyncio.run(talk())


# Over HTTP


async def test_the_jump_over_http(service: Http) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 9})
    nine = await service.state(path)
    await service.client.post(f"{path}/step", json={"ticks": 9})
    answer = await service.client.post(f"{path}/rewind", json={"tick": 9})
    assert (answer.status_code, answer.json()["reply"]) == (200, "Back at tick 9.")
    assert answer.json()["changes"][0] == {"path": "tick", "before": 18, "after": 9}
    assert (await service.state(path))["digest"] == nine["digest"]
    for tick in (9, 10):
        refused = await service.client.post(f"{path}/rewind", json={"tick": tick})
        assert (refused.status_code, refused.json()["errors"][0]["field"]) == (422, "tick")
    await service.act(path, {"do": "undo"})
    assert (await service.state(path))["tick"] == 18


async def test_a_recording_that_went_back_is_replayed_over_http(service: Http) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 12})
    await service.act(path, {"do": "add", "kind": "pothole", "count": 1})
    await service.client.post(f"{path}/rewind", json={"tick": 4})
    await service.say(path, "add two cars")
    recording = (await service.client.get(f"{path}/recording")).json()
    again = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert again.status_code == 201, again.text
    state = await service.state(again.headers["location"])
    assert (state["digest"], state["tick"]) == (recording["digest"], 4)


async def test_a_recording_cannot_make_endless_work(service: Http) -> None:
    path = await service.session(paused=True)
    recording = (await service.client.get(f"{path}/recording")).json()
    actions = [{"do": "step", "ticks": 10_000}, {"do": "rewind", "ticks": 10_000}] * 25
    recording["entries"] = [
        {"sequence": 1, "tick": 0, "text": None, "actions": actions},
    ]
    answer = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert (answer.status_code, answer.json()["errors"][0]["field"]) == (422, "recording.entries.0")


def test_a_recording_names_what_it_holds() -> None:
    async def talk() -> None:
        service = Service()
        session = await service.session()
        service.clock.tick(6)
        await do(session, rewind(2))
        recording = recording_json(session, await service.manager.entries(session))
        assert [EntryRecord(**each).tick for each in recording["entries"]] == [6]
        assert recording["tick"] == 4

    asyncio.run(talk())
