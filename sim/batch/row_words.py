"""A moment of a run as compiled words, a word for each row; and what the kernels that work by rows find."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.batch.backward_dp import BUFFER
from sim.batch.future_ends import grow_futures
from sim.batch.future_tree import SHUT_OFF
from sim.batch.row_decisions import SEEN, ranked_moves
from sim.batch.row_drive import drive_rows
from sim.batch.row_rules import BY_COST, PRIORITY, RULES
from sim.batch.row_search import IMPATIENT, NONE, least_ticks_among
from sim.config import Config
from sim.perceive import Percept, perceive_truth
from sim.randomness import Stream
from sim.search.compiled_costs import Unlike
from sim.search.costs import TICKS_ALONE, Weights
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.types import MARKED, MOVES, Kind, Move, Outcome
from sim.world import World
from sim.world.grid import Board

Words = NDArray[np.uint64]

_PLANNERS: Final = {"priority": PRIORITY, "rules": RULES}
"""Those that do not go by cost; every other one does."""
_ALL: Final = np.uint64(2**64 - 1)
_WALKERS: Final = MARKED.index(Kind.PEDESTRIAN)
_OUTCOMES: Final = (*Outcome, None)
assert _OUTCOMES[SHUT_OFF] is None


class FoundEnds(NamedTuple):
    """What a tree of futures has come to."""

    ends: dict[tuple[Outcome | None, int], float]
    drawn: bool
    """whether the ends were drawn, and are counted"""
    work: int
    branched: int


def make_ready() -> None:
    """Compile this, or load what was compiled before."""
    state = SimState.start(Config(rows=5, columns=4, vehicles=0, potholes=0, courtesy=0.5))
    futures_of(state, "rules", TICKS_ALONE, None, 0, 1, 1)
    drive_on(state, "rules", TICKS_ALONE, 1)
    least_ticks_of(state.world, state.config, 2, 1)
    moves_by_rank(perceive_truth(state.world, state.config), "rules", [Unlike()])


def futures_of(
    state: SimState,
    planner: str,
    charges: Weights,
    seen: tuple[int, int] | None,
    quick_until: int,
    most: int,
    futures: int,
) -> FoundEnds:
    """The ends of the futures of a moment.

    `charges`: those that the planner goes by, if it does. `seen`: the boards of who gives way and who brakes
    in the coming tick, None where that is left to chance. `quick_until`: decisions before which nothing is
    proved; `most`: decisions that are allowed; `futures`: the most that are drawn.
    """
    world, config = state.world, state.config
    columns, rows = world.road.columns, world.road.rows
    whole, below = (1 << columns) - 1, world.av // columns * columns
    ticks = max(1, config.max_ticks + 1 - world.episode_tick)
    ends, masses = np.empty((4 * (ticks + 2), 2), np.int64), np.empty(4 * (ticks + 2), np.float64)
    known = (0, 0, 0) if seen is None else (1, *(board >> below & whole for board in seen))
    key = Stream.of(config.seed, "confidence", world.episode, world.episode_tick).key
    out = np.empty(4, np.int64)
    grow_futures(
        _movers(world, rows),
        _rows(world.fixed, columns, rows),
        _rows(world.boards.holding, columns, rows),
        _place(world, config),
        world.av,
        _PLANNERS.get(planner, BY_COST),
        _charges(charges),
        np.array([_chances(config.courtesy), _chances(config.attentive)]),
        np.array(known, np.uint64),
        (quick_until, most, futures),
        np.uint64(key),
        ends,
        masses,
        out,
    )
    count, drawn, work, branched = out.tolist()
    told = zip(ends[:count].tolist(), masses[:count].tolist(), strict=True)
    found = {(_OUTCOMES[outcome], ticks): mass for (outcome, ticks), mass in told}
    return FoundEnds(found, bool(drawn), work, branched)


class DrivenTicks(NamedTuple):
    """Ticks of a run, and the state after them."""

    moves: tuple[Move, ...]
    met: tuple[str, ...]
    """of each tick whose move is not straight on, who of the movers is straight ahead after it; else empty"""
    state: SimState


def drive_on(state: SimState, planner: str, charges: Weights, most: int) -> DrivenTicks:
    """The ticks of a run up to before the one that ends the episode, at most so many."""
    world, config = state.world, state.config
    columns, rows = world.road.columns, world.road.rows
    movers = _movers(world, rows)
    cells = np.array(list(world.movers), np.int64)
    moves, met = np.empty(most, np.uint8), np.empty(most, np.int64)
    ticks, cell = drive_rows(
        movers,
        _rows(world.fixed, columns, rows),
        _rows(world.boards.holding, columns, rows),
        _place(world, config),
        world.av,
        _PLANNERS.get(planner, BY_COST),
        _charges(charges),
        np.array([config.courtesy, config.attentive]),
        _keys(world, config),
        most,
        cells,
        moves,
        met,
    )
    names = list(world.movers.values())
    right, left, walkers = (_board(movers[:, plane], columns) for plane in range(3))
    boards = world.boards
    after = replace(
        world,
        tick=world.tick + ticks,
        avs=(cell,),
        right=right,
        left=left,
        boards=boards.with_kind(Kind.PEDESTRIAN, walkers) if walkers else boards,
        movers=dict(zip(cells.tolist(), names, strict=True)),
    )
    return DrivenTicks(
        tuple([MOVES[move] for move in moves[:ticks].tolist()]),
        tuple([names[each] if each >= 0 else "" for each in met[:ticks].tolist()]),
        replace(state, world=after),
    )


def least_ticks_of(world: World, config: Config, limit: int, patience: int) -> int | None:
    """Ticks of a quickest way to row 0 within so many, where movers react as they are drawn to; None: no way.

    Raises `ImpatientError` where more than `patience` states would be looked at.
    """
    columns, row = world.road.columns, world.av // world.road.columns
    found = least_ticks_among(
        _movers(world, row + 1),
        _rows(world.fixed, columns, row + 1),
        _rows(world.boards.holding, columns, row + 1),
        _place(world, config),
        world.av,
        limit,
        patience,
        np.array([config.courtesy, config.attentive]),
        _keys(world, config),
    )
    if found == IMPATIENT:
        raise ImpatientError
    return None if found == NONE else int(found)


def moves_by_rank(percept: Percept, planner: str, unlike: Sequence[Unlike]) -> list[Move]:
    """The moves that `priority` or `rules` makes where each of these things is seen otherwise."""
    road = percept.road
    columns, length = road.columns, 8 * (road.columns * road.rows // 64 + 2)
    words = b"".join([_seen(percept, each, length) for each in unlike])
    moves = np.empty(len(unlike), np.uint8)
    ranked_moves(
        np.frombuffer(bytearray(words), np.uint64).reshape(len(unlike), SEEN, length // 8),
        percept.ego,
        columns,
        np.uint64(1 << columns - 1),
        percept.episode_tick,
        _ALL if percept.swept else np.uint64(0),
        _PLANNERS[planner],
        moves,
    )
    return [MOVES[move] for move in moves.tolist()]


def _seen(percept: Percept, unlike: Unlike, length: int) -> bytes:
    """What is seen, in the order of `SEEN_RIGHT`, each board as so many bytes."""
    boards, stay, rest = percept.boards, ~unlike.movers, ~unlike.fixed
    seen = (
        percept.right & stay,
        percept.left & stay,
        boards.marked[_WALKERS] & stay,
        boards.fixed & rest | unlike.barriers | unlike.potholes,
        boards.holding & rest | unlike.potholes,
        percept.yielding & stay,
        percept.attentive & stay,
    )
    return b"".join([board.to_bytes(length, "little") for board in seen])


def _charges(weights: Weights) -> NDArray[np.int64]:
    """The charges as a row of a table (`sim.batch.backward_dp.TICK`)."""
    return np.array(astuple(weights)[: BUFFER + 1], np.int64)


def _keys(world: World, config: Config) -> Words:
    """The keys of the draws of an episode: of who gives way, and of who brakes."""
    keys = [Stream.of(config.seed, each, world.episode).key for each in ("courtesy", "attentive")]
    return np.array(keys, np.uint64)


def _board(rows: Words, columns: int) -> Board:
    """The board of a word for each row."""
    if columns == 8:
        return int.from_bytes(rows.astype(np.uint8).tobytes(), "little")
    board = 0
    for row in reversed(rows.tolist()):
        board = board << columns | row
    return board


def _place(world: World, config: Config) -> tuple[object, ...]:
    """The road and the clock, as the kernels want them."""
    columns = world.road.columns
    swept = _ALL if config.collision == "swept" else np.uint64(0)
    return columns, np.uint64(1 << columns - 1), world.episode_tick, config.max_ticks, swept


def _rows(board: int, columns: int, count: int) -> Words:
    """A board as a word for each of its first rows."""
    if columns == 8:
        near = board & (1 << 8 * count) - 1
        return np.frombuffer(near.to_bytes(count, "little"), np.uint8).astype(np.uint64)
    whole = (1 << columns) - 1
    return np.array([board >> row * columns & whole for row in range(count)], np.uint64)


def _movers(world: World, count: int) -> Words:
    """The movers of the first rows, by heading, and the pedestrians among them (shape: rows, 3)."""
    columns = world.road.columns
    boards = (world.right, world.left, world.boards.marked[_WALKERS])
    return np.stack([_rows(board, columns, count) for board in boards], axis=1)


def _chances(share: float) -> list[list[float]]:
    """The chance that so many of so many movers react, each by itself with this chance."""
    if share in (0.0, 1.0):
        return [[float(reacting == share * beside) for reacting in range(3)] for beside in range(3)]
    table = [[0.0] * 3 for _ in range(3)]
    for beside in range(3):
        for reacting in range(beside + 1):
            table[beside][reacting] = share**reacting * (1.0 - share) ** (beside - reacting)
    return table
