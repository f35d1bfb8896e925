"""Finds the frame that fits a span of tokens: the one of the highest rank; none when two of them disagree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from service.grammar.build import CannotBuild, Parameters, build
from service.grammar.frames import Filled, Frame
from service.grammar.paths import Stretch, fill

WANT = "want"


class _Reach:
    """Which frames, by descending rank, could have all they need of some concepts.

    Each frame is a bit, and each of its needs a bit in another lane, so that all are asked at once.
    """

    def __init__(self, frames: Sequence[Frame]) -> None:
        self._frames = frames
        self._lanes = max((len(frame.needs) for frame in frames), default=0)
        self._meets: dict[str, int] = {}
        self._free = 0
        for place, frame in enumerate(frames):
            for lane in range(self._lanes):
                bit = 1 << (lane * len(frames) + place)
                if lane >= len(frame.needs):
                    self._free |= bit
                else:
                    for concept in frame.needs[lane]:
                        self._meets[concept] = self._meets.get(concept, 0) | bit

    def within(self, concepts: Iterable[str]) -> Iterator[Frame]:
        """Those of which each need could be met."""
        met, meets = self._free, self._meets
        for concept in concepts:
            if concept in meets:
                met |= meets[concept]
        left = (1 << len(self._frames)) - 1
        for lane in range(self._lanes):
            left &= met >> (lane * len(self._frames))
        while left:
            lowest = left & -left
            yield self._frames[lowest.bit_length() - 1]
            left ^= lowest


class Frames:
    """The frames of a language, by descending rank."""

    def __init__(self, frames: Sequence[Frame], parameters: Parameters) -> None:
        ranked = sorted(frames, key=lambda frame: -frame.rank)
        self._parameters = parameters
        stands = (concept for frame in frames if frame.verbless for concept in frame.accepted)
        self.nominal = frozenset(each for each in stands if not each.startswith("v.") and each != WANT)
        """The concepts of what requests are about; none of them alone says what to do."""
        self._eligible = {
            (joins, verbless): _Reach(
                [
                    frame
                    for frame in ranked
                    if (frame.joins or not joins) and verbless in (None, frame.verbless)
                ]
            )
            for joins in (False, True)
            for verbless in (None, False, True)
        }

    def match(
        self, stretch: Stretch, *, verbless: bool | None = None
    ) -> tuple[Filled, list[dict[str, Any]]] | None:
        """The best frame, filled, and its actions; of equal rank, the one with fewer pieces."""
        best: tuple[Filled, list[dict[str, Any]]] | None = None
        best_pieces = 0
        torn = False
        for frame in self._eligible[stretch.joined, verbless].within(stretch.concepts):
            if best is not None and frame.rank < best[0].frame.rank:
                break
            if frame.only_negated and not stretch.lenient:
                continue
            filled = fill(frame, stretch)
            if filled is None:
                continue
            try:
                actions = build(filled[0], self._parameters)
            except CannotBuild:
                continue
            if stretch.lenient:
                return filled[0], actions
            if best is None or filled[1] < best_pieces:
                best, best_pieces, torn = (filled[0], actions), filled[1], False
            elif filled[1] == best_pieces and (best[1] != actions or best[0].frame.ask != frame.ask):
                torn = True
        return None if torn else best
