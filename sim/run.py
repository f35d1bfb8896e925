"""A session's state as one value, and one tick of it: perceive → forecast → plan → commit → judge.

`advance` is a pure function: the same run in gives the same tick out, on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from sim.changing import changer, maker
from sim.commit import commit
from sim.config import Config
from sim.course import Course
from sim.events import Event, EventType
from sim.generate import GenerationError, generate
from sim.kinds import Mode, Move, Outcome
from sim.metrics import Metrics
from sim.perceive import perceive
from sim.plan import Decision
from sim.plan.guard import is_foreign, planned, stayed
from sim.plan.manual import obey
from sim.planner_names import LOCAL
from sim.repetition import NOTHING_KEPT, Watch, watched
from sim.transition import transition
from sim.world import World

_END_EVENTS = {
    Outcome.SUCCESS: EventType.ARRIVED,
    Outcome.CRASH: EventType.CRASHED,
    Outcome.STUCK: EventType.STUCK,
}


__all__ = [
    "Run",
    "Tick",
    "advance",
    "commit",
    "decide",
    "next_episode",
    "reconfigured",
    "repeated",
    "restarted",
]


@dataclass(frozen=True, slots=True)
class Run:
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
    course: Course = field(default_factory=Course)
    """what the episode has come to so far"""
    watch: Watch = NOTHING_KEPT
    """for a cycle that the vehicle is in (`sim.repetition`)"""

    @staticmethod
    def start(config: Config) -> Run:
        """The first episode's beginning. Raises `GenerationError` (`sim.generate`)."""
        return Run(config, generate(config, 1))


@dataclass(frozen=True, slots=True)
class Tick:
    """What one tick led to. There is no decision while a result stands."""

    run: Run
    decision: Decision | None
    events: tuple[Event, ...]


_advanced = changer(Run, "world", "metrics", "queue", "fault", "course", "watch")
_ticked = maker(Tick, "run", "decision", "events")


def decide(run: Run) -> Decision | None:
    """The decision the present state leads to; None once the episode has ended."""
    world, config = run.world, run.config
    if world.outcome is not Outcome.RUNNING:
        return None
    percept = perceive(world, config)
    by_hand = bool(run.queue) or run.mode is Mode.MANUAL
    # A person's move needs no planner, and a foreign one may be what is being taken over from.
    decision = stayed(percept, config) if by_hand and is_foreign(config.planner) else planned(percept, config)
    if run.queue:
        return obey(decision, run.queue[0])
    return obey(decision, Move.STAY) if run.mode is Mode.MANUAL else decision


def advance(run: Run, decided: Decision | None = None) -> Tick:
    """One tick; `decided`: what the present state leads to, where that is known already."""
    decision = decide(run) if decided is None else decided
    if decision is None:
        return _hold(run)
    moved = repeated(run, decision.move, by_person=decision.asked is not None, fault=decision.fault)
    after = moved.world
    events = []
    if decision.fault is not None and decision.fault != run.fault:
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
            how = "limit" if after.episode_tick > run.config.max_ticks else "repetition"
        events.append(Event(after.tick, event, after.episode, ids, cell, decision.move, how))
    return _ticked(moved, decision, tuple(events))


def repeated(run: Run, move: Move, *, by_person: bool, fault: str | None = None) -> Run:
    """The run one tick on, where it is known what was decided: to this move, asked for by a person or not."""
    before, config = run.world, run.config
    after = transition(before, move, config)
    watch: Watch | None = NOTHING_KEPT
    if after.outcome is Outcome.RUNNING and not by_person and fault is None and _recurs(config):
        watch = watched(run.watch, after)
        if watch is None:
            after = replace(after, outcome=Outcome.STUCK, ended=after.tick)
    metrics = run.metrics.after_move(move, config.cell_m)
    ended = after.outcome is not Outcome.RUNNING
    if ended:
        metrics = metrics.after_end(after.outcome, after.episode_tick)
    course = run.course.after(
        before,
        after,
        move,
        edits=run.edits,
        certain=config.certain,
        by_person=by_person,
        faulty=fault is not None,
        ended=ended,
    )
    return _advanced(run, after, metrics, run.queue[1:], fault, course, watch or NOTHING_KEPT)


def _recurs(config: Config) -> bool:
    """Whether a situation that repeats ends the episode."""
    return config.repetition and config.planner in LOCAL and config.certain


def next_episode(run: Run) -> tuple[Run, Event]:
    """The following episode's beginning, at the present tick.

    Where roads must be drivable and none is found, the present episode again, which was; the event says so.
    """
    try:
        return _begin(run, run.config, run.world.episode + 1)
    except GenerationError:
        begun, event = restarted(run)
        return begun, replace(event, type=EventType.ROAD_KEPT)


def restarted(run: Run) -> tuple[Run, Event]:
    """The present episode's beginning again, at the present tick."""
    return _begin(run, run.config, run.world.episode)


def reconfigured(run: Run, config: Config) -> tuple[Run, Event]:
    """A fresh road of another configuration, at the present tick."""
    return _begin(run, config, run.world.episode + 1)


def _begin(run: Run, config: Config, episode: int) -> tuple[Run, Event]:
    world = generate(config, episode, tick=run.world.tick, numbered=run.world.numbered)
    event = Event(world.tick, EventType.EPISODE_STARTED, episode)
    return replace(run, config=config, world=world, queue=(), course=Course(), watch=NOTHING_KEPT), event


def _hold(run: Run) -> Tick:
    """The result stands for a while; then the next episode begins."""
    world = replace(run.world, tick=run.world.tick + 1)
    held = replace(run, world=world, queue=())
    if world.ended is not None and world.tick - world.ended < run.config.reset_delay_ticks:
        return Tick(held, None, ())
    begun, event = next_episode(held)
    return Tick(begun, None, (event,))
