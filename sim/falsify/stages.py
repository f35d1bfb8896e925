"""The stages of a search as pieces of work: the generations, one after the other, then the cases.

What is to be done next follows from what the finished pieces came to, so a search that was interrupted goes
on where it was. Pieces and what they come to can be sent to other processes.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final

from sim.evaluate.executor import CancelledError
from sim.evaluate.spec import STATES
from sim.falsify.case import case_of
from sim.falsify.cross_entropy import Distribution, draw, fit
from sim.falsify.shrink import Shrinking
from sim.falsify.space import Point
from sim.falsify.spec import Falsification, Stretch
from sim.falsify.world import FAILURE_SCORE, Cancelled, Finding, Looked, look, with_only, world_at
from sim.oracle.lower_bounds import least_ticks
from sim.randomness import Stream
from sim.search.reactive import ImpatientError

CASES: Final = 6
"""Failures that are shrunk; where there are none, arrivals of which the hardest is looked for."""
_FINDINGS: Final = tuple(Finding)

Parts = Mapping[str, bytes]
"""What finished pieces came to, by key."""


@dataclass(frozen=True, slots=True)
class SearchPiece:
    """Worlds to look at."""

    stretch: Stretch
    distribution: Distribution | None

    @property
    def key(self) -> str:
        """The same whenever the search goes on."""
        return f"{self.stretch.generation}:{self.stretch.first}+{self.stretch.count}"

    @property
    def weight(self) -> int:
        """Share of all the work, in worlds."""
        return self.stretch.count


@dataclass(frozen=True, slots=True)
class CasePiece:
    """One failure to shrink, or one arrival to compare with the quickest way; or nothing."""

    number: int
    chosen: Looked | None
    weight: int

    @property
    def key(self) -> str:
        """The same whenever the search goes on."""
        return f"case:{self.number}"


SomePiece = SearchPiece | CasePiece


def case_weight(spec: Falsification) -> int:
    """Work of one case, in worlds (approximate)."""
    return max(1, spec.worlds // 50)


def total(spec: Falsification) -> int:
    """All the work, in worlds."""
    return spec.worlds + CASES * case_weight(spec)


def pieces(spec: Falsification, parts: Parts) -> Sequence[SomePiece]:
    """The pieces that can be done next; none when all are done."""
    distribution: Distribution | None = None
    seen: list[Looked] = []
    for stretches in spec.stretches():
        found = [SearchPiece(stretch, distribution) for stretch in stretches]
        if left := [piece for piece in found if piece.key not in parts]:
            return left
        looked = [each for piece in found for each in unpack(parts[piece.key])]
        if spec.directed:
            distribution = next_distribution(distribution, looked)
        seen += looked
    chosen: list[Looked | None] = [*choose(seen)]
    chosen += [None] * (CASES - len(chosen))
    last = [CasePiece(number, each, case_weight(spec)) for number, each in enumerate(chosen)]
    return [piece for piece in last if piece.key not in parts]


def next_distribution(former: Distribution | None, looked: Sequence[Looked]) -> Distribution:
    """The distribution that a generation leads to."""
    drawn = [each for each in looked if each.finding is not Finding.NO_ROAD]
    points, scores = [each.point for each in drawn], [each.score for each in drawn]
    return fit(former or Distribution(), points, scores, FAILURE_SCORE)


def choose(seen: Sequence[Looked]) -> list[Looked]:
    """The failures to shrink: of each way to fail on each layout in turn, those with the fewest things first.

    Where there are none, the arrivals that took longest.
    """
    groups: dict[tuple[Finding, int], list[Looked]] = {}
    for each in sorted(seen, key=lambda each: (each.things, each.index)):
        if each.finding.failed:
            groups.setdefault((each.finding, each.point.layout), []).append(each)
    if not groups:
        arrived = [each for each in seen if each.finding is Finding.ARRIVED]
        return sorted(arrived, key=lambda each: (-each.ticks, each.index))[:CASES]
    return list(_in_turn(groups[key] for key in sorted(groups, key=str)))[:CASES]


def _in_turn(groups: Iterator[list[Looked]]) -> Iterator[Looked]:
    lists = list(groups)
    for place in range(max(map(len, lists))):
        yield from (each[place] for each in lists if place < len(each))


def run_piece(values: Mapping[str, Any], piece: SomePiece, cancelled: Cancelled) -> bytes:
    """Do a piece of the work of a falsification (as JSON values). Raises `CancelledError`."""
    spec = Falsification.from_json(values)
    if isinstance(piece, SearchPiece):
        return pack(list(_look_at(spec, piece, cancelled)))
    return json.dumps(_case(spec, piece.chosen, cancelled)).encode()


def _look_at(spec: Falsification, piece: SearchPiece, cancelled: Cancelled) -> Iterator[Looked]:
    first = piece.stretch.first
    for index in range(first, first + piece.stretch.count):
        if cancelled():
            raise CancelledError
        yield look(spec, index, draw(piece.distribution, Stream.of(spec.seed, "falsify", index)))


def _case(spec: Falsification, chosen: Looked | None, cancelled: Cancelled) -> dict[str, Any] | None:
    start = None if chosen is None else world_at(spec, chosen.index, chosen.point)
    if chosen is None or start is None:
        return None
    if not chosen.finding.failed:
        try:
            least = least_ticks(start, STATES)
        except ImpatientError:
            return None
        return {"index": chosen.index, "ticks": chosen.ticks, "least": least, "config": asdict(start.config)}
    things = Shrinking(start, cancelled).minimal()
    case = None if things is None else case_of(with_only(start, things))
    found = {"index": chosen.index, "finding": chosen.finding.value, "things": chosen.things}
    return found | {"case": None if case is None else case.to_json()}


def pack(looked: Sequence[Looked]) -> bytes:
    """What was looked at as bytes."""
    rows = [
        [
            each.index,
            list(each.point.levels),
            each.point.layout,
            _FINDINGS.index(each.finding),
            each.ticks,
            each.things,
            each.score,
        ]
        for each in looked
    ]
    return json.dumps(rows, separators=(",", ":")).encode()


def unpack(body: bytes) -> list[Looked]:
    """The reverse of `pack`."""
    return [
        Looked(index, Point(tuple(levels), layout), _FINDINGS[finding], ticks, things, score)
        for index, levels, layout, finding, ticks, things, score in json.loads(body)
    ]
