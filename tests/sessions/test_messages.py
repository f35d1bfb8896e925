"""The stream's messages: what moved, by whichever order things are kept in, and what stands first."""

from __future__ import annotations

from dataclasses import replace

import orjson

from service.contract.encode.state import SessionStatus
from service.sessions.messages import changed_message, motion_json
from sim.config import Config
from sim.state import SimState
from sim.transition import step


def test_what_moved_does_not_hang_on_the_order_in_which_things_are_kept() -> None:
    run = SimState.start(Config(seed=3, vehicles=12))
    told = 0
    for _ in range(12):
        after = step(run).state
        mixed = replace(after.world, movers=dict(reversed(after.world.movers.items())))
        found = motion_json(run.world, after.world)
        assert found == motion_json(run.world, mixed)
        for name, cell in found["moved"].items():
            assert after.world.find(name).cell == tuple(cell)  # type: ignore[union-attr]
        told += len(found["moved"])
        run = after
    assert told > 0


def test_what_has_come_has_moved_and_turned_nowhere() -> None:
    run = SimState.start(Config(seed=3, vehicles=12))
    world = run.world
    first = next(iter(world.movers))
    without = world.without({world.movers[first]})
    found = motion_json(without, world)
    assert found["moved"] == {world.movers[first]: world.road.cell(first)}
    assert found["turned"] == {}


def test_the_type_stands_first_whatever_else_is_told() -> None:
    run = SimState.start(Config(seed=3))
    told = changed_message(SessionStatus("s", False, 1), run, None, "Done.", (), (), {"road": True})
    assert told.startswith(b'{"type":"changed",')
    assert orjson.loads(told)["views"] == {"road": True}
