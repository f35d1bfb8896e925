"""Why an episode ended in a crash, proved: what it hung on, and what would have saved it.

The causes are a smallest set of things that is *enough* for the crash, found as those of a decision are
(`causes`): with nothing else on the road the last tick, run again, ends the same way. What would have
saved it is looked for backwards along the way that was driven: the last tick at which some way still led to
the goal, the move that was made there, and one that leads there. Where somebody may give way by chance, or
the road was changed meanwhile, nothing is claimed about earlier ticks.

A crash may hang on what is there and was not detected, and on what was detected and is not there. So a thing
is taken away from the road and from what is seen at once.

Of several egos it is about the one that crashed. In the last tick, run again, the others make the moves that
they made.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final

from sim.commit import commit, moves_with
from sim.explain.alternatives import after_move
from sim.explain.avoidance import UNKNOWN, Avoidable, find_avoidance
from sim.explain.factors import is_factor
from sim.explain.facts import Explanation, QuestionError, Verified, check_ego
from sim.explain.intervention import Intervention
from sim.explain.why_causes import by_salience, minimal_sufficient_set, rank_causes
from sim.fast_replace import field_setter
from sim.forecast import predict
from sim.judge import collisions
from sim.oracle.lower_bounds import PATIENCE, least_ticks
from sim.oracle.other_egos import ego_first
from sim.perceive import Percept, perceive_truth
from sim.plan import Decision, Option
from sim.rules.slipping import moves_made
from sim.search.reactive import ImpatientError
from sim.session.timeline import SNAPSHOT_TICKS, Timeline
from sim.state import FIRST, SimState
from sim.types import Kind, Move, Outcome
from sim.world import Cause, Thing, World

LOOK_BACK_TICKS: Final = 1_000
"""How far back a crash that is asked about is looked for."""

SAVED_WITHIN: Final = 64
"""Ticks before a crash in which a move that would have saved it is looked for."""


@dataclass(frozen=True, slots=True)
class LastAvoidance:
    """A move after which a way led to the goal, at the last tick at which there was one."""

    tick: int
    made: Move
    instead: Move
    ticks: int
    """from the episode's beginning to the goal, by the quickest way after it"""


@dataclass(frozen=True, slots=True)
class Crash:
    """A crash, in facts."""

    explanation: Explanation
    """of the last tick: what the crash hung on, and how it goes without"""
    cause: Cause
    """what was hit, how, and where"""
    end: int
    """the tick at which it was so"""
    free: tuple[Move, ...]
    """moves of the last tick that would have met nothing"""
    certain: bool
    """whether anything is known of the ticks before: nobody gives way by chance"""
    looked_back: int
    """how many ticks before the crash were looked at for one that would have saved it"""
    whole: bool
    """whether that was the whole way from the episode's beginning, on a road nobody changed"""
    saving: LastAvoidance | None
    """None where no way led to the goal at any of those ticks"""
    avoidable: Avoidable
    """whether the crash could have been avoided all the same; not looked for where `saving` is known"""
    met: tuple[Option, ...]
    """the moves of the last tick with what each of them would have met, whatever was seen of it"""
    missed: tuple[str, ...] = ()
    """of what was hit and what it hung on, the things that were not detected where they were"""

    @property
    def made(self) -> Move:
        """The move of the last tick as it was made, which is not the one decided where that slipped."""
        moment, decision = self.explanation.moment, self.explanation.decision
        number = moment.number(decision.av)
        tried = moves_with(moment.world, decision.move, number)
        return moves_made(moment.world, tried, moment.config)[number]

    @property
    def slipped(self) -> bool:
        """Whether the step to the side of the last move was lost on snow."""
        return self.made is not self.explanation.decision.move


def stood_there(before: World, cause: Cause, name: str) -> bool:
    """Whether a thing was in the cell of the crash already the tick before, so that it was driven into."""
    thing = before.find(name)
    return thing is not None and thing.cell == cause.cell


class _LastTick:
    """The last tick again on roads that differ from its own: whether it ends in a crash."""

    def __init__(self, state: SimState, rerun: Intervention, made: Mapping[str, Move]) -> None:
        """`rerun` is that of its decision; `made`: the moves of all egos."""
        self._run = state
        self._rerun = rerun
        self._made = made
        self._known: dict[tuple[str, frozenset[str]], bool] = {}

    def without(self, names: Iterable[str]) -> bool:
        """Whether there is a crash had these never been there, or these wishes never been said."""
        gone = frozenset(names)
        key = ("without", gone)
        if key not in self._known:
            world = self._run.world.without(frozenset(name for name in gone if not is_factor(name)))
            self._known[key] = self._crashes(world, self._rerun.never_there(gone), gone)
        return self._known[key]

    def keeping(self, names: Iterable[str]) -> bool:
        """Whether there is a crash had nothing but these been there."""
        kept = frozenset(names)
        key = ("keeping", kept)
        if key not in self._known:
            world = self._run.world.keeping(frozenset(name for name in kept if not is_factor(name)))
            others = [id for id in self._run.egos if id != self._rerun.ego and id not in kept]
            self._known[key] = self._crashes(world, self._rerun.only_there(kept), others)
        return self._known[key]

    def _crashes(self, world: World, move: Move, gone: Collection[str]) -> bool:
        there, ids = ego_first(_on_road(self._run, world), self._rerun.ego, gone)
        moves = (move, *(self._made.get(id, Move.STAY) for id in ids[1:]))
        after = commit(there, moves, self._run.config)
        found = collisions(there, after, self._run.config.ego_dynamics(world.road))
        return any(FIRST in (cause.ego, *cause.ids) for cause in found)


