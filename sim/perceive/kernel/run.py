"""The looks of a tick by the compiled kernel: arguments packed, results unpacked.

The results are those of `sim.perceive.grid_sensor`, to the last bit. Compiling takes seconds, once on a
machine, and loading about one, so a process that has looked `WORTHWHILE` times loads the kernel in a thread
of its own. Until it is there `grid_sensor` answers. `load` loads it at once.
"""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Mapping
from threading import Lock, Thread
from typing import Any, Final

import numpy as np

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.bayes_filter import expected_motion
from sim.perceive.belief import LAYERS, RIGHT, GridBelief
from sim.perceive.kernel.names import Namer
from sim.perceive.kernel.places import SEEN, SEEN_BOARDS, SEEN_DOUBTS, SHOWN_HEAD, TIES, TRIPLE
from sim.perceive.kernel.tables import KINDS_SEEN, Setup, setup
from sim.perceive.look import NUMBER
from sim.perceive.parameters import SUITES, SensorSpec
from sim.perceive.percept import Percept
from sim.rules.traffic import shift_table
from sim.rules.traffic_cache import cached_reactions
from sim.types import HAZARDS, Kind, ego_id, kind_of
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, Road

WORTHWHILE: Final = 100
"""Looks of a process after which the kernel is loaded."""

_ROUND: Final = 3
"""Digits of likelihoods."""
_KEPT_SETUPS: Final = 256

_kernel: Any = None
_looks = 0
_loading = Lock()

_percept = fast_constructor(
    Percept,
    "road",
    "tick",
    "episode_tick",
    "ego",
    "ego_id",
    "right",
    "left",
    "boards",
    "yielding",
    "attentive",
    "vehicles",
    "swept",
    "movers",
    "hazards",
    "dynamics",
    "behaviour",
    "egos",
    "likelihoods",
    "doubtful",
)
_boards = fast_constructor(Boards, "hazards", "marked", "fixed", "holding", "others")
_belief = fast_constructor(
    GridBelief,
    "layers",
    "right",
    "left",
    "boards",
    "movers",
    "hazards",
    "vehicles",
    "episode_tick",
    "phantoms",
)


class _Known(dict[str, int]):
    """Numbers by id, worked out when they are first asked for; `MAX_KNOWN` of them are kept."""

    def __init__(self, number_of: Callable[[str], int]) -> None:
        super().__init__()
        self._number_of = number_of

    def __missing__(self, name: str) -> int:
        if len(self) >= MAX_KNOWN:
            self.clear()
        number = self[name] = self._number_of(name)
        return number


MAX_KNOWN: Final = 65_536
_kind_of: Final = _Known(lambda name: NUMBER[kind_of(name)]).__getitem__
_number_of: Final = _Known(lambda name: int(name.rpartition("-")[2])).__getitem__
_setups: dict[int, tuple[Config, Road, tuple[SensorSpec, ...], Setup]] = {}


def load() -> None:
    """Load the kernel now. Compiles it if this version of it has not been compiled on this machine."""
    global _kernel
    with _loading:
        if _kernel is None:
            from sim.perceive.kernel import tick

            # Functions are compiled when they are first called, so they are called here.
            road = Road.of(3, 4)
            nothing = World(road=road, avs=(road.start,), movers={}, hazards={}, numbered={})
            config = Config(columns=road.columns, rows=road.rows, sensor="camera")
            _sense(tick, nothing, config, 0, None, SUITES["camera"])
            _kernel = tick


def ready() -> bool:
    """Whether the kernel is loaded. Counts the calls, and has it loaded after some."""
    global _looks
    if _kernel is not None:
        return True
    _looks += 1
    if _looks == WORTHWHILE and sys.byteorder == "little":
        # Not a daemon: a process that ends in the middle of compiling would end badly.
        Thread(target=load, name="look-kernel").start()
    return False


def sense_tick(
    world: World, config: Config, ego: int, belief: GridBelief | None, suite: tuple[SensorSpec, ...]
) -> tuple[Percept, GridBelief]:
    """What a suite of devices shows to ego number `ego`, and the belief for the next tick.

    `belief`: that of the tick before; of a road of another size it counts as none. The kernel must be loaded.
    """
    return _sense(_kernel, world, config, ego, belief, suite)


