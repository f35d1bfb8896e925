"""The Bayes filter of a belief: movers are moved by their rule, then every look is weighed.

*Prediction*: what is believed to be a mover moves by the very rule of the road, among what else is believed.
What is only possible moves on in its heading and turns at the edge. Every hypothesis about a mover is mixed
with the prior by `FORGETTING`, the chance that the rule was wrong about it.

*Update*: a cell that was seen without a report becomes less likely by the chance of a miss. A report is
shared out among all that may have caused it: the things that may stand in its cell, those in cells beside
that may be displaced into it, and a false alarm, each by its probability (probabilistic data association,
Bar-Shalom & Tse, Automatica 11, 1975).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from sim.config import Config
from sim.perceive.belief import FIXED, LAYER, LAYERS, RIGHT, GridBelief, Layers, prior, table_of, unpacked
from sim.perceive.log_odds import LIMIT, PROBABILITY, clamped, log_odds
from sim.perceive.look import Look, Report
from sim.perceive.parameters import FORGETTING
from sim.perceive.sensor_model import Grid, SensorModel
from sim.rules.behaviour import NOBODY, Reactions
from sim.rules.mover_boards import PERIODS
from sim.rules.traffic import Motion, shift_table, steps_in_tick
from sim.types import HAZARDS, MOVERS
from sim.world import World
from sim.world.grid import Board, cells_of

UNLIKELY = 2 * LIMIT // 8
"""How much less likely than by the prior a mover is where the rule leads none to (log odds)."""


def predict_layers(belief: GridBelief, world: World, config: Config) -> tuple[Layers, Mapping[int, str]]:
    """The belief one tick on, before any look; and the names of the movers that are followed, by cell."""
    road = world.road
    layers = unpacked(belief.layers, road)
    motion = expected_motion(belief, world, config)
    table = table_of(belief.movers)
    followed = []
    for cell in table:
        row, column = divmod(cell, road.columns)
        layer = RIGHT[belief.boards.mover_kind(cell)] + (not belief.right >> cell & 1)
        followed.append((layer, cell, int(layers[layer, row, column])))
        layers[layer, row, column] = -LIMIT
    before = prior(config, road)
    moving = layers[FIXED:]
    for place, kind in enumerate(MOVERS):
        if steps_in_tick(PERIODS[kind], belief.episode_tick):
            moving[2 * place : 2 * place + 2] = _drifted(moving[2 * place : 2 * place + 2])
    for place in range(len(moving)):
        moving[place] = mixing_table(int(before[FIXED + place, 1, 0]))[moving[place] + LIMIT]
    for cell in cells_of(belief.boards.fixed):
        row, column = divmod(cell, road.columns)
        most = np.maximum(before[FIXED:, row, column] - UNLIKELY, -LIMIT)
        np.minimum(moving[:, row, column], most, out=moving[:, row, column])
    after = shift_table(table, motion)
    for (layer, _, value), cell in zip(followed, after, strict=True):
        row, column = divmod(cell, road.columns)
        heading = int(not motion.right >> cell & 1)
        layer = layer - (layer - FIXED) % 2 + heading
        mixed = int(mixing_table(int(before[layer, 1, 0]))[value + LIMIT])
        layers[layer, row, column] = max(int(layers[layer, row, column]), mixed)
    return layers, after


def expected_motion(belief: GridBelief, world: World, config: Config) -> Motion:
    """Where what is believed to be movers is after the tick, by the rule."""
    road, boards = world.road, belief.boards
    motion = config.mover_behaviour.step(
        belief.right,
        belief.left,
        boards.marked,
        (belief.right | belief.left) & boards.holding,
        boards.fixed,
        road.left_edge,
        road.right_edge,
        belief.episode_tick,
        0,
        NOBODY,
    )
    standing = belief.vehicles & world.driven
    if standing and config.attentive >= 0.5:
        motion = config.mover_behaviour.brake(motion, standing, Reactions(attentive=road.all))
    return motion


def _drifted(pair: Layers) -> Layers:
    """The layers of one kind of mover, right and left, one step on, with movers that turn at the edges."""
    right, left = pair
    moved = np.full_like(pair, -LIMIT)
    moved[0, :, 1:] = right[:, :-1]
    moved[1, :, :-1] = left[:, 1:]
    np.maximum(moved[1, :, -2], right[:, -1], out=moved[1, :, -2])
    np.maximum(moved[0, :, 1], left[:, 0], out=moved[0, :, 1])
    return moved


@lru_cache(maxsize=256)
def mixing_table(before: int) -> Grid:
    """Log odds after mixing with the prior `before`, by log odds + LIMIT."""
    base = PROBABILITY[before + LIMIT]
    mixed = [log_odds((1.0 - FORGETTING) * p + FORGETTING * base) for p in PROBABILITY]
    return np.array(mixed, np.int32)


def update_layers(layers: Layers, found: Look, row: int, column: int) -> None:
    """Weigh a look from the cell (row, column); changes the layers in place."""
    model, columns = found.model, layers.shape[2]
    top = max(0, row - model.reach)
    height = row + 1 - top
    window = layers[:, top : row + 1]
    visible = board_array(found.visible >> top * columns, height, columns)
    window += layer_misses(model)[:, -height:, columns - 1 - column : 2 * columns - 1 - column] * visible
    np.clip(window, -LIMIT, LIMIT, out=window)
    for report in found.reports:
        _weigh(layers, found, report, row, column)


@lru_cache(maxsize=64)
def layer_misses(model: SensorModel) -> Grid:
    """What a look without a report adds, by layer; the last row is the vehicle's own."""
    table = np.zeros((LAYERS, model.reach + 1, 2 * model.columns - 1), np.int32)
    for kind in HAZARDS:
        if kind in model.kinds:
            table[LAYER[kind]] = model.kinds[kind].miss[::-1]
    for kind in MOVERS:
        if kind in model.kinds:
            table[RIGHT[kind] : RIGHT[kind] + 2] = model.kinds[kind].miss[::-1]
    return table


