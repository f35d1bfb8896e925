"""Whose fault a crash was, by a stated duty; when it was too late; whether it was seen coming.

The duty follows responsibility-sensitive safety (S. Shalev-Shwartz, S. Shammah, A. Shashua, *On a formal
model of safe and scalable self-driving cars*, arXiv:1708.06374, 2017): nobody moves into another, and who
can avoid a crash must. So it is asked who moved into whom, and whether the ego could have kept clear
*knowing what it knew*: by a move that it saw to be free, or by a way that was there before and that nothing
left to chance or unseen hid from it. That a way was there is searched on the road as it was
(`sim.explain.avoidance`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from sim.explain.alternatives import after_move
from sim.explain.avoidance import UNKNOWN, Avoidable, Avoidance, find_avoidance
from sim.explain.crash import SAVED_WITHIN, Crash, is_detected, why_crashed
from sim.explain.episode_rollout import rollout, summarize
from sim.explain.foresight import driving
from sim.forecast import predict
from sim.perceive import sensor_named
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import SimState, StepResult
from sim.types import Move, Outcome

LOOK_BACK: Final = 40
"""Ticks before a crash in which it is looked for since when it was expected."""

RERUN_TICKS: Final = 12
"""Ticks before a crash whose other moves are run to the end, where ways cannot be searched."""
_CLEAR: Final = (Outcome.SUCCESS, Outcome.STUCK)


class Entered(StrEnum):
    """Who moved into whom."""

    EGO = "ego"
    """the ego moved, into something that stood"""
    OTHER = "other"
    """something moved into the cell in which the ego stayed"""
    BOTH = "both"
    """both moved"""


class Fault(StrEnum):
    """Whose fault a crash was."""

    PERSON = "person"
    """a person had asked for the move"""
    PLANNER = "planner"
    """the planner gave no valid answer"""
    SLIPPED = "slipped"
    """the move looked free, and its step to the side was lost on snow"""
    SENSOR = "sensor"
    """the move looked free, since something was not detected where it was"""
    EGO = "ego"
    OTHER = "other"
    SHARED = "shared"
    """something moved into the ego, and the ego could have kept clear"""
    NOBODY = "nobody"
    UNKNOWN = "unknown"
    """whether the ego could have kept clear was not found out"""


@dataclass(frozen=True, slots=True)
class Blame:
    """A crash in facts, as far as duty is concerned."""

    crash: Crash
    state: SimState
    """the state before the crash"""
    decision: Decision
    entered: Entered
    knew: bool
    """whether the move was seen to meet something when it was decided"""
    free: tuple[Move, ...]
    """other moves that were seen to be free then"""
    avoidable: Avoidable
    """the last move instead of which another would have kept clear"""
    exact: bool
    """whether it was searched that nothing later could have, rather than that nothing later was found"""
    knowable: bool
    """whether nothing that it takes to find this was left to chance or hidden from the sensor"""
    fault: Fault

    @property
    def ticks_before(self) -> int | None:
        """How many ticks before the crash the last way out was taken away."""
        last = self.avoidable.last
        return None if last is None else self.crash.end - last.tick


@dataclass(frozen=True, slots=True)
class Foreseen:
    """Whether a crash was seen coming, in facts."""

    crash: Crash
    state: SimState
    """the state before the crash"""
    seen_since: int | None
    """the first tick since which what was hit was detected where it was; None if not at the end"""
    expected_since: int | None
    """the same of those in which the forecast had it meet the ego's last move"""


def blame(timeline: Timeline, tick: int | None = None, *, ego: str | None = None) -> Blame:
    """Whose fault the latest crash was, or that of a tick. Raises `QuestionError` as `why_crashed` does."""
    crash = why_crashed(timeline, tick, ego=ego)
    decision, state = crash.explanation.decision, crash.explanation.moment
    states, whole = _before(timeline, state, decision.av)
    config = state.config
    driven = list(_decided(timeline, states, decision.av))
    avoidable = find_avoidance(driven, whole=whole)
    searched = avoidable.proved
    if not searched:
        avoidable = _found_by_rerun(driven)
    entered = _entered(crash, timeline.led_to(state).state, decision)
    free = tuple(
        option.move
        for option in decision.options
        if option.verdict == "free" and option.move is not decision.move
    )
    knew = decision.chosen.reason.blocks
    last = avoidable.last
    seen_free = last is not None and last.tick == decision.tick and knew and last.instead in free
    knowable = seen_free or (config.certain and sensor_named(config.sensor).faithful)
    exact = (searched and not config.reacting) or (last is not None and last.tick == decision.tick)
    fault = _fault(crash, decision, entered, knew, free, avoidable, knowable)
    return Blame(crash, state, decision, entered, knew, free, avoidable, exact, knowable, fault)


