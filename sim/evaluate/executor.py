"""Executors of evaluations: where the parts are run. Here: this process, or several on this machine.

`sim.evaluate.ray_executor` runs them on a cluster.

An executor runs pieces of work in any order and yields each answer with its piece. Processes are
started fresh (`spawn`), run at low priority, and end with the process that started them.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing import get_context
from threading import Event, Thread
from typing import Any, Final, Protocol, TypeVar

Piece = TypeVar("Piece")
Answer = TypeVar("Answer")

NICE: Final = 10
"""Priority of the processes: whatever else the machine does goes first."""
MAX_LOSSES: Final = 3
"""Times that lost processes are replaced without a piece of work done in between."""
POLL_S: Final = 0.2
"""How often a cancel is looked for while nothing is finished, in seconds."""

Work = Callable[[Piece, Callable[[], bool]], Answer]
"""Takes a piece and what tells whether it is cancelled; a function of a module, so that processes find it."""


def weight_of(piece: object) -> int:
    """How much of the work a piece is, in episodes or worlds; 1 where it does not say so."""
    weight = getattr(piece, "weight", 1)
    return weight if isinstance(weight, int) else 1


class CancelledError(Exception):
    """The work was cancelled while a piece was run."""


class WorkersLostError(Exception):
    """Processes ended again and again before they had done anything."""


class Executor(Protocol):
    """Runs pieces of work."""

    def run(
        self, work: Work[Piece, Answer], pieces: Sequence[Piece], cancelled: Event
    ) -> Iterator[tuple[Piece, Answer]]:
        """Yields each piece with its answer, in any order; ends early once `cancelled` is set."""

    def close(self) -> None:
        """Give back what it holds."""


def run_all(
    executor: Executor | None,
    work: Work[Piece, bytes],
    next_pieces: Callable[[], Sequence[Piece]],
    keep: Callable[[Piece, bytes], None],
    cancelled: Event,
    progress: Callable[[int], None] = lambda _: None,
) -> bool:
    """Runs pieces until `next_pieces` has no more; False where it was cancelled.

    `keep` is given what each came to, before more pieces are asked for; `progress` is told the weight of
    those done. Without an executor, this process runs them.
    """
    executor, done = executor or InProcess(), 0
    while left := next_pieces():
        answered = 0
        for piece, body in executor.run(work, left, cancelled):
            keep(piece, body)
            answered += 1
            done += weight_of(piece)
            progress(done)
        if cancelled.is_set():
            return False
        if answered != len(left):
            raise RuntimeError("the executor has left out pieces of work")
    return not cancelled.is_set()


class InProcess:
    """Runs everything here, one piece after the other."""

    def run(
        self, work: Work[Piece, Answer], pieces: Sequence[Piece], cancelled: Event
    ) -> Iterator[tuple[Piece, Answer]]:
        """See `Executor.run`."""
        for piece in pieces:
            if cancelled.is_set():
                return
            yield piece, work(piece, cancelled.is_set)

    def close(self) -> None:
        """Holds nothing."""


class LocalProcesses:
    """Runs pieces in processes of this machine. A lost process is replaced and its piece run again."""

    def __init__(self, processes: int) -> None:
        """`processes`: at least one."""
        self._processes = processes
        self._context = get_context("spawn")
        self._cancel = self._context.Event()
        self._pool: ProcessPoolExecutor | None = None
        self._busy = False
        """whether pieces are under way"""

    def run(
        self, work: Work[Piece, Answer], pieces: Sequence[Piece], cancelled: Event
    ) -> Iterator[tuple[Piece, Answer]]:
        """See `Executor.run`. Raises `WorkersLostError`, and whatever the work raises."""
        left = list(pieces)
        losses = 0
        self._cancel.clear()
        while left and not cancelled.is_set():
            try:
                for piece, answer in self._round(work, left, cancelled):
                    left.remove(piece)
                    losses = 0
                    yield piece, answer
            except BrokenProcessPool as error:
                self._drop()
                losses += 1
                if losses > MAX_LOSSES:
                    raise WorkersLostError(str(error)) from error
        if cancelled.is_set():
            self._cancel.set()
            self._drop()

    def _round(
        self, work: Work[Piece, Answer], pieces: Sequence[Piece], cancelled: Event
    ) -> Iterator[tuple[Piece, Answer]]:
        """Each piece that is finished before a process is lost or the work is cancelled."""
        if self._pool is None:
            self._pool = ProcessPoolExecutor(
                self._processes, mp_context=self._context, initializer=_begin, initargs=(self._cancel,)
            )
        waiting = iter(list(pieces))
        running: dict[Future[Answer], Piece] = {}

        def fill() -> None:
            # Few at a time: what is handed out is run even after a cancel.
            while self._pool is not None and len(running) <= self._processes:
                piece = next(waiting, None)
                if piece is None:
                    return
                running[self._pool.submit(_run, work, piece)] = piece

        self._busy = True
        fill()
        while running and not cancelled.is_set():
            done, _ = wait(running, POLL_S, FIRST_COMPLETED)
            for future in done:
                answer = future.result()
                yield running.pop(future), answer
            fill()
        self._busy = bool(running)

    def close(self) -> None:
        """End the processes; the pieces that they run are given up."""
        self._cancel.set()
        self._drop(wait=not self._busy)

    def _drop(self, *, wait: bool = False) -> None:
        """Give up the processes. Those that do nothing are waited for, which takes no time."""
        self._busy = False
        if self._pool is not None:
            self._pool.shutdown(wait=wait, cancel_futures=True)
            self._pool = None
            self._cancel = self._context.Event() if self._cancel.is_set() else self._cancel


_cancelled: Any = None


def _begin(cancel: Any) -> None:
    """Prepare a process: low priority, and an end with its parent."""
    global _cancelled
    _cancelled = cancel
    with suppress(OSError, AttributeError):
        os.nice(NICE)
    Thread(target=_end_with_parent, daemon=True, name="parent").start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _run(work: Work[Piece, Answer], piece: Piece) -> Answer:
    return work(piece, _cancelled.is_set)
