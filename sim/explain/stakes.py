"""What was at stake: where the other move would have led, run to the end, beside where this one leads.

After its first move each future goes on as it would: the planner decides, nobody speaks. Ticks lost
are those of the best way on after each move (`sim.optimum`), whatever the planner makes of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sim.explain.future import followed
from sim.kinds import Mode, Move, Outcome
from sim.optimum import least_ticks
from sim.plan import Decision
from sim.planner_names import LOCAL
from sim.repetition import NOTHING_KEPT, Situation, situation
from sim.run import Run
from sim.transition import transition


@dataclass(frozen=True, slots=True)
class Future:
    """How an episode ends after a move."""

    outcome: Outcome
    ticks: int
    """from the episode's start to its end"""
    ids: tuple[str, ...] = ()
    """what was crashed with"""


@dataclass(frozen=True, slots=True)
class Stakes:
    """A move that was not made, beside the one that was."""

    foil: Move
    would: Future | None
    """how it would have ended; None where a person drives and has not said on"""
    real: Future | None
    """how it ends after the move that was made, left to itself"""
    ticks_lost: int | None
    """how much longer the best way on is after the foil; None where there is none after either"""
    dead_end: bool
    """whether after the foil no way leads on, and after the move made one does"""


def stakes(run: Run, decision: Decision, foil: Move) -> Stakes | None:
    """What `foil` would have meant instead of the move of `decision`; None if it leads off the road."""
    if decision.option(foil).cell is None or foil is decision.move:
        return None
    other, real = after_move(run, foil), after_move(run, decision.move)
    rest_other, rest_real = least_ticks(other), least_ticks(real)
    both = rest_other is not None and rest_real is not None
    return Stakes(
        foil=foil,
        would=_end(other),
        real=_end(real),
        ticks_lost=rest_other - rest_real if both else None,  # type: ignore[operator]
        dead_end=rest_other is None and rest_real is not None,
    )


def after_move(run: Run, move: Move) -> Run:
    """The state after a move, judged."""
    return replace(run, world=transition(run.world, move, run.config), queue=(), watch=NOTHING_KEPT)


def _end(run: Run) -> Future | None:
    """How the episode ends if nobody says anything more; None if it waits for a person or is not told."""
    if run.mode is Mode.MANUAL and run.world.outcome is Outcome.RUNNING:
        return None
    # With `repetition` the run itself ends there.
    recurs = run.config.planner in LOCAL and run.config.certain and not run.config.repetition
    seen: set[Situation] = set()
    last = run
    if run.world.outcome is Outcome.RUNNING:
        for before, tick in followed(run):
            if recurs:
                now = situation(before.world)
                if now in seen:
                    return Future(Outcome.STUCK, run.config.max_ticks + 1)
                seen.add(now)
            last = tick.run
    world = last.world
    if world.outcome is Outcome.RUNNING:
        return None
    return Future(world.outcome, world.episode_tick, world.cause.ids if world.cause else ())
