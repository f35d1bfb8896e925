"""The state of a batch as arrays: what every lane holds, put in from a run, read out, saved and restored.

Nothing runs here (`sim.batch.batch`). Arrays (blocks: lanes / `LANES`, rounded up; the lanes that fill the
last block up are copies of the last configuration's):

- `_state` (blocks, words · planes · lanes of a block; uint64): boards cut into words (`sim.batch.layout`);
- `_lanes` (blocks, lane planes · lanes of a block; uint64): what a world has once;
- `_wholes` (lanes, 8; int64) and `_shares` (lanes, 4; float64): what roads are drawn from and who reacts,
  by the columns that `sim.batch.layout` names;
- `_charges` (lanes, 7; int64): the charges of `sim.search.costs.Weights`, in its order;
- `_ticks` (lanes; int64): ticks since the session began; `_counts` (8, lanes; int64): the fields of `Totals`.
"""

from __future__ import annotations

from collections.abc import Mapping, MutableSequence, Sequence
from dataclasses import astuple, dataclass, replace
from typing import Any, Final, Literal, NoReturn

import numpy as np
from numpy.typing import NDArray

from sim.batch.causes import cause_of_crash
from sim.batch.layout import (
    ASKED,
    ATTENTIVE_KEY,
    BRAKING,
    CELL,
    COLUMN_BIT,
    COURTESY_KEY,
    EPISODE,
    EPISODE_TICK,
    FIXED,
    HOLES,
    IN_ROW,
    KEPT_AT,
    KEPT_LEFT,
    KEPT_LEFT_AHEAD,
    KEPT_RIGHT,
    KEPT_RIGHT_AHEAD,
    KEPT_WALKERS,
    KEPT_WALKERS_AHEAD,
    LANE_PLANES,
    LANES,
    LEFT,
    OUTCOME,
    PLANES,
    RIGHT,
    SEED,
    SHIFT,
    SINCE_END,
    SWEPT,
    WALKERS,
    WATCHING,
    WORD,
    Layout,
    Words,
)
from sim.batch.observe import observe
from sim.batch.sensing.beliefs import Beliefs
from sim.config import COUNTS, Config
from sim.generation import assign_ids
from sim.randomness import Stream
from sim.repetition import Watch
from sim.rules.compiled import COMPILED_KINDS
from sim.search.costs import weights
from sim.state import SimState
from sim.types import KINDS, MARKED, MOVES, PLACEABLE, Kind, Outcome
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, bits

After = Literal["next", "restart", "stop"]
"""What follows an end: the next road as live, once the result has stood; the lane's first road, at once;
or nothing."""

_UNKNOWN: Final = tuple(kind for kind in PLACEABLE if kind not in COMPILED_KINDS)
"""The kinds that a batch refuses."""
_OUTCOMES: Final = tuple(Outcome)
STATE: Final = ("_state", "_lanes", "_wholes", "_ticks", "_counts")
"""What changes as lanes advance, unless their first roads begin again."""
_ALL: Final = np.uint64(2**64 - 1)
_COUNTERS: Final = 8


@dataclass(frozen=True, slots=True)
class Totals:
    """What has been counted, one number for each lane (shape: lanes, int64)."""

    forward: NDArray[np.int64]
    lateral: NDArray[np.int64]
    diagonal: NDArray[np.int64]
    stay: NDArray[np.int64]
    successes: NDArray[np.int64]
    crashes: NDArray[np.int64]
    stuck: NDArray[np.int64]
    ticks_to_goal: NDArray[np.int64]
    """ticks of the episodes that arrived, together"""


