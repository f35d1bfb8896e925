"""What was at stake: where the other move would have led, run to the end, beside where this one leads.

After its first move each future goes on as it would: the planner decides, nobody speaks. Ticks lost
are those of the best way on after each move (`sim.oracle`), whatever the planner makes of it. On the way it
is decided by what is seen, and judged by what is there.
"""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import moves_where, next_belief
from sim.ego import Ego
from sim.explain.chances import Chances, chances
from sim.explain.episode_rollout import driven_in_words, rollout
from sim.explain.stuck import is_stuck, shut_off
from sim.fast_replace import field_setter
from sim.oracle.lower_bounds import PATIENCE, least_ticks
from sim.plan import Decision
from sim.repetition import NOTHING_KEPT, Situation, situation
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.transition import next_world, repeats_for_ever, transition
from sim.types import Mode, Move, Outcome
from sim.world import World


@dataclass(frozen=True, slots=True)
class Future:
    """How an episode ends after a move."""

    outcome: Outcome
    ticks: int
    """from the episode's start to its end"""
    ids: tuple[str, ...] = ()
    """what was crashed with"""


@dataclass(frozen=True, slots=True)
class Alternatives:
    """A move that was not made, beside the one that was."""

    foil: Move
    would: Future | None
    """how it would have ended; None where a person drives and has not said on"""
    real: Future | None
    """how it ends after the move that was made, left to itself"""
    ticks_lost: int | None
    """how much longer the best way on is after the foil; None where there is none after either of them, and
    where that is not known within `sim.oracle.lower_bounds.PATIENCE`"""
    dead_end: bool
    """whether after the foil no way leads on, and after the move made one does"""
    would_chances: Chances | None = None
    """the chances after the foil, where it is left to chance how others react; `would` is one future then"""
    real_chances: Chances | None = None
    """the same after the move that was made"""

    @property
    def by_chance(self) -> bool:
        """Whether it hangs on chance how one of the two ends."""
        return any(each is not None and not each.settled for each in (self.would_chances, self.real_chances))


def stakes(state: SimState, decision: Decision, foil: Move) -> Alternatives | None:
    """What `foil` would have meant instead of the move of `decision`; None if it leads off the road."""
    if decision.option(foil).cell is None or foil is decision.move:
        return None
    ego = decision.av
    other, real = after_move(state, foil, ego), after_move(state, decision.move, ego)
    ticks_lost, dead_end = _compared(other, real, ego)
    likely = [chances(each, ego, seen=False) for each in (other, real)]
    return Alternatives(foil, _end(other, ego), _end(real, ego), ticks_lost, dead_end, *likely)


def _compared(other: SimState, real: SimState, ego: str) -> tuple[int | None, bool]:
    """Ticks that the best way on is longer after the other move; whether only after that none leads on."""
    try:
        rest_other, rest_real = least_ticks(other, PATIENCE, ego), least_ticks(real, PATIENCE, ego)
    except ImpatientError:
        return None, False
    if rest_other is None or rest_real is None:
        return None, rest_real is not None
    return rest_other - rest_real, False


def after_move(state: SimState, move: Move, ego: str | None = None) -> SimState:
    """The state after a move of an ego, the first by default, judged.

    Others that decide before it move as they do; those after it know the move and decide anew.
    """
    if len(state.world.avs) > 1:
        after = transition(state, moves_where(state, move, ego)).state
        return after.with_ego(ego, queue=(), watch=NOTHING_KEPT)
    only = state.ego()
    world = next_world(state.world, (move,), state.config)
    moved = _ego_after(only, (), NOTHING_KEPT, next_belief(state))
    return _state_after(state, world, {only.id: moved})


_ego_after = field_setter(Ego, "queue", "watch", "belief")
_state_after = field_setter(SimState, "world", "egos")


def _end(state: SimState, ego: str) -> Future | None:
    """How the episode ends if nobody says anything more; None if it waits for a person or is not told."""
    if state.ego(ego).mode is Mode.MANUAL and state.world.outcome is Outcome.RUNNING:
        return None
    driven = driven_in_words(state, ego)
    if driven is not None:
        return _future(driven, ego)
    # With `repetition` the run itself ends there. Of several egos what repeats is not looked for.
    alone = len(state.world.avs) == 1
    recurs = alone and repeats_for_ever(state.config, state.ego().planner) and not state.config.repetition
    seen: set[Situation] = set()
    last = state
    stuck: bool | None = None
    if state.world.outcome is Outcome.RUNNING:
        for before, tick in rollout(state, ego=ego):
            if tick.state.world.outcome is Outcome.RUNNING and stuck is None and shut_off(tick, ego):
                stuck = is_stuck(tick.state)
                if stuck:
                    return Future(Outcome.STUCK, state.config.max_ticks + 1)
            if recurs:
                now = situation(before.world)
                if now in seen:
                    return Future(Outcome.STUCK, state.config.max_ticks + 1)
                seen.add(now)
            last = tick.state
    world = last.world
    if world.outcome is Outcome.RUNNING:
        return None
    return _future(world, ego)


def _future(last: World, ego: str) -> Future:
    """What the last world of an episode tells of its end."""
    ids = last.cause.ids if last.cause else ()
    return Future(last.outcome, last.episode_tick, tuple(name for name in ids if name != ego))
