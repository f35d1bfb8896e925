"""The compiled engine is the live engine: same states every tick, same counts."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.batch import Batch, BatchPlanner
from sim.config import Config
from sim.decide import decide
from sim.state import SimState, StepResult
from sim.transition import next_world, step
from sim.types import Kind, Mode, Move, Outcome
from sim.world import World
from tests.support.roads import road, run_on, worlds
from tools.batch_parity import difference, mixed_configs

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")

CONFIGS = list(mixed_configs(seed=1, count=240))


@pytest.mark.parametrize("group", range(len(CONFIGS)))
def test_mixed_roads_go_the_same_way(group: int) -> None:
    assert difference(CONFIGS[group], 120) is None


@pytest.mark.parametrize("group", range(0, len(CONFIGS), 2))
def test_mixed_roads_go_the_same_way_by_rules(group: int) -> None:
    assert difference(CONFIGS[group], 120, "rules") is None


def test_the_largest_road() -> None:
    config = Config(columns=64, rows=512, pedestrians=50, potholes=300, courtesy=0.3, planner="priority")
    assert difference([config], 60) is None


RULES = st.sampled_from(
    [
        {"attentive": 1.0},
        {"collision": "cell", "attentive": 0.0, "repetition": False},
        {"collision": "cell", "attentive": 1.0},
        {"attentive": 0.0},
        {"attentive": 0.5},
        {"courtesy": 0.5, "attentive": 0.5, "collision": "cell"},
        {"courtesy": 0.5, "attentive": 1.0},
    ]
)
MOVES = list(Move)


@settings(max_examples=120)
@given(worlds(), RULES)
def test_the_rules_decide_the_same_at_any_moment(world: World, rules: dict[str, Any]) -> None:
    run = run_on(world, **rules, reset_delay_s=1.0, planner="rules")
    batch = Batch.of([run])
    for _ in range(12):
        assert batch.digest(0) == run.world.digest()
        batch.run(1, "rules")
        run = step(run).state


@settings(max_examples=120)
@given(worlds(), RULES)
def test_any_moment_goes_on_the_same_way(world: World, rules: dict[str, Any]) -> None:
    """Also with movers held by potholes, which no fresh road has."""
    run = run_on(world, **rules, reset_delay_s=1.0)
    batch = Batch.of([run])
    for _ in range(12):
        assert batch.digest(0) == run.world.digest()
        batch.run(1)
        run = step(run).state


@settings(max_examples=150)
@given(worlds(), st.sampled_from(MOVES), RULES)
def test_any_move_ends_as_the_judge_says(world: World, move: Move, rules: dict[str, Any]) -> None:
    run = run_on(world, **rules)
    batch = Batch.of([run])
    batch.step(np.array([MOVES.index(move)], np.uint8))
    possible = world.road.moved(world.av, move) is not None
    assert batch.digest(0) == next_world(world, (move if possible else Move.STAY,), run.config).digest()


@settings(max_examples=60)
@given(worlds(max_columns=12, max_rows=14), RULES, st.integers(0, 3), st.integers(0, 63))
def test_planners_decide_the_same_along_any_way(
    world: World, rules: dict[str, Any], buffer: int, waits: int
) -> None:
    """Least ticks and least cost with their moves, also after waits that no planner would choose."""
    for live, name in (("bfs", "bfs"), ("dijkstra", "weighted")):
        run = run_on(world, **rules, safety_buffer=buffer, planner=live)
        batch = Batch.of([run])
        for tick in range(6):
            decision = decide(run)
            if decision is None:
                break
            assert MOVES[int(batch.moves(name)[0])] is decision.move
            cost = decision.options[0].cost
            assert batch.least(name)[0] == (-1 if cost is None else cost)
            move = Move.STAY if waits >> tick & 1 else decision.move
            run = replace(run, world=next_world(run.world, (move,), run.config))
            batch.step(np.array([MOVES.index(move)], np.uint8))
            assert batch.digest(0) == run.world.digest()


def test_what_lies_near_is_charged_on_its_own_side() -> None:
    """A road's words may have bits that are no cells: nothing spreads through them to the other edge."""
    rows = [*["." * 9] * 6, ">#.......", "........A", *["." * 9] * 6]
    run = run_on(road(*rows), preferences=("cautious",), planner="dijkstra")
    decision = decide(run)
    assert decision is not None
    assert Batch.of([run]).least("weighted")[0] == decision.options[0].cost


