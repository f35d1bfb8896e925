"""Serializes states as JSON values and back, exactly; parts that several states share are written once.

Consecutive states share most of their parts: configurations, tables of ids, the first world of the episode.
Each shared part gets a number when it is first seen, and is one object again after reading. Boards are
hexadecimal strings, since JSON readers cannot take such large integers. Storage and trust are the caller's
concern.

A stateless sensor has no belief, and nothing is written for it. Only its sensor knows the form of any other
belief: such a state is not written (`BeliefError`), and is restored by a replay of its session.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from hashlib import blake2b
from operator import attrgetter
from typing import Any, TypeVar

from sim.actions import Trigger
from sim.config import COUNTS, Config
from sim.ego import Ego
from sim.episode_record import EpisodeRecord, sake_of
from sim.metrics import Metrics
from sim.perceive import NO_BELIEF
from sim.repetition import Situation, Watch
from sim.state import FIRST, SimState
from sim.triggers import NO_TRIGGERS, StandingTrigger, Triggers
from sim.types import MARKED, Kind, Mode, Move, Outcome
from sim.world import Cause, World
from sim.world.boards import Boards
from sim.world.grid import Road

Part = TypeVar("Part")

_CONFIG = tuple(field.name for field in fields(Config))
_LATER = {
    *COUNTS.values(),
    "dynamics",
    "behaviour",
    "weather",
    "time_of_day",
    "detection_sensitivity",
    "sensor_range_m",
    "sensor_noise",
    "false_positive_rate",
    "sensor_latency",
    "slip_probability",
    "traffic_by_hour",
}
"""Fields of configurations that came later; where one is missing, it is at its default."""
_ALWAYS = {*_CONFIG} - _LATER
_METRICS = tuple(field.name for field in fields(Metrics))
_config_values, _metrics_values = attrgetter(*_CONFIG), attrgetter(*_METRICS)


class BeliefError(ValueError):
    """A state whose sensor holds a belief, which cannot be written; a replay comes to it again."""


class Pool:
    """A pool of parts, each written once, by identity. The pool keeps its parts alive."""

    def __init__(self) -> None:
        self.values: list[Any] = []
        self._numbers: dict[int, int] = {}
        self._held: list[object] = []

    def number(self, part: Part, written: Callable[[Part], Any]) -> int:
        """Returns the number of a part; calls `written` for a part that is new."""
        found = self._numbers.get(id(part))
        if found is None:
            value = written(part)  # may add parts of its own first
            found = self._numbers[id(part)] = len(self.values)
            self.values.append(value)
            self._held.append(part)
        return found


class Packer:
    """Packs states into one JSON value."""

    def __init__(self) -> None:
        self._configs, self._tables, self._numbered = Pool(), Pool(), Pool()
        self._worlds, self._runs = Pool(), Pool()
        self._digests = blake2b(digest_size=16)
        self._planners: set[str] = set()
        self._triggers = Pool()

    @property
    def triggers(self) -> list[Trigger]:
        """The rules of the packed states, by number; whoever packs writes them, as any other action."""
        rules: list[Trigger] = self._triggers.values
        return rules

    def run(self, state: SimState) -> int:
        """Adds a state and returns its number. Raises `BeliefError`."""
        return self._runs.number(state, self._run)

    def packed(self) -> dict[str, Any]:
        """Returns everything packed so far as a JSON value."""
        return {
            "configs": self._configs.values,
            "tables": self._tables.values,
            "numbered": self._numbered.values,
            "worlds": self._worlds.values,
            "runs": self._runs.values,
            "digest": self._digests.hexdigest(),
        }

    def planners(self) -> set[str]:
        """The names of all planners in the packed states."""
        return {config["planner"] for config in self._configs.values} | self._planners

    def config(self, config: Config) -> int:
        """Adds a configuration and returns its number."""
        return self._configs.number(config, _config)

    def _run(self, state: SimState) -> list[Any]:
        first, *others = [self._ego(ego, state.config) for ego in state.egos.values()]
        _, planner, mode, queue, metrics, fault, record, watch = first
        parts = [self.config(state.config), self._world(state.world), mode, queue, metrics, state.edits]
        parts += [fault, record, watch]
        # One ego with the configuration's planner is nearly all there is, and all there was once.
        if state.triggers != NO_TRIGGERS:
            return [*parts, planner, others, self._rules(state.triggers)]
        return [*parts, planner, others] if others or planner is not None else parts

    def _rules(self, triggers: Triggers) -> list[Any]:
        standing = [
            [
                self._triggers.number(rule.trigger, lambda each: each),
                rule.number,
                rule.since,
                rule.held,
                rule.fired,
                rule.failed,
            ]
            for rule in triggers.standing
        ]
        return [triggers.made, standing]

    def _ego(self, ego: Ego, config: Config) -> list[Any]:
        if ego.belief is not NO_BELIEF:
            raise BeliefError(f"the belief of the sensor {config.sensor} is rebuilt by replay alone")
        record = ego.record
        if ego.planner is not None:
            self._planners.add(ego.planner)
        return [
            ego.id,
            ego.planner,
            ego.mode,
            [*ego.queue],
            [*_metrics_values(ego.metrics)],
            ego.fault,
            [
                None if record.start is None else self._world(record.start),
                record.edits,
                record.changed,
                record.certain,
                record.moves,
                [[*each] for each in record.sakes],
                None if record.last is None else self._world(record.last),
            ],
            _watch(ego.watch),
        ]

    def _world(self, world: World) -> int:
        return self._worlds.number(world, self._written)

    def _written(self, world: World) -> list[Any]:
        self._digests.update(world.digest().encode())
        cause = world.cause
        return [
            world.road.columns,
            world.road.rows,
            world.tick,
            world.episode,
            world.episode_start,
            world.outcome,
            world.ended,
            None if cause is None else _written_cause(cause),
            [*world.avs],
            *(f"{board:x}" for board in _boards(world)),
            self._tables.number(world.movers, _table),
            self._tables.number(world.hazards, _table),
            self._numbered.number(world.numbered, lambda numbered: [[*each] for each in numbered.items()]),
            *([kind, f"{board:x}"] for kind, board in world.boards.later),
        ]


class Unpacker:
    """Unpacks states from a JSON value; `runs` and `configs` are in the order of their numbers.

    Raises `ValueError` (`ConfigError` is one), `TypeError` or `LookupError` for an invalid value, and
    `ValueError` if the digest of the worlds differs from the saved one.
    """

    def __init__(self, packed: Mapping[str, Any], triggers: Sequence[Trigger] = ()) -> None:
        """`triggers`: those of the `Packer`, by number."""
        self.configs = [_read_config(parts) for parts in packed["configs"]]
        tables = [dict(zip(cells, ids, strict=True)) for cells, ids in packed["tables"]]
        numbered = [{Kind(kind): number for kind, number in pairs} for pairs in packed["numbered"]]
        worlds: list[World] = []
        digests = blake2b(digest_size=16)
        for parts in packed["worlds"]:
            worlds.append(_world(parts, tables, numbered))
            digests.update(worlds[-1].digest().encode())
        if digests.hexdigest() != packed["digest"]:
            raise ValueError("the worlds are not those that were written")
        self.runs = [_run(parts, self.configs, worlds, triggers) for parts in packed["runs"]]


def _boards(world: World) -> tuple[int, ...]:
    potholes, barriers, pedestrians = world.boards.first
    return potholes, barriers, world.right, world.left, pedestrians


def _config(config: Config) -> dict[str, Any]:
    return dict(zip(_CONFIG, _config_values(config), strict=True))


def _read_config(parts: Mapping[str, Any]) -> Config:
    if not _ALWAYS <= {*parts} <= set(_CONFIG):
        raise ValueError("a configuration has other fields")
    return Config(**{**parts, "preferences": tuple(parts["preferences"])})


def _table(table: Mapping[int, str]) -> list[Any]:
    return [[*table], [*table.values()]]


def _world(
    parts: Sequence[Any], tables: Sequence[Mapping[int, str]], numbered: Sequence[Mapping[Kind, int]]
) -> World:
    columns, rows, tick, episode, start, outcome, ended, cause, avs, *rest = parts
    potholes, barriers, right, left, pedestrians = (int(board, 16) for board in rest[:5])
    movers, hazards, last, *later = rest[5:]
    boards = {Kind.POTHOLE: potholes, Kind.BARRIER: barriers, Kind.PEDESTRIAN: pedestrians}
    return World(
        road=Road.of(columns, rows),
        tick=tick,
        episode=episode,
        episode_start=start,
        outcome=Outcome(outcome),
        ended=ended,
        cause=None if cause is None else _cause(*cause),
        avs=tuple(avs),
        right=right,
        left=left,
        boards=Boards.of(boards | {Kind(kind): int(board, 16) for kind, board in later}),
        movers=tables[movers],
        hazards=tables[hazards],
        numbered=numbered[last],
    )


def _written_cause(cause: Cause) -> list[Any]:
    parts = [cause.how, cause.kind, [*cause.ids], [*cause.cell]]
    return parts if cause.ego == FIRST else [*parts, cause.ego]


def _cause(how: str, kind: str, ids: Sequence[str], cell: Sequence[int], ego: str = FIRST) -> Cause:
    column, row = cell
    return Cause(how, Kind(kind), tuple(ids), (column, row), ego)


def _watch(watch: Watch) -> list[Any]:
    kept, ticks, span = watch
    if kept is None:
        return [None, ticks, span]
    cell, beat, right, left, marked = kept
    return [[cell, beat, *(f"{board:x}" for board in (right, left, *marked))], ticks, span]


def _read_watch(parts: Sequence[Any]) -> Watch:
    kept, ticks, span = parts
    if kept is None:
        return Watch(None, ticks, span)
    cell, beat, *boards = kept
    right, left, *marked = (int(board, 16) for board in boards)
    marked += [0] * (len(MARKED) - len(marked))  # kinds that came later
    return Watch(Situation(cell, beat, right, left, tuple(marked)), ticks, span)


def _run(
    parts: Sequence[Any], configs: Sequence[Config], worlds: Sequence[World], triggers: Sequence[Trigger]
) -> SimState:
    config, world, mode, queue, metrics, edits, fault, record, watch, *more = parts
    planner, others, *rules = more if more else (None, [])
    first = [FIRST, planner, mode, queue, metrics, fault, record, watch]
    egos = [_read_ego(each, worlds) for each in (first, *others)]
    standing = _read_rules(rules[0], triggers) if rules else NO_TRIGGERS
    return SimState(configs[config], worlds[world], {ego.id: ego for ego in egos}, edits, standing)


def _read_rules(parts: Sequence[Any], triggers: Sequence[Trigger]) -> Triggers:
    made, standing = parts
    return Triggers(
        made,
        tuple(
            StandingTrigger(number, triggers[which], since, held, fired, failed)
            for which, number, since, held, fired, failed in standing
        ),
    )


def _read_ego(parts: Sequence[Any], worlds: Sequence[World]) -> Ego:
    id, planner, mode, queue, metrics, fault, record, watch = parts
    start, seen, changed, certain, moves, sakes, last = record
    return Ego(
        id,
        planner,
        Mode(mode),
        tuple(Move(move) for move in queue),
        Metrics(**dict(zip(_METRICS, metrics, strict=True))),
        fault,
        EpisodeRecord(
            None if start is None else worlds[start],
            seen,
            changed,
            certain,
            moves,
            tuple((sake_of(sake), count) for sake, count in sakes),
            None if last is None else worlds[last],
        ),
        _read_watch(watch),
    )