class SeededConfigs(MutableSequence[Config]):
    """One configuration with many seeds, each made when it is asked for: checking a million takes long."""

    def __init__(self, config: Config, seeds: NDArray[np.int64]) -> None:
        self._config = config
        self.seeds = seeds
        self._changed: dict[int, Config] = {}
        self._first = replace(config, seed=int(seeds[0])) if len(seeds) else config

    def __len__(self) -> int:
        return len(self.seeds)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[each] for each in range(*index.indices(len(self)))]
        if index in self._changed:
            return self._changed[index]
        if index == 0:  # stands for all of them where a batch is made
            return self._first
        return replace(self._config, seed=int(self.seeds[index]))

    def __setitem__(self, index: Any, config: Any) -> None:
        self._changed[index] = config

    def __delitem__(self, index: Any) -> None:
        raise TypeError("lanes cannot be taken away")

    def insert(self, index: int, value: Config) -> None:  # noqa: ARG002
        """Refused. Raises `TypeError`."""
        raise TypeError("lanes cannot be added")


class Lanes:
    """Lanes side by side: configurations of one road size, and the state of each."""

    def __init__(self, configs: Sequence[Config], after: After) -> None:
        """Room for every lane; no road is begun yet. `after`: what follows an end."""
        self.configs: MutableSequence[Config] = (
            configs if isinstance(configs, SeededConfigs) else list(configs)
        )
        self.layout = Layout.of(configs[0].columns, configs[0].rows)
        self.after: After = after
        self._beliefs: Beliefs | None = None
        """of sensors that err"""
        count = len(self.configs)
        blocks = -(-count // LANES)
        self._state: Words = np.zeros((blocks, self.layout.words * PLANES * LANES), np.uint64)
        self._lanes: Words = np.zeros((blocks, LANE_PLANES * LANES), np.uint64)
        seeded = isinstance(configs, SeededConfigs)
        padded = [configs[0]] if seeded else [*self.configs, *[self.configs[-1]] * (blocks * LANES - count)]
        self._wholes = np.array(
            [
                (
                    -1 if config.vehicles is None else config.vehicles,
                    config.pedestrians,
                    config.barriers,
                    -1 if config.potholes is None else config.potholes,
                    config.seed,
                    1,
                    config.reset_delay_ticks,
                    config.solvable,
                )
                for config in padded
            ],
            np.int64,
        )
        self._shares = np.array(
            [
                (config.vehicle_probability, config.pothole_probability, config.courtesy, config.attentive)
                for config in padded
            ]
        )
        self._charges = np.array([astuple(weights(config)) for config in padded], np.int64)
        if isinstance(configs, SeededConfigs):
            for name in ("_wholes", "_shares", "_charges"):
                setattr(self, name, np.repeat(getattr(self, name), blocks * LANES, axis=0))
            self._wholes[:, SEED] = np.pad(configs.seeds, (0, blocks * LANES - count), "edge")
        for plane, holds in (
            (SWEPT, [config.collision == "swept" for config in padded]),
            # Who brakes in every tick; where it is drawn, the tick draws it (`ATTENTIVE`).
            (BRAKING, [config.attentive == 1.0 for config in padded]),
            (WATCHING, [config.repetition and config.certain for config in padded]),
        ):
            flags = np.where(holds, _ALL, np.uint64(0))
            self._plane(plane)[...] = flags if seeded else flags.reshape(-1, LANES)
        self._ticks = np.zeros(blocks * LANES, np.int64)
        self._counts = np.zeros((_COUNTERS, blocks * LANES), np.int64)

    def __len__(self) -> int:
        return len(self.configs)

    def saved(self) -> dict[str, NDArray[Any]]:
        """All that changes as the lanes advance, as arrays by name; `restore` takes them.

        Raises `ValueError` for a batch made with `after="restart"`, which has more to remember.
        """
        if self.after == "restart":
            raise ValueError('a batch made with after="restart" cannot be saved')
        found = {name[1:]: getattr(self, name).copy() for name in STATE}
        return found if self._beliefs is None else found | self._beliefs.saved()

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Be at the moment that was saved, of as many lanes of the same configurations, seeds aside.

        Raises `ValueError` unless names, shapes and types are those of this batch; nothing is changed then.
        """
        mine = self.saved()
        if {name: (array.shape, array.dtype) for name, array in mine.items()} != {
            name: (array.shape, array.dtype) for name, array in arrays.items()
        }:
            raise ValueError("these are not the arrays of a batch of this size")
        for name in STATE:
            getattr(self, name)[...] = arrays[name[1:]]
        if self._beliefs is not None:
            self._beliefs.put(arrays)
        seeds = self._wholes[: len(self), SEED].tolist()
        self.configs = [
            config.with_parts(seed=seed) for config, seed in zip(self.configs, seeds, strict=True)
        ]

    @property
    def seeds(self) -> NDArray[np.int64]:
        """The seed of every lane's configuration (shape: lanes)."""
        return self._wholes[: len(self), SEED].copy()

    @property
    def outcomes(self) -> NDArray[np.uint8]:
        """How every lane stands (shape: lanes; indices in the order of `Outcome`, 0 is running)."""
        return self._lane_values(OUTCOME).astype(np.uint8)

    @property
    def vehicles(self) -> NDArray[np.int64]:
        """Cell indices of the autonomous vehicles (shape: lanes)."""
        return self._lane_values(CELL).astype(np.int64)

    @property
    def episodes(self) -> NDArray[np.int64]:
        """Which episode every lane is in, from 1 (shape: lanes)."""
        return self._wholes[: len(self), EPISODE].copy()

    @property
    def episode_ticks(self) -> NDArray[np.int64]:
        """Ticks since every lane's episode began (shape: lanes)."""
        return self._lane_values(EPISODE_TICK).astype(np.int64)

    def observe(self) -> NDArray[np.uint8]:
        """Every lane's cells (shape: lanes, 7, rows, columns; planes as in `sim.perceive.observe`)."""
        return self._observed(self._state)

    def _observed(self, state: Words) -> NDArray[np.uint8]:
        columns, rows = self.layout.columns, self.layout.rows
        out = np.empty((len(self), 7, rows, columns), np.uint8)
        observe(state, self._lanes, len(self), columns, rows, out)
        return out

    def totals(self) -> Totals:
        """What has been counted since the batch was made."""
        return Totals(*(row[: len(self)].copy() for row in self._counts))

    def world(self, lane: int) -> World:
        """One lane's world, its things numbered in reading order."""
        right, left, fixed, potholes, walkers = (self._board(lane, plane) for plane in range(PLANES))
        outcome = _OUTCOMES[int(self.outcomes[lane])]
        tick = int(self._ticks[lane])
        since = int(self._lane_values(SINCE_END)[lane])
        numbered: dict[Kind, int] = {}

        def ids(kind: Kind, board: Board) -> dict[int, str]:
            return assign_ids(kind, bits(board), numbered)

        barriers = fixed & ~potholes
        vehicles = (right | left) & ~walkers
        world = World(
            road=self.layout.road,
            tick=tick,
            episode=int(self.episodes[lane]),
            episode_start=tick - int(self.episode_ticks[lane]),
            outcome=outcome,
            ended=None if outcome is Outcome.RUNNING else tick - since,
            avs=(int(self.vehicles[lane]),),
            right=right,
            left=left,
            boards=Boards.of({Kind.POTHOLE: potholes, Kind.BARRIER: barriers, Kind.PEDESTRIAN: walkers}),
            movers=ids(Kind.VEHICLE, vehicles) | ids(Kind.PEDESTRIAN, walkers),
            hazards=ids(Kind.POTHOLE, potholes) | ids(Kind.BARRIER, barriers),
            numbered=numbered,
        )
        if outcome is not Outcome.CRASH:
            return world
        # The move is that of the tick that ended, unless others went on since.
        move = None if since else MOVES[int(self._lane_values(ASKED)[lane])]
        return replace(world, cause=cause_of_crash(world, move) or cause_of_crash(world, None))

    def digest(self, lane: int) -> str:
        """`World.digest` of one lane."""
        return self.world(lane).digest()

    def _put(self, other: Lanes) -> None:
        """Be at the moment of a batch of the same configurations."""
        for name in STATE:
            getattr(self, name)[...] = getattr(other, name)

    def _place(self, lane: int, run: SimState) -> None:
        """Put a moment of a run into a lane."""
        world = run.world
        for kind in _UNKNOWN:
            if world.count(kind):
                _refuse_kind(kind)
        block, inner = divmod(lane, LANES)
        boards = self._state[block].reshape(self.layout.words, PLANES, LANES)
        planes = (world.right, world.left, world.fixed, world.potholes, world.pedestrians)
        for plane, board in zip((RIGHT, LEFT, FIXED, HOLES, WALKERS), planes, strict=True):
            boards[:, plane, inner] = np.array(self.layout.cut(board), np.uint64)
        row, column = divmod(world.av, self.layout.columns)
        word, row_in_word = divmod(row, self.layout.rows_per_word)
        values = {
            WORD: word,
            SHIFT: row_in_word * self.layout.columns,
            COLUMN_BIT: 1 << column,
            CELL: world.av,
            EPISODE_TICK: world.episode_tick,
            OUTCOME: _OUTCOMES.index(world.outcome),
            SINCE_END: 0 if world.ended is None else world.tick - world.ended,
            COURTESY_KEY: Stream.of(run.config.seed, "courtesy", world.episode).key,
            ATTENTIVE_KEY: Stream.of(run.config.seed, "attentive", world.episode).key,
            **self._watched(run.watch),
        }
        for plane, value in values.items():
            self._lanes[block].reshape(LANE_PLANES, LANES)[plane, inner] = np.uint64(value)
        self._wholes[lane, EPISODE] = world.episode
        self._ticks[lane] = world.tick

    def _watched(self, watch: Watch) -> dict[int, int]:
        """A run's watch as planes of a lane."""
        kept, columns, per_word = watch.kept, self.layout.columns, self.layout.rows_per_word
        if kept is None:
            return {IN_ROW: int(_ALL)}
        row = kept.cell // columns
        whole = (1 << columns) - 1
        values = {IN_ROW: watch.span - 1 + watch.ticks, KEPT_AT: 2 * kept.cell + kept.beat}
        for own, ahead, board in (
            (KEPT_RIGHT, KEPT_RIGHT_AHEAD, kept.right),
            (KEPT_LEFT, KEPT_LEFT_AHEAD, kept.left),
            (KEPT_WALKERS, KEPT_WALKERS_AHEAD, kept.marked[MARKED.index(Kind.PEDESTRIAN)]),
        ):
            values[own] = board >> columns << row % per_word * columns
            values[ahead] = (board & whole) << (row - 1) % per_word * columns
        return values

    def _plane(self, plane: int) -> Words:
        return self._lanes.reshape(-1, LANE_PLANES, LANES)[:, plane]

    def _plane_of_boards(self, plane: int) -> Words:
        return self._state.reshape(-1, self.layout.words, PLANES, LANES)[:, :, plane]

    def _lane_values(self, plane: int) -> Words:
        return self._plane(plane).reshape(-1)[: len(self)]

    def _board(self, lane: int, plane: int) -> int:
        block, inner = divmod(lane, LANES)
        return self.layout.joined(self._plane_of_boards(plane)[block, :, inner])


def listed(names: Sequence[str]) -> str:
    """Names as a list to read."""
    return f"{', '.join(names[:-1])} or {names[-1]}"


def check_kinds(configs: Sequence[Config]) -> None:
    """Raises `ValueError` for roads with things of a kind that the kernels do not know."""
    for kind in _UNKNOWN:
        if kind in COUNTS and any(getattr(config, COUNTS[kind]) for config in configs):
            _refuse_kind(kind)


def _refuse_kind(kind: Kind) -> NoReturn:
    """Raises `ValueError`: the kernels do not know things of this kind."""
    known = listed([KINDS[each].plural for each in COMPILED_KINDS])
    raise ValueError(
        f"a batch has {known} on its roads, and no {KINDS[kind].plural}; run such roads one by one"
    )
