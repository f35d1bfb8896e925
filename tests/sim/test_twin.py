"""The world against its slow twin: the same state after every tick, on many random roads."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Add, Where
from sim.config import Config
from sim.courtesy import yielding
from sim.edit import apply
from sim.kinds import Kind, Mode, Move, Outcome
from sim.road import bits
from sim.run import Run, advance
from sim.world import World
from tests.sim import twin
from tests.sim.roads import run_on, worlds


def courteous(run: Run) -> set[tuple[int, int]]:
    """The draw the twin cannot make: which movers give way this tick."""
    return {run.world.road.cell(cell) for cell in bits(yielding(run.world, run.config))}


def drive_both(run: Run, ticks: int) -> None:
    """Advance both until the episode ends, comparing everything there is to compare."""
    slow = twin.position(run.world)
    for _ in range(ticks):
        move, slow = twin.step(slow, courteous=courteous(run))
        tick = advance(run)
        run = tick.run
        assert tick.decision is not None
        assert tick.decision.move is move
        assert twin.position(run.world) == slow
        if slow.outcome is not Outcome.RUNNING:
            return


def random_run(random: Random) -> Run:
    """A run on a road of any size and density, some movers held by potholes."""
    columns, rows = random.randint(3, 12), random.randint(4, 40)
    room = columns * (rows - 2)
    density = random.choice((0.0, 0.05, 0.1, 0.2, 0.4, 0.7))

    def some(share: float) -> int:
        return random.randint(0, int(room * density * share))

    config = Config(
        columns=columns,
        rows=rows,
        seed=random.randrange(2**40),
        vehicles=random.choice((None, some(0.5))) if room - 2 * rows > room * density else some(0.5),
        potholes=some(0.3),
        barriers=some(0.1),
        pedestrians=some(0.3),
        courtesy=random.choice((0.0, 0.0, 0.5, 1.0)),
    )
    run = Run.start(config)
    for thing in list(run.world.things()):
        if thing.kind.moves and random.random() < 0.1:
            run = apply(run, Add(kind="pothole", count=1, where=Where(cell=thing.cell))).run
    return run


@pytest.mark.parametrize("part", range(4))
def test_same_state_every_tick_on_random_roads(part: int) -> None:
    random = Random(f"twin {part}")
    for _ in range(60):
        drive_both(random_run(random), 420)


@settings(max_examples=150, deadline=None)
@given(worlds(), st.sampled_from([0.0, 0.5, 1.0]))
def test_same_state_on_any_crowded_road(world: World, courtesy: float) -> None:
    drive_both(run_on(world, courtesy=courtesy, seed=3), 30)


@settings(max_examples=150, deadline=None)
@given(worlds(), st.lists(st.sampled_from(list(Move)), min_size=1, max_size=25))
def test_a_persons_moves_lead_to_the_same_states_and_ends(world: World, moves: list[Move]) -> None:
    run = Run(run_on(world).config, world, mode=Mode.MANUAL, queue=tuple(moves))
    slow = twin.position(world)
    for asked in moves:
        tick = advance(run)
        assert tick.decision is not None
        later = twin.moved_bodies(slow)
        wanted = (slow.av[0] + asked.offset[0], slow.av[1] + asked.offset[1])
        granted = asked if twin.will_be_free(slow, later, wanted) else Move.STAY
        assert tick.decision.move is granted
        _, slow = twin.step(slow, granted)
        run = tick.run
        assert twin.position(run.world) == slow
        if slow.outcome is not Outcome.RUNNING:
            return


@pytest.mark.parametrize("part", range(2))
def test_the_result_of_an_episode_stands_still(part: int) -> None:
    random = Random(f"standing {part}")
    for _ in range(15):
        run = random_run(random)
        while run.world.outcome is Outcome.RUNNING:
            run = advance(run).run
        ended = twin.position(run.world)
        for later in range(1, run.config.reset_delay_ticks):
            tick = advance(run)
            run = tick.run
            assert tick.decision is None
            assert twin.position(run.world).bodies == ended.bodies
            assert twin.position(run.world).av == ended.av
            assert run.world.tick == ended.tick + later
        run = advance(run).run
        assert (run.world.episode, run.world.episode_tick) == (2, 0)
        assert run.world.count(Kind.AV) == 1
