"""One look of one device: what it reports of the road, right or wrong.

All draws come from streams of (seed, episode, tick, ego, device), and in them from the number of the thing or
of the false alarm: whatever else is on the road changes nothing about them, and no order matters. One word
decides for one thing: whether it is detected (32 bits), in which cell it is reported (24 bits) and whether
its heading is read the right way round (8 bits).
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

from sim.config import Config
from sim.perceive.occlusion import Occluder, hidden
from sim.perceive.sensor_model import FULL, SensorModel
from sim.randomness import Stream, fraction, scaled
from sim.types import HAZARDS, KINDS, MOVERS, Kind, kind_of
from sim.world import World
from sim.world.grid import Board

_KINDS: Final = (*HAZARDS, *MOVERS)
NUMBER: Final = {kind: number for number, kind in enumerate(_KINDS)}
"""Numbers of kinds in random streams."""
_OCCLUDING: Final = tuple(kind for kind, spec in KINDS.items() if spec.occludes)
ALARMS: Final = 100
"""The sub-stream of false alarms; those of kinds come before."""


class Report(NamedTuple):
    """Something that a device reports."""

    kind: Kind
    cell: int
    heading: str | None
    """"right" or "left" for movers"""
    id: str | None
    """of the thing that was detected; None for a false alarm. The belief never reads it"""


class Look(NamedTuple):
    """What one device reports in one tick."""

    model: SensorModel
    visible: Board
    """the cells that it saw: within range and view, and not hidden"""
    reports: tuple[Report, ...]


def occluders(world: World, ego: int) -> list[Occluder]:
    """The bodies that hide what is behind them from ego number `ego`."""
    return [
        (kind, world.board(kind) & ~(1 << world.avs[ego]) if kind is Kind.AV else world.board(kind))
        for kind in _OCCLUDING
    ]


def look(world: World, config: Config, ego: int, model: SensorModel) -> Look:
    """What a device reports from ego number `ego`."""
    road, here = world.road, world.avs[ego]
    columns = road.columns
    row, column = divmod(here, columns)
    view, above = model.view(column), (row - model.reach) * columns
    view = view << above if above >= 0 else view >> -above
    visible = view & ~hidden(road, here, model.reach, occluders(world, ego))
    draws = Stream.of(config.seed, "sensor", world.episode, world.episode_tick, ego, model.spec.number)
    reports = []
    for table in (world.hazards, world.movers):
        for cell, name in table.items():
            if visible >> cell & 1:
                report = _report(world, model, draws, cell, name, row, column)
                if report is not None:
                    reports.append(report)
    reports += _false_alarms(model, draws, visible, row)
    return Look(model, visible, tuple(reports))


@lru_cache(maxsize=65_536)
def _key(name: str) -> tuple[Kind, int, int]:
    """Kind of a thing, and where its draws are."""
    kind = kind_of(name)
    return kind, NUMBER[kind], int(name.rpartition("-")[2])


def _report(
    world: World, model: SensorModel, draws: Stream, cell: int, name: str, row: int, column: int
) -> Report | None:
    kind, stream, number = _key(name)
    columns = model.columns
    own_row, own_column = divmod(cell, columns)
    rows, place = row - own_row, own_column - column + columns - 1
    threshold = model.kinds[kind].drawn[rows][place]
    word = draws.narrow(stream).word(number)
    if word & FULL - 1 >= threshold:
        return None
    share = (word >> 32 & 0xFFFFFF) / 0x1000000
    shifts = model.shifts[rows][place]
    by_rows, by_columns = 0, 0
    for ahead, aside, chance in shifts:
        share -= chance
        if share < 0.0:
            by_rows, by_columns = ahead, aside
            break
    there = own_row - by_rows, own_column + by_columns
    first = max(0, row - model.reach)
    if not (0 <= there[1] < columns and first <= there[0] <= row) or there == (row, column):
        there = own_row, own_column
    heading = None
    if kind.moves:
        right = bool(world.right >> cell & 1)
        wrong = (word >> 56) < round(256 * model.spec.wrong_heading)
        heading = "right" if right is not wrong else "left"
    return Report(kind, there[0] * columns + there[1], heading, name)


def _false_alarms(model: SensorModel, draws: Stream, visible: Board, row: int) -> list[Report]:
    """At most one of each kind in a look, in a cell that is drawn from all that it might see."""
    columns, stream = model.columns, draws.narrow(ALARMS)
    cells = (model.reach + 1) * columns
    found = []
    for kind, seen in model.kinds.items():
        place = 4 * NUMBER[kind]
        if fraction(stream.word(place)) >= seen.false_alarm * cells:
            continue
        drawn = scaled(stream.word(place + 1), cells)
        cell = drawn + (row - model.reach) * columns
        if cell < 0 or not visible >> cell & 1:
            continue
        heading = ("right" if stream.word(place + 2) & 1 else "left") if kind.moves else None
        found.append(Report(kind, cell, heading, None))
    return found
