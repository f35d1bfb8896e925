"""What is proved to hold whatever the others do is what no outcome breaks: every one of them is tried."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator
from functools import cache

import pytest

from sim.config import Config
from sim.forecast import Forecast
from sim.generation import generate
from sim.rules.collision_geometry import Path, first_contact
from sim.rules.ego_contacts import paths_touch
from sim.rules.slipping import STRAIGHT
from sim.search.robust_reachability import Guarantee, guarantee, movers_that_may_hit
from sim.state import SimState
from sim.types import MOVES, Kind, Move
from sim.world import World
from tests.support.any_movers import histories, kinds_of
from tests.support.roads import road, run_on
from tests.support.two_egos import drawn

HORIZON = 3


def forecast_of(world: World, number: int = 0) -> Forecast:
    return Forecast.of_truth(world, run_on(world).config, 1, number)


Step = tuple[int, int, Kind]
"""A step that some mover may make: from a cell index to another."""


def possible_steps(world: World, ticks: int) -> list[set[Step]]:
    """By tick, every step that a mover makes in some outcome."""
    kinds = kinds_of(world)
    return [
        {step for pair in steps for step in zip(*pair, kinds, strict=True)}
        for steps in histories(world, ticks)
    ]


@cache
def touch(own: Path, other: Path) -> bool:
    return first_contact(own, other) is not None


def met(world: World, start: int, end: int, steps: set[Step]) -> bool:
    """Whether the body of the ego touches a mover's in some outcome, or ends on something fixed."""
    cell = world.road.cell
    if world.boards.fixed >> end & 1:
        return True
    own = Path(Kind.AV, cell(start), cell(end))
    return any(touch(own, Path(kind, cell(was), cell(now))) for was, now, kind in steps)


def longest(world: World, here: int, steps: list[set[Step]], moves: Iterable[Move] = MOVES) -> int:
    """For how many ticks a sequence of moves, the first of which is one of `moves`, meets nothing at all."""
    if not steps:
        return 0
    ends = [world.road.moved(here, move) for move in moves]
    free = [end for end in ends if end is not None and not met(world, here, end, steps[0])]
    return max((1 + longest(world, end, steps[1:]) for end in free), default=0)


def small_worlds(count: int) -> Iterator[World]:
    draw = random.Random(23)
    for _ in range(count):
        rows = ["....", *("".join(draw.choices("....><)(o#}", k=4)) for _ in range(3)), "...."]
        column = draw.randrange(4)
        at = draw.choice([2, 3, 4])
        rows[at] = rows[at][:column] + "A" + rows[at][column + 1 :]
        if sum(sign in "><)(" for sign in "".join(rows)) <= 4:
            yield road(*rows, tick=draw.randint(0, 1))


def test_no_more_and_no_less_is_proved_than_holds_in_every_outcome() -> None:
    short = 0
    for world in small_worlds(40):
        forecast, steps = forecast_of(world), possible_steps(world, HORIZON)
        for first in MOVES:
            found = guarantee(forecast, HORIZON, first=first)
            ticks = HORIZON if found.arrives is None else found.arrives
            best = longest(world, world.av, steps[:ticks], (first,))
            assert best == (ticks if found.to_the_end else found.ticks), (first, found)
            short += best < HORIZON
    assert short > 40


def test_the_best_move_is_as_good_as_all_of_them() -> None:
    for world in small_worlds(24):
        forecast = forecast_of(world)
        each = [guarantee(forecast, 30, first=move) for move in MOVES]
        best = guarantee(forecast, 30)
        assert best.to_the_end is any(found.to_the_end for found in each)
        if not best.to_the_end:
            assert best.ticks == max(found.ticks for found in each)
        arrivals = [found.arrives for found in each if found.arrives is not None]
        assert best.arrives == min(arrivals, default=None)


