"""How likely it was, by what was believed at a move, that the cell it led to would be taken."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import sense
from sim.explain.cell_belief import taken_in
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.perceive import sensor_named
from sim.session.timeline import Timeline
from sim.types import Cell, Kind, Move, Outcome


@dataclass(frozen=True, slots=True)
class CellEntered:
    """A move that was made, and the cell it led to."""

    tick: int
    move: Move
    cell: Cell | None
    """None is off the road"""
    faithful: bool
    """whether the sensor shows what is there"""
    expected_free: bool
    """whether the step was expected to meet nothing"""
    taken: float | None
    """the likelihood that anything would be there after the tick; None where it is not known"""
    truth: Kind | None
    """what really was there after the tick, beside the ego"""


def cell_entered(timeline: Timeline, tick: int | None = None) -> CellEntered:
    """The cell of the move that was made at a tick, by default of the latest. Raises `QuestionError`.

    `no_such_tick`; `not_yet` for the present tick; `nothing_yet` before the first move; `result_stood`.
    """
    world = timeline.state.world
    last = (timeline.tick if world.ended is None else world.ended) - 1
    if tick is None and last < world.episode_start:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    at = last if tick is None else tick
    if at == timeline.tick and world.outcome is Outcome.RUNNING:
        raise QuestionError("not_yet", tick=at)
    state = state_at(timeline, at)
    decision = timeline.decided(state)
    if decision is None:
        raise QuestionError("result_stood", tick=at, outcome=state.world.outcome)
    after = timeline.at(at + 1).world
    chosen, config = decision.chosen, state.config
    found = None
    if chosen.cell is not None:
        there = (
            each.kind for each in after.things() if each.cell == chosen.cell and each.kind is not Kind.AV
        )
        found = next(there, None)
    faithful = sensor_named(config.sensor).faithful
    taken = None
    if not faithful and chosen.cell is not None and not config.sensor_latency:
        # Needs numpy, which sessions with the perfect sensor do without.
        from sim.perceive.bayes_filter import predict_layers
        from sim.perceive.belief import GridBelief

        belief = sense(state)[1]
        if isinstance(belief, GridBelief):
            taken = taken_in(predict_layers(belief, after, config)[0], chosen.cell)
    return CellEntered(at, decision.move, chosen.cell, faithful, not chosen.reason.blocks, taken, found)
