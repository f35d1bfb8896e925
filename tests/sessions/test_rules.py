"""Rules in a session: done after ticks, told, switched off, undone, and the same after every replay."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from service.narration import Narrator
from service.problems import DoesNotFit, Invalid, NotAvailable
from service.sessions.persistence.recording import recording_json
from sim.config import Config
from sim.types import Kind
from tests.support.session_talk import anew
from tests.support.sessions import UNDO, Service, do, fingerprint
from tests.support.snapshots import all_of

CAR = {"do": "add", "kind": "vehicle", "count": 1}


def rule(fact: str, *then: dict[str, Any], until: dict[str, Any] | None = None, **keys: Any) -> dict[str, Any]:
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
    for clock in range(25):
        service.clock.tick(1)
    await do(session, UNDO)
    assert session.run.world.digest() == other.run.world.digest()
    assert not session.run.triggers
