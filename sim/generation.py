"""Generates a road from a configuration (with its seed) and the number of an episode.

Every kind draws from its own random stream, so another number of potholes leaves the cars where they were. An
exact number takes the free cells of lowest random rank: one more adds a thing and moves none. Where roads
must be drivable, the road is drawn again, from streams numbered by the attempt, until one is drivable; roads
with a layout always must be.

The barriers of a layout (`sim.world.layouts`) come first. Other things prefer the cells that the layout
names; an exact number uses the remaining cells last.
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
from sim.world.layouts import crossing_vehicles, lay_out

MAX_ATTEMPTS = 200
"""Most draws for a drivable road."""

IN_ORDER = (*MOVERS, *reversed(HAZARDS))
"""The order in which a road is furnished: each kind takes cells that those before it have left."""

_PRESENCE, _COLUMN = 0, 1


class GenerationError(ConfigError):
    """No drivable road was found in `MAX_ATTEMPTS` draws."""

    def __init__(self) -> None:
        super().__init__((Problem("solvable", "no_drivable_road", draws=MAX_ATTEMPTS),))


def generate(
    config: Config, episode: int, *, tick: int = 0, numbered: Mapping[Kind, int] | None = None
) -> World:
    """Generates the first world of an episode, at `tick`; ids continue after `numbered`.

    Raises `GenerationError` if the road must be drivable and no such road is found.
    """
    if not (config.solvable or config.layout):
        return _draw_road(config, episode, (), tick, numbered)
    for attempt in range(MAX_ATTEMPTS):
        world = _draw_road(config, episode, (attempt,) if attempt else (), tick, numbered)
        if drivable(world, config):
            return world
    raise GenerationError


def drivable(world: World, config: Config) -> bool:
    """Whether row 0 can be reached in time if no mover gives way after the first tick."""
    limit = steps_left(config, world.episode_tick)
    forecast = Forecast.of_truth(world, config, limit)
    return reachability(forecast, 1 << world.av, limit).ticks is not None


def _draw_road(
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
        if count == 0:
            return 0
        drawn_by = KINDS[kind].probability
        probability = getattr(config, drawn_by) if drawn_by else 0.0
        if kind is Kind.VEHICLE:
            probability = config.vehicle_probability
        first = layout.movers if kind.moves else layout.potholes if kind is Kind.POTHOLE else road.between
        stream = Stream.of(config.seed, f"spawn {kind}", episode, *attempt)
        free = road.between & ~taken
        best = free & first
        if count is not None:
            chosen = _exact_number(best, count, stream)
            chosen |= _exact_number(free & ~first, count - chosen.bit_count(), stream)
        elif kind is Kind.VEHICLE and config.layout == "crossing":
            chosen = _several_per_row(road, best, probability, stream)
        else:
            chosen = _one_per_row(road, best, probability, stream)
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
        if placed[kind]:
            table |= assign_ids(kind, bits(placed[kind]), last)
    return table


def assign_ids(kind: Kind, cells: Iterable[int], last: dict[Kind, int]) -> dict[int, str]:
    """Gives new ids to these cells and updates `last`, the highest number of each kind."""
    table = {}
    for cell in cells:
        last[kind] = last.get(kind, 0) + 1
        table[cell] = f"{kind}-{last[kind]}"
    return table


def lowest_ranked(free: Board, count: int, stream: Stream) -> list[int]:
    """Draws `count` cells of a board: those of lowest rank in the stream."""
    if not count:
        return []  # most roads: skips the ranking
    ranks = stream.words(free.bit_length())
    return sorted(cells_of(free), key=ranks.__getitem__)[:count]


def _exact_number(free: Board, count: int, stream: Stream) -> Board:
    return board_of(lowest_ranked(free, count, stream))


def _several_per_row(road: Road, free_cells: Board, probability: float, stream: Stream) -> Board:
    """Draws several cells in each row that has free cells: those of lowest random rank."""
    board, columns = 0, road.columns
    for row in range(1, road.rows - 1):
        start = row * columns
        free = free_cells >> start & (1 << columns) - 1
        if free:
            draws = stream.narrow(row)
            board |= (
                _exact_number(free, crossing_vehicles(columns, probability, draws), draws.narrow(_COLUMN))
                << start
            )
    return board


def _one_per_row(road: Road, free: Board, probability: float, stream: Stream) -> Board:
    """Draws a free cell in each row with that probability."""
    board, columns = 0, road.columns
    whole = (1 << columns) - 1
    for row in range(1, road.rows - 1):
        # The row's own stream (`narrow`), by its key alone, since a new road has many rows.
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
