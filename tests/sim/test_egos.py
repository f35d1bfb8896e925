"""Several egos on one road: none ever drives into or through another, whoever plans."""

from __future__ import annotations

from itertools import combinations
from random import Random

import pytest

from sim.config import Config
from sim.decide import deciding_order
from sim.forecast import Forecast, StepVerdict, predict
from sim.judge import collisions
from sim.perceive import perceive_truth
from sim.rules.ego_contacts import REACH, ego_contacts
from sim.search.reachability import reachability
from sim.search.reactive import ReactiveSearch
from sim.session.serialization import Packer, Unpacker
from sim.session.timeline import Timeline
from sim.state import SimState, StepResult
from sim.transition import step, transition
from sim.types import Kind, Mode, Move, Outcome
from sim.validation import validate_world
from sim.world import World
from sim.world.grid import bits
from tests.support import twin
from tests.support.roads import road, run_on
from tests.support.two_egos import FIRST, SECOND, drawn

PLANNERS = {"rules": 300, "priority": 300, "exact": 60, "dijkstra": 20, "astar": 20}
"""Roads that each planner drives."""


def overlap_at(cell: tuple[int, int], own: Move, other: Move, share: int, of: int) -> bool:
    """Whether two egos overlap at a share of the tick, by where their centres are then; in 1/100 cells."""
    across = 100 * of * cell[0] + 100 * share * (other.offset[0] - own.offset[0])
    along = 100 * of * cell[1] + 100 * share * (other.offset[1] - own.offset[1])
    return abs(across) < 32 * of and abs(along) < 66 * of


def test_the_table_of_contacts_is_what_is_seen_at_many_times() -> None:
    near, touching = range(-REACH - 1, REACH + 2), 0
    for cell in ((across, along) for along in near for across in near if (across, along) != (0, 0)):
        for own in Move:
            for other in Move:
                touch = any(overlap_at(cell, own, other, share, 400) for share in range(401))
                told = (own.offset, other.offset) in ego_contacts("swept").get(cell, ())
                assert told is touch, (cell, own, other)
                touching += touch
    assert touching > 40


@pytest.mark.parametrize(
    ("cell", "own", "other"),
    [
        ((1, 0), Move.FORWARD_RIGHT, Move.FORWARD_LEFT),
        ((1, 0), Move.RIGHT, Move.LEFT),
        ((0, -1), Move.FORWARD, Move.STAY),
        ((-1, 0), Move.FORWARD_LEFT, Move.FORWARD_RIGHT),
        ((-1, -1), Move.FORWARD_LEFT, Move.RIGHT),
    ],
)
def test_moves_that_meet(cell: tuple[int, int], own: Move, other: Move) -> None:
    assert (own.offset, other.offset) in ego_contacts("swept")[cell]


@pytest.mark.parametrize("rule", ["swept", "cell"])
def test_contacts_are_the_same_seen_from_the_other(rule: str) -> None:
    table = ego_contacts(rule)  # type: ignore[arg-type]
    for (across, along), pairs in table.items():
        assert {(other, own) for own, other in pairs} == table[-across, -along]


def test_ego_that_stands_is_touched_in_its_own_cell_alone() -> None:
    for cell, pairs in ego_contacts("swept").items():
        assert {own for own, other in pairs if other == (0, 0)} <= {cell}


def egos_apart(before: World, after: World, *, swept: bool = True) -> bool:
    """Whether no two egos met in a tick, by rectangles that glide or by cells, without the table."""
    cells = [
        tuple(before.road.cell(index) for index in pair) for pair in zip(before.avs, after.avs, strict=True)
    ]
    for one, other in combinations(cells, 2):
        if swept and twin.together(one, twin.EGO, other, twin.EGO):  # type: ignore[arg-type]
            return False
        if one[1] == other[1] or (one == other[::-1] and one[0] != one[1]):
            return False
    return True


def driven(state: SimState, ticks: int = 120) -> list[tuple[SimState, StepResult]]:
    """Every tick to the end of the episode."""
    seen = []
    for _ in range(ticks):
        if state.world.outcome is not Outcome.RUNNING:
            break
        tick = step(state)
        seen.append((state, tick))
        state = tick.state
    return seen


