"""What a behaviour says of the future, and that everything that looks ahead asks it."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from sim.batch import Batch
from sim.commit import commit
from sim.config import Config
from sim.forecast import Forecast
from sim.oracle.certificate import Drivable, arrives, certify
from sim.oracle.lower_bounds import least_ticks
from sim.rules import behaviour_registry
from sim.rules.behaviour import Behaviour, Reactions, SidewaysTraffic
from sim.rules.traffic import Motion
from sim.state import SimState
from sim.transition import next_world
from sim.types import MARKED, MOVES, Kind, Move, Outcome
from sim.world import World
from sim.world.grid import Board
from tests.support.roads import grid, road, run_on


class PatientPedestrians(SidewaysTraffic):
    """A pedestrian beside a vehicle waits."""

    name = "patient"

    def reads_egos(self, config: Config) -> bool:  # noqa: ARG002
        return True

    def free_ways_hold(self, config: Config) -> bool:  # noqa: ARG002
        return False

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
        beside = (vehicles & ~left_edge) >> 1 | (vehicles & ~right_edge) << 1
        pedestrians = marked[MARKED.index(Kind.PEDESTRIAN)] if marked else 0
        waiting = disabled | pedestrians & beside
        return super().step(
            right, left, marked, waiting, fixed, left_edge, right_edge, episode_tick, vehicles, reactions
        )


@pytest.fixture(autouse=True)
def _two_behaviours(monkeypatch: pytest.MonkeyPatch) -> None:
    both: dict[str, Behaviour] = {each.name: each for each in (SidewaysTraffic(), PatientPedestrians())}
    monkeypatch.setitem(behaviour_registry.BEHAVIOURS, "patient", both["patient"])  # type: ignore[arg-type]
    monkeypatch.setitem(__import__("sim.config").config.CHOICES, "behaviour", tuple(both))


@pytest.mark.parametrize(
    ("courtesy", "attentive", "draws", "certain", "reacting", "free_ways_hold"),
    [
        (0.0, 0.0, False, True, False, True),
        (0.0, 1.0, False, True, True, True),
        (0.0, 0.5, True, False, True, True),
        (0.5, 0.0, True, False, True, False),
        (1.0, 1.0, False, False, True, False),
    ],
)
def test_what_the_default_says_of_the_future(
    courtesy: float, attentive: float, draws: bool, certain: bool, reacting: bool, free_ways_hold: bool
) -> None:
    config = Config(courtesy=courtesy, attentive=attentive)
    assert config.mover_behaviour.draws(config) is draws
    assert (config.certain, config.reacting, config.free_ways_hold) == (certain, reacting, free_ways_hold)


def test_what_may_be_drawn_adds_up_and_can_be_drawn() -> None:
    world = road("....", ">A<.", "....", "....")
    config = run_on(world, courtesy=0.25, attentive=0.5).config
    behaviour = config.mover_behaviour
    possible = behaviour.possible_reactions(world, config)
    assert len(possible) == len({drawn for drawn, _ in possible}) == 16
    assert sum(chance for _, chance in possible) == pytest.approx(1.0)
    for drawn, _ in possible:
        assert behaviour.reactions(world, behaviour.drawing(world, config, drawn)) == drawn


def test_another_behaviour_holds_in_commit_and_forecast() -> None:
    world = road("....", "....", ".)A.", "....", tick=1)
    usual, patient = (run_on(world, behaviour=name).config for name in ("sideways", "patient"))
    assert grid(commit(world, (Move.FORWARD,), usual))[2] == "..)."
    after = commit(world, (Move.FORWARD,), patient)
    assert grid(after)[2] == ".).."
    assert Forecast.of_truth(world, patient, 1).slices.movers(0) == after.movers


def _least(world: World, config: Config, limit: int) -> int | None:
    """By trying everything, in the world itself."""
    layer = [world]
    for tick in range(1, limit + 1):
        found: dict[object, World] = {}
        for now in layer:
            for move in MOVES:
                if config.ego_dynamics(now.road).target(now.av, move) is None:
                    continue
                after = next_world(now, (move,), config)
                if after.outcome is Outcome.SUCCESS:
                    return tick
                if after.outcome is Outcome.RUNNING:
                    found[after.av, after.right, after.left, after.pedestrians] = after
        layer = list(found.values())
    return None


def test_another_behaviour_holds_in_proofs() -> None:
    quicker = 0
    for seed in range(12):
        config = Config(columns=4, rows=7, seed=seed, pedestrians=6, vehicles=3, behaviour="patient")
        state, limit = SimState.start(config), 14
        found, tried = least_ticks(state), _least(SimState.start(config).world, config, limit)
        assert (found if found is not None and found <= limit else None) == tried
        proof = certify(state)
        assert not isinstance(proof, Drivable) or arrives(state, proof.plan)
        quicker += found is not None
    assert quicker > 0


def test_a_batch_refuses_what_it_is_not_compiled_for() -> None:
    with pytest.raises(ValueError, match="behaviour 'sideways' only, not 'patient'"):
        Batch([Config(), Config(behaviour="patient")])
