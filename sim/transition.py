"""One tick: everything moves at once, then it is judged. The same for live sessions, proofs and environments.

All of it is pure: the same state and moves lead to the same result, on every machine.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from sim.commit import commit
from sim.config import Config
from sim.decide import decide_alone, decide_each, sense
from sim.ego import Ego
from sim.events import Event, EventType
from sim.fast_replace import fast_constructor, field_setter
from sim.judge import collisions, outcome
from sim.perceive import NO_BELIEF, Belief, sensor_named
from sim.plan import Decision, traits_of
from sim.repetition import NOTHING_KEPT, Watch, update_watch
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.rules.slipping import moves_made
from sim.state import FIRST, EgoStep, SimState, StepResult, hold_result
from sim.types import Move, Outcome, ego_id
from sim.world import World

_END_EVENTS = {
    Outcome.SUCCESS: EventType.ARRIVED,
    Outcome.CRASH: EventType.CRASHED,
    Outcome.STUCK: EventType.STUCK,
}
_NO_STEPS: dict[str, EgoStep] = {}
_NO_FAULTS: dict[str, str] = {}
_NO_DECISIONS: dict[str, Decision] = {}

_ego_after = field_setter(Ego, "queue", "metrics", "fault", "record", "watch", "belief")
_state_after = field_setter(SimState, "world", "egos")
_ticked = fast_constructor(StepResult, "state", "steps", "events")


def next_world(world: World, moves: tuple[Move, ...], config: Config, parked: Collection[int] = ()) -> World:
    """The world one tick later, with the outcome, its tick and the cause of a crash set.

    `moves` are in the order of `World.avs`; `parked`: places in it of egos that the end does not wait for.
    Raises `ValueError` where a move leads off the road.
    """
    after = commit(world, moves, config)
    crashes = collisions(world, after, config.ego_dynamics(world.road))
    result = outcome(after, crashes, config.max_ticks, parked)
    if result is Outcome.RUNNING:
        return after
    return replace(after, outcome=result, ended=after.tick, cause=crashes[0] if crashes else None)


def transition(
    state: SimState,
    moves: Mapping[str, Move],
    steps: Mapping[str, EgoStep] = _NO_STEPS,
    *,
    by_person: Collection[str] = (),
    faults: Mapping[str, str] = _NO_FAULTS,
) -> StepResult:
    """The state one tick on, in which the egos make these moves; an ego that is left out stays.

    `steps` are handed on in the result. `by_person`: the egos whose move a person asked for; `faults`: what
    planners did instead of answering. Raises `ValueError` where a move leads off the road.
    """
    before = state.world
    if before.outcome is not Outcome.RUNNING:
        return hold_result(state)
    if len(before.avs) == 1:
        ego = state.ego()
        move, fault = moves.get(ego.id, Move.STAY), faults.get(ego.id)
        return transition_alone(state, ego, move, steps, ego.id in by_person, fault)
    ids = [ego_id(number) for number in range(len(before.avs))]
    tried = tuple([moves.get(id, Move.STAY) for id in ids])
    after = next_world(before, tried, state.config, state.parked)
    all_moves = moves_made(before, tried, state.config)
    egos = {
        id: _one_of_several_moved(
            state,
            number,
            after,
            all_moves[number],
            id in by_person,
            faults.get(id),
            _next_belief(state, steps, id, moves),
        )
        for number, id in enumerate(ids)
        if id in state.egos
    }
    made = dict(zip(ids, all_moves, strict=True))
    events = _events(state, after, dict(zip(ids, tried, strict=True)), made, steps)
    return _ticked(_state_after(state, after, egos), steps, events)


def transition_alone(
    state: SimState,
    ego: Ego,
    move: Move,
    steps: Mapping[str, EgoStep] = _NO_STEPS,
    by_person: bool = False,
    fault: str | None = None,
) -> StepResult:
    """`transition` of the only ego of a road. The episode must not have ended."""
    before, config = state.world, state.config
    after = next_world(before, (move,), config)
    tried = move
    if config.slips:
        move = moves_made(before, (move,), config)[0]
    certain, ended = config.certain, after.outcome is not Outcome.RUNNING
    watch: Watch | None = NOTHING_KEPT
    undecided = ended or by_person or fault is not None
    if config.repetition and not undecided and repeats_for_ever(config, ego.planner):
        watch = update_watch(ego.watch, after)
        if watch is None:
            after, ended = replace(after, outcome=Outcome.STUCK, ended=after.tick), True
    metrics = ego.metrics.after_move(move, config.cell_m)
    if ended:
        metrics = metrics.after_end(after.outcome, after.episode_tick)
    faulty = fault is not None
    record = ego.record.after(before, after, move, state.edits, certain, by_person, faulty, ended)
    stateless = sensor_named(config.sensor).stateless
    belief = NO_BELIEF if stateless else _next_belief(state, steps, ego.id)
    made = _ego_after(ego, ego.queue[1:], metrics, fault, record, watch or NOTHING_KEPT, belief)
    told = ended or (steps and (by_person or faulty or move is not tried))  # of a decision, with steps alone
    events = _events(state, after, {ego.id: tried}, {ego.id: move}, steps) if told else ()
    return _ticked(_state_after(state, after, {ego.id: made}), steps, events)


def repeats_for_ever(config: Config, planner: str | None = None) -> bool:
    """Whether a repeated situation repeats for ever: nothing outside it affects the decisions.

    `planner`: None means that of the configuration.
    """
    # A `Situation` holds two rows (`sim.repetition`), which is enough if a move gains at most one row.
    return (
        config.certain
        and config.dynamics == DEFAULT_DYNAMICS
        and traits_of(planner or config.planner).local
        and sensor_named(config.sensor).faithful
    )


def _next_belief(
    state: SimState, steps: Mapping[str, EgoStep], id: str, moves: Mapping[str, Move] | None = None
) -> Belief:
    """What an ego's sensor carries into the next tick; `moves`: those of all egos."""
    if sensor_named(state.config.sensor).stateless:
        return NO_BELIEF
    step = steps.get(id)
    return sense(state, moves or {}, id)[1] if step is None else step.belief


