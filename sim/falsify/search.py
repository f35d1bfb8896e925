"""Runs a whole search with an executor, for programs and the command line. The service keeps pieces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from threading import Event
from typing import Any

from sim.evaluate.executor import Executor, run_all
from sim.falsify.spec import Falsification
from sim.falsify.stages import SomePiece, pieces, run_piece
from sim.falsify.summary import summarize


def falsify(
    spec: Falsification,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda _: None,
    cancelled: Event | None = None,
    parts: dict[str, bytes] | None = None,
) -> dict[str, Any] | None:
    """The result of a search; None where it was cancelled. `progress` is told the weight of what is done.

    Pieces that are there already are not run; the others are added as they are finished.
    """
    cancelled, done = cancelled or Event(), {} if parts is None else parts

    def left() -> Sequence[SomePiece]:
        return pieces(spec, done)

    def keep(piece: SomePiece, body: bytes) -> None:
        done[piece.key] = body

    if not run_all(executor, partial(run_piece, spec.to_json()), left, keep, cancelled, progress):
        return None
    return summarize(spec, done)
