"""What a search for a goal claims is so: each claim is checked anew, by certificates and by driving."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from sim.actions import Add, Remove, Scenario, Set
from sim.config import Config
from sim.explain.episode_rollout import rollout
from sim.goals import Budget, CancelledError, Finding, find_goal
from sim.goals.measure import measure, room
from sim.oracle import Blocked, Drivable, certify
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState, next_episode
from sim.transition import next_world, step
from sim.types import KINDS, Kind, Mode, Outcome
from tests.sim.goals.plain_room import plain_room

SEEDS = range(20)
LAYOUTS = (None, None, "walls", "maze", "crossing")


def road(seed: int, **parts: Any) -> SimState:
    """A road of one of the families, a few ticks in on every third."""
    state = SimState.start(Config(seed=seed, **{"layout": LAYOUTS[seed % len(LAYOUTS)], **parts}))
    for _ in range(3 if seed % 3 == 0 else 0):
        state = step(state).state
    return state


def applied(state: SimState, found: Finding) -> SimState:
    """The road that the actions lead to."""
    for action in found.actions:
        state = apply(state, action).state
    return state


def outcome_of(state: SimState, planner: str) -> tuple[Outcome, int]:
    """How a planner's drive ends, and after how many ticks."""
    driven = replace(state, config=replace(state.config, planner=planner)).with_ego(mode=Mode.AUTO, queue=())
    last = [tick.state for _, tick in rollout(driven)][-1]
    return last.world.outcome, last.world.tick - state.world.tick


def check_claims(state: SimState, found: Finding) -> SimState:
    """Check what holds for every finding; returns the road that it leads to."""
    after = applied(state, found)
    assert after.world.digest() == found.state.world.digest()
    certificate = certify(after)
    assert isinstance(certificate, Drivable)
    assert certificate.ticks == found.after.ticks
    world = after.world
    for move in certificate.plan:
        world = next_world(world, (move,), after.config)
    assert world.outcome is Outcome.SUCCESS
    for drive in found.drives:
        assert (drive.outcome, drive.ticks) == outcome_of(after, drive.planner)
    for drive in found.drives_before:
        assert (drive.outcome, drive.ticks) == outcome_of(state, drive.planner)
    return after


@pytest.mark.parametrize("seed", SEEDS)
def test_a_harder_road_has_less_room_and_can_be_driven(seed: int) -> None:
    state = road(seed)
    found = find_goal(state, "harder")
    after = check_claims(state, found)
    assert all(isinstance(action, Add) for action in found.actions)
    assert found.before is not None
    assert found.after.ticks >= found.before.ticks
    assert found.after.room <= 0.88 * found.before.room
    (was,), (now,) = found.drives_before, found.drives
    assert not now.arrives or now.ticks >= was.ticks
    horizon = found.before.horizon
    assert found.before.room == pytest.approx(plain_room(state, horizon))
    assert found.after.room == pytest.approx(plain_room(after, horizon))


@pytest.mark.parametrize("seed", SEEDS)
def test_an_easier_road_has_more_room_and_only_lacks_things(seed: int) -> None:
    state = road(seed)
    found = find_goal(state, "easier")
    check_claims(state, found)
    assert all(isinstance(action, Remove) for action in found.actions)
    assert found.before is not None
    assert found.after.ticks <= found.before.ticks
    assert found.after.room > found.before.room
    (was,), (now,) = found.drives_before, found.drives
    assert now.arrives or not was.arrives


@pytest.mark.parametrize("goal", ["harder", "easier"])
def test_degrees_go_further_in_order(goal: Any) -> None:
    rooms = [find_goal(road(5), goal, degree=degree).after.room for degree in ("little", None, "lot")]
    assert sorted(rooms, reverse=goal == "harder") == rooms
    assert len(set(rooms)) == 3


@pytest.mark.parametrize("seed", SEEDS)
def test_all_lanes_but_one_are_blocked(seed: int) -> None:
    state = road(seed)
    found = find_goal(state, "one_lane_free")
    after = check_claims(state, found)
    assert found.row is not None
    assert found.lane is not None
    world = after.world
    in_row = [column for column in range(world.road.columns) if not is_fixed(after, column, found.row)]
    assert in_row == [found.lane - 1]
    assert {action.kind for action in found.actions if isinstance(action, Add)} == {"barrier"}


def is_fixed(state: SimState, column: int, row: int) -> bool:
    """Whether a cell holds a pothole or a barrier."""
    return bool(state.world.fixed >> state.world.road.index((column, row)) & 1)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_surprise_is_another_kind_of_road(seed: int) -> None:
    state = road(seed)
    found = find_goal(state, "surprise")
    after = check_claims(state, found)
    assert isinstance(found.actions[0], Scenario)
    assert after.config.layout != state.config.layout
    assert after.config.planner == state.config.planner
    assert after.world.episode > state.world.episode