@pytest.mark.parametrize("planner", PLANNERS)
def test_nobody_drives_into_a_parked_ego(planner: str) -> None:
    random, arrived = Random(f"parked {planner}"), 0
    for _ in range(PLANNERS[planner]):
        state = drawn(random, planner).with_ego(SECOND, mode=Mode.MANUAL)
        parked = state.world.avs[1]
        for before, tick in driven(state):
            after = tick.state.world
            assert after.avs[1] == parked
            assert egos_apart(before.world, after)
            if after.cause is not None:
                assert after.cause.kind is not Kind.AV
        assert validate_world(after) == ()
        arrived += after.outcome is Outcome.SUCCESS
    assert arrived > PLANNERS[planner] / 2


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize("collision", ["swept", "cell"])
def test_egos_that_drive_never_meet(planner: str, collision: str) -> None:
    random, arrived, together = Random(f"driving {planner} {collision}"), 0, 0
    roads = PLANNERS[planner] // 2
    for _ in range(roads):
        state = drawn(random, planner, random.choice((2, 2, 3)), collision=collision)
        for before, tick in driven(state):
            after = tick.state.world
            assert egos_apart(before.world, after, swept=collision == "swept")
            together += any(
                after.road.columns + 1 >= abs(one - other) for one, other in combinations(after.avs, 2)
            )
        assert validate_world(after) == ()
        arrived += after.outcome is Outcome.SUCCESS
    assert arrived > roads / 3
    assert together > roads


def test_egos_meet_no_other_where_movers_are_left_to_chance() -> None:
    random = Random("chance")
    for _ in range(80):
        state = drawn(random, "rules", 3, courtesy=0.4, attentive=0.5)
        for before, tick in driven(state):
            assert egos_apart(before.world, tick.state.world)


def test_ego_that_would_be_hit_from_beside_is_braked_for_and_foreseen() -> None:
    """A mover in front of a parked ego keeps its cell and heading, in the forecast as in the world."""
    world = road(".....", ".....", "..>A.", ".....", "..A..")
    state = run_on(world, attentive=1.0, planner="rules").with_ego(FIRST, mode=Mode.MANUAL)
    forecast = predict(perceive_truth(world, state.config, 1), 12)
    for ahead in range(12):
        state = transition(state, {}).state
        assert state.world.movers == forecast.slices.movers(ahead) == world.movers
        assert state.world.right == forecast.slices[ahead].right


def test_forecast_with_a_parked_ego_is_what_happens() -> None:
    """What is said of every step of the first ticks is what the judge says of it."""
    random, said = Random("foreseen"), set()
    for _ in range(150):
        state = drawn(random, "rules").with_ego(SECOND, mode=Mode.MANUAL)
        for before, _ in driven(state, 6):
            world = before.world
            forecast = predict(perceive_truth(world, state.config, 0, {}, {1}), 3)
            free = forecast.own_steps()
            for move, board in zip(Move, free, strict=True):
                end = world.road.moved(world.av, move)
                verdict, ids = forecast.check_step(world.av, end)
                said.add(verdict)
                assert bool(board) is (verdict is StepVerdict.FREE)
                if end is None:
                    continue
                after = transition(before, {FIRST: move}).state.world
                motion = state.config.ego_dynamics(world.road)
                met = [cause for cause in collisions(world, after, motion) if cause.ego == FIRST]
                met += [cause for cause in collisions(world, after, motion) if cause.kind is Kind.AV]
                assert bool(met) is verdict.blocks
                assert (SECOND in ids) is any(cause.kind is Kind.AV for cause in met)
    assert StepVerdict.EGO_STAYS in said


def announced(rows: tuple[str, ...], move: Move) -> Forecast:
    """The forecast of the second ego, where the first has announced a move."""
    world = road(*rows)
    return predict(perceive_truth(world, run_on(world).config, 1, {0: move}), 4)


