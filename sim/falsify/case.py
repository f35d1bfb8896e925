"""Cases: worlds in which a planner fails although they can be driven, as files that can be replayed.

A case carries its world as text (`sim.world.notation`), so that it stays the same when roads are generated
otherwise, and a way through it as proof. As a regression test it is replayed: the planner is to arrive.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Final

from sim.config import Config, ConfigError
from sim.falsify.world import drive, way_through
from sim.oracle.other_egos import arrives
from sim.planner_names import canonical
from sim.session.saved_config import saved_config
from sim.state import SimState
from sim.types import Move, Outcome
from sim.world import World
from sim.world.notation import NotationError, read, write

FORMAT: Final = "roadtalk-case"
VERSION: Final = 1
_NAME: Final = re.compile(r"[a-z0-9_-]{1,80}")
_KEYS: Final = frozenset(
    ("format", "version", "name", "config", "world", "outcome", "ticks", "digest", "way", "why")
)
LAST_TICKS: Final = {Outcome.STUCK: 8, Outcome.CRASH: 4}
"""Ticks before the end at which it is worth looking."""


class CaseError(ValueError):
    """What was read is not a case."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A world that a planner fails."""

    config: Config
    """with the planner and the seed"""
    world: World
    """the beginning"""
    outcome: Outcome
    ticks: int
    digest: str
    """of the world at the end"""
    way: tuple[Move, ...]
    """moves that arrive: the certificate that the world can be driven"""
    why: str = ""
    """the failure in words"""

    @property
    def name(self) -> str:
        """What it is called: the planner, how it failed and the beginning of the world's digest."""
        return f"{self.config.planner}-{self.outcome}-{self.world.digest()[:8]}"

    @property
    def things(self) -> tuple[str, ...]:
        """The ids of all things on the road."""
        return (*self.world.movers.values(), *self.world.hazards.values())

    @property
    def start(self) -> SimState:
        """How the episode begins."""
        return SimState.start(self.config, self.world)

    @property
    def tick(self) -> int:
        """The tick at which it is worth looking."""
        return max(0, self.ticks - LAST_TICKS[self.outcome])

    def to_json(self) -> dict[str, Any]:
        """As JSON values: the case's file."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "name": self.name,
            "config": asdict(self.config),
            "world": write(self.world),
            "outcome": self.outcome.value,
            "ticks": self.ticks,
            "digest": self.digest,
            "way": [move.value for move in self.way],
            "why": self.why,
        }

    @staticmethod
    def from_json(values: Any) -> Case:
        """From JSON values, read strictly. Raises `CaseError`."""
        if not isinstance(values, Mapping) or values.get("format") != FORMAT:
            raise CaseError(f"no case: 'format' is not {FORMAT!r}")
        if values.get("version") != VERSION:
            raise CaseError(f"'version' is {values.get('version')!r}; {VERSION} is known")
        if set(values) != _KEYS:
            raise CaseError(f"keys that differ: {', '.join(sorted(set(values) ^ _KEYS))}")
        if not _NAME.fullmatch(str(values["name"])):
            raise CaseError("'name' is made of a-z, 0-9, - and _")
        try:
            case = Case(
                config=saved_config(values["config"]),
                world=read(values["world"]),
                outcome=Outcome(values["outcome"]),
                ticks=int(values["ticks"]),
                digest=str(values["digest"]),
                way=tuple(Move(move) for move in values["way"]),
                why=str(values["why"]),
            )
            case.start  # noqa: B018 - raises for a world that is none
        except (ConfigError, NotationError, ValueError, TypeError, AttributeError, KeyError) as error:
            raise CaseError(str(error)) from error
        return case


@dataclass(frozen=True, slots=True)
class Replayed:
    """What came of driving a case again."""

    outcome: Outcome
    ticks: int
    digest: str
    drivable: bool
    """whether the way that the case carries still arrives"""

    def as_recorded(self, case: Case) -> bool:
        """Whether it failed just as the case says."""
        return (self.outcome, self.ticks, self.digest) == (case.outcome, case.ticks, case.digest)


def replay(case: Case, planner: str | None = None) -> Replayed:
    """Drive a case again, with another planner if one is named."""
    start = case.start
    if planner is not None:
        start = SimState.start(case.config.with_parts(planner=canonical(planner)), case.world)
    end = drive(start)[-1].world
    return Replayed(end.outcome, end.tick, end.digest(), arrives(case.start, case.way, None))


def case_of(start: SimState) -> Case | None:
    """The case of an episode's beginning; None where the planner arrives or no way is proved."""
    end = drive(start)[-1].world
    if end.outcome is Outcome.SUCCESS or (way := way_through(start)) is None:
        return None
    return Case(
        config=start.config,
        world=read(write(start.world)),  # as it is in a file
        outcome=end.outcome,
        ticks=end.tick,
        digest=end.digest(),
        way=way,
    )
