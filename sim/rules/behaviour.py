"""How the movers (obstacle vehicles and pedestrians) move in a tick, and whether they react to the vehicles.

A behaviour is a class with a name (`Config.behaviour`). It says who may react in a tick (`reactions`), where
all movers are after it (`step`, `brake`), and what that means for whoever looks ahead: whether the movers
react to the vehicles (`reads_egos`), whether something is drawn (`draws`), whether the future is certain, and
whether a path that is collision-free without reactions stays collision-free (`free_ways_hold`). Commit,
forecasts, searches and explanations call these methods and never read a probability.
`SidewaysTraffic` is the default behaviour.

Contract: rows do not interact, nobody leaves its row, and a mover reacts only to vehicles in its own row.
`sim.search.reactive` and `sim.repetition` rest on it.
A further behaviour is a class in a module of its own, named in `sim.rules.behaviour_registry`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache, partial
from itertools import chain, combinations, count, product
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple

from sim.rules.mover_boards import resting_marked
from sim.rules.traffic import Motion, brake, move_movers
from sim.rules.yielding import attentive_movers, movers_beside, yielding_movers
from sim.world.grid import Board, bits, board_of

if TYPE_CHECKING:
    from sim.config import Config
    from sim.world import World

DEFAULT_BEHAVIOUR: Final = "sideways"


class Reactions(NamedTuple):
    """Who may react to the vehicles in one tick."""

    yielding: Board = 0
    """movers that count the cells of vehicles as blocked"""
    attentive: Board = 0
    """movers that brake for a vehicle that stands still before them"""


NOBODY: Final = Reactions()
_reactions = partial(tuple.__new__, Reactions)  # a third of the time that the class's own takes


class Behaviour:
    """What movers do by themselves, and no reaction at all. A subclass gives `name` and what differs."""

    name: ClassVar[str]

    def reads_egos(self, config: Config) -> bool:  # noqa: ARG002
        """Whether movers react to vehicles, so that where they go depends on where those are."""
        return False

    def draws(self, config: Config) -> bool:  # noqa: ARG002
        """Whether anything about the movers is drawn tick by tick."""
        return False

    def certain(self, config: Config) -> bool:
        """Whether the future is certain: the same moves lead to the same ends, whatever is drawn."""
        return not self.draws(config)

    def free_ways_hold(self, config: Config) -> bool:
        """Whether a path that is collision-free in a forecast without reactions stays collision-free."""
        return not self.reads_egos(config)

    def reactions(self, world: World, config: Config) -> Reactions:  # noqa: ARG002
        """Who may react to the vehicles in the coming tick, as it is drawn."""
        return NOBODY

    def possible_reactions(self, world: World, config: Config) -> list[tuple[Reactions, float]]:
        """What may be drawn in the coming tick, with the chance of each."""
        return [(self.reactions(world, config), 1.0)]

    def drawing(self, world: World, config: Config, drawn: Reactions) -> Config:  # noqa: ARG002
        """A configuration under which exactly this is drawn in the coming tick."""
        return config

    def step(
        self,
        right: Board,
        left: Board,
        marked: Sequence[Board],
        disabled: Board,
        fixed: Board,
        left_edge: Board,
        right_edge: Board,
        episode_tick: int,
        vehicles: Board,
        reactions: Reactions,
    ) -> Motion:
        """Where all movers are after the tick that begins at `episode_tick`, unless someone brakes.

        Boards of one road, or of a part of it that holds whole rows: movers by heading, those of each kind
        in `MARKED` (empty where there are none), those that a hazard holds; fixed hazards; the first and the
        last column; and the autonomous vehicles, where it is known where they are.
        """
        return move_movers(
            right,
            left,
            disabled | resting_marked(marked, episode_tick) if marked and any(marked) else disabled,
            fixed,
            reactions.yielding,
            vehicles,
            left_edge,
            right_edge,
        )

    def brake(self, motion: Motion, standing: Board, reactions: Reactions) -> Motion:
        """The motion where the vehicles in the cells `standing` do not move in this tick."""
        return brake(motion, standing, reactions.attentive) if reactions.attentive else motion


class SidewaysTraffic(Behaviour):
    """To and fro in its row; some give way to a vehicle beside them, and some brake for one that stands.

    Who gives way (`Config.courtesy`) and who brakes (`Config.attentive`) is drawn by mover and tick.
    """

    name = DEFAULT_BEHAVIOUR

    def reads_egos(self, config: Config) -> bool:
        """See `Behaviour`."""
        return config.courtesy > 0.0 or config.attentive > 0.0

    def draws(self, config: Config) -> bool:
        """See `Behaviour`."""
        return 0.0 < config.courtesy < 1.0 or 0.0 < config.attentive < 1.0

    def certain(self, config: Config) -> bool:
        """See `Behaviour`. With courtesy 1 nothing is drawn either, but the future counts as uncertain."""
        return config.courtesy == 0.0 and config.attentive in (0.0, 1.0)

    def free_ways_hold(self, config: Config) -> bool:
        """See `Behaviour`. A mover brakes only for a vehicle that it would hit."""
        return config.courtesy == 0.0

    def reactions(self, world: World, config: Config) -> Reactions:
        """See `Behaviour`."""
        near = movers_beside(world)
        if not near:
            return NOBODY
        return _reactions((yielding_movers(world, config, near), attentive_movers(world, config, near)))

    def possible_reactions(self, world: World, config: Config) -> list[tuple[Reactions, float]]:
        """See `Behaviour`: every set of the movers beside a vehicle in its row, each drawn by itself."""
        near = movers_beside(world) & _rows_of_vehicles(world)
        return [
            (Reactions(giving, braking), chance * other)
            for (giving, chance), (braking, other) in product(
                _subsets(near, config.courtesy), _subsets(near, config.attentive)
            )
        ]

    def drawing(self, world: World, config: Config, drawn: Reactions) -> Config:
        """See `Behaviour`: the first seed that draws it."""
        near = movers_beside(world)
        shares = {"courtesy": _share(drawn.yielding, near), "attentive": _share(drawn.attentive, near)}
        tried = (_with_shares(config, **shares, seed=seed) for seed in count())
        return next(each for each in tried if self.reactions(world, each) == drawn)


def _rows_of_vehicles(world: World) -> Board:
    """All cells of the rows with a vehicle. A mover beside one across the edge has nothing to react to."""
    road, cells = world.road, 0
    for cell in world.avs:
        cells |= road.row(cell // road.columns)
    return cells


def _subsets(near: Board, share: float) -> Iterator[tuple[Board, float]]:
    """Which of the movers near may be drawn, each for itself with this chance, and the chance of it."""
    if share in (0.0, 1.0) or not near:
        return iter([(near if share == 1.0 else 0, 1.0)])
    cells = list(bits(near))
    chosen = chain.from_iterable(combinations(cells, size) for size in range(len(cells) + 1))
    return (
        (board_of(some), share ** len(some) * (1.0 - share) ** (len(cells) - len(some))) for some in chosen
    )


@lru_cache(maxsize=256)
def _with_shares(config: Config, courtesy: float, attentive: float, seed: int) -> Config:
    """A configuration with other chances and another seed; one is asked for at every tick of every future."""
    return config.with_parts(courtesy=courtesy, attentive=attentive, seed=seed)


def _share(drawn: Board, near: Board) -> float:
    """A chance under which these of the movers near can be drawn."""
    return 0.0 if not drawn else 1.0 if drawn == near else 0.5
