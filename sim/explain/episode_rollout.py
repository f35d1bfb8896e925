"""What will come of a run: the same ticks as it would be driven through, taken on a copy.

Nothing is foretold here, everything is run, to the end of the episode or for a few ticks. What a person
may say meanwhile is left out: a story is told as if nothing were said any more.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

from sim.episode_record import DetourReason, Sake, detour_reason
from sim.explain.compiled_futures import compiled_drive, drive_is_compiled_for, ticks_are_compiled_for
from sim.explain.effort import prepare
from sim.plan import Decision, traits_of
from sim.state import SimState, StepResult
from sim.transition import step
from sim.types import Mode, Move, Outcome, kind_of
from sim.world import Cause, World
from sim.world.grid import Road

NEXT_TICKS: Final = 5
"""How far the way from here is told."""

MAX_WORK: Final = 10_000_000
"""How much is looked through for one story where the planner searches: cells times rows, every tick.

Four whole episodes on the default road; on the largest roads, where one decision takes a second, a few
ticks.
"""

MAX_FAULTS: Final = 20
"""After so many failures one after the other no answer is expected of a planner any more."""


@dataclass(frozen=True, slots=True)
class Detour:
    """A move that was not straight on."""

    tick: int
    move: Move
    sake: Sake
    ids: tuple[str, ...]
    """who would have been met straight ahead"""


@dataclass(frozen=True, slots=True)
class EpisodeRollout:
    """A run to the end of its episode; where a result stands, to the end of the next."""

    tick: int
    """where it begins"""
    waited: int
    """ticks until the next road, where a result stood"""
    episode: int
    end: int
    """the tick at which it ends"""
    outcome: Outcome
    """`RUNNING` where it is not told: no answer from the planner in time, or too much to look through"""
    cause: Cause | None
    """of a crash"""
    path: tuple[Move, ...]
    """every move, in order"""
    detours: tuple[Detour, ...]
    held_back: tuple[int, ...]
    """ticks in which a person's move is not made, since its cell will not be free"""
    by_hand: bool
    """whether a person drives and asked for nothing, from the first move on"""
    silent: str | None
    """what the planner did instead of answering"""
    digest: str
    """of the world at the end"""

    @property
    def ticks(self) -> int:
        """Ticks from the beginning to the end."""
        return self.end - self.tick

    @property
    def driven(self) -> int:
        """Ticks on the road, without those waited."""
        return len(self.path)

    def moves(self) -> dict[Move, int]:
        """How many moves of each kind."""
        return {move: self.path.count(move) for move in Move}


@dataclass(frozen=True, slots=True)
class RouteAhead:
    """The next decisions, none of them taken yet."""

    state: SimState
    """the moment it is seen from"""
    decisions: tuple[Decision, ...]
    detours: tuple[Detour, ...]
    outcome: Outcome
    cause: Cause | None
    offered: bool
    """whether this is what the planner would do, were it let: a person drives and has asked for nothing"""
    chance: bool
    """whether what comes after the first move hangs on who gives way"""


def story(state: SimState, *, ego: str | None = None) -> EpisodeRollout:
    """What comes of a run if nothing more is said, told of an ego, the first by default."""
    return drive(state, ego=ego).story


@dataclass(frozen=True, slots=True)
class Drive:
    """A run to the end of its episode, each tick of which can be looked up."""

    state: SimState
    story: EpisodeRollout
    ego: str | None
    _ticks: tuple[tuple[SimState, StepResult], ...] | None
    """None where it was driven in compiled words"""

    def moves(self) -> list[tuple[int, Move]]:
        """The moves that led on, with their ticks; one that did not come in time leads nowhere."""
        if self._ticks is None:
            return list(enumerate(self.story.path, self.story.tick))
        found = [decided(tick, self.ego) for _, tick in self._ticks]
        return [(each.tick, each.move) for each in found if each is not None and not each.timed_out]

    def at(self, tick: int) -> SimState:
        """The state before a tick of the run."""
        if self._ticks is None:
            return compiled_drive(self.state, tick - self.story.tick).state
        return next(state for state, _ in self._ticks if state.world.tick == tick)


