"""Live sessions whose tick is dear: they decide in a process, are slowed visibly, and delay nobody."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from service.sessions.session import Session
from service.work.live_lane import LiveLane, NoDecisionError
from sim.config import Config
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.types import Mode
from tests.support.sessions import ADD, Service, do

DEAR = Config(seed=2, columns=40, rows=60, planner="astar")


async def settle() -> None:
    for _ in range(20):
        await asyncio.sleep(0)


class _Lane:
    """A live lane that answers when a test says so."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.asked: list[tuple[Any, Any, asyncio.Future[Any]]] = []
        monkeypatch.setattr(LiveLane, "run", self._run)

    async def _run(self, function: Any, *arguments: Any) -> Any:
        answer = asyncio.get_running_loop().create_future()
        self.asked.append((function, arguments, answer))
        return await answer

    async def answer(self) -> None:
        function, arguments, answer = self.asked.pop(0)
        answer.set_result(function(*arguments))
        await settle()


@pytest.fixture
def lane(monkeypatch: pytest.MonkeyPatch) -> _Lane:
    return _Lane(monkeypatch)


def slowed(session: Session) -> int:
    return sum(line.type == "slowed" for line in session.log.latest(400))


async def test_it_ticks_when_the_decision_comes_and_says_once_that_it_is_slowed(lane: _Lane) -> None:
    service = Service()
    session, other = await service.session(DEAR), await service.session()
    service.clock.tick()
    await settle()
    assert (session.timeline.tick, other.timeline.tick, slowed(session)) == (0, 1, 0)
    service.clock.tick(3)
    await settle()
    assert (session.timeline.tick, other.timeline.tick, slowed(session)) == (0, 4, 1)
    assert len(lane.asked) == 1
    await lane.answer()
    assert session.timeline.tick == 1
    service.clock.tick()
    await settle()
    await lane.answer()
    plain = Timeline(DEAR)
    plain.advance()
    plain.advance()
    assert session.run == plain.state
    assert slowed(session) == 1


async def test_a_decision_for_a_road_that_was_changed_meanwhile_is_dropped(lane: _Lane) -> None:
    service = Service()
    session = await service.session(DEAR)
    service.clock.tick()
    await settle()
    await do(session, ADD)
    await lane.answer()
    assert session.timeline.tick == 0
    service.clock.tick()
    await settle()
    await lane.answer()
    assert session.timeline.tick == 1


async def test_a_decision_that_never_comes_hands_the_vehicle_over(lane: _Lane) -> None:
    service = Service()
    session = await service.session(DEAR)
    service.clock.tick()
    await settle()
    lane.asked.pop()[2].set_exception(NoDecisionError("did not answer within 30 s"))
    await settle()
    await asyncio.gather(*session.tasks)
    assert session.run.mode is Mode.MANUAL
    assert "did not answer within 30 s" in session.log.latest(1)[0].text


async def test_a_session_that_ends_drops_its_decision(lane: _Lane) -> None:
    service = Service()
    session = await service.session(DEAR)
    service.clock.tick()
    await settle()
    await service.manager.delete(session.id)
    await settle()
    assert lane.asked[0][2].cancelled()


async def test_a_real_process_decides_alike() -> None:
    service = Service()
    session = await service.session(DEAR)
    subscriber = session.subscribers.subscribe(())
    service.clock.tick()
    await asyncio.wait_for(subscriber.next(), 60)
    assert session.timeline.tick == 1
    latest = session.latest_decision()
    assert latest is not None
    decision: Decision = latest[0]
    assert decision == Timeline(DEAR).decision(0)
    service.manager.work.stop()


async def test_the_latest_decision_is_kept_and_taken_anew_elsewhere_where_it_is_dear() -> None:
    service = Service()
    session = await service.session(DEAR, paused=True)
    await do(session, {"do": "step", "ticks": 3})
    known = session.latest_decision()
    assert known is not None
    await do(session, {"do": "rewind", "to": 2})
    assert session.latest_decision() is None
    await session.load_latest_decision()
    found = session.latest_decision()
    assert found is not None
    assert found[0] == session.timeline.decision(1)
    service.manager.work.stop()


async def test_a_session_that_becomes_dear_is_decided_elsewhere_from_the_next_tick_on(lane: _Lane) -> None:
    service = Service()
    session = await service.session(Config(seed=2, columns=40, rows=60, planner="priority"))
    service.clock.tick(2)
    await settle()
    assert (session.timeline.tick, len(lane.asked)) == (2, 0)
    await do(session, {"do": "set", "parameter": "planner", "value": "astar"})
    service.clock.tick()
    await settle()
    assert (session.timeline.tick, len(lane.asked)) == (2, 1)
    await lane.answer()
    await do(session, {"do": "undo"})
    service.clock.tick(2)
    await settle()
    assert (session.timeline.tick, len(lane.asked)) == (5, 0)
