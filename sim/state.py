"""A session's state as one value, and how episodes begin. `sim.transition` takes it one tick on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, Final, NamedTuple

from sim.config import Config
from sim.ego import Ego
from sim.episode_record import EpisodeRecord
from sim.events import Event, EventType
from sim.fast_replace import field_setter
from sim.forecast import Forecast
from sim.generation import GenerationError, generate
from sim.metrics import Metrics
from sim.perceive import NO_BELIEF, Belief, Percept
from sim.plan import Decision
from sim.repetition import NOTHING_KEPT, Watch
from sim.triggers import NO_TRIGGERS, Triggers
from sim.types import Mode, Move, ego_id
from sim.validation import validate_world
from sim.world import World

FIRST: Final = ego_id(0)


def _one_ego() -> dict[str, Ego]:
    return {FIRST: Ego(FIRST)}


@dataclass(frozen=True, slots=True)
class SimState:
    """A world with all that decides how it goes on."""

    config: Config
    world: World
    egos: Mapping[str, Ego] = field(default_factory=_one_ego)
    """by id, in the order of `World.avs`; a vehicle of the world that is left out is parked"""
    edits: int = 0
    """changes made so far; numbers the stream random places are drawn from"""
    triggers: Triggers = NO_TRIGGERS
    """the rules that stand; they outlast episodes and scenarios"""

    @staticmethod
    def start(config: Config, world: World | None = None, planners: Sequence[str | None] = ()) -> SimState:
        """The first episode's beginning, on a given road or a generated one.

        `planners`: one for each ego of the road, in order; None and what is left out are the configuration's.
        Raises `ConfigError` for an unknown planner, `ValueError` for an inconsistent world (`validation`),
        and `GenerationError` (`sim.generation`).
        """
        if world is not None and (defects := validate_world(world)):
            raise ValueError("; ".join(f"{each.code} {' '.join(each.ids)}".strip() for each in defects))
        if world is None:
            world = generate(config, 1)
            if len(planners) > 1:
                world = with_egos_at_start(world, len(planners))
        egos = {}
        for number in range(len(world.avs)):
            planner = planners[number] if number < len(planners) else None
            config_with(config, planner)
            egos[ego_id(number)] = Ego(ego_id(number), planner)
        return SimState(config, world, egos)

    def ego(self, id: str | None = None) -> Ego:
        """The ego with this id, the first by default. Raises `KeyError` if there is none."""
        if id is None:
            for ego in self.egos.values():
                return ego
        return self.egos[id or FIRST]

    def number(self, id: str | None = None) -> int:
        """The place of an ego in `World.avs`, of the first by default. Raises `KeyError` if there is none."""
        for number, each in enumerate(self.egos):
            if id in (None, each):
                return number if id is None else int(each.rpartition("-")[2]) - 1
        raise KeyError(id)

    def with_ego(self, id: str | None = None, /, **parts: Any) -> SimState:
        """The same with some fields of an ego changed, those of the first by default."""
        ego = self.ego(id)
        return replace(self, egos={**self.egos, ego.id: replace(ego, **parts)})

    def with_each_ego(self, **parts: Any) -> SimState:
        """The same with some fields of every ego changed."""
        return replace(self, egos={id: replace(ego, **parts) for id, ego in self.egos.items()})

    def config_of(self, id: str | None = None) -> Config:
        """The configuration with the planner of an ego, of the first by default."""
        return config_with(self.config, self.ego(id).planner)

    @property
    def parked(self) -> frozenset[int]:
        """The egos that stay where they are, as places in `World.avs`."""
        return frozenset(
            number
            for number in range(len(self.world.avs))
            if (ego := self.egos.get(ego_id(number))) is None or ego.parked
        )

    @property
    def mode(self) -> Mode:
        """Who drives the first ego."""
        return self.ego().mode

    @property
    def queue(self) -> tuple[Move, ...]:
        """Moves a person asked the first ego for."""
        return self.ego().queue

    @property
    def metrics(self) -> Metrics:
        """Counts of the first ego."""
        return self.ego().metrics

    @property
    def fault(self) -> str | None:
        """What the first ego's planner did instead of answering at the latest decision."""
        return self.ego().fault

    @property
    def record(self) -> EpisodeRecord:
        """What the episode of the first ego has come to so far."""
        return self.ego().record

    @property
    def watch(self) -> Watch:
        """For a cycle that the first ego is in."""
        return self.ego().watch

    @property
    def belief(self) -> Belief:
        """What the first ego's sensor carries from the ticks before this one."""
        return self.ego().belief