def drive(state: SimState, first: Decision | None = None, *, ego: str | None = None) -> Drive:
    """What comes of a run if nothing more is said, by compiled words where they are loaded for it.

    `first`: as in `rollout`.
    """
    prepare(state)
    if first is None and is_driven_in_words(state, ego):
        return Drive(state, _compiled_story(state), ego, None)
    ticks = tuple(rollout(state, first, ego=ego))
    return Drive(state, summarize(state, list(ticks), ego=ego), ego, ticks)


def is_driven_in_words(state: SimState, ego: str | None = None) -> bool:
    """Whether a run is driven by compiled words, to its end."""
    return drive_is_compiled_for(state, ego) and _is_short(state, ego)


def _is_short(state: SimState, ego: str | None) -> bool:
    """Whether no more is looked through to the end of a run than is allowed for a story."""
    config, world = state.config_of(ego), state.world
    if not traits_of(config.planner).plans_to_goal:
        return True
    return (config.max_ticks + 1 - world.episode_tick) * work_of_tick(world.road) <= MAX_WORK


def driven_in_words(state: SimState, ego: str | None = None) -> World | None:
    """The world at the end of a run by compiled words, without its story; None where they do not tell it.

    What repeats itself goes on for ever, so a run that arrives or crashes in words has not ended before by
    a repetition, which words do not know. One that is stuck in words may have.
    """
    known = ticks_are_compiled_for(state, ego) and state.ego(ego).mode is Mode.AUTO
    if not known or not _is_short(state, ego):
        return None
    last = step(compiled_drive(state).state).state.world
    if last.outcome is Outcome.STUCK and not drive_is_compiled_for(state, ego):
        return None
    return last


def _compiled_story(state: SimState) -> EpisodeRollout:
    """`story` of a run that is driven in compiled words up to its last tick."""
    driven = compiled_drive(state)
    world, columns = state.world, state.world.road.columns
    detours, cell = [], world.av
    for tick, (move, met) in enumerate(zip(driven.moves, driven.met, strict=True), world.tick):
        if move is not Move.FORWARD:
            ahead = cell - columns
            ids = tuple(name for name in (world.hazards.get(ahead), met) if name)
            detours.append(Detour(tick, move, kind_of(ids[0]) if ids else DetourReason.BETTER, ids))
        across, along = move.offset
        cell += across + along * columns
    last = step(driven.state)
    told = summarize(driven.state, [(driven.state, last)])
    return replace(
        told,
        tick=world.tick,
        path=driven.moves + told.path,
        detours=(*detours, *told.detours),
    )


def rollout(
    state: SimState, first: Decision | None = None, *, ego: str | None = None
) -> Iterator[tuple[SimState, StepResult]]:
    """Each tick to the end of the episode, with the run before it; a result that stands is waited out first.

    `first`: what an ego decides in the first tick, where that is not what the state itself leads to.

    A tick whose planner did not answer in time is the last: a session would hand over to a person there.
    So is that of one that has failed `MAX_FAULTS` times running; and on long roads a planner that searches is
    followed for so long only as `MAX_WORK` allows.
    """
    prepare(state)
    work = faults = 0
    planners = [each.planner or state.config.planner for each in state.egos.values()]
    searching = sum(traits_of(planner).plans_to_goal for planner in planners)
    started = state.world.outcome is Outcome.RUNNING
    while state.world.outcome is Outcome.RUNNING or not started:
        tick = step(state) if first is None else step(state, {first.av: first})
        first = None
        yield state, tick
        decision = decided(tick, ego)
        faults = faults + 1 if decision is not None and decision.fault is not None else 0
        if faults == MAX_FAULTS or any(each.decision.timed_out for each in tick.steps.values()):
            return
        state = tick.state
        if searching:
            work += searching * work_of_tick(state.world.road)
            if work > MAX_WORK:
                return
        started = started or state.world.outcome is Outcome.RUNNING


