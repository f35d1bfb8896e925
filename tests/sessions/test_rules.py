"""Rules in a session: done after ticks, told, switched off, undone, and the same after every replay."""

from __future__ import annotations

from typing import Any

import pytest

from service.narration import Narrator
from service.problems import DoesNotFit, Invalid, NotAvailable
from service.sessions.persistence.recording import replay_recording
from sim.config import Config
from sim.triggers import MAX_TRIGGERS
from sim.types import Kind
from tests.support.session_talk import anew
from tests.support.sessions import UNDO, Service, do, fingerprint, recorded
from tests.support.snapshots import back

CAR = {"do": "add", "kind": "vehicle", "count": 1}


def rule(
    fact: str, *then: dict[str, Any], until: dict[str, Any] | None = None, **keys: Any
) -> dict[str, Any]:
    ends = {} if until is None else {"until": until}
    return {"do": "trigger", "when": {"fact": fact, **keys}, "then": list(then), **ends}


EVERY = rule("every", CAR, ticks=10)


async def test_a_rule_is_done_every_so_often() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    await do(session, EVERY)
    cars = session.run.world.count(Kind.VEHICLE)
    service.clock.tick(9)
    assert session.run.world.count(Kind.VEHICLE) == cars
    service.clock.tick(1)
    assert session.run.world.count(Kind.VEHICLE) == cars + 1
    assert session.run.triggers.standing[0].fired == 1
    assert session.log.latest(1)[0].text.startswith("Rule 1: Added a car")
    service.clock.tick(10)
    assert session.run.world.count(Kind.VEHICLE) == cars + 2
    assert anew(session) == session.run


async def test_one_undo_takes_back_the_rule_and_what_it_did() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    other = await service.session(Config(seed=3))
    await do(session, EVERY)
    service.clock.tick(25)
    await do(session, UNDO)
    assert session.run.world.digest() == other.run.world.digest()
    assert not session.run.triggers


async def test_a_rule_pauses_the_session_and_says_so() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    await do(session, rule("row", {"do": "pause"}, row=20))
    service.clock.tick(200)
    assert session.paused
    assert session.run.world.road.cell(session.run.world.av)[1] == 20
    assert session.log.latest(1)[0].text == "Rule 1: Paused."


async def test_steps_end_where_a_rule_pauses() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, rule("tick", {"do": "pause"}, tick=7))
    reply = await do(session, {"do": "step", "ticks": 50})
    assert session.timeline.tick == 7
    assert "7" in reply
    assert not session.run.triggers, "what comes to hold once is done once"


async def test_after_the_end_the_road_begins_again_and_the_end_is_seen() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, rule("arrival", {"do": "reset"}))
    while session.run.world.outcome == "running":
        await do(session, {"do": "step", "ticks": 1})
    assert session.run.world.outcome == "success", "the end is seen for a tick"
    before = session.run.world
    await do(session, {"do": "step", "ticks": 1})
    assert session.run.world.outcome == "running"
    assert session.run.world.episode == before.episode, "the same road"
    assert session.run.world.episode_start == before.tick + 1
    assert session.run.triggers.standing[0].fired == 1


async def test_rules_are_told_and_switched_off() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    reply = await do(session, EVERY)
    assert reply == "Rule 1: every 10 ticks: add 1 car."
    await do(session, rule("near", {"do": "pause"}, closer_than_m=10.0))
    told = await do(session, {"do": "ask", "about": "rules"})
    assert told.startswith("There are 2 rules. Rule 1: every 10 ticks: add 1 car (not done yet).")
    assert [each["number"] for each in session.status.rules] == [1, 2]
    await do(session, {"do": "cancel", "doing": "add", "kind": "vehicle"})
    assert [each.number for each in session.run.triggers.standing] == [2]
    await do(session, UNDO)
    assert [each.number for each in session.run.triggers.standing] == [1, 2]
    await do(session, {"do": "cancel", "which": "all"})
    assert await do(session, {"do": "ask", "about": "rules"}) == "There are no rules."
    await do(session, EVERY)
    assert session.run.triggers.standing[0].number == 3, "no number is used again"


@pytest.mark.parametrize(
    ("action", "kind"),
    [
        ({"do": "cancel", "which": "all"}, DoesNotFit),
        (rule("row", {"do": "pause"}, row=9_999), DoesNotFit),
        (rule("every", {**CAR, "where": {"lane": 99}}, ticks=5), DoesNotFit),
        (rule("every", {"do": "add", "kind": "av", "count": 1}, ticks=5), NotAvailable),
    ],
)
async def test_what_can_never_be_done_is_refused_when_it_is_said(action: dict[str, Any], kind: type) -> None:
    session = await Service().session(Config(seed=3), paused=True)
    before = fingerprint(session)
    with pytest.raises(kind):
        await do(session, action)
    assert fingerprint(session) == before


