"""Evaluations and searches for failures as kinds of jobs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache, partial
from typing import Any, Final

import orjson

from service.evaluations.names import EVALUATION, FIND_WORST
from service.jobs.kind import Parts, Piece, Spec
from service.resources import DEFAULT_LANGUAGE
from sim.evaluate.spec import Evaluation, Part
from sim.falsify import Falsification
from sim.falsify.stages import pieces, total

_EPISODE_BYTES: Final = 12
"""Figures of an episode by one planner, before they are compressed."""
_WORLD_BYTES: Final = 80
"""What is kept of a world that was looked at."""


class EvaluationJobs:
    """Runs the parts of an evaluation; a piece is a stretch of episodes, and its weight what they cost.

    Episodes that are followed tick by tick cost many times more than others, and the progress is to be true.
    """

    name = EVALUATION

    def total(self, spec: Spec) -> int:
        """See `JobKind.total`."""
        return Evaluation.from_json(spec).work

    def size(self, spec: Spec) -> int:
        """See `JobKind.size`."""
        episodes = int(spec["episodes"]) * max(1, len(spec.get("cases", ())))
        return _EPISODE_BYTES * episodes * len(spec["planners"])

    def pieces(self, spec: Spec, parts: Parts) -> Sequence[Piece]:
        """See `JobKind.pieces`."""
        if len(parts) == len(cut := _cut(orjson.dumps(spec))):
            return ()
        evaluation = Evaluation.from_json(spec)
        return [Piece(part_key(part), evaluation.work_of(part), part) for part in cut]

    def work(self, spec: Spec) -> Callable[[Piece, Callable[[], bool]], bytes]:
        """See `JobKind.work`."""
        return partial(_run, dict(spec))

    def finish(self, spec: Spec) -> Callable[[Parts, Callable[[], bool]], dict[str, Any]]:
        """See `JobKind.finish`."""
        return partial(_summarize, dict(spec))


@lru_cache(maxsize=4)
def _cut(spec: bytes) -> tuple[Part, ...]:
    return tuple(Evaluation.from_json(orjson.loads(spec)).parts())


class FindWorstJobs:
    """Runs the stages of a search for failures; the weight of a piece is about the number of its worlds."""

    name = FIND_WORST

    def total(self, spec: Spec) -> int:
        """See `JobKind.total`."""
        return total(Falsification.from_json(spec))

    def size(self, spec: Spec) -> int:
        """See `JobKind.size`."""
        return _WORLD_BYTES * Falsification.from_json(spec).worlds

    def pieces(self, spec: Spec, parts: Parts) -> Sequence[Piece]:
        """See `JobKind.pieces`."""
        left = pieces(Falsification.from_json(spec), parts)
        return [Piece(each.key, each.weight, each) for each in left]

    def work(self, spec: Spec) -> Callable[[Piece, Callable[[], bool]], bytes]:
        """See `JobKind.work`."""
        return partial(_search, dict(spec))

    def finish(self, spec: Spec) -> Callable[[Parts, Callable[[], bool]], dict[str, Any]]:
        """See `JobKind.finish`."""
        return partial(_tell, dict(spec))


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


def _search(spec: Mapping[str, Any], piece: Piece, cancelled: Callable[[], bool]) -> bytes:
    from sim.falsify.stages import run_piece

    return run_piece(spec, piece.what, cancelled)


def _tell(spec: Mapping[str, Any], parts: Parts, cancelled: Callable[[], bool]) -> dict[str, Any]:
    from service.evaluations.cases import explain_cases
    from sim.falsify.summary import summarize

    result = summarize(Falsification.from_json(spec), parts)
    return explain_cases(result, str(spec.get("language") or DEFAULT_LANGUAGE), cancelled)
