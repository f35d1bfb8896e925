"""An executor on Ray: the nodes of a cluster run the pieces, and some may be lost on the way.

Ray (the extra `cluster`) is loaded when an executor is made. A task takes several pieces
(`sim.evaluate.chunks`). One whose process or node is lost is handed out again. An answer depends on its piece
alone, so the results are those of one process. Each node needs Roadtalk installed, with the same text of
`sim`, which every task checks.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import cache
from hashlib import blake2b
from importlib import import_module
from pathlib import Path
from threading import Event
from typing import Any, Final

from sim.evaluate.chunks import Costs, Done, run_task, take
from sim.evaluate.executor import MAX_LOSSES, POLL_S, Answer, Piece, Work, WorkersLostError, weight_of

LOCAL: Final = "local"
"""The address that stands for a cluster started on this machine for this run alone."""
RETRIES: Final = 2
"""Times that Ray itself runs a task again whose process or node is lost."""
CONNECT_S: Final = 10.0
"""Seconds within which a cluster must answer."""
OBJECT_STORE_BYTES: Final = 100_000_000
"""Memory of a local cluster for what tasks hand over."""


class RayError(RuntimeError):
    """There is no Ray, no cluster at the address, or its nodes cannot do this work."""


class RayExecutor:
    """Runs pieces on a Ray cluster: one at an address, or one that it starts on this machine."""

    def __init__(self, address: str = LOCAL, processes: int | None = None) -> None:
        """`processes`: of a local cluster. A program that is connected to Ray already stays connected there.

        Raises `RayError`.
        """
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # Ray reads it when it is loaded
        try:
            self._ray: Any = import_module("ray")
        except ImportError as error:
            raise RayError('Ray is not installed here; it is in the extra "cluster"') from error
        self._connected = not self._ray.is_initialized()
        """whether the connection is this executor's own"""
        self._running: dict[Any, list[Any]] = {}
        """the pieces of each task that is under way"""
        if self._connected:
            self._connect(address, processes)
        if not self._slots():
            self.close()
            raise RayError("the Ray cluster has no processor that could run episodes")
        # Wherever there is room: a node more is used as soon as it is there.
        self._task = self._ray.remote(num_cpus=1, max_retries=RETRIES, scheduling_strategy="SPREAD")(_run)

    def run(
        self, work: Work[Piece, Answer], pieces: Sequence[Piece], cancelled: Event
    ) -> Iterator[tuple[Piece, Answer]]:
        """See `Executor.run`. Raises `WorkersLostError`, and whatever the work raises."""
        left, costs, losses = list(pieces), Costs(), 0
        asked = sum(map(weight_of, left))
        try:
            while (left or self._running) and not cancelled.is_set():
                self._hand_out(work, left, costs, asked)
                ready, _ = self._ray.wait(list(self._running), num_returns=1, timeout=POLL_S)
                for task in ready:
                    given, done = self._running.pop(task), self._result(task)
                    losses = losses + 1 if done is None else 0
                    if losses > MAX_LOSSES:
                        raise WorkersLostError("nodes of the cluster were lost again and again")
                    done = done or Done((), ())
                    left[:0] = given[len(done.answers) :]
                    for piece, answer, seconds in zip(given, done.answers, done.seconds, strict=False):
                        costs.add(weight_of(piece), seconds)
                        yield piece, answer
        finally:
            self._give_up()

    def close(self) -> None:
        """End the tasks, and the connection with the cluster that it started."""
        self._give_up()
        if self._connected:
            self._ray.shutdown()

    # Within

    def _connect(self, address: str, processes: int | None) -> None:
        own: dict[str, Any] = {
            "num_cpus": processes or os.cpu_count() or 1,
            "object_store_memory": OBJECT_STORE_BYTES,
            "include_dashboard": False,
        }
        try:
            _check_reachable(address)
            self._ray.init(
                address=address,
                log_to_driver=False,
                logging_level="ERROR",
                **(own if address == LOCAL else {}),
            )
        except (OSError, ValueError, RuntimeError) as error:
            raise RayError(f"there is no Ray cluster at {address}: {error}") from error

    def _slots(self) -> int:
        """Tasks that the cluster can run at once."""
        return int(self._ray.cluster_resources().get("CPU", 0))

    def _hand_out(self, work: Work[Piece, Answer], left: list[Piece], costs: Costs, asked: int) -> None:
        """A task for each processor that has none, and one more, for the one that is free first."""
        slots = max(1, self._slots())
        while left and len(self._running) <= slots:
            given = take(left, slots, costs, asked)
            self._running[self._task.remote(source_digest(), work, given)] = given

    def _result(self, task: Any) -> Done[Any] | None:
        """What a task did; None where it was lost. Raises what the work raised."""
        errors = self._ray.exceptions
        try:
            done: Done[Any] = self._ray.get(task)
        except errors.RayTaskError as error:
            if isinstance(error.cause, Exception):
                raise error.cause from None
            raise RayError(str(error)) from None
        except errors.RayError:
            return None
        return done

    def _give_up(self) -> None:
        """End the tasks that are under way, with their processes."""
        for task in self._running:
            with suppress(Exception):  # it may be done by now, or its node gone
                self._ray.cancel(task, force=True)
        self._running.clear()


def _check_reachable(address: str) -> None:
    """Raises `OSError` where nobody answers at host:port; Ray itself would go on trying for minutes."""
    host, _, port = address.rpartition("://")[2].rpartition(":")
    if host and port.isdecimal():
        socket.create_connection((host, int(port)), CONNECT_S).close()


@cache
def source_digest() -> str:
    """A digest of the text of `sim`: nodes with another one could come to other results."""
    digest, folder = blake2b(digest_size=8), Path(__file__).parents[1]
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _run(sources: str, work: Work[Piece, Answer], pieces: Sequence[Piece]) -> Done[Answer]:
    """A task. Raises `RayError` where the node has another version of `sim`, and whatever the work raises."""
    if sources != source_digest():
        raise RayError("a node of the cluster has another version of Roadtalk")
    return run_task(work, pieces)
