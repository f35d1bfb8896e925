"""The C yardstick, compiled when it is measured, and checked against the batch engine first."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from sim.batch import Batch
from sim.batch.layout import Layout
from sim.config import Config
from sim.generation import generate

SOURCE = Path(__file__).parent / "c" / "roads.c"
LANES, PLANES, LANE_PLANES = 64, 4, 18
IN_ROW, FORWARD = 5, 6
FLAGS = ("-O3", "-march=native", "-mprefer-vector-width=512", "-shared", "-fPIC")


class CLoop:
    """As many worlds as a batch has, in C: of one road size, without pedestrians and courtesy."""

    def __init__(self, configs: Sequence[Config]) -> None:
        """Compile and lay out. Raises `LookupError` where there is no C compiler."""
        compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
        if compiler is None:
            raise LookupError("there is no C compiler")
        with tempfile.TemporaryDirectory() as folder:
            library = Path(folder) / "roads.so"
            subprocess.run([compiler, *FLAGS, str(SOURCE), "-o", str(library)], check=True)
            self._run = ctypes.CDLL(str(library)).state
        self.layout = Layout.of(configs[0].columns, configs[0].rows)
        blocks = -(-len(configs) // LANES)
        self.state = np.zeros((blocks, self.layout.words, PLANES, LANES), np.uint64)
        self.lanes = np.zeros((blocks, LANE_PLANES, LANES), np.uint64)
        for lane in range(blocks * LANES):
            block, inner = divmod(lane, LANES)
            world = generate(configs[min(lane, len(configs) - 1)], 1)
            for plane, board in enumerate((world.right, world.left, world.fixed, world.potholes)):
                self.state[block, :, plane, inner] = np.array(self.layout.cut(board), np.uint64)
            row, column = divmod(world.av, self.layout.columns)
            word, inside = divmod(row, self.layout.rows_per_word)
            start = (word, inside * self.layout.columns, 1 << column, world.av)
            self.lanes[block, :4, inner] = np.array(start, np.uint64)
            self.lanes[block, IN_ROW, inner] = np.uint64(2**64 - 1)
        self.first_state, self.first_lanes = self.state.copy(), self.lanes.copy()

    def run(self, ticks: int) -> None:
        """So many ticks of every world."""
        layout = self.layout
        pointers = (self.state, self.first_state, self.lanes, self.first_lanes)
        self._run(
            *(each.ctypes.data_as(ctypes.c_void_p) for each in pointers),
            *map(ctypes.c_int64, (self.state.shape[0], layout.words, layout.columns, layout.rows)),
            ctypes.c_uint64(layout.left_edge),
            ctypes.c_uint64(layout.right_edge),
            ctypes.c_int64(ticks),
        )

    def agrees_with(self, batch: Batch) -> bool:
        """Whether boards, vehicles and counts are the batch's."""
        totals = batch.totals()
        counts = self.lanes[:, FORWARD : FORWARD + 7].transpose(1, 0, 2).reshape(7, -1)[:, : len(batch)]
        names = ("forward", "lateral", "diagonal", "stay", "successes", "crashes", "stuck")
        same = all((counts[index] == getattr(totals, name)).all() for index, name in enumerate(names))
        for lane in range(0, len(batch), 37):
            block, inner = divmod(lane, LANES)
            world = batch.world(lane)
            same &= self.layout.joined(self.state[block, :, 0, inner]) == world.right
            same &= self.layout.joined(self.state[block, :, 1, inner]) == world.left
            same &= int(self.lanes[block, 3, inner]) == world.av
        return same
