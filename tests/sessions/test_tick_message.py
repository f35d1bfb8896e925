"""What is told of a tick is what a plain look at both worlds gives, however it is made quickly."""

from __future__ import annotations

import pytest

from service.narration import Narrator
from service.narration.sayings import Sayings
from service.sessions.messages import motion_json
from sim.config import Config
from sim.decide import decide
from sim.state import SimState
from sim.transition import step
from sim.world import World
from tests.support.tick_roads import TICKS, roads


def looked_at(before: World, after: World) -> dict[str, object]:
    """Where things went and which way they turned, thing by thing."""
    was = {thing.id: thing for thing in before.things()}
    moving = [after.find(name) for name in after.movers.values()]
    there = [thing for thing in moving if thing is not None]
    return {
        "vehicles": {"av-1": after.road.cell(after.av)},
        "moved": {each.id: each.cell for each in there if was[each.id].cell != each.cell},
        "turned": {each.id: each.heading for each in there if was[each.id].heading != each.heading},
    }


@pytest.mark.parametrize(
    "config", roads(), ids=lambda config: f"{config.columns}x{config.rows} {config.seed}"
)
def test_what_moved_and_turned_is_what_a_look_at_every_thing_gives(config: Config) -> None:
    run = SimState.start(config)
    moves = 0
    for _ in range(TICKS):
        after = step(run).state
        if after.world.episode == run.world.episode:
            told = motion_json(run.world, after.world)
            expected = looked_at(run.world, after.world)
            assert told == expected
            assert [*told["moved"]] == [*expected["moved"]], "in the same order"  # type: ignore[misc]
            moves += len(told["moved"])
        run = after
    assert moves > TICKS


@pytest.mark.parametrize(
    "config", roads(), ids=lambda config: f"{config.columns}x{config.rows} {config.seed}"
)
def test_what_is_said_from_memory_is_what_would_be_said_anew(config: Config) -> None:
    sayings = Sayings.load()
    remembering, told = Narrator(sayings), set()
    run = SimState.start(config)
    for _ in range(TICKS):
        decision = decide(run)
        if decision is not None:
            anew = Narrator(Sayings(sayings._files))
            said = remembering.decision(decision, run)
            assert said == remembering.decision(decision, run) == anew.decision(decision, run)
            told.add(said)
        run = step(run).state
    assert len(told) >= 2
