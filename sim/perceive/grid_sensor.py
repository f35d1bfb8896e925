"""Sensors that err: the looks of devices gathered in a belief, and what of it is shown to the planner."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from sim.config import Config
from sim.perceive.bayes_filter import predict_layers, update_layers
from sim.perceive.belief import FIXED, LAYER, LAYERS, RIGHT, GridBelief, Layers, packed, prior, probabilities
from sim.perceive.kernel import run as kernel
from sim.perceive.log_odds import LIMIT
from sim.perceive.look import Look, look
from sim.perceive.parameters import SensorSpec
from sim.perceive.percept import DOUBTS, Percept
from sim.perceive.perfect import perceive_truth
from sim.perceive.sensor import NO_BELIEF, Belief
from sim.perceive.sensor_model import sensor_model, tuning_of
from sim.types import HAZARDS, KINDS, MOVERS, Kind, phantom_id
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, board_of


class _Shown(NamedTuple):
    """One thing that is believed to be there."""

    kind: Kind
    right: bool
    likelihood: float


def looks(world: World, config: Config, ego: int, suite: Iterable[SensorSpec]) -> list[Look]:
    """What each device of a suite reports from ego number `ego`."""
    return [
        look(
            world,
            config,
            ego,
            sensor_model(
                spec,
                config.weather,
                config.time_of_day,
                config.cell_m,
                world.road.columns,
                tuning_of(config),
            ),
        )
        for spec in suite
    ]


@dataclass(frozen=True)
class Gathered:
    """The grid after the looks of a tick, and the names of the movers that are followed."""

    layers: Layers
    followed: Mapping[int, str]
    looks: list[Look]


def gather(world: World, config: Config, ego: int, belief: Belief, suite: Iterable[SensorSpec]) -> Gathered:
    """The belief of a tick: the one before, moved on, and the looks of this tick."""
    road = world.road
    followed: Mapping[int, str] = {}
    if isinstance(belief, GridBelief) and len(belief.layers) == 2 * LAYERS * road.columns * road.rows:
        layers, followed = predict_layers(belief, world, config)
    else:
        layers = prior(config, road).copy()
    found = looks(world, config, ego, suite)
    row, column = divmod(world.avs[ego], road.columns)
    for each in found:
        update_layers(layers, each, row, column)
    for cell in world.avs:  # egos tell where they are
        layers[:, cell // road.columns, cell % road.columns] = -LIMIT
    return Gathered(layers, followed, found)


def show(
    world: World, config: Config, ego: int, belief: Belief, gathered: Gathered
) -> tuple[Percept, GridBelief]:
    """The percept of what is believed to be there, and the belief for the next tick."""
    threshold = 1.0 - config.detection_sensitivity
    # What is behind is never looked at again, and never met: nobody leaves its row.
    ahead = gathered.layers[:, : world.avs[ego] // world.road.columns + 1]
    hazards, movers = _believed(ahead, threshold)
    earlier = belief if isinstance(belief, GridBelief) else None
    names = _Names(world, gathered.looks, earlier.phantoms if earlier else 0)
    remembered = dict(earlier.hazards) if earlier else {}
    fixed_names = names.name({cell: each.kind for cell, each in hazards.items()}, remembered, fixed=True)
    mover_names = names.name(
        {cell: each.kind for cell, each in movers.items()}, gathered.followed, fixed=False
    )
    by_kind: dict[Kind, Board] = {}
    for shown in (hazards, movers):
        for cell, each in shown.items():
            if each.kind is not Kind.VEHICLE:
                by_kind[each.kind] = by_kind.get(each.kind, 0) | 1 << cell
    boards = Boards.of(by_kind)
    right = board_of([cell for cell, each in movers.items() if each.right])
    left = board_of([cell for cell, each in movers.items() if not each.right])
    truth = perceive_truth(world, config, ego)
    percept = Percept(
        road=world.road,
        tick=world.tick,
        episode_tick=world.episode_tick,
        ego=truth.ego,
        ego_id=truth.ego_id,
        right=right,
        left=left,
        boards=boards,
        yielding=truth.yielding & (right | left),
        attentive=truth.attentive & (right | left),
        vehicles=truth.vehicles,
        swept=truth.swept,
        movers=mover_names,
        hazards=fixed_names,
        dynamics=truth.dynamics,
        behaviour=truth.behaviour,
        doubtful=_doubtful(ahead, boards.fixed),
        likelihoods={
            table[cell]: round(each.likelihood, 3)
            for shown, table in ((hazards, fixed_names), (movers, mover_names))
            for cell, each in shown.items()
        },
    )
    after = GridBelief(
        packed(gathered.layers),
        right,
        left,
        boards,
        tuple(mover_names.items()),
        tuple(fixed_names.items()),
        world.driven,
        world.episode_tick,
        names.phantoms,
    )
    return percept, after


def _believed(layers: Layers, threshold: float) -> tuple[dict[int, _Shown], dict[int, _Shown]]:
    """What is at least as likely as the threshold, by cell: of fixed hazards the likeliest, and of movers.

    A mover on what holds movers is shown with it; on any other hazard the hazard alone.
    """
    likely = probabilities(layers).reshape(LAYERS, -1)
    hazards: dict[int, _Shown] = {}
    for kind in HAZARDS:
        found = likely[LAYER[kind]]
        for cell in np.flatnonzero(found >= threshold).tolist():
            share = float(found[cell])
            if cell not in hazards or share > hazards[cell].likelihood:
                hazards[cell] = _Shown(kind, False, share)
    movers: dict[int, _Shown] = {}
    for kind in MOVERS:
        right, left = likely[RIGHT[kind]], likely[RIGHT[kind] + 1]
        either = right + left
        for cell in np.flatnonzero(either >= threshold).tolist():
            share = min(float(either[cell]), 1.0)
            held = cell not in hazards or KINDS[hazards[cell].kind].holds_movers
            if held and (cell not in movers or share > movers[cell].likelihood):
                movers[cell] = _Shown(kind, bool(right[cell] >= left[cell]), share)
    return dict(sorted(hazards.items())), dict(sorted(movers.items()))


def _doubtful(layers: Layers, shown: Board) -> tuple[Board, ...]:
    """The cells that hold something fixed with each of the likelihoods `DOUBTS`, without those shown."""
    likely = probabilities(layers[:FIXED]).max(axis=0).ravel()
    boards = (int.from_bytes(np.packbits(likely >= level, bitorder="little"), "little") for level in DOUBTS)
    return tuple(board & ~shown for board in boards)


class _Names:
    """Names of what is believed to be there. No planner reads them: they are for answers and pictures."""

    def __init__(self, world: World, looks: Iterable[Look], phantoms: int) -> None:
        self.phantoms = phantoms
        self._world = world
        self._reported = {
            (report.kind, report.cell): report.id
            for each in looks
            for report in each.reports
            if report.id is not None
        }

    def name(self, kinds: Mapping[int, Kind], known: Mapping[int, str], *, fixed: bool) -> dict[int, str]:
        """The id of each: of the thing that is there, else of the one followed or detected, else a new one.

        `known`: the ids of what was believed to be in a cell before this look.
        """
        there = self._world.hazards if fixed else self._world.movers
        names = {
            cell: there[cell] for cell, kind in kinds.items() if cell in there and self._is(kind, cell, fixed)
        }
        used = set(names.values())
        for cell, kind in kinds.items():
            if cell in names:
                continue
            for id in (known.get(cell), self._reported.get((kind, cell))):
                if id is not None and id not in used and id.startswith(f"{kind}-"):
                    break
            else:
                self.phantoms += 1
                id = phantom_id(kind, self.phantoms)
            names[cell] = id
            used.add(id)
        return {cell: names[cell] for cell in kinds}

    def _is(self, kind: Kind, cell: int, fixed: bool) -> bool:
        boards = self._world.boards
        return kind is (boards.fixed_kind(cell) if fixed else boards.mover_kind(cell))


def _perceive_late(
    world: World, config: Config, ego: int, belief: GridBelief, suite: tuple[SensorSpec, ...]
) -> tuple[Percept, Belief]:
    """What is believed without the looks of this tick, and the belief with them, for the next one.

    In arrays: the kernel weighs looks before it shows anything. The first looks of an episode, before which
    the vehicle has stood, are known at once; without a belief from tick to tick no look is ever late.
    """
    expected = gather(world, config, ego, belief, ())
    percept, _ = show(world, config, ego, belief, expected)
    _, after = show(world, config, ego, belief, gather(world, config, ego, belief, suite))
    return percept, after


def perceive_grid(
    world: World, config: Config, ego: int, belief: Belief, suite: tuple[SensorSpec, ...], remembers: bool
) -> tuple[Percept, Belief]:
    """What a suite of devices shows; with `remembers` false, of this tick's looks alone."""
    before = belief if remembers else NO_BELIEF
    if config.sensor_latency and isinstance(before, GridBelief):
        return _perceive_late(world, config, ego, before, suite)
    if kernel.ready():
        known = before if isinstance(before, GridBelief) else None
        percept, after = kernel.sense_tick(world, config, ego, known, suite)
        return percept, after if remembers else NO_BELIEF
    percept, after = show(world, config, ego, before, gather(world, config, ego, before, suite))
    return percept, after if remembers else NO_BELIEF
