"""Steps over many ends of large roads: their ends are put into words beside the event loop."""

from __future__ import annotations

import threading

import pytest

from sim.config import Config
from sim.events import Event
from sim.explain.summary import long_to_tell
from sim.state import SimState
from tests.support.sessions import Service, do

LARGE = Config(seed=1, planner="rules", columns=12, rows=60, pedestrians=0)


async def test_ends_of_large_roads_are_told_in_a_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service()
    session = await service.session(LARGE, paused=True)
    loop, told_on_loop, told_in_threads = threading.get_ident(), [], []
    told = type(session.narrator).event

    def event(narrator: object, event: Event, run: SimState) -> str:
        if long_to_tell(run):
            here = told_on_loop if threading.get_ident() == loop else told_in_threads
            here.append(event.type)
        return told(narrator, event, run)  # type: ignore[arg-type]

    monkeypatch.setattr(type(session.narrator), "event", event)
    await do(session, {"do": "step", "ticks": 200})
    assert told_in_threads
    assert not told_on_loop
    logged = [line.type for line in session.log.latest(session.log.capacity)]
    assert set(told_in_threads) <= set(logged)
    assert logged[0] == "changed"
