"""What a falsification searches, checked before any work starts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, Final

from sim import planner_names
from sim.config import Config, ConfigError, Problem
from sim.evaluate.spec import EvaluationError
from sim.randomness import MAX_SEED
from sim.session.saved_config import saved_config

MAX_WORLDS: Final = 100_000
"""Most worlds of one search."""
GENERATIONS: Final = 10
"""Generations of a search; the first one is drawn at random."""
PART: Final = 20
"""Worlds of a piece of work in a search of `MANY` or fewer, and the same of a larger one."""
MANY, LARGE_PART = 10_000, 100


@dataclass(frozen=True, slots=True, order=True)
class Stretch:
    """Worlds of one generation."""

    generation: int
    first: int
    count: int


@dataclass(frozen=True, kw_only=True)
class Falsification:
    """Which planner is searched for failures, in how many worlds.

    World i has the seed `seed` + i. `config` says what is not searched: the grid, the clock, what the planner
    sees with, the weather and how others behave.
    """

    planner: str
    worlds: int
    config: Config = field(default_factory=Config)
    seed: int = 0
    directed: bool = True
    """whether worlds are drawn near those that were hard; else all are drawn at random"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "planner", planner_names.canonical(self.planner))
        if problems := tuple(self._problems()):
            raise EvaluationError(problems)
        object.__setattr__(self, "config", replace(self.config, planner=self.planner, seed=self.seed))

    def _problems(self) -> Iterator[Problem]:
        if not 1 <= self.worlds <= MAX_WORLDS:
            yield Problem("episodes", "must_be_between", low=1, high=MAX_WORLDS)
        elif not 0 <= self.seed <= MAX_SEED - self.worlds:
            yield Problem("seed", "must_be_between", low=0, high=MAX_SEED - self.worlds)
        try:
            self.config.with_parts(planner=self.planner)
        except ConfigError as error:
            yield from (Problem("planner", each.code, **each.facts) for each in error.problems)

    def stretches(self) -> list[list[Stretch]]:
        """The worlds cut into pieces of work, by generation."""
        size = -(-self.worlds // GENERATIONS)
        part = PART if self.worlds <= MANY else LARGE_PART
        cut = []
        for generation, start in enumerate(range(0, self.worlds, size)):
            end = min(self.worlds, start + size)
            firsts = range(start, end, part)
            cut.append([Stretch(generation, first, min(part, end - first)) for first in firsts])
        return cut

    def to_json(self) -> dict[str, Any]:
        """As JSON values; `from_json` takes them."""
        return {
            "planner": self.planner,
            "worlds": self.worlds,
            "config": asdict(self.config),
            "seed": self.seed,
            "directed": self.directed,
        }

    @staticmethod
    def from_json(values: Mapping[str, Any]) -> Falsification:
        """From JSON values. Raises `EvaluationError` or `ConfigError`."""
        known = {each.name for each in fields(Falsification)}
        parts = {name: value for name, value in values.items() if name in known}
        return Falsification(**parts | {"config": saved_config(parts["config"])})