def _sense(
    kernel: Any,
    world: World,
    config: Config,
    ego: int,
    belief: GridBelief | None,
    suite: tuple[SensorSpec, ...],
) -> tuple[Percept, GridBelief]:
    road = world.road
    cells = road.columns * road.rows
    if belief is not None and len(belief.layers) != 2 * LAYERS * cells:
        belief = None
    used = _setup(kernel, config, road, suite)
    followed = _followed(belief, world, config) if belief is not None else _NONE
    names = [*world.hazards.values(), *world.movers.values()]
    shown, marked, layers, likelihoods = _call(kernel, world, config, ego, belief, used, followed, names)
    size = (cells + 7) // 8
    boards = [int.from_bytes(marked[at : at + size], "little") for at in range(0, len(marked), size)]
    fixed_count, all_count, head = shown[0], shown[0] + shown[1], SHOWN_HEAD
    if shown[TIES]:
        likelihoods = [round(each, _ROUND) for each in likelihoods]
    namer = Namer(shown, head + TRIPLE * all_count, names, belief.phantoms if belief is not None else 0)
    middle = head + TRIPLE * fixed_count
    hazards = namer.named(head, middle, dict(belief.hazards) if belief is not None else {})
    movers = namer.named(middle, head + TRIPLE * all_count, followed[2])
    right, left = boards[0], boards[1]
    first, doubts = SEEN_BOARDS, SEEN_DOUBTS
    moving = first + len(HAZARDS)
    seen = _boards(tuple(boards[first:moving]), tuple(boards[moving:doubts]), *boards[2:first])
    reactions, driven = cached_reactions(world, config), world.driven
    percept = _percept(
        road,
        world.tick,
        world.episode_tick,
        world.avs[ego],
        ego_id(ego),
        right,
        left,
        seen,
        reactions.yielding & (right | left),
        reactions.attentive & (right | left),
        driven,
        config.collision == "swept",
        movers,
        hazards,
        config.dynamics,
        config.behaviour,
        (),
        dict(zip([*hazards.values(), *movers.values()], likelihoods, strict=True)),
        tuple(boards[doubts:]),
    )
    after = _belief(
        layers,
        right,
        left,
        seen,
        tuple(movers.items()),
        tuple(hazards.items()),
        driven,
        world.episode_tick,
        namer.phantoms,
    )
    return percept, after


def _setup(kernel: Any, config: Config, road: Road, suite: tuple[SensorSpec, ...]) -> Setup:
    """`setup`, found by identity: hashing a configuration takes as long as the kernel does."""
    found = _setups.get(id(config))
    if found is not None and found[0] is config and found[1] is road and found[2] is suite:
        return found[3]
    made = setup(config, road, suite)
    if not made.tables.shadows.any():
        kernel.fill_shadows(made.tables, road.columns)
    if len(_setups) >= _KEPT_SETUPS:
        _setups.clear()
    _setups[id(config)] = config, road, suite, made
    return made


_Followed = tuple[list[int], Board, Mapping[int, str]]
_NONE: Final[_Followed] = ([], 0, {})


def _followed(belief: GridBelief, world: World, config: Config) -> _Followed:
    """Of the movers that are followed: layers, cells before and after; those heading right; their names."""
    motion = expected_motion(belief, world, config)
    table = dict(belief.movers)
    after = shift_table(table, motion)
    right, boards = belief.right, belief.boards
    if boards.others:
        layers = [RIGHT[boards.mover_kind(cell)] + (not right >> cell & 1) for cell in table]
    else:
        first = RIGHT[Kind.VEHICLE]
        layers = [first + (not right >> cell & 1) for cell in table]
    return [*layers, *table, *after], motion.right, after


def _call(
    kernel: Any,
    world: World,
    config: Config,
    ego: int,
    belief: GridBelief | None,
    used: Setup,
    followed: _Followed,
    names: list[str],
) -> tuple[list[int], bytes, bytes, list[float]]:
    """Calls the kernel; returns what is shown, its boards, the belief, and the likelihoods."""
    road = world.road
    cells, things, devices = road.columns * road.rows, len(names), len(used.tables.devices)
    numbers = array(
        "q",
        [
            used.key,
            world.episode,
            world.episode_tick,
            ego,
            world.avs[ego],
            road.columns,
            road.rows,
            belief is not None,
            0 if belief is None else belief.episode_tick,
            things,
            len(world.hazards),
            len(world.avs),
            len(followed[0]) // 3,
            *divmod(world.avs[ego], road.columns),
            *world.hazards,
            *world.movers,
            *map(_kind_of, names),
            *map(_number_of, names),
            *world.avs,
            *followed[0],
        ],
    )
    size = (cells + 7) // 8
    fixed = 0 if belief is None else belief.boards.fixed
    boards = b"".join([board.to_bytes(size, "little") for board in (world.right, fixed, followed[1])])
    before = used.prior if belief is None else belief.layers
    most = 2 * cells
    layers = np.empty(LAYERS * cells, np.int16)
    shown = np.empty(SHOWN_HEAD + TRIPLE * (most + devices * (things + KINDS_SEEN)), np.int64)
    likelihoods = np.empty(most)
    marked = np.empty(SEEN * size, np.uint8)
    end = kernel.sense_tick(
        np.frombuffer(numbers, np.int64),
        np.frombuffer(boards, np.uint8),
        np.frombuffer(before, np.int16),
        1.0 - config.detection_sensitivity,
        used.mixing,
        used.least,
        used.tables,
        layers,
        shown,
        likelihoods,
        marked,
    )
    found = shown[:end].tolist()
    return found, marked.tobytes(), layers.tobytes(), likelihoods[: found[0] + found[1]].tolist()
