"""The costs of every move by compiled words, once they are loaded: what the searches find, much faster.

A session that nobody asks about needs none of it. An explanation takes hundreds of decisions, and so it has
this loaded first (`load_compiled_costs`), if it was ever compiled on this machine; from then on the planners
that weigh costs answer from it. The answers are the same ones.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

from sim.compiled_files import ready_mark
from sim.perceive import Percept
from sim.search.costs import Weights
from sim.types import MOVES, Move
from sim.world.grid import Board

if TYPE_CHECKING:
    from sim.batch.move_kernel import MoveKernel

COMPILED: Final = "one_decision"
"""Under which it is kept that they were compiled (`sim.compiled_files`)."""


@dataclass(frozen=True, slots=True)
class CompiledCosts:
    """What every move costs in all."""

    totals: tuple[int | None, ...]
    """with the cheapest way on, in the order of `Move`; None: no way"""
    lasting: Move | None
    """where no move leads to the goal: the one after which the ego keeps clear longest"""


class Unlike(NamedTuple):
    """How what is seen differs from a percept, as boards."""

    movers: Board = 0
    """cells of movers that are not there"""
    fixed: Board = 0
    """cells of what never moves that is not there"""
    barriers: Board = 0
    """cells with a barrier more"""
    potholes: Board = 0
    """cells with a pothole more"""


_Found = Callable[[Percept, Weights, int], "tuple[tuple[int | None, ...], int | None] | None"]
_found: _Found | None = None


def load_compiled_costs(*, compile_now: bool = False) -> bool:
    """Load the compiled costs, unless they would have to be compiled first; whether they are there now.

    Compiling takes a minute or two, once for each version; `compile_now` does it where it is needed.
    """
    global _found
    if _found is None:
        if not (compile_now or are_compiled()):
            return False
        from sim.batch.move_kernel import make_ready
        from sim.batch.percept_words import totals_where_compiled

        make_ready()
        _found = totals_where_compiled
    return True


def are_compiled() -> bool:
    """Whether they were compiled on this machine before, so that they are quickly loaded."""
    mark = ready_mark(COMPILED)
    return mark is not None and mark.exists()


def wait_to_be_compiled() -> bool:
    """Whether they have not been compiled yet, and what is compiled can be kept."""
    mark = ready_mark(COMPILED)
    return mark is not None and not mark.exists()


def are_loaded() -> bool:
    """Whether the planners that weigh costs answer from them."""
    return _found is not None


def forget_compiled_costs() -> None:
    """Search from now on; what is decided is the same."""
    global _found
    _found = None


def compiled_costs(percept: Percept, weights: Weights, limit: int) -> CompiledCosts | None:
    """What every move costs where this is seen, with `limit` ticks left; None where it must be searched for.

    That is where nothing is loaded, and of roads, movers or sensors that it is not compiled for.
    """
    if _found is None:
        return None
    found = _found(percept, weights, limit)
    if found is None:
        return None
    totals, lasting = found
    return CompiledCosts(totals, None if lasting is None else MOVES[lasting])


def move_kernel(percept: Percept, limit: int) -> MoveKernel:
    """What tells the moves where things are seen otherwise, with `limit` ticks left.

    Precondition: `are_loaded`, and `compiled_costs` answers for what is seen.
    """
    from sim.batch.move_kernel import MoveKernel

    return MoveKernel(percept, limit)


if __name__ == "__main__":  # in a process of its own, so that nobody waits for a compiler
    if hasattr(os, "nice"):
        os.nice(19)
    load_compiled_costs(compile_now=True)
