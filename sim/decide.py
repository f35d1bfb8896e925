"""What a state leads to: each ego perceives, foresees and decides.

Several egos decide one after the other, the one furthest ahead first, and announce their moves. An ego
that decides later knows these moves and assumes that the egos after it stay. So the chosen moves do not
collide: earlier moves are known, and a later ego can at least stay.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import partial
from typing import Final

from sim.config import Config
from sim.ego import Ego
from sim.forecast import predict
from sim.perceive import NO_BELIEF, Belief, Percept, perceive, sensor_named
from sim.plan import Decision
from sim.plan.manual_override import override
from sim.plan.safe_planning import hold_position, is_foreign, plan_safely
from sim.plan.sandbox.answer import FAULTS
from sim.state import FIRST, EgoStep, SimState
from sim.types import Mode, Move, Outcome, ego_id

INTO_ANOTHER: Final = FAULTS["into-ego"]
"""The fault of a planner whose move would meet another ego; it is not made."""

_NOTHING: dict[str, Decision] = {}
_NO_MOVES: dict[str, Move] = {}
_made = partial(tuple.__new__, EgoStep)  # a third of the time that the class's own takes


def decide(
    state: SimState, id: str | None = None, decided: Mapping[str, Decision] = _NOTHING
) -> Decision | None:
    """The decision the present state leads to, of the first ego by default.

    None once the episode has ended, and once that ego has arrived. `decided`: what is known already, by id.
    """
    step = decide_each(state, decided).get(id or FIRST)
    return None if step is None else step.decision


def decide_each(state: SimState, decided: Mapping[str, Decision] = _NOTHING) -> dict[str, EgoStep]:
    """What every ego sees, expects and decides, by id; `decided`: what is known already.

    Empty once the episode has ended. Egos that have arrived decide nothing.
    """
    world = state.world
    if world.outcome is not Outcome.RUNNING:
        return {}
    if len(world.avs) == 1:
        ego = state.ego()
        return {ego.id: decide_alone(state, ego, decided.get(ego.id))}
    steps = dict(_in_order(state, decided))
    return {id: steps[id] for id in state.egos if id in steps}


def announced_before(
    state: SimState,
    id: str | None = None,
    decided: Mapping[str, Decision] = _NOTHING,
    gone: Collection[str] = (),
) -> dict[str, Move]:
    """The moves that an ego (the first by default) knows when it decides: of those that decide before it.

    `gone`: ids of things and egos that none of them sees.
    """
    world = state.world
    if len(world.avs) == 1 or world.outcome is not Outcome.RUNNING:
        return {}
    return {
        name: step.decision.move
        for name, step in _in_order(state, decided, until=id or FIRST, gone=frozenset(gone))
    }


def moves_where(state: SimState, move: Move, id: str | None = None) -> dict[str, Move]:
    """The moves of all egos where one of them (the first by default) makes this move, whatever it meets.

    Those that decide after it know the move. The episode must not have ended.
    """
    name = id or FIRST
    if len(state.world.avs) == 1:
        return {name: move}
    made = {name: move}
    return {each: step.decision.move for each, step in _in_order(state, made=made)} | made


def _in_order(
    state: SimState,
    decided: Mapping[str, Decision] = _NOTHING,
    made: Mapping[str, Move] = _NO_MOVES,
    until: str | None = None,
    gone: frozenset[str] = frozenset(),
) -> Iterator[tuple[str, EgoStep]]:
    """What several egos decide, one after the other, up to and without the ego `until`.

    Those in `made` make that move and are not asked; nobody sees what is `gone`.
    """
    world, parked, announced = state.world, state.parked, dict[int, Move]()
    for number in deciding_order(world.avs):
        name = ego_id(number)
        if name == until:
            return
        one = state.egos.get(name)
        move = made.get(name, Move.STAY)
        driven = one is not None and name not in made and name not in gone
        if one is not None and driven and world.avs[number] >= world.road.columns:
            own = state.config_of(name)
            percept, belief = perceive(world, own, number, one.belief, announced, parked)
            found = _step(one, percept.without(gone) if gone else percept, belief, own, decided.get(name))
            step = _clear_of_egos(found, own)
            move = step.decision.move
            yield name, step
        announced[number] = move


def decide_alone(state: SimState, ego: Ego, known: Decision | None = None) -> EgoStep:
    """What the only ego of a road sees, expects and decides; `known`: the decision, if it is known already.

    The episode must not have ended.
    """
    config = state.config if ego.planner is None else state.config_of(ego.id)
    percept, belief = perceive(state.world, config, 0, ego.belief)
    return _step(ego, percept, belief, config, known)


def decide_on(state: SimState, percept: Percept, id: str | None = None) -> Decision:
    """The decision of an ego (the first by default) that sees this; the world has no part in it."""
    config = state.config_of(id)
    found = _step(state.ego(id), percept, NO_BELIEF, config, None)
    return (_clear_of_egos(found, config) if percept.egos else found).decision


def sense(
    state: SimState, moves: Mapping[str, Move] = _NO_MOVES, id: str | None = None
) -> tuple[Percept, Belief]:
    """What an ego (the first by default) sees in a state, and what its sensor carries into the next tick.

    `moves`: those that all egos make in this tick; an ego knows the ones of those that decide before it.
    Raises `KeyError` for an ego that is not on the road.
    """
    world, wanted = state.world, id or FIRST
    if len(world.avs) == 1:
        return perceive(world, state.config, 0, state.ego().belief)
    announced: dict[int, Move] = {}
    for number in deciding_order(world.avs):
        name = ego_id(number)
        if name == wanted:
            one = state.egos.get(name)
            belief = NO_BELIEF if one is None else one.belief
            return perceive(world, state.config, number, belief, announced, state.parked)
        announced[number] = moves.get(name, Move.STAY)
    raise KeyError(wanted)


def next_belief(state: SimState) -> Belief:
    """What the first ego's sensor carries into the next tick; a stateless sensor is not asked."""
    return NO_BELIEF if sensor_named(state.config.sensor).stateless else sense(state)[1]


def deciding_order(cells: tuple[int, ...]) -> list[int]:
    """The egos in the order in which they decide: the furthest ahead first, ties by id."""
    return sorted(range(len(cells)), key=cells.__getitem__)


def _step(ego: Ego, percept: Percept, belief: Belief, config: Config, known: Decision | None) -> EgoStep:
    if known is not None:
        return EgoStep(percept, predict(percept, 1), known, belief)
    by_hand = ego.queue or ego.mode is Mode.MANUAL
    # A person's move needs no planner, and a foreign one may be what is being taken over from.
    if by_hand and is_foreign(config.planner):
        forecast, decision = predict(percept, 1), hold_position(percept, config)
    else:
        forecast, decision = plan_safely(percept, config)
    if by_hand:
        decision = override(decision, ego.queue[0] if ego.queue else Move.STAY)
    return _made((percept, forecast, decision, belief))


def _clear_of_egos(step: EgoStep, config: Config) -> EgoStep:
    """The step; or to stay, where its move would meet another ego."""
    percept, forecast, decision, belief = step
    if decision.move is Move.STAY or not forecast.meets_ego(decision.move):
        return step
    return EgoStep(percept, forecast, hold_position(percept, config, INTO_ANOTHER), belief)
