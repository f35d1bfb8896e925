"""Thousands of worlds of one road size, side by side, by the rules that a single live world goes by.

Lane i runs configuration i from its first episode (or from a given moment). Nothing here is named:
ids, words and traces belong to single worlds, and `world(lane)` gives one to look at. What a batch
leaves out is a person: queued moves, manual mode and edits. It knows one motion and one behaviour of movers,
those it is compiled for; another in a configuration is refused.

Structure: a block of worlds is kept in the processor's nearest cache for many ticks
(`sim.batch.layout`), one compiled call does all ticks of all worlds (`sim.batch.tick_kernel`). Guarantee: the
same states as `sim.transition.step`, bit for bit, every tick. Idea: worlds as arrays of machine words, as
in Waymax (Gulino et al., 2023) and Craftax (Matthews et al., 2024), with the set operations of chess
engines in place of floating point.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from sim.batch.backward_dp import weighted_moves
from sim.batch.lanes import STATE, After, Lanes, SeededConfigs, check_kinds, listed
from sim.batch.layout import (
    ASKED,
    ENDS,
    EPISODE,
    IN_ROW,
    LANES,
    MOVES,
    PEDESTRIANS,
    SEED,
    TICKS_TO_GOAL,
    WALKERS,
    WATCHING,
)
from sim.batch.reachability import exact_moves
from sim.batch.roads import begin_all, renew
from sim.batch.rule_moves import ruled_moves
from sim.batch.sensing.beliefs import Beliefs
from sim.batch.tick_kernel import END_FIELD, MAX_TICKS_A_CALL, MOVE_FIELD, ticks_kernel
from sim.config import Config
from sim.generation import GenerationError
from sim.perceive.parameters import SUITES
from sim.planner_names import Alias, canonical
from sim.rules.compiled import COMPILED_MOTION, SENSING_PLANNER
from sim.sensor_names import DEFAULT_SENSOR
from sim.state import SimState

BatchPlanner = Literal["priority", "rules", "bfs", "weighted", "astar", "dijkstra", Alias]
"""Two by rules; the least ticks, by an older name as well; the least cost by three names, since `astar` and
`dijkstra` decide the same."""

_KERNELS: Final[dict[str, Any]] = {
    "bfs": exact_moves,
    "weighted": weighted_moves,
    "astar": weighted_moves,
    "dijkstra": weighted_moves,
}
"""Planners that search a way, apart from the tick."""
_LOCAL: Final = frozenset(("priority", "rules"))
"""Planners for which a situation that repeats is STUCK (`sim.repetition`)."""

_NEXT, _THIS = 1, 2
_FIELD: Final = np.uint64(2**16 - 1)
_ALL: Final = np.uint64(2**64 - 1)
_NO_QUEUE: Final[NDArray[np.uint64]] = np.zeros((0, 3), np.uint64)


class Batch(Lanes):
    """Lanes that advance together. Not safe to use from several threads; `run` uses several by itself."""

    def __init__(self, configs: Sequence[Config], *, after: After = "next") -> None:
        """Every lane at its first episode's beginning. Raises `ValueError` unless all roads have one size.

        Raises `ValueError` as well for other dynamics than "grid", another behaviour than "sideways",
        a sensor that a program registered, "perfect" beside sensors that err, and `after="restart"` with
        these.
        Raises `GenerationError` where a road must be drivable and none is found. What a configuration says of
        its planner is left aside: `run` names one.
        """
        if after not in get_args(After):
            raise ValueError(f"after an end follows {listed(get_args(After))}, not {after!r}")
        # Of configurations that differ by their seeds alone, one stands for all.
        kinds = configs[:1] if isinstance(configs, SeededConfigs) else configs
        sizes = {(config.columns, config.rows) for config in kinds}
        if len(sizes) != 1:
            raise ValueError(f"a batch has roads of one size, not of {len(sizes)}")
        _check_rules(kinds)
        sensed = _sensed(kinds, after)
        check_kinds(kinds)
        if any(config.layout for config in kinds):
            raise ValueError('roads of a layout: make them with Batch.of, and after="stop" or "restart"')
        super().__init__(configs, after)
        self._by_chance = any(not config.certain for config in kinds)
        self._bodily = any(config.collision == "swept" or config.reacting for config in kinds)
        found = begin_all(
            self._state,
            self._lanes,
            self._ticks.size,
            self.layout.columns,
            self.layout.rows,
            self._wholes,
            self._shares,
        )
        if not found:
            raise GenerationError
        blocks = self._state.shape[0]
        self._beliefs = Beliefs(kinds, self.layout, len(self), blocks) if sensed else None
        self._remember_first()

    @classmethod
    def of_seeds(cls, config: Config, seeds: NDArray[np.int64], *, after: After = "next") -> Batch:
        """Every lane at its first episode's beginning: a configuration with these seeds (shape: lanes).

        The same as a batch of those configurations, made much faster. Raises as the constructor does.
        """
        return cls(SeededConfigs(config, seeds), after=after)

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
            if batch._beliefs is not None:
                batch._beliefs.take(lane, run)
        batch._remember_first()
        return batch

    def run(self, ticks: int, planner: BatchPlanner = "priority", *, threads: int = 1) -> None:
        """So many ticks of every lane, decided by a planner, on so many threads.

        Raises `ValueError` for a planner that there is not, less than 0 ticks, and less than 1 thread.
        """
        planner = _known(planner)
        if ticks < 0:
            raise ValueError(f"a batch runs 0 ticks or more, not {ticks}")
        _some(threads)
        if planner == "priority" and self._beliefs is None:
            self._advance(ticks, threads, asked=False, watching=True)
            return
        for _ in range(ticks):
            moves = self.moves(planner, threads=threads)
            self._step(moves, threads, watching=planner in _LOCAL and self._beliefs is None)

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
        self._step(moves, threads, watching=False)

    def _step(self, moves: NDArray[np.uint8], threads: int, *, watching: bool) -> None:
        """One tick; with `watching` the moves are those of a planner that repeats itself."""
        asked = np.full(self._ticks.shape, 5, np.uint64)
        asked[: len(self)] = moves
        self._plane(ASKED)[...] = asked.reshape(-1, LANES)
        if not watching:
            self._plane(IN_ROW)[...] = _ALL
        self._sense(threads)
        self._advance(1, threads, asked=True, watching=watching)
        if self._beliefs is not None:
            self._beliefs.looked[:] = 0

    def moves(self, planner: BatchPlanner, *, threads: int = 1) -> NDArray[np.uint8]:
        """What a planner would do now in every lane (shape: lanes); waits where a result stands.

        Raises `ValueError` for `priority`, which decides within the tick unless sensors err, for a planner
        that there is not, and for less than 1 thread.
        """
        if self._beliefs is not None:
            return self._sensed_moves(planner, threads)
        if planner == "rules":
            return self._ruled_moves(threads)
        return self._plan(planner, threads)[0]

    def least(self, planner: BatchPlanner, *, threads: int = 1) -> NDArray[np.int64]:
        """Least ticks (`bfs`) or least cost (`weighted`) to the goal (shape: lanes).

        −1 where no way leads there, 0 where a result stands. Raises `ValueError` as `moves` does, and for
        planners that search none.
        """
        return self._plan(planner, threads)[1]

    def trials(self, *, threads: int = 1) -> NDArray[np.uint8]:
        """How every lane would stand after each of the six moves (shape: lanes, 6; indices as `outcomes`).

        Nothing is changed: the moves are made in a copy. Lanes whose result stands keep it.
        """
        trial, found = self.copy(after="stop"), np.empty((len(self), 6), np.uint8)
        trial._beliefs = None  # what is believed has no part in where moves lead
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
        if self._beliefs is not None:
            self._beliefs.looked[lanes] = 0
        for lane, seed in enumerate(seeds or ()):
            if seed is not None and lanes[lane]:
                self.configs[lane] = self.configs[lane].with_parts(seed=seed)
                self._wholes[lane, SEED], self._wholes[lane, EPISODE] = seed, 1
                chosen[lane] = _THIS
                if self._beliefs is not None:
                    self._beliefs.forget(lane)
        layout, tables = self.layout, (self._wholes, self._shares)
        if not renew(self._state, self._lanes, chosen, layout.columns, layout.rows, *tables):
            raise GenerationError

    def observe(self) -> NDArray[np.uint8]:
        """What is seen of every lane's cells (shape: lanes, 7, rows, columns; `sim.perceive.observe`)."""
        if self._beliefs is None:
            return super().observe()
        self._sense(1, ended=True)
        return self._observed(self._beliefs.believed)

    def copy(self, *, after: After | None = None) -> Batch:
        """The same lanes at the same moment, to go on by themselves; what follows an end may differ."""
        twin = copy(self)
        twin.configs = list(self.configs)
        twin.after = after or self.after
        twin._beliefs = None if self._beliefs is None else self._beliefs.copy()
        for name in STATE:
            setattr(twin, name, getattr(self, name).copy())
        if twin.after == self.after == "restart":
            twin._first_state, twin._first_lanes = self._first_state.copy(), self._first_lanes.copy()
        else:
            twin._remember_first()
        return twin

    # Within

    def _sense(self, threads: int, *, ended: bool = False) -> None:
        """Look where it has not been looked in this tick; `ended`: also where a result stands."""
        beliefs = self._beliefs
        if beliefs is not None:
            given = self._state, self._lanes, self._wholes, self._shares
            self._on_threads(threads, lambda part: beliefs.sense(*given, part, ended=ended))

    def _sensed_moves(self, planner: str, threads: int) -> NDArray[np.uint8]:
        """The moves of the rule planner by what is believed."""
        beliefs = self._beliefs
        assert beliefs is not None
        if _known(planner) != SENSING_PLANNER:
            raise ValueError(f"with a sensor that errs a batch is driven by priority, not by {planner!r}")
        _some(threads)
        self._sense(threads)
        moves = np.empty(len(self), np.uint8)
        given = self._state, self._lanes, self._shares
        self._on_threads(threads, lambda part: beliefs.rule_moves(*given, part, moves))
        return moves

    def _advance(self, ticks: int, threads: int, *, asked: bool, watching: bool) -> None:
        kernel = ticks_kernel(
            walking=self._walking(),
            courteous=self._by_chance,
            bodily=self._bodily,
            watching=watching and bool(self._plane(WATCHING).any()),
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

    def _walking(self) -> bool:
        """Whether there are pedestrians, or will be."""
        return bool(self._plane_of_boards(WALKERS).any() or (self._wholes[:, PEDESTRIANS] > 0).any())

    def _ruled_moves(self, threads: int) -> NDArray[np.uint8]:
        """The moves of the rule-based planner, which plans no way."""
        _some(threads)
        moves = np.zeros(self._ticks.shape, np.uint8)
        size = self.layout.columns, self.layout.rows

        def work(part: slice) -> None:
            lanes = slice(part.start * LANES, min(part.stop * LANES, len(self)))
            given = self._state[part], self._lanes[part], self._shares[lanes], *size
            ruled_moves(*given, lanes.stop - lanes.start, moves[lanes])

        self._on_threads(threads, work)
        return moves[: len(self)]

    def _plan(self, planner: BatchPlanner, threads: int) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
        planner = _known(planner)
        _some(threads)
        if planner not in _KERNELS:
            raise ValueError(f"{planner!r} searches no way to the goal; use run")
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
            _NO_QUEUE,
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

    def _remember_first(self) -> None:
        restart = self.after == "restart"
        self._first_state = self._state.copy() if restart else self._state
        self._first_lanes = self._lanes.copy() if restart else self._lanes


def _check_rules(configs: Sequence[Config]) -> None:
    """Raises `ValueError` for a motion or a behaviour that is not compiled."""
    for name, compiled in COMPILED_MOTION.items():
        for value in sorted({getattr(config, name) for config in configs} - {compiled}):
            raise ValueError(
                f"a batch has {name} {compiled!r} only, not {value!r}; run such roads one by one"
            )
    if any(config.sensor_latency for config in configs):
        raise ValueError("in a batch no sensor is late; run roads with a sensor_latency one by one")
    if any(config.slips for config in configs):
        raise ValueError("in a batch no move slips; run roads with a slip_probability on snow one by one")


def _sensed(configs: Sequence[Config], after: After) -> bool:
    """Whether sensors err. Raises `ValueError` for what a batch does not do with such."""
    sensors = {config.sensor for config in configs}
    if sensors == {DEFAULT_SENSOR}:
        return False
    for sensor in sorted(sensors - {DEFAULT_SENSOR} - set(SUITES)):
        raise ValueError(f"a batch has no sensor {sensor!r} of a program; run such roads one by one")
    if DEFAULT_SENSOR in sensors:
        raise ValueError(f"a batch has no sensor {DEFAULT_SENSOR!r} beside others; run each in its own batch")
    if after == "restart":
        raise ValueError('with a sensor that errs a batch is made with after="next" or "stop"')
    return True


def _known(planner: str) -> BatchPlanner:
    """The present name of a planner. Raises `ValueError` for one that decides for no batch."""
    found: BatchPlanner = canonical(planner)
    if found not in _LOCAL and found not in _KERNELS:
        there = listed([*sorted(_LOCAL), *_KERNELS])
        raise ValueError(f"a batch is driven by {there}, not by {planner!r}")
    return found


def _some(threads: int) -> None:
    """Raises `ValueError` for less than one thread."""
    if threads < 1:
        raise ValueError(f"a batch runs on 1 thread or more, not on {threads}")
