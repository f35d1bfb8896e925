"""Runs a whole search with an executor, for programs and the command line. The service keeps pieces."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from threading import Event
from typing import Any

from sim.evaluate.executor import Executor, InProcess
from sim.falsify.spec import Falsification
from sim.falsify.stages import pieces, run_piece
from sim.falsify.summary import summarize


def falsify(
    spec: Falsification,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda _: None,
    cancelled: Event | None = None,
) -> dict[str, Any] | None:
    """The result of a search; None where it was cancelled. `progress` is told of each piece's weight."""
    cancelled = cancelled or Event()
    executor = executor or InProcess()
    parts: dict[str, bytes] = {}
    while left := pieces(spec, parts):
        for piece, body in executor.run(partial(run_piece, spec.to_json()), left, cancelled):
            parts[piece.key] = body
            progress(piece.weight)
        if cancelled.is_set():
            return None
    return summarize(spec, parts)
