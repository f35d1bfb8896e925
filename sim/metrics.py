"""Metrics: counts over the episodes of a session."""

from __future__ import annotations

from dataclasses import dataclass, replace

from sim.fast_replace import field_setter
from sim.types import Move, Outcome

_LATERAL = frozenset((Move.LEFT, Move.RIGHT))
_DIAGONAL = frozenset((Move.FORWARD_LEFT, Move.FORWARD_RIGHT))


@dataclass(frozen=True, slots=True, kw_only=True)
class Metrics:
    """Counts of outcomes and moves so far; an episode counts when it has ended."""

    successes: int = 0
    crashes: int = 0
    stuck: int = 0
    forward: int = 0
    lateral: int = 0
    diagonal: int = 0
    stay: int = 0
    distance_m: float = 0.0
    """length of the path driven, from cell centre to cell centre"""
    last_episode_ticks: int | None = None
    """length in ticks of the latest episode that has ended"""

    @property
    def episodes(self) -> int:
        """The number of episodes that have ended."""
        return self.successes + self.crashes + self.stuck

    @property
    def steps(self) -> int:
        """The number of decisions taken."""
        return self.forward + self.lateral + self.diagonal + self.stay

    @property
    def success_rate(self) -> float | None:
        """Successes per ended episode; None before the first end."""
        return self.successes / self.episodes if self.episodes else None

    def after_move(self, move: Move, cell_m: float) -> Metrics:
        """Returns the metrics with one more move counted."""
        if move is Move.FORWARD:
            return _forward(self, self.forward + 1, self.distance_m + cell_m)
        if move in _LATERAL:
            return _lateral(self, self.lateral + 1, self.distance_m + cell_m)
        if move in _DIAGONAL:
            return _diagonal(self, self.diagonal + 1, self.distance_m + cell_m * 2**0.5)
        return _stay(self, self.stay + 1)

    def after_end(self, outcome: Outcome, ticks: int) -> Metrics:
        """Returns the metrics with one more ended episode, which lasted `ticks`."""
        return replace(
            self,
            successes=self.successes + (outcome is Outcome.SUCCESS),
            crashes=self.crashes + (outcome is Outcome.CRASH),
            stuck=self.stuck + (outcome is Outcome.STUCK),
            last_episode_ticks=ticks,
        )


_forward = field_setter(Metrics, "forward", "distance_m")
_lateral = field_setter(Metrics, "lateral", "distance_m")
_diagonal = field_setter(Metrics, "diagonal", "distance_m")
_stay = field_setter(Metrics, "stay")
