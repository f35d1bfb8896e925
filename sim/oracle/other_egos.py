"""The road of one ego among others that stay: what searches for the best may take as known.

Other egos that are parked or have arrived are part of the road, exactly. What others that drive will do is
not known to a search, so nothing is claimed where there are any (`UndeterminedError`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from sim.forecast import Forecast, predict
from sim.perceive import perceive_truth
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.transition import next_world
from sim.types import Move, Outcome, ego_id
from sim.world import World


class UndeterminedError(ImpatientError):
    """No answer: it hangs on what other egos do, on movers that react to them, or on moves that may slip.

    The arguments say which: `drives` and the id of the ego that does, `courtesy` where a mover may give way
    to one that stays, `hit` where a mover runs into one, `slips`.
    """


def check_others_stay(state: SimState, ego: str | None, gone: Collection[str] = ()) -> None:
    """Raises `UndeterminedError` where another ego drives, or where movers may give way to one that stays."""
    world = state.world
    if len(world.avs) == 1:
        return
    number, parked = state.number(ego), state.parked
    columns, rows = world.road.columns, 0
    for other, cell in enumerate(world.avs):
        if other == number or ego_id(other) in gone:
            continue
        if other not in parked and cell >= columns:
            raise UndeterminedError("drives", ego_id(other))
        rows |= world.road.row(cell // columns)
    if state.config.courtesy and world.moving & rows:
        raise UndeterminedError("courtesy")


def truth_for(state: SimState, horizon: int, ego: str | None = None, gone: Collection[str] = ()) -> Forecast:
    """What follows from what is, for an ego, the first by default; `gone`: other egos that are left out."""
    if len(state.world.avs) == 1:
        return Forecast.of_truth(state.world, state.config, horizon)
    number = state.number(ego)
    percept = perceive_truth(state.world, state.config, number, {}, state.parked)
    return predict(percept.without(gone) if gone else percept, horizon)


def alone(state: SimState, ego: str | None = None) -> World:
    """The world with this ego on it and no other: a forecast has the others."""
    world = state.world
    return world if len(world.avs) == 1 else replace(world, avs=(world.avs[state.number(ego)],))


def ego_first(state: SimState, ego: str | None = None, gone: Collection[str] = ()) -> tuple[World, list[str]]:
    """The world with an ego in the first place and without others that are gone; and their ids in order."""
    world = state.world
    if len(world.avs) == 1:
        return world, [ego_id(0)]
    own = state.number(ego)
    others = [number for number in range(len(world.avs)) if number != own and ego_id(number) not in gone]
    numbers = [own, *others]
    avs = tuple(world.avs[number] for number in numbers)
    return replace(world, avs=avs), [ego_id(number) for number in numbers]


def arrives(
    state: SimState, plan: Iterable[Move], ego: str | None = None, gone: Collection[str] = ()
) -> bool:
    """Whether an ego that makes these moves gets to row 0, judged tick by tick, while all others stay.

    `gone`: other egos that are not there.
    """
    world, ids = ego_first(state, ego, gone)
    staying = (Move.STAY,) * (len(ids) - 1)
    for move in plan:
        if (
            world.outcome is not Outcome.RUNNING
            or state.config.ego_dynamics(world.road).target(world.av, move) is None
        ):
            return False
        world = next_world(world, (move, *staying), state.config, range(1, len(ids)))
    return world.outcome is Outcome.SUCCESS and world.av < world.road.columns


def others_standing(state: SimState, ego: str | None = None) -> list[str]:
    """The ids of the egos beside this one."""
    own = state.number(ego)
    return [ego_id(number) for number in range(len(state.world.avs)) if number != own]