def decided(tick: StepResult, ego: str | None) -> Decision | None:
    """What an ego decided in a tick, the first by default; None where it decided nothing."""
    found = tick.of(ego)
    return None if found is None else found.decision


def work_of_tick(road: Road) -> int:
    """How much a planner that searches looks through in a tick."""
    return road.columns * road.rows * road.rows


def summarize(
    state: SimState, ticks: list[tuple[SimState, StepResult]], *, ego: str | None = None
) -> EpisodeRollout:
    """The story of ticks that were followed from a run, told of an ego, the first by default.

    The end is that of the episode; who has arrived before it waits for the others.
    """
    path, detours, held_back = [], [], []
    last, silent = state, None
    for before, tick in ticks:
        late = [each.decision for each in tick.steps.values() if each.decision.timed_out]
        if late:
            silent = late[0].fault
            break
        decision = decided(tick, ego)
        last = tick.state
        if decision is not None:
            path.append(decision.move)
            detours += find_detour(before, tick, ego=ego)
            held_back += [decision.tick] if decision.held_back else []
    if last.world.outcome is Outcome.RUNNING and ticks:
        final = decided(ticks[-1][1], ego)
        silent = silent or (None if final is None else final.fault)
    first = next((found for _, tick in ticks if (found := decided(tick, ego)) is not None), None)
    own = state.ego(ego)
    return EpisodeRollout(
        tick=state.world.tick,
        waited=sum(before.world.outcome is not Outcome.RUNNING for before, _ in ticks),
        episode=last.world.episode,
        end=last.world.tick,
        outcome=last.world.outcome,
        cause=last.world.cause,
        path=tuple(path),
        detours=tuple(detours),
        held_back=tuple(held_back),
        by_hand=first is not None and first.asked is not None and own.mode is Mode.MANUAL and not own.queue,
        silent=silent,
        digest=last.world.digest(),
    )


def find_detour(before: SimState, tick: StepResult, *, ego: str | None = None) -> list[Detour]:
    """The detour of an ego in a tick, if it was one."""
    decision = decided(tick, ego)
    if decision is None or decision.move is Move.FORWARD:
        return []
    by_person, faulty = decision.asked is not None, decision.fault is not None
    number = before.number(ego)
    whose, ids = detour_reason(
        before.world, tick.state.world, by_person=by_person, faulty=faulty, number=number
    )
    return [Detour(decision.tick, decision.move, whose, ids)]


def route_ahead(state: SimState, ticks: int = NEXT_TICKS, *, ego: str | None = None) -> RouteAhead:
    """The next decision of an ego (the first by default) and the way from there.

    Empty while a result stands, and where that ego has arrived.

    Where a person drives and has asked for nothing, it is what the planner would do, were it let. Movers
    that may give way or brake are a matter of chance that no driver knows beforehand, so then the way is
    not told beyond the next decision.
    """
    own = state.ego(ego)
    offered = own.mode is Mode.MANUAL and not own.queue
    chance = not state.config.certain
    seen = state.with_ego(ego, mode=Mode.AUTO) if offered else state
    decisions: list[Decision] = []
    detours: list[Detour] = []
    after = seen
    for _ in range(1 if chance else ticks):
        if after.world.outcome is not Outcome.RUNNING:
            break
        tick = step(after)
        decision = decided(tick, ego)
        if decision is None or any(each.decision.timed_out for each in tick.steps.values()):
            break
        decisions.append(decision)
        detours += find_detour(after, tick, ego=ego)
        after = tick.state
    outcome, cause = after.world.outcome, after.world.cause
    return RouteAhead(state, tuple(decisions), tuple(detours), outcome, cause, offered, chance)
