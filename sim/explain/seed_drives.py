"""The planner's drives on the roads that the next seeds draw from the same settings, in figures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from sim.config import Config
from sim.explain.closest_call import near_misses
from sim.explain.episode_rollout import rollout, summarize
from sim.explain.foresight import driving
from sim.explain.question_error import QuestionError
from sim.plan import traits_of
from sim.planner_names import BUILT_IN
from sim.session.timeline import Timeline
from sim.types import Move, Outcome

SEEDS: Final = 10
"""Seeds that are looked at: those that follow the session's."""
KEPT: Final = 64
"""Drives that are kept, since several questions are about the same ones."""


@dataclass(frozen=True, slots=True)
class SeedDrive:
    """One drive of the planner, from its start to its end."""

    seed: int
    outcome: Outcome
    """`running` where its end is too far to tell"""
    rows: tuple[int, ...]
    """rows that it had come ahead after 0, 1, 2, … ticks"""
    stays: tuple[int, ...]
    """the ticks, counted from its start, in which it stayed where it was"""
    misses: tuple[int, ...]
    """the ticks, counted from its start, of its near misses"""

    @property
    def ticks(self) -> int:
        """How long it lasted."""
        return len(self.rows) - 1

    def rows_after(self, ticks: int) -> int:
        """Rows that it had come ahead after so many ticks; after its end those that it came at all."""
        return self.rows[min(ticks, self.ticks)]


def seed_drives(timeline: Timeline) -> tuple[SeedDrive, ...]:
    """The planner's drives on the first roads of the next seeds, under the present settings.

    A person who drives is left out: the planner drives. So is what was put on this road by hand.
    Raises `QuestionError`: `too_long_again` for a planner that takes long, or with several egos.
    """
    state = timeline.state
    if not traits_of(state.config.planner).quick or len(state.world.avs) > 1:
        raise QuestionError("too_long_again")
    first = state.config.seed + 1
    # A planner that is not built in may be another one tomorrow under the same name.
    driven = _kept if state.config.planner in BUILT_IN else _driven
    return tuple(driven(state.config.with_parts(seed=seed)) for seed in range(first, first + SEEDS))


def _driven(config: Config) -> SeedDrive:
    """The drive that a session of these settings begins with."""
    begun = driving(Timeline(config).state)
    ticks = list(rollout(begun))
    states = [before for before, _ in ticks]
    if ticks and not any(each.decision.timed_out for each in ticks[-1][1].steps.values()):
        states.append(ticks[-1][1].state)
    told, start = summarize(begun, ticks), begun.world
    rows = [state.world.road.cell(state.world.av)[1] for state in states] or [start.road.cell(start.av)[1]]
    return SeedDrive(
        config.seed,
        told.outcome,
        tuple(rows[0] - row for row in rows),
        tuple(tick for tick, move in enumerate(told.path) if move is Move.STAY),
        tuple(call.tick - start.tick for call in near_misses(states)),
    )


_kept = lru_cache(maxsize=KEPT)(_driven)
