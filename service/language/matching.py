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
        self._frames = sorted(frames, key=lambda frame: -frame.rank)
        self._parameters = parameters

    def match(
        self, stretch: Stretch, *, verbless: bool | None = None
    ) -> tuple[Filled, list[dict[str, Any]]] | None:
        """The best frame, filled, and its actions; of equal rank, the one with fewer pieces."""
        best: tuple[Filled, list[dict[str, Any]]] | None = None
        best_pieces = 0
        torn = False
        for frame in self._frames:
            if best is not None and frame.rank < best[0].frame.rank:
                break
            if stretch.joined and not frame.joins:
                continue
            if verbless is not None and frame.verbless != verbless:
                continue
            if any(group.isdisjoint(stretch.concepts) for group in frame.needs):
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