def test_a_proof_to_the_end_needs_no_limit() -> None:
    """It is found by a repetition, and to look further changes nothing."""
    for seed in range(12):
        config = Config(seed=seed, columns=6, rows=12, vehicles=6, pedestrians=3)
        forecast = Forecast.of_truth(generate(config, 0), config, 1)
        near, far = guarantee(forecast, 120), guarantee(forecast, 1_000)
        assert (near.to_the_end, near.arrives) == (far.to_the_end, far.arrives)


@pytest.mark.parametrize(
    ("rows", "move", "expected"),
    [
        (("....", "....", "....", "...A"), Move.FORWARD, Guarantee(3, to_the_end=True, arrives=3)),
        (("....", "....", "#...", "A..."), Move.FORWARD, Guarantee(0, to_the_end=False, arrives=None)),
        (("....", "....", "....", "A..."), Move.LEFT, Guarantee(0, to_the_end=False, arrives=None)),
        # The car may turn round, whatever its heading.
        (("....", "..>.", "....", ".A.."), Move.STAY, Guarantee(3, to_the_end=True, arrives=None)),
        (("....", "....", "..>.", ".A.."), Move.FORWARD, Guarantee(0, to_the_end=False, arrives=None)),
    ],
)
def test_hand_made_roads(rows: tuple[str, ...], move: Move, expected: Guarantee) -> None:
    found = guarantee(forecast_of(road(*rows)), 60, first=move)
    assert (found.to_the_end, found.arrives) == (expected.to_the_end, expected.arrives)
    assert found.to_the_end or found.ticks == expected.ticks


def test_where_moves_may_slip_both_outcomes_must_hold() -> None:
    for world in small_worlds(30):
        forecast = forecast_of(world)
        for move in MOVES:
            sure, slippery = (guarantee(forecast, 20, first=move, slips=slips) for slips in (False, True))
            assert not slippery.to_the_end or sure.to_the_end
            if move in STRAIGHT:
                left = guarantee(forecast, 20, first=STRAIGHT[move], slips=True)
                assert not slippery.to_the_end or left.to_the_end


def test_no_move_of_another_ego_breaks_it() -> None:
    draw = random.Random(31)
    proved = 0
    for _ in range(30):
        state = drawn(draw, "rules", pedestrians=0, vehicles=0)
        world = state.world
        forecast = Forecast.of_truth(world, state.config, 1)
        for first in MOVES:
            found = guarantee(forecast, 2, first=first)
            proved += found.to_the_end
            if found.to_the_end and found.arrives != 1:
                assert any(holds_against_ego(state, (first, then)) for then in MOVES), first
    assert proved > 10


def holds_against_ego(state: SimState, moves: tuple[Move, Move]) -> bool:
    """Whether two moves of the first ego meet nothing, whatever the second does."""
    world = state.world
    road = world.road

    def pairs(start: int) -> Iterator[tuple[int, int]]:
        return ((start, end) for move in MOVES if (end := road.moved(start, move)) is not None)

    here, others = world.avs[0], {world.avs[1]}
    for move in moves:
        if here < road.columns:
            return True  # arrived
        end = road.moved(here, move)
        if end is None or world.boards.fixed >> end & 1:
            return False
        own = road.cell(here), road.cell(end)
        steps = [pair for other in others for pair in pairs(other)]
        if any(paths_touch(own, (road.cell(was), road.cell(now)), "swept") for was, now in steps):
            return False
        here, others = end, {now for _, now in steps}
    return True


def test_who_may_hit_is_who_makes_it_unsafe() -> None:
    """Without those the move itself can be hit by nobody; with them it can."""
    for world in small_worlds(40):
        forecast = forecast_of(world)
        for move in MOVES:
            end = world.road.moved(world.av, move)
            if end is None or forecast.fixed >> end & 1:
                continue
            own = Path(Kind.AV, world.road.cell(world.av), world.road.cell(end))
            hit = {
                world.movers[was]
                for was, now, kind in possible_steps(world, 1)[0]
                if touch(own, Path(kind, world.road.cell(was), world.road.cell(now)))
            }
            assert set(movers_that_may_hit(forecast, move)) == hit
            assert (guarantee(forecast, 1, first=move).ticks == 0) is bool(hit)
