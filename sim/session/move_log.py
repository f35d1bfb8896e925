"""Which move was made at every tick, one byte each: who has it comes to a past state without deciding anew.

Deciding is most of what a tick takes, with a planner that searches nearly all. A fork shares its parent's
bytes: they are cut into blocks that never change. Leaves out why a move was made: that is asked for seldom,
and derived anew. Where a planner failed, and where nothing was decided, the tick is run as if it were new.
But a planner of another package is not asked again: it is noted that it failed, and that the vehicle stayed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from sim.plan.decision import Decision
from sim.plan.safe_planning import failed_decision, is_foreign
from sim.state import SimState, apply_move, sense, step
from sim.types import Move

BLOCK: Final = 256
"""Ticks in one block."""

_BY_PLANNER: Final = dict(zip(Move, (b"a", b"b", b"c", b"d", b"e", b"f"), strict=True))
_BY_PERSON: Final = {move: sign.upper() for move, sign in _BY_PLANNER.items()}
_OTHERWISE: Final = b"-"
_FAILED: Final = b"x"
_MEANT: Final = {
    sign[0]: (move, by_person)
    for by_person, signs in ((False, _BY_PLANNER), (True, _BY_PERSON))
    for move, sign in signs.items()
}


class MoveLog:
    """The moves of the first ticks of a session. It grows by `note`; a copy goes its own way."""

    __slots__ = ("_blocks", "_tail")

    def __init__(self, blocks: Sequence[bytes] = ()) -> None:
        """Of such blocks as another has. Raises `ValueError` where they cannot be another's."""
        self._blocks, self._tail = tuple(blocks), b""
        if self._blocks and len(self._blocks[-1]) < BLOCK:
            self._tail, self._blocks = self._blocks[-1], self._blocks[:-1]
        if any(len(block) != BLOCK for block in self._blocks):
            raise ValueError("only the last block may be short")

    @property
    def blocks(self) -> tuple[bytes, ...]:
        """All of it, in ASCII; each but the last is full."""
        return (*self._blocks, self._tail) if self._tail else self._blocks

    def __len__(self) -> int:
        return BLOCK * len(self._blocks) + len(self._tail)

    def copy(self) -> MoveLog:
        """One that goes its own way."""
        twin = MoveLog.__new__(MoveLog)
        twin._blocks, twin._tail = self._blocks, self._tail
        return twin

    def note(self, decision: Decision | None) -> None:
        """What was decided at the next tick."""
        if decision is None or decision.fault is not None:
            foreign = decision is not None and decision.asked is None and is_foreign(decision.planner)
            self._tail += _FAILED if foreign else _OTHERWISE
        else:
            self._tail += (_BY_PLANNER if decision.asked is None else _BY_PERSON)[decision.move]
        if len(self._tail) == BLOCK:
            self._blocks, self._tail = (*self._blocks, self._tail), b""

    def cut(self, ticks: int) -> None:
        """Forget all but the first ticks."""
        if ticks < len(self):
            whole, rest = divmod(ticks, BLOCK)
            self._blocks, self._tail = self._blocks[:whole], self.blocks[whole][:rest]

    def after(self, state: SimState) -> SimState:
        """The state one tick on, from one that it was noted in."""
        sign = self._sign(state.world.tick)
        meant = _MEANT.get(sign)
        if meant is not None:
            move, by_person = meant
            return apply_move(state, move, by_person=by_person)
        if sign == _FAILED[0]:
            decision = failed_decision(sense(state)[0], state.config)
            return apply_move(state, decision.move, by_person=False, fault=decision.fault)
        return step(state).state

    def planned(self, tick: int) -> Move | None:
        """The move that a planner made at a tick; None where a person did, nobody did, or it failed."""
        move, by_person = _MEANT.get(self._sign(tick), (None, True))
        return None if by_person else move

    def failed(self, tick: int) -> bool:
        """Whether a planner of another package failed at a tick."""
        return self._sign(tick) == _FAILED[0]

    def _sign(self, tick: int) -> int:
        number, place = divmod(tick, BLOCK)
        block = self._blocks[number] if number < len(self._blocks) else self._tail
        return block[place] if place < len(block) else _OTHERWISE[0]
