"""Which move was made at every tick, one byte each: who has it comes to a past state without deciding anew.

Deciding is most of what a tick takes, with a planner that searches nearly all. A fork shares its parent's
bytes: they are cut into blocks that never change. Leaves out why a move was made: that is asked for seldom,
and derived anew. Where a planner failed, and where nothing was decided, the tick is run as if it were new.
But a planner of another package is not asked again: it is noted that it failed, and that the ego stayed.
Of several egos each has a byte in every tick, in the order of their ids.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from sim.decide import sense
from sim.plan.decision import Decision
from sim.plan.safe_planning import failed_decision, is_foreign
from sim.state import SimState
from sim.transition import step, transition, transition_alone
from sim.types import Move, Outcome

BLOCK: Final = 256
"""Ticks in one block."""

_BY_PLANNER: Final = dict(zip(Move, (b"a", b"b", b"c", b"d", b"e", b"f"), strict=True))
_BY_PERSON: Final = {move: sign.upper() for move, sign in _BY_PLANNER.items()}
_OTHERWISE: Final = b"-"
_FAILED: Final = b"x"
_ARRIVED: Final = b"."
_MEANT: Final = {
    sign[0]: (move, by_person)
    for by_person, signs in ((False, _BY_PLANNER), (True, _BY_PERSON))
    for move, sign in signs.items()
}


class MoveLog:
    """The moves of the egos in the first ticks of a session. It grows by `note`; a copy goes its own way."""

    __slots__ = ("_blocks", "_egos", "_size", "_tail")

    def __init__(self, blocks: Sequence[bytes] = (), egos: int = 1) -> None:
        """Of such blocks as another has. Raises `ValueError` where they cannot be another's."""
        self._blocks, self._tail = tuple(blocks), b""
        self._egos, self._size = egos, BLOCK * egos
        if self._blocks and len(self._blocks[-1]) < self._size:
            self._tail, self._blocks = self._blocks[-1], self._blocks[:-1]
        if any(len(block) != self._size for block in self._blocks) or len(self._tail) % egos:
            raise ValueError("only the last block may be short")

    @property
    def blocks(self) -> tuple[bytes, ...]:
        """All of it, in ASCII; each but the last is full."""
        return (*self._blocks, self._tail) if self._tail else self._blocks

    def __len__(self) -> int:
        return BLOCK * len(self._blocks) + len(self._tail) // self._egos

    def copy(self) -> MoveLog:
        """One that goes its own way."""
        twin = MoveLog.__new__(MoveLog)
        twin._blocks, twin._tail = self._blocks, self._tail
        twin._egos, twin._size = self._egos, self._size
        return twin

    def note(self, *decisions: Decision | None) -> None:
        """What the egos decided at the next tick, in order.

        One that decided nothing while others did has arrived.
        """
        if len(decisions) == 1:
            (decision,) = decisions
            self._tail += _OTHERWISE if decision is None else _sign(decision)
        else:
            none = _ARRIVED if any(decisions) else _OTHERWISE
            self._tail += b"".join([none if each is None else _sign(each) for each in decisions])
        if len(self._tail) == self._size:
            self._blocks, self._tail = (*self._blocks, self._tail), b""

    def cut(self, ticks: int) -> None:
        """Forget all but the first ticks."""
        if ticks < len(self):
            whole, rest = divmod(ticks, BLOCK)
            self._blocks, self._tail = self._blocks[:whole], self.blocks[whole][: rest * self._egos]

    def after(self, state: SimState) -> SimState:
        """The state one tick on, from one that it was noted in."""
        world = state.world
        if self._egos == 1 and len(world.avs) == 1 and world.outcome is Outcome.RUNNING:
            known = _MEANT.get(self._sign(world.tick, 0))
            if known is not None:
                return transition_alone(state, state.ego(), known[0], by_person=known[1]).state
        moves: dict[str, Move] = {}
        by_person, failed = [], []
        for number, id in enumerate(state.egos):
            sign = self._sign(state.world.tick, number)
            meant = _MEANT.get(sign)
            if meant is not None:
                moves[id] = meant[0]
                if meant[1]:
                    by_person.append(id)
            elif sign == _FAILED[0]:
                failed.append(id)
            elif sign != _ARRIVED[0]:
                return step(state).state
        faults = {}
        for id in failed:
            decision = failed_decision(sense(state, moves, id)[0], state.config_of(id))
            faults[id] = decision.fault or ""
        return transition(state, moves, by_person=by_person, faults=faults).state

    def moves(self, state: SimState) -> dict[str, Move]:
        """The moves made in a state that it was noted in, by ego id, where they are known."""
        signs = {id: self._sign(state.world.tick, number) for number, id in enumerate(state.egos)}
        return {id: _MEANT[sign][0] for id, sign in signs.items() if sign in _MEANT}

    def planned(self, tick: int, number: int = 0) -> Move | None:
        """The move of an ego's planner at a tick; None where a person made it, nobody did, or it failed."""
        move, by_person = _MEANT.get(self._sign(tick, number), (None, True))
        return None if by_person else move

    def failed(self, tick: int, number: int = 0) -> bool:
        """Whether an ego's planner of another package failed at a tick."""
        return self._sign(tick, number) == _FAILED[0]

    def _sign(self, tick: int, number: int) -> int:
        block_number, place = divmod(tick, BLOCK)
        block = self._blocks[block_number] if block_number < len(self._blocks) else self._tail
        place = place * self._egos + number
        return block[place] if place < len(block) else _OTHERWISE[0]


def _sign(decision: Decision) -> bytes:
    if decision.fault is None:
        return (_BY_PLANNER if decision.asked is None else _BY_PERSON)[decision.move]
    return _FAILED if decision.asked is None and is_foreign(decision.planner) else _OTHERWISE