_on_road = field_setter(SimState, "world")


def why_crashed(timeline: Timeline, tick: int | None = None, *, ego: str | None = None) -> Crash:
    """Why the latest crash came about, or the one that the decision of a tick led to.

    `ego`: the one that it is to be of; by default it is of the one that crashed. Raises `QuestionError`:
    `no_crash` with the number of episodes that have ended, `no_crash_lately`, `no_such_tick`,
    `no_crash_then`, and `no_such_ego`.
    """
    check_ego(timeline.state, ego)
    state = _fatal(timeline) if tick is None else _at(timeline, tick)
    fatal = timeline.led_to(state)
    after = fatal.state.world
    assert after.cause is not None
    ego = ego or after.cause.ego
    decision = timeline.decided(state, ego)
    if decision is None or ego not in (after.cause.ego, *after.cause.ids):
        raise QuestionError("no_crash_then", tick=after.tick)
    certain = state.config.certain
    rerun = Intervention(state, decision, timeline.announced(state, ego))
    met = _met(rerun)
    made = {id: each.decision.move for id, each in fatal.steps.items()}
    explanation = _last_tick(rerun, met, made)
    looked_back, whole, saving = _saving(timeline, state, ego) if certain else (0, False, None)
    free = tuple(option.move for option in met if option.verdict == "free")
    involved = dict.fromkeys((*after.cause.ids, *(cause.id for cause in explanation.causes)))
    missed = tuple(name for name in involved if _missed(rerun, name))
    avoidable = UNKNOWN
    if certain and saving is None:
        avoidable = find_avoidance(_driven(timeline, state, ego, looked_back), whole=whole)
    return Crash(
        explanation,
        after.cause,
        after.tick,
        free,
        certain,
        looked_back,
        whole,
        saving,
        avoidable,
        met,
        missed,
    )


def led_to_crash(timeline: Timeline, tick: int | None) -> bool:
    """Whether the decision of a tick ended in a crash, or if none is named, the latest one."""
    if tick is None:
        world = timeline.state.world
        return world.outcome is Outcome.CRASH and (world.ended or 0) > 0
    return 0 <= tick < timeline.tick and crashed_in(timeline, timeline.at(tick))


def crashed_in(timeline: Timeline, state: SimState) -> bool:
    """Whether the decision that is taken in this state of a timeline ends in a crash."""
    if state.world.outcome is not Outcome.RUNNING:
        return False
    return timeline.led_to(state).state.world.outcome is Outcome.CRASH


def _at(timeline: Timeline, tick: int) -> SimState:
    """The state before the crash at a tick: that of its decision, or that in which it was so."""
    for each in (tick, tick - 1):
        if not 0 <= each < timeline.tick:
            continue
        state = timeline.at(each)
        if crashed_in(timeline, state):
            return state
    if tick > timeline.tick:
        raise QuestionError("no_such_tick", tick=tick, now=timeline.tick)
    raise QuestionError("no_crash_then", tick=tick)


def _fatal(timeline: Timeline) -> SimState:
    """The state in which the last decision before the latest crash was taken."""
    metrics = timeline.state.metrics
    if not metrics.crashes:
        raise QuestionError("no_crash", episodes=metrics.episodes)
    stop, span = timeline.tick, 1
    oldest = max(0, stop - LOOK_BACK_TICKS)
    after = timeline.state
    while stop > oldest:
        first = max(oldest, stop - span)
        for state in reversed(list(timeline.between(first, stop))):
            if after.metrics.crashes > state.metrics.crashes:
                return state
            after = state
        stop, span = first, min(4 * span, SNAPSHOT_TICKS)
    raise QuestionError("no_crash_lately", ticks=LOOK_BACK_TICKS)


def _met(rerun: Intervention) -> tuple[Option, ...]:
    """The decision's options with what each move would really have met."""
    options = rerun.decision.options
    if rerun.faithful:
        return options
    forecast = predict(_truth(rerun), 1)
    own = forecast.ego
    met = []
    for option in options:
        reason, causes = forecast.check_step(own, forecast.dynamics.target(own, option.move))
        met.append(replace(option, reason=reason, causes=causes))
    return tuple(met)