@pytest.mark.parametrize(
    ("move", "own", "verdict"),
    [
        (Move.STAY, Move.FORWARD, StepVerdict.EGO_STAYS),
        (Move.FORWARD, Move.FORWARD, StepVerdict.FREE),
        (Move.LEFT, Move.FORWARD, StepVerdict.FREE),
        (Move.LEFT, Move.FORWARD_LEFT, StepVerdict.EGO_ENTERS),
    ],
)
def test_what_is_said_of_an_ego_ahead(move: Move, own: Move, verdict: StepVerdict) -> None:
    forecast = announced((".....", ".....", "..A..", "..A..", "....."), move)
    met = (FIRST,) if verdict.blocks else ()
    assert forecast.check_step(forecast.ego, forecast.road.moved(forecast.ego, own)) == (verdict, met)
    assert forecast.meets_ego(own) is verdict.blocks


def test_what_is_said_of_an_ego_beside() -> None:
    rows = (".....", ".....", ".AA..", ".....", ".....")
    swaps = announced(rows, Move.RIGHT)
    assert swaps.check_step(swaps.ego, swaps.ego - 1) == (StepVerdict.EGO_SWAPS, (FIRST,))
    crosses = announced(rows, Move.FORWARD_RIGHT)
    assert crosses.check_step(crosses.ego, crosses.ego - 6) == (StepVerdict.EGO_CROSSES, (FIRST,))
    assert crosses.check_step(crosses.ego, crosses.ego - 5) == (StepVerdict.EGO_ENTERS, (FIRST,))


def test_sets_and_single_steps_agree_with_other_egos_on_the_road() -> None:
    random = Random("sets")
    for _ in range(60):
        state = drawn(random, "rules", 3)
        told = {1: random.choice(list(Move)), 2: random.choice(list(Move))}
        told = {n: m if state.world.road.moved(state.world.avs[n], m) else Move.STAY for n, m in told.items()}
        forecast = predict(perceive_truth(state.world, state.config, 0, told), 3)
        road_ = forecast.road
        for ahead in (0, 1, 2):
            for start in random.sample(range(road_.columns, road_.columns * road_.rows), 12):
                if start == forecast.ego and ahead == 0 and forecast.standing is not None:
                    continue
                ends = {road_.moved(start, move) for move in Move}
                free = {e for e in ends if e is not None and forecast.will_be_free(start, e, ahead)}
                assert set(bits(forecast.spread(1 << start, ahead))) == free
                for end in free:
                    assert forecast.spread_back(1 << end, ahead) >> start & 1


def test_search_with_reactions_and_search_by_sets_agree_past_a_parked_ego() -> None:
    random, found = Random("search"), 0
    for _ in range(60):
        state = drawn(random, "rules", attentive=1.0).with_ego(SECOND, mode=Mode.MANUAL)
        forecast = predict(perceive_truth(state.world, state.config, 0, {}, {1}), 40)
        by_sets = reachability(forecast, 1 << forecast.ego, 40).ticks
        reacting = ReactiveSearch(state.world, state.config, forecast)
        plan = reacting.plan(40)
        if plan is not None:
            found += 1
            after = state
            for move in plan:
                after = transition(after, {FIRST: move}).state
            assert after.world.outcome is Outcome.SUCCESS
        if by_sets is not None:
            assert plan is not None
            assert len(plan) <= by_sets
    assert found > 30


def test_parked_ego_in_a_gap_is_no_way_on() -> None:
    state = SimState.start(
        run_on(road("......", "......", "#A##.#", "......", "......", ".A....")).config.with_parts(
            planner="rules"
        ),
        road("......", "......", "#A##.#", "......", "......", ".A...."),
    ).with_ego(FIRST, mode=Mode.MANUAL)
    last = driven(state)[-1][1].state.world
    assert last.outcome is Outcome.SUCCESS
    assert last.episode_tick <= 9


def test_the_one_furthest_ahead_decides_first() -> None:
    assert deciding_order((30, 12, 25)) == [1, 2, 0]
    state = SimState.start(
        Config(columns=5, rows=6, vehicles=0, potholes=0),
        road(".....", ".....", ".....", "..A..", "..A..", "....."),
    )
    tick = step(state)
    assert [each.decision.move for each in tick.steps.values()] == [Move.FORWARD, Move.FORWARD]
    second = tick.steps[SECOND]
    assert [(other.id, other.move) for other in second.percept.egos] == [(FIRST, Move.FORWARD)]
    assert [(other.id, other.move) for other in tick.steps[FIRST].percept.egos] == [(SECOND, Move.STAY)]


