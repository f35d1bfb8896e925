"""Evaluations as a kind of job."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache, partial
from typing import Any, Final

import orjson

from service.jobs.kind import Parts, Piece, Spec
from sim.evaluate.spec import Evaluation, Part

EVALUATION: Final = "evaluation"


class EvaluationJobs:
    """Runs the parts of an evaluation; a piece is a stretch of episodes, and its weight their number."""

    name = EVALUATION

    def total(self, spec: Spec) -> int:
        """See `JobKind.total`."""
        return int(spec["episodes"]) * max(1, len(spec.get("cases", ())))

    def pieces(self, spec: Spec, parts: Parts) -> Sequence[Piece]:
        """See `JobKind.pieces`."""
        if len(parts) == len(cut := _cut(orjson.dumps(spec))):
            return ()
        return [Piece(part_key(part), part.count, part) for part in cut]

    def work(self, spec: Spec) -> Callable[[Piece, Callable[[], bool]], bytes]:
        """See `JobKind.work`."""
        return partial(_run, dict(spec))

    def finish(self, spec: Spec) -> Callable[[Parts, Callable[[], bool]], dict[str, Any]]:
        """See `JobKind.finish`."""
        return partial(_summarize, dict(spec))


@lru_cache(maxsize=4)
def _cut(spec: bytes) -> tuple[Part, ...]:
    return tuple(Evaluation.from_json(orjson.loads(spec)).parts())


def part_key(part: Part) -> str:
    """The key of a part's piece."""
    return f"{part.first}+{part.count}"


def part_of(key: str) -> Part:
    """The part of a piece's key."""
    first, _, count = key.partition("+")
    return Part(int(first), int(count))


def _run(spec: Mapping[str, Any], piece: Piece, cancelled: Callable[[], bool]) -> bytes:
    from sim.evaluate.run import pack_part  # in the process that does the work: it loads NumPy

    return pack_part(spec, piece.what, cancelled)


def _summarize(spec: Mapping[str, Any], parts: Parts, cancelled: Callable[[], bool]) -> dict[str, Any]:
    from sim.evaluate.run import summarize_parts

    return summarize_parts(
        Evaluation.from_json(spec), {part_of(key): body for key, body in parts.items()}, cancelled
    )
