"""Thousands of worlds of one road size, side by side, by the rules that a single live world goes by.

Lane i runs configuration i from its first episode (or from a given moment). Nothing here is named:
ids, words and traces belong to single worlds, and `world(lane)` gives one to look at. What a batch
leaves out is a person: queued moves, manual mode and edits.

Structure: a block of worlds is kept in the processor's nearest cache for many ticks
(`sim.batch.layout`), one compiled call does all ticks of all worlds (`sim.batch.tick`). Guarantee: the
same states as `sim.transition.step`, bit for bit, every tick. Idea: worlds as arrays of machine words, as
in Waymax (Gulino et al., 2023) and Craftax (Matthews et al., 2024), with the set operations of chess
engines in place of floating point.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import astuple, dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any, Final, Literal, NoReturn, get_args

import numpy as np
from numpy.typing import NDArray

from sim.batch.backward_dp import weighted_moves
from sim.batch.causes import cause_of_crash
from sim.batch.layout import (
    ASKED,
    ATTENTIVE,
    ATTENTIVE_KEY,
    BRAKING,
    CELL,
    COLUMN_BIT,
    COURTESY,
    COURTESY_KEY,
    ENDS,
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
    MOVES,
    OUTCOME,
    PEDESTRIANS,
    PLANES,
    RIGHT,
    SEED,
    SHIFT,
    SINCE_END,
    SWEPT,
    TICKS_TO_GOAL,
    WALKERS,
    WATCHING,
    WORD,
    Layout,
    Words,
)
from sim.batch.observe import observe
from sim.batch.reachability import exact_moves
from sim.batch.roads import begin_all, renew
from sim.batch.tick import END_FIELD, MAX_TICKS_A_CALL, MOVE_FIELD, ticks_kernel
from sim.config import COUNTS, Config
from sim.generation import GenerationError, assign_ids
from sim.planner_names import Alias, canonical
from sim.randomness import Stream
from sim.repetition import Watch
from sim.search.costs import weights
from sim.state import SimState
from sim.types import KINDS, MARKED, PLACEABLE, Kind, Move, Outcome
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, bits

After = Literal["next", "restart", "stop"]
"""What follows an end: the next road as live, once the result has stood; the lane's first road, at once;
or nothing."""

BatchPlanner = Literal["priority", "bfs", "weighted", "astar", "dijkstra", Alias]
"""The rule; the least ticks, by an older name as well; the least cost by three names, since `astar` and
`dijkstra` decide the same."""

_KERNELS: Final[dict[str, Any]] = {
    "bfs": exact_moves,
    "weighted": weighted_moves,
    "astar": weighted_moves,
    "dijkstra": weighted_moves,
}
"""Planners that look ahead, apart from the tick."""

_KINDS: Final = (Kind.POTHOLE, Kind.BARRIER, Kind.VEHICLE, Kind.PEDESTRIAN)
"""The kinds that the kernels know."""
_UNKNOWN: Final = tuple(kind for kind in PLACEABLE if kind not in _KINDS)
_OUTCOMES: Final = tuple(Outcome)
_MOVES: Final = tuple(Move)
_NEXT, _THIS = 1, 2
_STATE: Final = ("_state", "_lanes", "_wholes", "_ticks", "_counts")
"""What changes as lanes advance, unless their first roads begin again."""
_FIELD: Final = np.uint64(2**16 - 1)
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


class Batch:
    """Lanes that advance together. Not safe to use from several threads; `run` uses several by itself."""

    def __init__(self, configs: Sequence[Config], *, after: After = "next") -> None:
        """Every lane at its first episode's beginning. Raises `ValueError` unless all roads have one size.

        Raises `GenerationError` where a road must be drivable and none is found. What a configuration says of
        its planner is left aside: `run` names one.
        """
        if after not in get_args(After):
            raise ValueError(f"after an end follows {_listed(get_args(After))}, not {after!r}")
        sizes = {(config.columns, config.rows) for config in configs}
        if len(sizes) != 1:
            raise ValueError(f"a batch has roads of one size, not of {len(sizes)}")
        for kind in _UNKNOWN:
            if kind in COUNTS and any(getattr(config, COUNTS[kind]) for config in configs):
                _refuse_kind(kind)
        if any(config.layout for config in configs):
            raise ValueError('roads of a layout: make them with Batch.of, and after="stop" or "restart"')
        self.configs = list(configs)
        self.layout = Layout.of(*sizes.pop())
        self.after: After = after
        count = len(self.configs)
        blocks = -(-count // LANES)
        self._state: Words = np.zeros((blocks, self.layout.words * PLANES * LANES), np.uint64)
        self._lanes: Words = np.zeros((blocks, LANE_PLANES * LANES), np.uint64)
        padded = [*self.configs, *[self.configs[-1]] * (blocks * LANES - count)]
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
                (config.spawn_probability, config.pothole_probability, config.courtesy, config.attentive)
                for config in padded
            ]
        )
        for plane, holds in (
            (SWEPT, [config.collision == "swept" for config in padded]),
            (BRAKING, [config.attentive == 1.0 for config in padded]),
            (WATCHING, [config.repetition and config.certain for config in padded]),
        ):
            self._plane(plane)[...] = np.where(holds, _ALL, np.uint64(0)).reshape(-1, LANES)
        self._charges = np.array([astuple(weights(config)) for config in padded], np.int64)
        self._ticks = np.zeros(blocks * LANES, np.int64)
        self._counts = np.zeros((_COUNTERS, blocks * LANES), np.int64)
        found = begin_all(
            self._state,
            self._lanes,
            blocks * LANES,
            self.layout.columns,
            self.layout.rows,
            self._wholes,
            self._shares,
        )
        if not found:
            raise GenerationError
        self._remember_first()

    @classmethod
    def of(cls, runs: Sequence[SimState], *, after: After = "next") -> Batch:
        """Every lane at a given moment of a run; queued moves and the manual mode are left behind.

        Raises `ValueError` where a road has a layout and `after` is "next": no more of them are drawn here.
        """
        configs = [run.config for run in runs]
        if after != "next":
            # Nothing is drawn again, so that the first worlds drawn here may be any.
            configs = [
                replace(each, layout=None, solvable=False) if each.layout else each for each in configs
            ]
        batch = cls(configs, after=after)
        batch.configs = [run.config for run in runs]
        for lane, run in enumerate(runs):
            batch._place(lane, run)
        batch._remember_first()
        return batch

    def __len__(self) -> int:
        return len(self.configs)

    def run(self, ticks: int, planner: BatchPlanner = "priority", *, threads: int = 1) -> None:
        """So many ticks of every lane, decided by a planner, on so many threads.

        Raises `ValueError` for a planner that there is not, less than 0 ticks, and less than 1 thread.
        """
        planner = _known(planner)
        if ticks < 0:
            raise ValueError(f"a batch runs 0 ticks or more, not {ticks}")
        _some(threads)
        if planner == "priority":
            self._advance(ticks, threads, asked=False)
            return
        for _ in range(ticks):
            self.step(self.moves(planner, threads=threads), threads=threads)

    def run_to_end(self, planner: BatchPlanner = "priority", *, threads: int = 1) -> None:
        """All lanes to the end of their episodes.

        Raises `ValueError` unless made with `after="stop"`, and as `run` does.
        """
        planner = _known(planner)
        _some(threads)
        if self.after != "stop":
            raise ValueError('only a batch made with after="stop" has an end')
        while (self.outcomes == 0).any():
            self.run(self.layout.rows if planner == "priority" else 1, planner, threads=threads)

    def step(self, moves: NDArray[np.uint8], *, threads: int = 1) -> None:
        """One tick, every vehicle making its move (shape: lanes; indices in the order of `Move`).

        Nothing is held back: a move into a collision is a crash. A move off the road is a wait. Lanes whose
        result stands do not move. Moves handed in are as a person's: a situation that repeats is not STUCK.
        Raises `ValueError` for another shape, a number that is no move, and less than 1 thread.
        """
        _some(threads)
        if moves.shape != (len(self),):
            raise ValueError(f"{len(self)} moves are wanted, one for each lane")
        if moves.max(initial=0) > 5:
            raise ValueError("a move is a number from 0 to 5")
        asked = np.full(self._ticks.shape, 5, np.uint64)
        asked[: len(self)] = moves
        self._plane(ASKED)[...] = asked.reshape(-1, LANES)
        self._plane(IN_ROW)[...] = _ALL
        self._advance(1, threads, asked=True)

    def moves(self, planner: BatchPlanner, *, threads: int = 1) -> NDArray[np.uint8]:
        """What a planner would do now in every lane (shape: lanes); waits where a result stands.

        Raises `ValueError` for `priority`, which decides within the tick, for a planner that there is not,
        and for less than 1 thread.
        """
        return self._plan(planner, threads)[0]

    def least(self, planner: BatchPlanner, *, threads: int = 1) -> NDArray[np.int64]:
        """Least ticks (`bfs`) or least cost (`weighted`) to the goal (shape: lanes).

        −1 where no way leads there, 0 where a result stands. Raises `ValueError` as `moves` does.
        """
        return self._plan(planner, threads)[1]

    def trials(self, *, threads: int = 1) -> NDArray[np.uint8]:
        """How every lane would stand after each of the six moves (shape: lanes, 6; indices as `outcomes`).

        Nothing is changed: the moves are made in a copy. Lanes whose result stands keep it.
        """
        trial, found = self.copy(after="stop"), np.empty((len(self), 6), np.uint8)
        for move in range(6):
            trial._put(self)
            trial.step(np.full(len(self), move, np.uint8), threads=threads)
            found[:, move] = trial.outcomes
        return found

    def renew(self, lanes: NDArray[np.bool_], seeds: Sequence[int | None] | None = None) -> None:
        """Begin the next episode in the chosen lanes (shape: lanes), or the first of a seed that is given.

        Where a next road must be drivable and none is found, the present one again
        (`sim.state.next_episode`). Raises `GenerationError` where none is found for a seed, and
        `ConfigError` for a seed that is none.
        """
        chosen = np.where(lanes, _NEXT, 0).astype(np.uint8)
        for lane, seed in enumerate(seeds or ()):
            if seed is not None and lanes[lane]:
                self.configs[lane] = self.configs[lane].with_parts(seed=seed)
                self._wholes[lane, SEED], self._wholes[lane, EPISODE] = seed, 1
                chosen[lane] = _THIS
        layout, tables = self.layout, (self._wholes, self._shares)
        if not renew(self._state, self._lanes, chosen, layout.columns, layout.rows, *tables):
            raise GenerationError

    def copy(self, *, after: After | None = None) -> Batch:
        """The same lanes at the same moment, to go on by themselves; what follows an end may differ."""
        twin = copy(self)
        twin.configs = list(self.configs)
        twin.after = after or self.after
        for name in _STATE:
            setattr(twin, name, getattr(self, name).copy())
        if twin.after == self.after == "restart":
            twin._first_state, twin._first_lanes = self._first_state.copy(), self._first_lanes.copy()
        else:
            twin._remember_first()
        return twin

    def saved(self) -> dict[str, NDArray[Any]]:
        """All that changes as the lanes advance, as arrays by name; `restore` takes them.

        Raises `ValueError` for a batch made with `after="restart"`, which has more to remember.
        """
        if self.after == "restart":
            raise ValueError('a batch made with after="restart" cannot be saved')
        return {name[1:]: getattr(self, name).copy() for name in _STATE}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Be at the moment that was saved, of as many lanes of the same configurations, seeds aside.

        Raises `ValueError` unless names, shapes and types are those of this batch; nothing is changed then.
        """
        mine = self.saved()
        if {name: (array.shape, array.dtype) for name, array in mine.items()} != {
            name: (array.shape, array.dtype) for name, array in arrays.items()
        }:
            raise ValueError("these are not the arrays of a batch of this size")
        for name in _STATE:
            getattr(self, name)[...] = arrays[name[1:]]
        seeds = self._wholes[: len(self), SEED].tolist()
        self.configs = [
            config.with_parts(seed=seed) for config, seed in zip(self.configs, seeds, strict=True)
        ]

    # Reading

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
        columns, rows = self.layout.columns, self.layout.rows
        out = np.empty((len(self), 7, rows, columns), np.uint8)
        observe(self._state, self._lanes, len(self), columns, rows, out)
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
        move = None if since else _MOVES[int(self._lane_values(ASKED)[lane])]
        return replace(world, cause=cause_of_crash(world, move) or cause_of_crash(world, None))

    def digest(self, lane: int) -> str:
        """`World.digest` of one lane."""
        return self.world(lane).digest()

    # Within

    def _advance(self, ticks: int, threads: int, *, asked: bool) -> None:
        attentive = self._shares[:, ATTENTIVE]
        kernel = ticks_kernel(
            walking=bool(self._plane_of_boards(WALKERS).any() or (self._wholes[:, PEDESTRIANS] > 0).any()),
            courteous=bool((self._shares[:, COURTESY] > 0).any() or (attentive % 1.0 > 0).any()),
            bodily=bool(self._plane(SWEPT).any() or (attentive > 0).any()),
            watching=bool(self._plane(WATCHING).any()) and not asked,
            held=self.after != "restart",
            asked=asked,
            renewed=self.after == "next",
        )
        while ticks > 0:
            now = min(ticks, MAX_TICKS_A_CALL)
            self._on_threads(threads, partial(self._call, kernel, now))
            self._ticks += now
            self._empty_counters()
            ticks -= now

    def _plan(self, planner: BatchPlanner, threads: int) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
        planner = _known(planner)
        _some(threads)
        if planner not in _KERNELS:
            raise ValueError(f"{planner!r} decides within the tick; use run")
        kernel = _KERNELS[planner]
        size = self._ticks.shape
        moves, least = np.zeros(size, np.uint8), np.zeros(size, np.int64)

        def work(part: slice) -> None:
            lanes = slice(part.start * LANES, min(part.stop * LANES, len(self)))
            charges = (self._charges[lanes],) if kernel is weighted_moves else ()
            kernel(
                self._state[part],
                self._lanes[part],
                self._shares[lanes],
                *charges,
                *self._geometry(),
                lanes.stop - lanes.start,
                moves[lanes],
                least[lanes],
            )

        self._on_threads(threads, work)
        return moves[: len(self)], least[: len(self)]

    def _geometry(self) -> tuple[int, int, np.uint64, np.uint64]:
        """Columns, rows and the edges of a word, as compiled functions take them."""
        layout = self.layout
        return layout.columns, layout.rows, np.uint64(layout.left_edge), np.uint64(layout.right_edge)

    def _call(self, kernel: Any, ticks: int, part: slice) -> None:
        lanes = slice(part.start * LANES, part.stop * LANES)
        kernel(
            self._state[part],
            self._first_state[part],
            self._lanes[part],
            self._first_lanes[part],
            self._wholes[lanes],
            self._shares[lanes],
            *self._geometry(),
            ticks,
        )

    def _on_threads(self, threads: int, work: Callable[[slice], None]) -> None:
        """Split the blocks evenly over threads; compiled code holds no interpreter lock."""
        blocks = self._state.shape[0]
        parts = min(threads, blocks)
        edges = [blocks * part // parts for part in range(parts + 1)]
        slices = [slice(start, stop) for start, stop in pairwise(edges)]
        if parts == 1:
            work(slices[0])
            return
        with ThreadPoolExecutor(parts) as pool:
            list(pool.map(work, slices))

    def _empty_counters(self) -> None:
        moves, ends = self._plane(MOVES).reshape(-1), self._plane(ENDS).reshape(-1)
        for index in range(4):
            self._counts[index] += (moves >> np.uint64(MOVE_FIELD * index) & _FIELD).astype(np.int64)
        for index in range(3):
            self._counts[4 + index] += (ends >> np.uint64(END_FIELD * index) & _FIELD).astype(np.int64)
        self._counts[7] += self._plane(TICKS_TO_GOAL).reshape(-1).astype(np.int64)
        for plane in (MOVES, ENDS, TICKS_TO_GOAL):
            self._plane(plane)[...] = 0

    def _put(self, other: Batch) -> None:
        """Be at the moment of a batch of the same configurations."""
        for name in _STATE:
            getattr(self, name)[...] = getattr(other, name)

    def _remember_first(self) -> None:
        restart = self.after == "restart"
        self._first_state = self._state.copy() if restart else self._state
        self._first_lanes = self._lanes.copy() if restart else self._lanes

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


def _listed(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} or {names[-1]}"


def _known(planner: str) -> BatchPlanner:
    """The present name of a planner. Raises `ValueError` for one that decides for no batch."""
    found: BatchPlanner = canonical(planner)
    if found != "priority" and found not in _KERNELS:
        there = _listed(["priority", *_KERNELS])
        raise ValueError(f"a batch is driven by {there}, not by {planner!r}")
    return found


def _refuse_kind(kind: Kind) -> NoReturn:
    """Raises `ValueError`: the kernels do not know things of this kind."""
    known = _listed([KINDS[each].plural for each in _KINDS])
    raise ValueError(
        f"a batch has {known} on its roads, and no {KINDS[kind].plural}; run such roads one by one"
    )


def _some(threads: int) -> None:
    """Raises `ValueError` for less than one thread."""
    if threads < 1:
        raise ValueError(f"a batch runs on 1 thread or more, not on {threads}")