class EgoStep(NamedTuple):
    """One ego's way to its move in a tick: what it saw, expected and decided."""

    percept: Percept
    forecast: Forecast
    """as far ahead as its planner read"""
    decision: Decision
    belief: Belief
    """what its sensor carries into the next tick"""


@dataclass(frozen=True, slots=True)
class StepResult:
    """What one tick led to."""

    state: SimState
    steps: Mapping[str, EgoStep]
    """by ego id, without egos that had arrived; empty while a result is shown, and where moves alone were
    given"""
    events: tuple[Event, ...]

    def of(self, id: str | None = None) -> EgoStep | None:
        """How an ego came to its move, the first by default; None where that is not known."""
        return self.steps.get(id or FIRST)

    @property
    def decision(self) -> Decision | None:
        """The first ego's decision; None while a result stands."""
        found = self.steps.get(FIRST)
        return None if found is None else found.decision


_held = field_setter(World, "tick")
_told_nothing = field_setter(Ego, "queue")
_holding = field_setter(SimState, "world", "egos")
_beginning = field_setter(Ego, "queue", "record", "watch", "belief")
_begun = field_setter(SimState, "config", "world", "egos")


def config_with(config: Config, planner: str | None) -> Config:
    """The configuration with another planner; as it is for None. Raises `ConfigError`."""
    return config if planner is None else _config_with(config, planner)


@lru_cache(maxsize=64)
def _config_with(config: Config, planner: str) -> Config:
    return replace(config, planner=planner)


def with_egos_at_start(world: World, count: int) -> World:
    """A road's beginning with so many egos in the last row, side by side. Raises `ValueError`."""
    road = world.road
    first = world.avs[0]
    row = first - first % road.columns
    cells = sorted(range(row, row + road.columns), key=lambda cell: (abs(cell - first), cell))
    free = [cell for cell in cells if cell == first or not (world.fixed | world.moving) >> cell & 1]
    if count > len(free):
        raise ValueError(f"{count} egos do not fit side by side on {road.columns} lanes")
    return replace(world, avs=tuple(free[:count]))


def next_episode(state: SimState) -> tuple[SimState, Event]:
    """The following episode's beginning, at the present tick.

    If roads must be drivable and none is found, the present episode restarts (`EventType.ROAD_KEPT`).
    """
    try:
        return _begin(state, state.config, state.world.episode + 1)
    except GenerationError:
        begun, event = restart_episode(state)
        return begun, replace(event, type=EventType.ROAD_KEPT)


def restart_episode(state: SimState) -> tuple[SimState, Event]:
    """The present episode's beginning again, at the present tick."""
    return _begin(state, state.config, state.world.episode)


def reconfigure(state: SimState, config: Config) -> tuple[SimState, Event]:
    """A fresh road of another configuration, at the present tick."""
    return _begin(state, config, state.world.episode + 1)


def hold_result(state: SimState) -> StepResult:
    """The result stands for a tick more; or the next episode begins."""
    world = _held(state.world, state.world.tick + 1)
    egos = state.egos
    if any(ego.queue for ego in egos.values()):
        egos = {id: _told_nothing(ego, ()) for id, ego in egos.items()}
    held = _holding(state, world, egos)
    if world.ended is not None and world.tick - world.ended < state.config.reset_delay_ticks:
        return StepResult(held, {}, ())
    begun, event = next_episode(held)
    return StepResult(begun, {}, (event,))


def _begin(state: SimState, config: Config, episode: int) -> tuple[SimState, Event]:
    world = generate(config, episode, tick=state.world.tick, numbered=state.world.numbered)
    if len(state.egos) > 1:
        world = with_egos_at_start(world, len(state.egos))
    event = Event(world.tick, EventType.EPISODE_STARTED, episode)
    record = EpisodeRecord()
    egos = {id: _beginning(ego, (), record, NOTHING_KEPT, NO_BELIEF) for id, ego in state.egos.items()}
    return _begun(state, config, world, egos), event