def test_who_has_arrived_waits_for_the_others_and_for_none_that_is_parked() -> None:
    config = Config(columns=5, rows=8, vehicles=0, potholes=0)
    world = road(".....", "A....", ".....", ".....", ".....", ".....", "....A", ".....")
    both = driven(SimState.start(config, world))
    assert [tick.state.world.outcome for _, tick in both] == [Outcome.RUNNING] * 5 + [Outcome.SUCCESS]
    assert all(tick.state.world.avs[0] == 0 for _, tick in both)
    assert FIRST not in both[3][1].steps
    end = both[-1][1].state
    assert (end.ego(FIRST).metrics.steps, end.ego(SECOND).metrics.steps) == (1, 6)
    assert [end.ego(id).metrics.successes for id in (FIRST, SECOND)] == [1, 1]
    alone = driven(SimState.start(config, world).with_ego(SECOND, mode=Mode.MANUAL))
    assert [tick.state.world.outcome for _, tick in alone] == [Outcome.SUCCESS]


def test_a_crash_says_which_ego_it_was() -> None:
    world = road(".....", ".....", "...o.", "A..A.", ".....")
    state = run_on(world, planner="rules")
    state = SimState.start(state.config, world)
    tick = transition(state, {SECOND: Move.FORWARD})
    cause = tick.state.world.cause
    assert cause is not None
    assert (cause.ego, cause.ids) == (SECOND, ("pothole-1",))
    assert [(event.ego, event.move) for event in tick.events] == [(SECOND, Move.FORWARD)]


def test_each_ego_has_its_own_planner() -> None:
    world = road(".....", ".....", ".....", "A..A.", ".....")
    state = SimState.start(Config(columns=5, rows=5, planner="rules"), world, ["priority", None])
    decided = {id: each.decision.planner for id, each in step(state).steps.items()}
    assert decided == {FIRST: "priority", SECOND: "rules"}


def test_a_timeline_with_two_egos_replays_to_the_same_digests() -> None:
    random = Random("replayed")
    for planners in (["rules", "priority"], ["priority", "exact"], ["rules", "rules", "astar"]):
        start = drawn(random, "rules", len(planners))
        start = SimState.start(start.config, start.world, planners)
        if planners[0] == "priority":
            start = start.with_ego(SECOND, mode=Mode.MANUAL, queue=(Move.FORWARD, Move.LEFT, Move.STAY))
        timeline, seen = Timeline(start.config, start), []
        for _ in range(150):
            seen.append(timeline.state)
            timeline.advance()
        assert {state.world.episode for state in seen} > {1}
        assert all(len(state.world.avs) == len(planners) for state in seen)
        assert [*timeline.between(0, 150)] == seen
        twin_ = Timeline.made(*timeline.copy().parts())
        twin_.rewind(40)
        assert twin_.state == seen[40]
        for state in seen[40:]:
            assert twin_.state.world.digest() == state.world.digest()
            twin_.advance()
        for tick in (3, 17, 60):
            for id in timeline.state.egos:
                known = step(seen[tick]).steps.get(id)
                assert timeline.decision(tick, id) == (None if known is None else known.decision)


def test_states_with_several_egos_are_written_and_read() -> None:
    state = drawn(Random("written"), "rules", 3)
    state = SimState.start(state.config, state.world, ["priority", None, "exact"])
    for _ in range(6):
        state = step(state).state
    state = state.with_ego(SECOND, mode=Mode.MANUAL, queue=(Move.LEFT,), fault="broke")
    crashed = transition(state, dict.fromkeys(state.egos, Move.STAY)).state
    packer = Packer()
    numbers = [packer.run(each) for each in (state, crashed)]
    assert packer.planners() == {"rules", "priority", "exact"}
    runs = Unpacker(packer.packed()).runs
    assert [runs[number] for number in numbers] == [state, crashed]
