"""The outlook of a road: what is answered holds, and the work is bounded."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.oracle import Blocked, certify
from sim.oracle.certificate import opens
from sim.oracle.outlook import OPEN, outlook, quickly_open
from sim.state import SimState
from sim.types import Kind
from sim.world import notation
from tests.support.roads import run_on

EMPTY = Config(rows=6, columns=3, vehicles=0, potholes=0, planner="priority", seed=4)


def test_an_outlook_names_what_a_certificate_proves() -> None:
    closed = 0
    for seed in range(40):
        state = SimState.start(Config(rows=8, columns=4, seed=seed, potholes=11, vehicles=3, barriers=2))
        found, proof = outlook(state), certify(state)
        assert found is not None
        assert found.open is not isinstance(proof, Blocked)
        if isinstance(proof, Blocked):
            closed += 1
            assert found.ids
            assert opens(state, found.ids)
            assert len(found.ids) == len(proof.ids) or not found.minimal
    assert closed > 3


def test_too_little_time_is_another_thing_than_no_way() -> None:
    state = SimState.start(EMPTY)
    late = run_on(state.world, planner="priority")
    world = notation.read(notation.write(late.world).replace("tick 0", "tick 58"))
    found = outlook(SimState(late.config, world))
    assert found is not None
    assert (found.open, found.late, found.ids) == (False, True, ())


def test_bounds_end_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    crowded = SimState.start(Config(seed=17, vehicles=60, potholes=40))
    found = outlook(crowded)
    assert found is not None
    assert found.ids
    monkeypatch.setattr("sim.oracle.outlook.LOOKS", 0)
    found = outlook(crowded)
    assert found is not None
    assert (found.open, found.ids) == (False, ())
    assert outlook(SimState.start(Config(seed=3, vehicles=60, potholes=40))) is None, (
        "neither found nor excluded"
    )


def test_an_open_road_is_found_at_once() -> None:
    state = SimState.start(Config(seed=1))
    assert quickly_open(state)
    assert outlook(state) is OPEN
    assert state.world.count(Kind.VEHICLE) > 0