def test_a_mover_brakes_for_a_vehicle_that_stays() -> None:
    """And the rule, the planners and moves handed in know it."""
    walled = road(".....", "#####", ".>A#.", ".###.", ".....")
    for planner, name in (
        ("priority", "priority"),
        ("rules", "rules"),
        ("bfs", "bfs"),
        ("dijkstra", "weighted"),
    ):
        run = run_on(walled, planner=planner, attentive=1.0, repetition=False)
        batch = Batch.of([run])
        batch.run(1, name)
        run = step(run).state
        assert run.world.outcome is Outcome.RUNNING
        assert batch.digest(0) == run.world.digest()
    asleep = Batch.of([run_on(walled, attentive=0.0)])
    asleep.step(np.array([MOVES.index(Move.STAY)], np.uint8))
    assert asleep.outcomes[0] == list(Outcome).index(Outcome.CRASH)


CAGE = road(".....", "#####", ".#A#.", ".###.", ".....")


def test_a_situation_that_repeats_is_stuck_at_the_same_tick() -> None:
    run = run_on(CAGE)
    batch = Batch.of([run], after="stop")
    while run.world.outcome is Outcome.RUNNING:
        run = step(run).state
        batch.run(1)
        assert batch.digest(0) == run.world.digest()
    assert run.world.outcome is Outcome.STUCK
    assert run.world.episode_tick < 10
    assert batch.totals().stuck[0] == 1


def test_a_batch_takes_over_what_a_run_has_watched() -> None:
    """From any moment on, a batch notices a repeated situation when the run does."""
    dense = Config(columns=6, rows=12, potholes=16, barriers=6, planner="priority")
    for config in (replace(dense, seed=seed) for seed in range(40)):
        run = SimState.start(config)
        for _ in range(300):
            if run.world.outcome is not Outcome.RUNNING:
                break
            batch, after = Batch.of([run], after="stop"), run
            for _ in range(3):
                after = step(after).state
                batch.run(1)
                if after.world.outcome is Outcome.RUNNING:
                    assert batch.outcomes[0] == 0
                else:
                    assert batch.outcomes[0] == list(Outcome).index(after.world.outcome)
                    break
            run = step(run).state


def test_moves_handed_in_are_never_repetitions_and_are_forgotten() -> None:
    run = run_on(CAGE).with_ego(mode=Mode.MANUAL)
    batch = Batch.of([run], after="stop")
    stay = np.array([MOVES.index(Move.STAY)], np.uint8)
    for _ in range(12):
        run = step(run).state
        batch.step(stay)
        assert batch.digest(0) == run.world.digest()
    run = run.with_ego(mode=Mode.AUTO)
    for _ in range(3):
        run = step(run).state
        batch.run(1)
        assert batch.digest(0) == run.world.digest()
    assert batch.outcomes[0] == 0


def test_an_episode_begun_again_has_watched_nothing() -> None:
    batch = Batch.of([run_on(CAGE)], after="restart")
    run, ticks = run_on(CAGE), 0
    while run.world.outcome is Outcome.RUNNING:
        run, ticks = step(run).state, ticks + 1
    for episodes in range(1, 5):
        batch.run(ticks)
        assert batch.totals().stuck[0] == episodes


