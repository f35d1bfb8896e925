"""Which frame a stretch of tokens is: the highest-ranking that fits, and none when two disagree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service.language.build import CannotBuild, Parameters, build
from service.language.frames import Filled, Frame
from service.language.paths import Stretch, fill


class Frames:
    """The frames of a language, by descending rank."""

    def __init__(self, frames: Sequence[Frame], parameters: Parameters) -> None:
        ranked = sorted(frames, key=lambda frame: -frame.rank)
        self._parameters = parameters
        self._eligible = {
            (joins, verbless): [
                (frame, frame.needs)
                for frame in ranked
                if (frame.joins or not joins) and verbless in (None, frame.verbless)
            ]
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
        concepts = stretch.concepts
        for frame, needs in self._eligible[stretch.joined, verbless]:
            if best is not None and frame.rank < best[0].frame.rank:
                break
            if not _within_reach(needs, concepts) or (frame.only_negated and not stretch.lenient):
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


def _within_reach(needs: Sequence[frozenset[str]], concepts: frozenset[str]) -> bool:
    """Whether each need could be met at all; asked of every frame, so a plain loop."""
    for group in needs:  # noqa: SIM110 - a generator costs twice the time here
        if group.isdisjoint(concepts):
            return False
    return True