def foreseen(timeline: Timeline, tick: int | None = None, *, ego: str | None = None) -> Foreseen:
    """Since when what was hit was seen, and expected. Raises `QuestionError` as `why_crashed` does."""
    crash = why_crashed(timeline, tick, ego=ego)
    decision, fatal = crash.explanation.decision, crash.explanation.moment
    own = decision.av
    start = fatal.world.avs[fatal.number(own)]
    end = fatal.config.ego_dynamics(fatal.world.road).target(start, decision.move)
    hit = {name for name in crash.cause.ids if name != own}
    seen_since = expected_since = None
    looking_seen = looking_expected = True
    for state in _before(timeline, fatal, own, LOOK_BACK)[0]:
        taken = timeline.taken(state, own)
        if taken is None:
            break
        now, ahead = state.world.tick, fatal.world.tick - state.world.tick
        looking_seen = looking_seen and any(is_detected(taken.percept, state.world, name) for name in hit)
        if looking_expected:
            met = predict(taken.percept, ahead + 1).check_step(start, end, ahead)[1]
            looking_expected = bool(hit.intersection(met))
        seen_since = now if looking_seen else seen_since
        expected_since = now if looking_expected else expected_since
        if not (looking_seen or looking_expected):
            break
    return Foreseen(crash, fatal, seen_since, expected_since)


def _before(
    timeline: Timeline, fatal: SimState, ego: str, most: int = SAVED_WITHIN
) -> tuple[list[SimState], bool]:
    """The states up to the last of an episode, the last first, as far as the road was left alone.

    With whether they begin with the episode.
    """
    end, start = fatal.world.tick + 1, fatal.world.episode_start
    found: list[SimState] = []
    for state in reversed(list(timeline.between(max(start, end - most), end))):
        same = (state.config, state.world.episode) == (fatal.config, fatal.world.episode)
        if not same or state.edits != fatal.edits or ego not in state.egos:
            return found, False
        found.append(state)
    return found, end - most <= start


def _decided(timeline: Timeline, states: list[SimState], ego: str) -> Iterator[tuple[SimState, Decision]]:
    for state in states:
        decision = timeline.decided(state, ego)
        if decision is not None:
            yield state, decision


def _found_by_rerun(driven: list[tuple[SimState, Decision]]) -> Avoidable:
    """The last move instead of which another, run with everybody reacting as drawn, ends without a crash.

    For roads on which ways cannot be searched; nothing is proved where none is found.
    """
    for state, decision in driven[:RERUN_TICKS]:
        for option in decision.options:
            if option.cell is None or option.move is decision.move:
                continue
            after = driving(after_move(state, option.move, decision.av), decision.av)
            if summarize(after, _run(after, decision.av), ego=decision.av).outcome in _CLEAR:
                found = Avoidance(state.world.tick, decision.move, option.move, stays=False)
                return Avoidable(found, proved=True)
    return UNKNOWN


def _run(state: SimState, ego: str) -> list[tuple[SimState, StepResult]]:
    """The ticks to the end of the episode; none where it has ended."""
    return list(rollout(state, ego=ego)) if state.world.outcome is Outcome.RUNNING else []


def _entered(crash: Crash, after: SimState, decision: Decision) -> Entered:
    """Who moved in the last tick, of the ego and what it hit; `after`: the state with the crash."""
    if crash.made is Move.STAY:
        return Entered.OTHER
    state = crash.explanation.moment
    moved = [
        name
        for name in crash.cause.ids
        if name != decision.av and _cell(state, name) is not None and _cell(state, name) != _cell(after, name)
    ]
    return Entered.BOTH if moved else Entered.EGO


def _cell(state: SimState, name: str) -> object:
    found = state.world.find(name)
    return None if found is None else found.cell


def _fault(
    crash: Crash,
    decision: Decision,
    entered: Entered,
    knew: bool,
    free: tuple[Move, ...],
    avoidable: Avoidable,
    knowable: bool,
) -> Fault:
    """Whose fault it was, by the duty stated above."""
    if decision.fault is not None:
        return Fault.PLANNER
    if decision.asked is not None and not decision.held_back:
        return Fault.PERSON
    if not knew and crash.slipped:
        return Fault.SLIPPED
    if not knew and any(name in crash.cause.ids for name in crash.missed):
        return Fault.SENSOR
    could = bool(free) and knew
    could = could or (avoidable.last is not None and knowable)
    if entered is Entered.OTHER:
        return Fault.SHARED if could else Fault.OTHER
    if could:
        return Fault.EGO
    known = avoidable.proved and (avoidable.last is None or not knowable)
    return Fault.NOBODY if known else Fault.UNKNOWN
