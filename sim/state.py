"""A session's state as one value, and one tick of it: perceive → forecast → plan → commit → judge.

`advance` is a pure function: the same run in gives the same tick out, on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from sim.commit import commit
from sim.config import Config
from sim.episode_record import EpisodeRecord
from sim.events import Event, EventType
from sim.fast_replace import fast_constructor, field_setter
from sim.generation import GenerationError, generate
from sim.metrics import Metrics
from sim.perceive import perceive
from sim.plan import Decision
from sim.plan.manual_override import override
from sim.plan.safe_planning import hold_position, is_foreign, plan_safely
from sim.planner_names import LOCAL
from sim.repetition import NOTHING_KEPT, Watch, update_watch
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.transition import transition
from sim.types import Mode, Move, Outcome
from sim.world import World

_END_EVENTS = {
    Outcome.SUCCESS: EventType.ARRIVED,
    Outcome.CRASH: EventType.CRASHED,
    Outcome.STUCK: EventType.STUCK,
}


__all__ = [
    "SimState",
    "StepResult",
    "apply_move",
    "commit",
    "decide",
    "next_episode",
    "reconfigure",
    "restart_episode",
    "step",
]


@dataclass(frozen=True, slots=True)
class SimState:
    """A world with all that decides how it goes on."""

    config: Config
    world: World
    mode: Mode = Mode.AUTO
    queue: tuple[Move, ...] = ()
    """moves a person asked for, taken one a tick"""
    metrics: Metrics = field(default_factory=Metrics)
    edits: int = 0
    """changes made so far; numbers the stream random places are drawn from"""
    fault: str | None = None
    """what the planner did instead of answering at the latest decision"""
    record: EpisodeRecord = field(default_factory=EpisodeRecord)
    """what the episode has come to so far"""
    watch: Watch = NOTHING_KEPT
    """for a cycle that the vehicle is in (`sim.repetition`)"""

    @staticmethod
    def start(config: Config) -> SimState:
        """The first episode's beginning. Raises `GenerationError` (`sim.generation`)."""
        return SimState(config, generate(config, 1))


@dataclass(frozen=True, slots=True)
class StepResult:
    """What one tick led to. There is no decision while a result stands."""

    state: SimState
    decision: Decision | None
    events: tuple[Event, ...]


_advanced = field_setter(SimState, "world", "metrics", "queue", "fault", "record", "watch")
_ticked = fast_constructor(StepResult, "state", "decision", "events")


def decide(state: SimState) -> Decision | None:
    """The decision the present state leads to; None once the episode has ended."""
    world, config = state.world, state.config
    if world.outcome is not Outcome.RUNNING:
        return None
    percept = perceive(world, config)
    by_hand = bool(state.queue) or state.mode is Mode.MANUAL
    # A person's move needs no planner, and a foreign one may be what is being taken over from.
    decision = (
        hold_position(percept, config)
        if by_hand and is_foreign(config.planner)
        else plan_safely(percept, config)
    )
    if state.queue:
        return override(decision, state.queue[0])
    return override(decision, Move.STAY) if state.mode is Mode.MANUAL else decision


def step(state: SimState, decided: Decision | None = None) -> StepResult:
    """One tick; `decided`: what the present state leads to, where that is known already."""
    decision = decide(state) if decided is None else decided
    if decision is None:
        return _hold(state)
    moved = apply_move(state, decision.move, by_person=decision.asked is not None, fault=decision.fault)
    after = moved.world
    events = []
    if decision.fault is not None and decision.fault != state.fault:
        events.append(Event(after.tick, EventType.PLANNER_FAILED, after.episode, how=decision.fault))
    if decision.held_back and decision.asked is not None:
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
            )
        )
    if after.outcome is not Outcome.RUNNING:
        cause = after.cause
        ids, cell, how = (cause.ids, cause.cell, cause.how) if cause else ((), None, None)
        event = _END_EVENTS[after.outcome]
        if after.outcome is Outcome.STUCK:
            how = "limit" if after.episode_tick > state.config.max_ticks else "repetition"
        events.append(Event(after.tick, event, after.episode, ids, cell, decision.move, how))
    return _ticked(moved, decision, tuple(events))


def apply_move(state: SimState, move: Move, *, by_person: bool, fault: str | None = None) -> SimState:
    """The run one tick on, where it is known what was decided: to this move, asked for by a person or not."""
    before, config = state.world, state.config
    after = transition(before, move, config)
    watch: Watch | None = NOTHING_KEPT
    if after.outcome is Outcome.RUNNING and not by_person and fault is None and _recurs(config):
        watch = update_watch(state.watch, after)
        if watch is None:
            after = replace(after, outcome=Outcome.STUCK, ended=after.tick)
    metrics = state.metrics.after_move(move, config.cell_m)
    ended = after.outcome is not Outcome.RUNNING
    if ended:
        metrics = metrics.after_end(after.outcome, after.episode_tick)
    record = state.record.after(
        before,
        after,
        move,
        edits=state.edits,
        certain=config.certain,
        by_person=by_person,
        faulty=fault is not None,
        ended=ended,
    )
    return _advanced(state, after, metrics, state.queue[1:], fault, record, watch or NOTHING_KEPT)


def _recurs(config: Config) -> bool:
    """Whether a situation that repeats ends the episode."""
    # A situation holds two rows (`sim.repetition`): all that matters where a move gains a row at most.
    local = config.planner in LOCAL and config.dynamics == DEFAULT_DYNAMICS
    return config.repetition and local and config.certain


def next_episode(state: SimState) -> tuple[SimState, Event]:
    """The following episode's beginning, at the present tick.

    Where roads must be drivable and none is found, the present episode again, which was; the event says so.
    """
    try:
        return _begin(state, state.config, state.world.episode + 1)
    except GenerationError:
        begun, event = restart_episode(state)
        return begun, replace(event, type=EventType.ROAD_KEPT)


def restart_episode(state: SimState) -> tuple[SimState, Event]:
    """The present episode's beginning again, at the present tick."""
    return _begin(state, state.config, state.world.episode)


def reconfigure(state: SimState, config: Config) -> tuple[SimState, Event]:
    """A fresh road of another configuration, at the present tick."""
    return _begin(state, config, state.world.episode + 1)


def _begin(state: SimState, config: Config, episode: int) -> tuple[SimState, Event]:
    world = generate(config, episode, tick=state.world.tick, numbered=state.world.numbered)
    event = Event(world.tick, EventType.EPISODE_STARTED, episode)
    return replace(
        state, config=config, world=world, queue=(), record=EpisodeRecord(), watch=NOTHING_KEPT
    ), event


def _hold(state: SimState) -> StepResult:
    """The result stands for a while; then the next episode begins."""
    world = replace(state.world, tick=state.world.tick + 1)
    held = replace(state, world=world, queue=())
    if world.ended is not None and world.tick - world.ended < state.config.reset_delay_ticks:
        return StepResult(held, None, ())
    begun, event = next_episode(held)
    return StepResult(begun, None, (event,))
