"""What the vehicles of a batch believe, by lane, for sensors that err; made only where a lane has one.

The same belief as `sim.perceive.grid_sensor` gathers live, as far as the vehicle's own row: what is behind is
never looked at again and never met. `Batch` has it moved on once in every tick.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.batch.layout import FIXED, HOLES, LANES, LEFT, PLANES, RIGHT, WALKERS, Layout, Words
from sim.batch.sensing.lane import rule_moves, scratch_arrays, sense_lanes
from sim.batch.sensing.memory import BEFORE, COLUMNS_KEPT, COUNT, LAST_NUMBER, TICK_BEFORE
from sim.config import Config
from sim.perceive.belief import LAYERS, GridBelief
from sim.perceive.kernel.look import fill_shadows
from sim.perceive.kernel.tables import Setup, setup
from sim.perceive.look import NUMBER
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.types import kind_of
from sim.world import World
from sim.world.grid import bits

KEPT: Final = ("believed", "layers", "memory", "looked")
"""What changes as the lanes advance."""


class _Group(NamedTuple):
    """Lanes that see alike."""

    setup: Setup
    threshold: float
    lanes: NDArray[np.int64]


class Beliefs:
    """Beliefs of the lanes of a batch."""

    def __init__(self, configs: Sequence[Config], layout: Layout, count: int, blocks: int) -> None:
        """Nothing is believed yet. `configs`: of every lane, or the one of all `count` lanes."""
        self._layout = layout
        cells = layout.columns * layout.rows
        self.believed: Words = np.zeros((blocks, layout.words * PLANES * LANES), np.uint64)
        """the boards that are shown, as `Lanes` keeps those that are"""
        self.layers = np.zeros((count, LAYERS * cells), np.int16)
        self.memory = np.zeros((count, COLUMNS_KEPT), np.int64)
        self.memory[:, BEFORE] = -1
        self.looked = np.zeros(count, np.uint8)
        """whether a lane has looked in this tick"""
        self._groups = _groups(configs, layout, count)

    def sense(
        self,
        state: Words,
        lanes: Words,
        wholes: NDArray[Any],
        shares: NDArray[Any],
        part: slice,
        *,
        ended: bool = False,
    ) -> None:
        """Look at the road in those lanes of some blocks that have not in this tick.

        With `ended`, also where a result stands.
        """
        layout = self._layout
        for group in self._groups:
            first, last = np.searchsorted(group.lanes, (part.start * LANES, part.stop * LANES))
            sense_lanes(
                state,
                lanes,
                self.believed,
                self.layers,
                self.memory,
                self.looked,
                ended,
                wholes,
                shares,
                group.lanes[first:last],
                layout.columns,
                layout.rows,
                np.uint64(layout.left_edge),
                np.uint64(layout.right_edge),
                group.threshold,
                np.frombuffer(group.setup.prior, np.int16),
                group.setup.mixing,
                group.setup.least,
                group.setup.tables,
                scratch_arrays(layout.columns, layout.rows, group.setup.tables),
            )

    def rule_moves(
        self, state: Words, lanes: Words, shares: NDArray[Any], part: slice, moves: NDArray[np.uint8]
    ) -> None:
        """Write the moves of the rule planner in the lanes of some blocks."""
        layout = self._layout
        first, last = part.start * LANES, min(part.stop * LANES, len(self.layers))
        rule_moves(
            state[part],
            lanes[part],
            self.believed[part],
            shares[first:last],
            layout.columns,
            np.uint64(layout.left_edge),
            np.uint64(layout.right_edge),
            last - first,
            moves[first:last],
        )

    def forget(self, lane: int) -> None:
        """Begin a lane anew: nothing has been numbered."""
        self.memory[lane] = 0

    def take(self, lane: int, run: SimState) -> None:
        """Believe what the first ego of a run believes. Raises `ValueError` for things put by hand."""
        world, belief = run.world, run.ego().belief
        memory = self.memory[lane]
        memory[:] = 0
        memory[BEFORE] = -1
        for kind, number in NUMBER.items():
            last, there = _numbers(world, kind.value)
            # A road that is to be looked at first in this tick is counted then.
            memory[LAST_NUMBER + number] = last - there
            memory[COUNT + number] = there if world.episode_tick else 0
        if isinstance(belief, GridBelief) and len(belief.layers) == 2 * self.layers.shape[1]:
            self.layers[lane] = np.frombuffer(belief.layers, "<i2")
            memory[BEFORE], memory[TICK_BEFORE] = next(bits(belief.vehicles)), belief.episode_tick
            shown = belief.boards
            boards = (belief.right, belief.left, shown.fixed, shown.holding, shown.others)
            block, inner = divmod(lane, LANES)
            planes = self.believed[block].reshape(self._layout.words, PLANES, LANES)
            for plane, board in zip((RIGHT, LEFT, FIXED, HOLES, WALKERS), boards, strict=True):
                planes[:, plane, inner] = np.array(self._layout.cut(board), np.uint64)

    def copy(self) -> Beliefs:
        """The same, to go on by itself."""
        twin = object.__new__(Beliefs)
        twin.__dict__ |= self.__dict__ | {name: getattr(self, name).copy() for name in KEPT}
        return twin

    def saved(self) -> dict[str, NDArray[Any]]:
        """All that changes as the lanes advance, by name."""
        return {name: getattr(self, name).copy() for name in KEPT}

    def put(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Be as it was saved."""
        for name in KEPT:
            getattr(self, name)[...] = arrays[name]


def _groups(configs: Sequence[Config], layout: Layout, count: int) -> list[_Group]:
    by_look: dict[object, tuple[Setup, float, list[int]]] = {}
    for lane, config in enumerate(configs):
        found = _setup_of(config.with_parts(seed=0), layout)
        threshold = 1.0 - config.detection_sensitivity
        by_look.setdefault((id(found), threshold), (found, threshold, []))[2].append(lane)
    groups = [_Group(made, least, np.array(chosen)) for made, least, chosen in by_look.values()]
    if len(configs) == 1 < count:
        groups = [group._replace(lanes=np.arange(count)) for group in groups]
    return groups


def _setup_of(config: Config, layout: Layout) -> Setup:
    found = setup(config, layout.road, SUITES[config.sensor])
    if not found.tables.shadows.any():
        fill_shadows(found.tables, layout.columns)
    return found


def _numbers(world: World, kind: str) -> tuple[int, int]:
    """The highest number of a kind, and how many of it there are.

    Raises `ValueError` unless they have the highest numbers, in reading order, as on a road that was drawn.
    """
    numbers = [
        int(name.rpartition("-")[2])
        for table in (world.hazards, world.movers)
        for _, name in sorted(table.items())
        if kind_of(name) == kind
    ]
    last = next((last for each, last in world.numbered.items() if each == kind), 0)
    if numbers != list(range(last - len(numbers) + 1, last + 1)):
        raise ValueError(f"a {kind} was put or taken by hand; run roads that are sensed like that one by one")
    return last, len(numbers)
