"""A session that comes back is the one that never went: its state, its log, what it can undo and talk of."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.problems import NothingToUndo, NotRestorable, ProblemError
from service.sessions.session import Session
from service.store import MemoryStore
from service.work.executor import WorkExecutor
from tests.support.sessions import ADD, REDO, UNDO, Service, do, potholes
from tests.support.snapshots import TALK, whole


@settings(max_examples=150, deadline=None)
@given(said=TALK, kept=st.sampled_from([10, 400]))
def test_whatever_was_said_and_however_little_the_log_holds(
    said: list[tuple[int, list[dict[str, object]]]], kept: int
) -> None:
    async def talk() -> None:
        service = Service(log_events=kept)
        session = await service.session()
        for ticks, actions in said:
            service.clock.tick(ticks)
            try:
                await do(session, *actions)
            except ProblemError:
                continue
        await service.manager.close()
        again = await Service(service.store, log_events=kept).manager.get(session.id)
        assert whole(again) == whole(session)
        for tick in range(0, session.timeline.tick, 3):
            assert again.timeline.at(tick) == session.timeline.at(tick)
        # And it goes on the same.
        other = Service(service.store, log_events=kept)
        for actions in ([UNDO], [UNDO], [REDO], [ADD], [UNDO, ADD]):
            outcomes = []
            for each in (again, await other.manager.get(session.id)):
                try:
                    each.paused = True
                    outcomes.append((await _tried(each, actions), each.run))
                except ProblemError as problem:
                    outcomes.append((problem.detail, each.run))
            assert outcomes[0] == outcomes[1]

    async def _tried(session: Session, actions: list[dict[str, object]]) -> str:
        return await do(session, *actions, dry_run=True)

    asyncio.run(talk())


async def test_only_what_the_log_still_holds_is_put_into_words(monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service(log_events=10)
    session = await service.session(paused=True)
    for number in range(60):
        await do(session, {"do": "set_count", "kind": "pothole", "count": number % 7})
    await service.manager.close()
    other = Service(service.store, log_events=10)
    words = other.manager._services.narrator
    told, done = [], type(words).reply

    def counted(self: Any, facts: Any) -> str:
        told.append(facts)
        return done(self, facts)

    monkeypatch.setattr(type(words), "reply", counted)
    again = await other.manager.get(session.id)
    assert len(told) == 10
    assert (again.log.first_number, again.log.last_number) == (
        session.log.first_number,
        session.log.last_number,
    )
    assert again.log.latest(10) == session.log.latest(10)


async def test_redo_and_undo_in_one_breath_is_no_step_of_its_own() -> None:
    session = await Service().session()
    await do(session, ADD)
    await do(session, UNDO)
    await do(session, REDO, UNDO)
    assert (potholes(session), session.undo_stack.steps, len(session.undo_stack.undone)) == (4, 0, 1)
    await do(session, REDO)
    assert potholes(session) == 5
    await do(session, UNDO, REDO)
    assert (session.undo_stack.steps, len(session.undo_stack.undone)) == (1, 0)
    await do(session, UNDO)
    with pytest.raises(NothingToUndo):
        await do(session, UNDO)


async def test_many_undos_at_once_are_done_beside_the_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    threads = []
    in_thread = WorkExecutor.in_thread

    async def noted(self: WorkExecutor, work: Any, *given: Any) -> Any:
        threads.append(work.__name__)
        return await in_thread(self, work, *given)

    monkeypatch.setattr(WorkExecutor, "in_thread", noted)
    session = await Service().session(paused=True)
    for _ in range(5):
        await do(session, {"do": "step", "ticks": 15}, ADD)
    threads.clear()
    await do(session, UNDO)
    assert threads == []
    await do(session, *[UNDO] * 4)
    assert (threads, potholes(session)) == (["perform"], 4)


async def test_what_cannot_be_done_again_is_told_by_its_number_also_in_a_fork() -> None:
    store = MemoryStore()
    service = Service(store)
    parent = await service.session(paused=True)
    await do(parent, ADD)
    await do(parent, {"do": "step", "ticks": 3}, ADD)
    child = await service.manager.fork(parent, None)
    await do(child, ADD)
    await do(child, ADD)
    await service.manager.close()
    last = max(store._entries[child.id].values(), key=lambda entry: entry.sequence)
    store._entries[child.id][last.sequence] = type(last)(
        sequence=last.sequence, tick=last.tick, text=None, actions=last.actions, digest="0" * 32
    )
    with pytest.raises(NotRestorable, match=f"entry {last.sequence}"):
        await Service(store).manager.get(child.id)


async def test_a_pause_that_nobody_said_is_no_part_of_a_step_afterwards_either() -> None:
    """A session that ran comes back paused; what is said then comes back as it was said."""
    store = MemoryStore()
    first = await (service := Service(store)).session(paused=False)
    await service.manager.close()
    second = await (service := Service(store)).manager.get(first.id)
    assert second.paused
    await do(second, ADD, {"do": "pause"})
    await do(second, {"do": "resume"})
    await do(second, {"do": "pause"})
    await service.manager.close()
    third = await Service(store).manager.get(first.id)
    assert whole(third) == whole(second)
    assert third.undo_stack.done[0].paused_before is True
    assert [each.paused for each in await store.entries(first.id)] == [True, None, None]
