"""Runs a whole evaluation with an executor, for programs and the command line. The service keeps parts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from threading import Event
from typing import Any

from sim.evaluate.executor import Executor, run_all
from sim.evaluate.part import run_part
from sim.evaluate.rows import join, pack, unpack
from sim.evaluate.spec import Evaluation, Part
from sim.evaluate.summary import summarize
from sim.evaluate.summary_of_cases import summarize_cases


def pack_part(spec: Mapping[str, Any], piece: Part, cancelled: Callable[[], bool]) -> bytes:
    """The figures of a part as bytes; all arguments and the answer can be sent to another process."""
    return pack(run_part(Evaluation.from_json(spec), piece, cancelled))


def summarize_parts(
    spec: Evaluation, parts: Mapping[Part, bytes], cancelled: Callable[[], bool]
) -> dict[str, Any]:
    """The summary of all parts. Raises `ValueError` unless each episode is there once."""
    ordered = sorted(parts)
    edges = [0, *(part.first + part.count for part in ordered)]
    if edges[:-1] != [part.first for part in ordered] or edges[-1] != spec.total:
        raise ValueError("episodes are missing, or there twice")
    if spec.cases:
        cases = [
            join([unpack(parts[part]) for part in ordered if part.first // spec.episodes == number])
            for number in range(len(spec.cases))
        ]
        return summarize_cases(spec, cases, cancelled)
    return summarize(spec, join([unpack(parts[part]) for part in ordered]), cancelled)


def evaluate(
    spec: Evaluation,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda _: None,
    cancelled: Event | None = None,
    parts: dict[Part, bytes] | None = None,
) -> dict[str, Any] | None:
    """The summary of an evaluation; None where it was cancelled. `progress` is told the episodes done.

    Parts that are there already are not run; the others are added as they are finished.
    """
    cancelled, done = cancelled or Event(), {} if parts is None else parts

    def left() -> list[Part]:
        return [part for part in spec.parts() if part not in done]

    work = partial(pack_part, spec.to_json())
    if not run_all(executor, work, left, done.__setitem__, cancelled, progress):
        return None
    return summarize_parts(spec, done, cancelled.is_set)