def test_lanes_of_different_rules_lie_side_by_side() -> None:
    """Each lane goes the way it goes by itself."""
    choices = [
        {"collision": collision, "attentive": attentive, "repetition": repetition}
        for collision in ("swept", "cell")
        for attentive in (0.0, 1.0)
        for repetition in (True, False)
    ]
    configs = [
        Config(seed=seed, columns=6, rows=14, potholes=14, vehicles=14, **rules)
        for seed in range(12)
        for rules in choices
    ]
    together = Batch(configs)
    together.run(200)
    by_rules = [Batch(configs[number :: len(choices)]) for number in range(len(choices))]
    for number, batch in enumerate(by_rules):
        batch.run(200)
        alone = [batch.digest(lane) for lane in range(len(batch))]
        assert [together.digest(lane) for lane in range(number, len(configs), len(choices))] == alone
    assert len({tuple(batch.digest(lane) for lane in range(12)) for batch in by_rules}) > len(choices) // 2


def test_what_is_measured_by_happens() -> None:
    """Or the comparisons above would say little."""
    configs = [Config(seed=seed, columns=6, rows=14, potholes=14, vehicles=14) for seed in range(300)]
    batch = Batch(configs, after="stop")
    batch.run_to_end()
    assert batch.totals().stuck.sum() > 5
    assert batch.episode_ticks.max() <= 140  # not one of them at the limit of ticks
    others = Batch([replace(config, collision="cell", repetition=False) for config in configs], after="stop")
    others.run_to_end()
    assert (batch.vehicles != others.vehicles).any()


def test_many_ticks_in_one_call_are_as_many_calls() -> None:
    configs = [Config(seed=seed, pedestrians=3) for seed in range(100)]
    once, often = Batch(configs), Batch(configs)
    once.run(150)
    for _ in range(150):
        often.run(1)
    assert [once.digest(lane) for lane in range(100)] == [often.digest(lane) for lane in range(100)]
    assert all((a == b).all() for a, b in zip(_rows(once), _rows(often), strict=True))


def test_threads_change_nothing() -> None:
    configs = [Config(seed=seed) for seed in range(500)]
    one, two = Batch(configs), Batch(configs)
    one.run(200)
    two.run(200, threads=2)
    assert all(one.digest(lane) == two.digest(lane) for lane in range(0, 500, 7))
    assert all((a == b).all() for a, b in zip(_rows(one), _rows(two), strict=True))


def _rows(batch: Batch) -> list[np.ndarray]:
    totals = batch.totals()
    return [getattr(totals, name) for name in totals.__slots__]


def test_a_restarting_lane_begins_its_first_road_at_once() -> None:
    config = Config(seed=4, planner="priority")
    batch = Batch([config], after="restart")
    first = batch.world(0)
    run, ticks = SimState.start(config), 0
    while run.world.outcome is Outcome.RUNNING:
        run, ticks = step(run).state, ticks + 1
    batch.run(ticks)
    begun = batch.world(0)
    assert (begun.av, begun.right, begun.left) == (first.av, first.right, first.left)
    assert int(batch.totals().successes[0]) + int(batch.totals().crashes[0]) == 1
    batch.run(ticks)
    assert batch.totals().forward[0] == 2 * run.metrics.forward


def test_a_stopping_batch_plays_one_episode_each() -> None:
    configs = [Config(seed=seed, potholes=20, planner="priority") for seed in range(300)]
    batch = Batch(configs, after="stop")
    batch.run_to_end()
    totals = batch.totals()
    assert ((totals.successes + totals.crashes + totals.stuck) == 1).all()
    for lane in range(0, 300, 29):
        run = SimState.start(configs[lane])
        while run.world.outcome is Outcome.RUNNING:
            run = step(run).state
        assert batch.outcomes[lane] == list(Outcome).index(run.world.outcome)
        assert totals.forward[lane] == run.metrics.forward
        if run.world.outcome is Outcome.SUCCESS:
            assert totals.ticks_to_goal[lane] == run.world.episode_tick


def test_roads_of_two_sizes_are_refused() -> None:
    with pytest.raises(ValueError, match="one size"):
        Batch([Config(), Config(rows=31)])


