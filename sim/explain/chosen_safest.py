"""Whether a move that was made was the safest of all that could be made: each is run, and what follows."""

from __future__ import annotations

from dataclasses import dataclass

from sim.explain.move_risk import move_risk
from sim.explain.safe_move import SafeMove
from sim.explain.safest_moves import safest_moves, safety
from sim.session.timeline import Timeline
from sim.types import Move


@dataclass(frozen=True, slots=True)
class ChosenSafest:
    """A move that was made beside all that could have been, in facts."""

    tick: int
    moves: tuple[SafeMove, ...]
    """all moves, the safest first"""
    made: SafeMove

    @property
    def safest(self) -> tuple[Move, ...]:
        """The safest moves; several are alike."""
        return tuple(each.move for each in self.moves if safety(each) == safety(self.moves[0]))

    @property
    def was_safest(self) -> bool:
        """Whether none was safer."""
        return self.made.move in self.safest


def chosen_safest(timeline: Timeline, tick: int | None = None) -> ChosenSafest:
    """The first ego's latest move of the present drive, or that at a tick. Raises as `move_risk`."""
    risk = move_risk(timeline, tick)
    earlier = timeline.copy()
    if risk.tick != timeline.tick:
        earlier.rewind(risk.tick)
    moves = safest_moves(earlier)
    return ChosenSafest(risk.tick, moves, next(each for each in moves if each.move is risk.made))
