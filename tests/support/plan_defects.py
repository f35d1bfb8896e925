"""Lists what is wrong with a plan, by playing it: a judge that knows no planner and no forecast."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from sim.commit import commit, moves_with
from sim.config import Config
from sim.judge import collisions, outcome
from sim.types import Move, Outcome
from sim.validation import Defect
from sim.world import World


def validate_plan(world: World, plan: Iterable[Move], config: Config) -> tuple[Defect, ...]:
    """Every way in which playing these moves is no way to row 0 for the first ego; others stay.

    A step off the road is left out and the plan goes on; after a collision it goes on as well, so that
    all that is wrong is listed. Codes: `off_road`; `hit_…`, `swap_…` and `cross_…` with what was met;
    `after_the_end`, `too_long`, `not_at_goal`.
    """
    return tuple(_of_plan(world, plan, config))


def _of_plan(world: World, plan: Iterable[Move], config: Config) -> Iterator[Defect]:
    arrived = world.outcome is Outcome.SUCCESS
    for move in plan:
        if arrived:
            yield Defect("after_the_end", world.tick)
        if config.ego_dynamics(world.road).target(world.av, move) is None:
            yield Defect("off_road", world.tick, cell=world.road.cell(world.av))
            continue
        after = commit(world, moves_with(world, move), config)
        for crash in collisions(world, after, config.ego_dynamics(world.road)):
            yield Defect(f"{crash.how}_{crash.kind}", after.tick, crash.ids, crash.cell)
        # What was hit is noted, the plan goes on.
        result = outcome(after, (), config.max_ticks, range(1, len(world.avs)))
        if result is Outcome.STUCK and not arrived:
            yield Defect("too_long", after.tick)
        arrived = arrived or result is Outcome.SUCCESS
        world = replace(after, outcome=Outcome.RUNNING)
    if not arrived:
        yield Defect("not_at_goal", world.tick, cell=world.road.cell(world.av))