async def test_there_are_only_so_many_rules() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, *[EVERY] * MAX_TRIGGERS)
    with pytest.raises(Invalid, match="20 rules already"):
        await do(session, EVERY)


async def test_a_runaway_rule_fills_half_a_road_and_is_switched_off() -> None:
    session = await Service().session(Config(seed=3, rows=12, columns=5), paused=True)
    await do(session, rule("every", {"do": "add", "kind": "pothole", "count": 4}, ticks=1))
    await do(session, {"do": "mode", "mode": "manual"})
    for _ in range(4):
        await do(session, {"do": "step", "ticks": 10})
    world = session.run.world
    assert (world.occupied & world.road.between).bit_count() <= world.road.between.bit_count() * 0.5
    assert not session.run.triggers
    told = [line.text for line in session.log.latest(60)]
    assert any("could not be done, and nothing of it was" in text for text in told)
    assert any(text.endswith("10 times in a row, and is switched off.") for text in told)


async def test_a_rule_is_done_wholly_or_not_at_all() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    both = rule(
        "every",
        {"do": "add", "kind": "pothole", "count": 1},
        {"do": "remove", "kind": "barrier", "count": 9},
        ticks=1,
    )
    await do(session, {"do": "set_count", "kind": "barrier", "count": 0}, both)
    potholes = session.run.world.count(Kind.POTHOLE)
    await do(session, {"do": "step", "ticks": 3})
    assert session.run.world.count(Kind.POTHOLE) == potholes
    assert session.run.triggers.standing[0].failed == 3


async def test_rewinding_and_forks_lead_to_the_same_states() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    await do(session, EVERY)
    await do(
        session,
        rule("every", {"do": "add", "kind": "pothole", "count": 1}, until={"fact": "arrival"}, ticks=1),
    )
    service.clock.tick(40)
    states = [session.timeline.at(tick) for tick in range(session.timeline.tick + 1)]
    await do(session, {"do": "rewind", "ticks": 25})
    assert session.run == states[15]
    service.clock.tick(25)
    assert session.run == states[40]
    fork = await service.manager.fork(session, 20)
    assert fork.run.world.digest() == states[20].world.digest()
    assert fork.run.triggers == states[20].triggers


@pytest.mark.parametrize("short", [True, False], ids=["snapshot", "log"])
async def test_a_restart_leads_to_the_same(short: bool) -> None:
    service = Service(snapshot_work=1)
    session = await service.session(Config(seed=3))
    await do(session, EVERY)
    await do(session, rule("crash", {"do": "reset"}))
    service.clock.tick(33)
    await do(session, {"do": "pause"})
    await service.manager.close()
    found = await back(service.store, session.id, short=short)
    assert found.run == session.run
    assert [line.text for line in found.log.latest(20)] == [line.text for line in session.log.latest(20)]


async def test_a_recording_with_rules_replays_to_its_digest() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    await do(session, EVERY)
    service.clock.tick(35)
    recording = await recorded(session, service)
    again = await service.session(Config(seed=3), paused=True)
    await replay_recording(again, recording, session.services)
    assert again.run == session.run


async def test_german_sessions_tell_their_rules_in_german() -> None:
    text = Narrator.load("de").rules((await _with_a_rule()).run)[0]["text"]
    assert text.startswith("Alle 10 Ticks: ")


async def _with_a_rule() -> Any:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, EVERY)
    return session


@pytest.mark.parametrize("seed", range(4))
async def test_moves_and_halts_are_noticed_when_they_happen(seed: int) -> None:
    """The oracle looks only at the cells the ego was in, tick by tick."""
    service = Service()
    session = await service.session(Config(seed=seed, vehicles=40, potholes=25))
    moves = ("left", "right", "lane_change")
    await do(session, *(rule("move", CAR, move=move) for move in moves), rule("standing", CAR))
    expected = [0, 0, 0, 0]
    stood = False
    for _ in range(150):
        was = session.run.world
        service.clock.tick(1)
        world = session.run.world
        drove = was.outcome == "running" and was.episode_start == world.episode_start
        lanes = (world.road.cell(world.av)[0] - was.road.cell(was.av)[0]) * drove
        stands = drove and world.av == was.av
        noticed = (lanes < 0, lanes > 0, lanes != 0, stands and not stood)
        expected = [count + happened for count, happened in zip(expected, noticed, strict=True)]
        stood = stands
        assert [each.fired for each in session.run.triggers.standing] == expected
    assert all(expected), "each of them happened"
