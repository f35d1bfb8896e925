"""A road from a configuration, a seed and the number of an episode.

Every kind draws from a stream of its own, so that asking for another number of potholes leaves
the cars where they were. An exact number takes the free cells of lowest random rank: one more
adds one and moves none. Where roads must be drivable, the same is drawn again, from streams numbered
by the attempt, until one is; a road of a layout must always be.

With a layout (`sim.world.layouts`) its barriers come first. What is drawn beside them keeps to the cells
that the layout names; an exact number takes the others last.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sim.config import COUNTS, Config, ConfigError, Problem
from sim.forecast import Forecast
from sim.randomness import Stream, fraction, scaled, word_at
from sim.search.reachability import reachability, steps_left
from sim.types import HAZARDS, KINDS, MOVERS, Kind
from sim.world import World
from sim.world.boards import BOARDED, Boards
from sim.world.grid import Board, Road, bits, board_of, cells_of, union
from sim.world.layouts import crossing, lay_out

MAX_ATTEMPTS = 200
"""Draws until it is given up that a road be drivable."""

IN_ORDER = (*MOVERS, *reversed(HAZARDS))
"""The order in which a road is furnished: each kind takes cells that those before it have left."""

_PRESENCE, _COLUMN = 0, 1


class GenerationError(ConfigError):
    """No road that can be driven was found among `MAX_ATTEMPTS` draws."""

    def __init__(self) -> None:
        super().__init__((Problem("solvable", "no_drivable_road", draws=MAX_ATTEMPTS),))


def generate(
    config: Config, episode: int, *, tick: int = 0, numbered: Mapping[Kind, int] | None = None
) -> World:
    """The world in which an episode begins, at `tick`; ids go on from `numbered`.

    Raises `GenerationError` where the road must be drivable and none is found.
    """
    if not (config.solvable or config.layout):
        return _drawn(config, episode, (), tick, numbered)
    for attempt in range(MAX_ATTEMPTS):
        world = _drawn(config, episode, (attempt,) if attempt else (), tick, numbered)
        if drivable(world, config):
            return world
    raise GenerationError


def drivable(world: World, config: Config) -> bool:
    """Whether row 0 can be reached in time, assuming that nobody gives way after the first tick."""
    limit = steps_left(config, world.episode_tick)
    forecast = Forecast.of_truth(world, config, limit)
    return reachability(forecast, 1 << world.av, limit).ticks is not None


def _drawn(
    config: Config, episode: int, attempt: tuple[int, ...], tick: int, numbered: Mapping[Kind, int] | None
) -> World:
    road = config.geometry
    layout = lay_out(
        config.layout, road, Stream.of(config.seed, f"layout {config.layout}", episode, *attempt)
    )
    taken = layout.barriers

    def furnish(kind: Kind) -> Board:
        nonlocal taken
        count = getattr(config, COUNTS[kind]) if kind in COUNTS else 0
        drawn_by = KINDS[kind].probability
        probability = getattr(config, drawn_by) if drawn_by else 0.0
        first = layout.movers if kind.moves else layout.potholes if kind is Kind.POTHOLE else road.between
        stream = Stream.of(config.seed, f"spawn {kind}", episode, *attempt)
        free = road.between & ~taken
        best = free & first
        if count is not None:
            chosen = _exactly(best, count, stream)
            chosen |= _exactly(free & ~first, count - chosen.bit_count(), stream)
        elif kind is Kind.VEHICLE and config.layout == "crossing":
            chosen = _several_a_row(road, best, probability, stream)
        else:
            chosen = _one_a_row(road, best, probability, stream)
        taken |= chosen
        return chosen

    placed = {kind: furnish(kind) for kind in IN_ORDER}
    placed[Kind.BARRIER] |= layout.barriers
    moving = union(placed[kind] for kind in MOVERS)

    heading = Stream.of(config.seed, "heading", episode, *attempt)
    right = board_of([cell for cell in bits(moving) if heading.below(2, cell)])
    last = dict(numbered or {})
    return World(
        road=road,
        tick=tick,
        episode=episode,
        episode_start=tick,
        avs=(road.start,),
        right=right,
        left=moving & ~right,
        boards=Boards.of({kind: placed[kind] for kind in BOARDED}),
        movers=_ids(MOVERS, placed, last),
        hazards=_ids(HAZARDS, placed, last),
        numbered=last,
    )


def _ids(kinds: Iterable[Kind], placed: Mapping[Kind, Board], last: dict[Kind, int]) -> dict[int, str]:
    table: dict[int, str] = {}
    for kind in kinds:
        table |= assign_ids(kind, bits(placed[kind]), last)
    return table


def assign_ids(kind: Kind, cells: Iterable[int], last: dict[Kind, int]) -> dict[int, str]:
    """New ids for these cells; `last` remembers the highest number given."""
    table = {}
    for cell in cells:
        last[kind] = last.get(kind, 0) + 1
        table[cell] = f"{kind}-{last[kind]}"
    return table


def lowest_ranked(free: Board, count: int, stream: Stream) -> list[int]:
    """`count` cells of a board, at random: those of lowest rank in the stream."""
    if not count:
        return []  # as on most roads: nobody has to be ranked for that
    ranks = stream.words(free.bit_length())
    return sorted(cells_of(free), key=ranks.__getitem__)[:count]


def _exactly(free: Board, count: int, stream: Stream) -> Board:
    return board_of(lowest_ranked(free, count, stream))


def _several_a_row(road: Road, free_cells: Board, probability: float, stream: Stream) -> Board:
    """Several things in each row that has free cells, in those of lowest random rank."""
    board, columns = 0, road.columns
    for row in range(1, road.rows - 1):
        start = row * columns
        free = free_cells >> start & (1 << columns) - 1
        if free:
            draws = stream.narrow(row)
            board |= _exactly(free, crossing(columns, probability, draws), draws.narrow(_COLUMN)) << start
    return board


def _one_a_row(road: Road, free: Board, probability: float, stream: Stream) -> Board:
    """One thing in each row with that probability, in a free cell of the row."""
    board, columns = 0, road.columns
    whole = (1 << columns) - 1
    for row in range(1, road.rows - 1):
        # The row's own stream (`narrow`), by its key alone: there are many rows in a tick that begins a road.
        key = word_at(stream.key, row)
        if fraction(word_at(key, _PRESENCE)) < probability:
            start = row * columns
            room = free >> start & whole
            if room == whole:
                board |= 1 << start + scaled(word_at(key, _COLUMN), columns)
            elif room:
                cells = cells_of(room)
                board |= 1 << start + cells[scaled(word_at(key, _COLUMN), len(cells))]
    return board