def step(state: SimState, decided: Mapping[str, Decision] = _NO_DECISIONS) -> StepResult:
    """One tick: every ego decides, then all move. `decided`: decisions that are known already, by ego id."""
    world = state.world
    if world.outcome is not Outcome.RUNNING:
        return hold_result(state)
    if len(world.avs) == 1:
        ego = state.ego()
        alone = decide_alone(state, ego, decided.get(ego.id))
        decision = alone.decision
        by_person = decision.asked is not None
        return transition_alone(state, ego, decision.move, {ego.id: alone}, by_person, decision.fault)
    steps = decide_each(state, decided)
    made = {id: each.decision for id, each in steps.items()}
    return transition(
        state,
        {id: decision.move for id, decision in made.items()},
        steps,
        by_person=[id for id, decision in made.items() if decision.asked is not None],
        faults={id: decision.fault for id, decision in made.items() if decision.fault is not None},
    )


def _one_of_several_moved(
    state: SimState,
    number: int,
    after: World,
    move: Move,
    by_person: bool,
    fault: str | None,
    belief: Belief,
) -> Ego:
    """An ego after its move. An ego that has arrived no longer moves; the episode ends for all at once."""
    before, config = state.world, state.config
    ego = state.egos[ego_id(number)]
    metrics = ego.metrics
    if before.avs[number] >= before.road.columns:
        metrics = metrics.after_move(move, config.cell_m)
    ended = after.outcome is not Outcome.RUNNING
    if ended:
        metrics = metrics.after_end(after.outcome, after.episode_tick)
    record = ego.record.after(
        before, after, move, state.edits, config.certain, by_person, fault is not None, ended, number
    )
    # Cycles of several egos are not detected: a situation would have to hold all of them.
    return _ego_after(ego, ego.queue[1:], metrics, fault, record, NOTHING_KEPT, belief)


def _events(
    state: SimState,
    after: World,
    tried: Mapping[str, Move],
    moves: Mapping[str, Move],
    steps: Mapping[str, EgoStep],
) -> tuple[Event, ...]:
    """What there is to be told of a tick; `moves`: those that were made of those `tried`."""
    events = []
    for id, each in steps.items():
        decision = each.decision
        if decision.fault is not None and decision.fault != state.egos[id].fault:
            failed = EventType.PLANNER_FAILED
            events.append(Event(after.tick, failed, after.episode, how=decision.fault, ego=id))
        if decision.asked is not None and decision.held_back:
            blocked = decision.option(decision.asked)
            events.append(
                Event(
                    after.tick,
                    EventType.HELD_BACK,
                    after.episode,
                    blocked.causes,
                    blocked.cell,
                    decision.asked,
                    blocked.reason,
                    ego=id,
                )
            )
    events += [
        Event(after.tick, EventType.SLIPPED, after.episode, move=tried[id], ego=id)
        for id in steps
        if moves.get(id) is not tried.get(id)
    ]
    if after.outcome is not Outcome.RUNNING:
        cause = after.cause
        ids, cell, how = (cause.ids, cause.cell, cause.how) if cause else ((), None, None)
        event, ego = _END_EVENTS[after.outcome], cause.ego if cause else FIRST
        if after.outcome is Outcome.STUCK:
            how = "limit" if after.episode_tick > state.config.max_ticks else "repetition"
        events.append(
            Event(after.tick, event, after.episode, ids, cell, moves.get(ego, Move.STAY), how, ego=ego)
        )
    return tuple(events)