@pytest.mark.parametrize("seed", range(0, 20, 4))
def test_a_hard_road_is_no_straight_one_and_fails_a_planner(seed: int) -> None:
    state = road(seed)
    found = find_goal(state, "hard_but_solvable")
    after = check_claims(state, found)
    assert found.after.ticks >= after.world.road.rows
    assert any(not drive.arrives for drive in found.drives)
    assert any(drive.arrives for drive in found.drives)


@pytest.mark.parametrize(
    ("can", "cannot"), [("astar", "priority"), ("rules", "priority"), ("bfs", "priority")]
)
@pytest.mark.parametrize("seed", range(0, 20, 3))
def test_a_separating_road_is_driven_by_the_one_and_not_by_the_other(
    seed: int, can: str, cannot: str
) -> None:
    state = road(seed)
    found = find_goal(state, "separates", planners=(can, cannot))
    after = check_claims(state, found)
    assert outcome_of(after, can)[0] is Outcome.SUCCESS
    assert outcome_of(after, cannot)[0] in (Outcome.STUCK, Outcome.CRASH)
    assert isinstance(found.actions[-1], Set)


@pytest.mark.parametrize("goal", ["harder", "easier", "one_lane_free", "surprise", "hard_but_solvable"])
def test_the_same_moment_finds_the_same(goal: Any) -> None:
    first, second = (find_goal(road(7), goal) for _ in range(2))
    assert first == second
    assert first.actions != find_goal(road(8), goal).actions


def test_a_blocked_road_becomes_easier_by_what_blocks_it() -> None:
    state = road(1, vehicles=0, potholes=0)
    for lane in range(1, 9):
        action = Add(kind="barrier", count=1, where=where_in(lane, 12))
        state = apply(state, action).state
    assert isinstance(certify(state), Blocked)
    found = find_goal(state, "easier")
    check_claims(state, found)
    assert found.before is None
    assert found.after.ticks >= 29
    with pytest.raises(EditError) as refused:
        find_goal(state, "harder")
    assert refused.value.code == "goal_no_way"


def where_in(lane: int, row: int) -> Any:
    """A cell as a place."""
    from sim.actions import Where

    return Where(cell=(lane - 1, row))


def test_an_empty_road_gets_no_easier() -> None:
    with pytest.raises(EditError) as refused:
        find_goal(road(1, vehicles=0, potholes=0), "easier")
    assert refused.value.code == "goal_not_found"
    assert refused.value.facts["tried"] == 1


def test_a_search_ends_with_its_budget() -> None:
    budget = Budget(left=600)
    with pytest.raises(EditError) as refused:
        find_goal(road(1), "separates", planners=("rules", "astar"), budget=budget)
    assert refused.value.code == "goal_not_found"
    assert 0 <= budget.left < 600
    assert refused.value.facts["driven"] == budget.driven > 0


def test_the_largest_road_is_not_searched_for_long() -> None:
    budget = Budget()
    with pytest.raises(EditError):
        find_goal(SimState.start(Config(columns=64, rows=512)), "hard_but_solvable", budget=budget)
    assert budget.tried <= 20


def test_a_search_ends_where_nobody_waits() -> None:
    budget = Budget(cancelled=lambda: budget.tried >= 5)
    with pytest.raises(CancelledError):
        find_goal(road(1), "harder", budget=budget)
    assert budget.tried == 5


@pytest.mark.parametrize(
    ("planners", "code"),
    [(("astar", "astar"), "goal_same_planner"), (("astar", "dwa"), "scenario_not_available")],
)
def test_planners_that_cannot_be_told_apart(planners: tuple[str, str], code: str) -> None:
    with pytest.raises(EditError) as refused:
        find_goal(road(1), "separates", planners=planners)
    assert refused.value.code == code


def test_nothing_is_changed_on_a_road_that_is_gone() -> None:
    state = road(2, layout=None)
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    for goal in ("harder", "easier", "one_lane_free"):
        with pytest.raises(EditError) as refused:
            find_goal(state, goal)  # type: ignore[arg-type]
        assert refused.value.code == "goal_after_end"
    check_claims(state, find_goal(state, "surprise"))
    assert measure(next_episode(state)[0], Budget()) is not None


def test_room_is_that_of_plain_sets() -> None:
    for seed in range(6):
        state = road(seed)
        for horizon in (1, 12, 34, 50):
            assert room(state, horizon) == pytest.approx(plain_room(state, horizon))


def test_what_is_added_are_things_of_the_road() -> None:
    kinds = {action.kind for seed in range(4) for action in find_goal(road(seed), "harder").actions}  # type: ignore[union-attr]
    assert kinds <= {kind.value for kind in KINDS if kind is not Kind.AV}
