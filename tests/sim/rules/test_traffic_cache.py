"""What is computed once for two who ask is what each would have computed."""

from __future__ import annotations

from sim.commit import commit
from sim.config import Config
from sim.forecast import Forecast
from sim.rules.behaviour import NOBODY, Behaviour, Reactions, SidewaysTraffic
from sim.rules.traffic import Motion, shift_table
from sim.rules.traffic_cache import cached_shift_table, cached_step
from sim.state import SimState
from sim.transition import step
from sim.types import Move


def test_what_is_expected_is_what_comes_and_no_second_table_is_made() -> None:
    """Unless the vehicle stays and a mover brakes for it."""
    state = SimState.start(Config(seed=3, pedestrians=4))
    for _ in range(12):
        world = state.world
        forecast = Forecast.of_truth(world, state.config, 1)
        after = commit(world, (Move.FORWARD,), state.config)
        assert after.movers == forecast.slices.movers(0)
        assert after.movers is forecast.slices.movers(0)
        state = step(state).state


def test_the_latest_answer_is_for_its_own_question_only() -> None:
    behaviour = SidewaysTraffic()
    movers = (0b0010, 0b0100_0000, (), 0, 0, 0b0001_0001, 0b1000_1000, 0)
    motion = cached_step(behaviour, *movers, 0, NOBODY)
    assert motion == behaviour.step(*movers, 0, NOBODY)
    assert cached_step(behaviour, *movers, 0, NOBODY) is motion
    others = (0b0001, *movers[1:])
    assert cached_step(behaviour, *others, 0, NOBODY) == behaviour.step(*others, 0, NOBODY) != motion
    beside = Reactions(yielding=0b0010)
    turned = cached_step(behaviour, *movers, 0b0100, beside)
    assert turned == behaviour.step(*movers, 0b0100, beside) != motion
    assert cached_step(Behaviour(), *movers, 0b0100, beside) is not turned
    table = {1: "vehicle-1", 6: "vehicle-2"}
    assert cached_shift_table(table, motion) == shift_table(table, motion) == {2: "vehicle-1", 5: "vehicle-2"}
    still = Motion(motion.right, motion.left, 0, 0)
    assert cached_shift_table(table, still) == table
    twin = dict(table)
    assert cached_shift_table(twin, motion) == {2: "vehicle-1", 5: "vehicle-2"}
    assert cached_shift_table(table, motion) is cached_shift_table(table, motion)


def test_a_table_is_followed_to_the_last_cell_of_any_road() -> None:
    for cell in (0, 5, 62, 239, 240, 32_767):
        here = 1 << cell
        right = Motion(here << 1, 0, here << 1, 0)
        assert shift_table({cell: "vehicle-1"}, right) == {cell + 1: "vehicle-1"}
        stays = Motion(here, 0, 0, 0)
        assert shift_table({cell: "vehicle-1"}, stays) == {cell: "vehicle-1"}
        if cell:
            left = Motion(0, here >> 1, 0, here >> 1)
            assert shift_table({cell: "vehicle-1"}, left) == {cell - 1: "vehicle-1"}
