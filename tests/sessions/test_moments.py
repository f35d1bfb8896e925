"""Going back to a moment, questions about the past, and small talk, in a session."""

from __future__ import annotations

import pytest

from service.problems import Invalid
from sim.config import Config
from sim.types import Outcome
from tests.support.session_talk import rewind_to
from tests.support.sessions import ADD, UNDO, Service, do, fingerprint

CRASHING = Config(seed=4, planner="priority", rules=1, attentive=0.0, collision="cell", reset_delay_s=0.5)


async def test_back_to_the_latest_crash_and_one_undo_brings_it_all_back() -> None:
    service = Service()
    session = await service.session(CRASHING)
    service.clock.tick(400)
    while session.run.metrics.crashes < 2:
        service.clock.tick(50)
    ends = list(session.timeline.between(0, session.timeline.tick + 1))
    crashes = [
        state.world.tick
        for state in ends
        if state.world.outcome is Outcome.CRASH and state.world.ended == state.world.tick
    ]
    present = session.run
    assert await do(session, rewind_to("crash")) == f"Back at tick {crashes[-1]}."
    assert session.run.world.outcome is Outcome.CRASH
    await do(session, UNDO)
    assert session.run == present


async def test_back_to_a_tick_to_the_start_of_the_episode_and_of_the_session() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(5)
    await do(session, ADD, {"do": "reset"})
    service.clock.tick(6)
    assert await do(session, rewind_to(7)) == "Back at tick 7."
    assert await do(session, rewind_to("episode")) == "Back at tick 5."
    assert await do(session, rewind_to("start")) == "Back at tick 0."


@pytest.mark.parametrize(
    ("moment", "why"),
    [("crash", "no crash"), (99, "no tick 99"), (3, "tick 3 already"), ("start", "tick 0 already")],
)
async def test_a_moment_that_never_was_is_refused(moment: str | int, why: str) -> None:
    service = Service()
    session = await service.session()
    if moment != "start":
        service.clock.tick(3)
    before = fingerprint(session)
    with pytest.raises(Invalid, match=why) as raised:
        await do(session, rewind_to(moment))
    assert raised.value.errors[0].field == "actions.0.to"
    assert fingerprint(session) == before


@pytest.mark.parametrize("kind", ["greeting", "farewell", "thanks", "complaint", "identity", "joke"])
async def test_small_talk_is_answered_in_a_line_and_changes_nothing(kind: str) -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(3)
    before = fingerprint(session)
    reply = await do(session, {"do": "chat", "kind": kind})
    assert reply
    assert "\n" not in reply
    assert fingerprint(session) == before
    assert not await service.store.entries(session.id)


async def test_the_playback_speed_is_answered_as_it_is() -> None:
    session = await Service().session()
    await do(session, {"do": "set", "parameter": "playback_speed", "value": 4})
    reply = await do(session, {"do": "ask", "about": "setting", "parameter": "playback_speed"})
    assert "4×" in reply


async def test_ticks_that_never_were_are_named() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(6)
    asked = {"do": "ask", "about": "history", "what": "seen"}
    assert "no tick 60" in await do(session, {**asked, "tick": 60})
    assert "only tick 6" in await do(session, {**asked, "ticks": 7})
    assert (await do(session, {**asked, "tick": 6})).startswith("At tick 6: ")