def _truth(rerun: Intervention) -> Percept:
    """What was there, with what the other egos told."""
    state = rerun.state
    truth = perceive_truth(state.world, state.config, state.number(rerun.ego))
    return replace(truth, egos=rerun.percept.egos) if rerun.percept.egos else truth


def _missed(rerun: Intervention, name: str) -> bool:
    """Whether a thing was there and not detected where it was."""
    if rerun.faithful:
        return False
    there = rerun.state.world.find(name)
    if there is None or there.kind is Kind.AV:
        return False
    return not is_detected(rerun.percept, rerun.state.world, name)


def is_detected(percept: Percept, world: World, name: str) -> bool:
    """Whether a percept has a thing where it is, rather than where it was when it was last detected."""
    there, seen = world.find(name), percept.find(name)
    if seen is None or there is None or there.kind is Kind.AV:
        return seen is not None
    return (seen.kind, seen.cell) == (there.kind, there.cell)


def _last_tick(rerun: Intervention, met: tuple[Option, ...], made: Mapping[str, Move]) -> Explanation:
    """What the crash hung on, as the explanation of the last decision."""
    state, decision = rerun.state, rerun.decision
    tried = _LastTick(state, rerun, made)
    names = [*rerun.factors, *_by_salience(rerun, met)]
    enough, groups, minimal = minimal_sufficient_set(tried, True, names)
    made_first = sorted(met, key=lambda option: option.move is not decision.move)

    def find(name: str) -> tuple[Thing, bool] | None:
        there = state.world.find(name)
        return rerun.seen(name) if there is None else (there, True)

    causes = rank_causes(tried, True, find, made_first, groups)
    told = dict.fromkeys(cause.group for cause in causes if cause.group)
    return Explanation(
        about="why",
        moment=state,
        decision=decision,
        foil=None,
        causes=causes,
        verified=Verified(
            necessary=all(cause.necessary for cause in causes),
            sufficient=tried.keeping(enough),
            minimal=minimal,
        ),
        counterfactuals=tuple(rerun.counterfactual(group, rerun.never_there(group)) for group in told),
        stakes=None,
        reruns=rerun.count,
    )


def _by_salience(rerun: Intervention, met: tuple[Option, ...]) -> list[str]:
    """The id of all that is there, the most telling first, then of what was only seen."""
    seen = by_salience(rerun.percept, rerun.decision)
    if rerun.faithful:
        return seen
    there = by_salience(_truth(rerun), replace(rerun.decision, options=met))
    return list(dict.fromkeys([*there, *seen]))


def _driven(timeline: Timeline, fatal: SimState, ego: str, ticks: int) -> Iterator[tuple[SimState, Decision]]:
    """The states before a crash with what was decided in them, the last first."""
    end = fatal.world.tick + 1
    for state in reversed(list(timeline.between(max(0, end - ticks), end))):
        decision = timeline.decided(state, ego)
        if decision is not None:
            yield state, decision


def _saving(timeline: Timeline, fatal: SimState, ego: str) -> tuple[int, bool, LastAvoidance | None]:
    """The last move instead of which another would have led to the goal.

    With how many ticks before the crash were looked at, and whether the episode began with the first of them.
    """
    start = fatal.world.episode_start
    stop, span, looked = fatal.world.tick + 1, 4, 0
    oldest = max(start, stop - SAVED_WITHIN)
    while stop > oldest:
        first = max(oldest, stop - span)
        for state in reversed(list(timeline.between(first, stop))):
            if (state.edits, state.config, state.world.episode) != (
                fatal.edits,
                fatal.config,
                fatal.world.episode,
            ):
                return looked, False, None
            try:
                saving = _saved(timeline, state, ego)
            except ImpatientError:
                return looked, False, None
            looked += 1
            if saving is not None:
                return looked, False, saving
        stop, span = first, 4 * span
    return looked, oldest == start, None


def _saved(timeline: Timeline, state: SimState, ego: str) -> LastAvoidance | None:
    """A move from which a way leads to the goal, with the quickest, if there is one."""
    decision = timeline.decided(state, ego)
    if decision is None or least_ticks(state, PATIENCE, ego) is None:
        return None
    ways = [
        (ticks, order, option.move)
        for order, option in enumerate(decision.options)
        if option.cell is not None and option.move is not decision.move
        if (ticks := least_ticks(after_move(state, option.move, ego), PATIENCE, ego)) is not None
    ]
    if not ways:
        return None
    ticks, _, move = min(ways)
    world = state.world
    return LastAvoidance(world.tick, decision.move, move, world.episode_tick + 1 + ticks)