def board_array(board: Board, height: int, columns: int) -> np.ndarray[tuple[int, int], np.dtype[np.uint8]]:
    """A board's first rows as an array of 0 and 1."""
    cells = height * columns
    words = np.frombuffer((board & (1 << cells) - 1).to_bytes((cells + 7) // 8, "little"), np.uint8)
    return np.unpackbits(words, count=cells, bitorder="little").reshape(height, columns)


def _weigh(layers: Layers, found: Look, report: Report, row: int, column: int) -> None:
    """Share a report out among all that may have caused it."""
    model, columns = found.model, layers.shape[2]
    seen = model.kinds[report.kind]
    there_row, there_column = divmod(report.cell, columns)
    if report.heading is None:
        hypotheses = [(LAYER[report.kind], 1.0)]
        alarm = seen.false_alarm
    else:
        first, wrong = RIGHT[report.kind], model.spec.wrong_heading
        right = report.heading == "right"
        hypotheses = [(first, 1.0 - wrong if right else wrong), (first + 1, wrong if right else 1.0 - wrong)]
        alarm = seen.false_alarm / 2
    shifts = model.shifts[row - there_row][there_column - column + columns - 1]
    sources = []
    whole = alarm / (1.0 - alarm)
    for ahead, aside, share in shifts:
        own_row, own_column = there_row + ahead, there_column - aside
        if not (0 <= own_column < columns and 0 <= own_row <= row):
            continue
        rows = row - own_row
        if rows > model.reach or not found.visible >> own_row * columns + own_column & 1:
            continue
        chance = seen.detection[rows][own_column - column + columns - 1]
        if not chance:
            continue
        for layer, fits in hypotheses:
            value = int(layers[layer, own_row, own_column])
            missed = PROBABILITY[value + LIMIT]
            weight = missed * chance / (1.0 - chance) * share * fits
            whole += weight
            sources.append((layer, own_row, own_column, missed, weight))
    for layer, own_row, own_column, missed, weight in sources:
        share = weight / whole
        layers[layer, own_row, own_column] = clamped(log_odds(share + (1.0 - share) * missed))