def test_moves_must_be_moves() -> None:
    batch = Batch([Config(), Config(seed=1)])
    with pytest.raises(ValueError, match="2 moves"):
        batch.step(np.zeros(3, np.uint8))
    with pytest.raises(ValueError, match="0 to 5"):
        batch.step(np.array([0, 6], np.uint8))
    assert (batch.episode_ticks == 0).all()


def test_a_lane_can_be_looked_at_as_a_world() -> None:
    world = Batch([Config(seed=3, pedestrians=2, barriers=2)]).world(0)
    counts = {kind: world.count(kind) for kind in (Kind.PEDESTRIAN, Kind.BARRIER)}
    assert counts == {Kind.PEDESTRIAN: 2, Kind.BARRIER: 2}
    assert len({thing.id for thing in world.things()}) == sum(world.counts().values())
    tick = step(SimState(Config(seed=3, pedestrians=2, barriers=2), world))
    assert isinstance(tick, StepResult)


@pytest.mark.parametrize("planner", ["banana", "manual", "Priority", ""])
def test_a_planner_that_there_is_not_is_refused(planner: Any) -> None:
    batch = Batch([Config(rows=5)], after="stop")
    for use in (lambda: batch.run(1, planner), lambda: batch.run_to_end(planner)):
        with pytest.raises(ValueError, match="priority, rules, bfs, weighted, astar or dijkstra"):
            use()
    for ask in (batch.moves, batch.least):
        with pytest.raises(ValueError, match="priority, rules, bfs, weighted, astar or dijkstra"):
            ask(planner)
    with pytest.raises(ValueError, match="priority, rules, bfs"):
        batch.run(0, planner)
    assert (batch.episode_ticks == 0).all()


def test_the_rule_is_not_asked_ahead_of_the_tick() -> None:
    batch = Batch([Config()])
    for ask in (batch.moves, batch.least):
        with pytest.raises(ValueError, match="searches no way"):
            ask("priority")


@pytest.mark.parametrize("name", ["astar", "dijkstra"])
def test_planners_that_weigh_costs_go_by_their_own_names(name: BatchPlanner) -> None:
    configs = [Config(seed=seed, potholes=30, preferences=("cautious",)) for seed in range(30)]
    batch = Batch(configs, after="stop")
    assert (batch.moves(name) == batch.moves("weighted")).all()
    assert (batch.least(name) == batch.least("weighted")).all()
    assert (batch.least(name) != batch.least("bfs")).any()
    batch.run_to_end(name)
    run = SimState.start(replace(configs[3], planner=name))
    while run.world.outcome is Outcome.RUNNING:
        run = step(run).state
    assert batch.digest(3) == replace(run.world, tick=int(batch.world(3).tick)).digest()


def test_threads_ticks_and_what_follows_an_end_are_checked() -> None:
    batch = Batch([Config()], after="stop")
    stay = np.full(1, 5, np.uint8)
    for threads in (0, -2):
        with pytest.raises(ValueError, match="1 thread or more"):
            batch.run(1, threads=threads)
        with pytest.raises(ValueError, match="1 thread or more"):
            batch.run_to_end(threads=threads)
        with pytest.raises(ValueError, match="1 thread or more"):
            batch.step(stay, threads=threads)
        with pytest.raises(ValueError, match="1 thread or more"):
            batch.moves("bfs", threads=threads)
        with pytest.raises(ValueError, match="1 thread or more"):
            batch.least("bfs", threads=threads)
    with pytest.raises(ValueError, match="0 ticks or more"):
        batch.run(-1)
    batch.run(0)
    assert (batch.episode_ticks == 0).all()
    wrong: Any = "banana"
    with pytest.raises(ValueError, match="next, restart or stop"):
        Batch([Config()], after=wrong)
    with pytest.raises(ValueError, match="next, restart or stop"):
        Batch.of([SimState.start(Config())], after=wrong)
