"""What is said of the time ahead holds when the road is really driven, tick by tick, as was claimed."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace

import pytest

from sim.actions import Drive, Remove, Set, SetMode, Where
from sim.config import Config
from sim.explain import QuestionError
from sim.explain.ahead import arrival, crash_ahead, stuck_ahead
from sim.explain.own_move import own_move
from sim.explain.planners import planners_here
from sim.explain.repair import repair, without
from sim.explain.safe_move import safe_move
from sim.repetition import NOTHING_KEPT
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step
from sim.types import MOVES, Mode, Move, Outcome, kind_of
from sim.world import World


def moments(count: int, **parts: object) -> Iterator[Timeline]:
    """Running sessions on crowded roads where nothing is left to chance, somewhere on their way."""
    draw = random.Random(7)
    while count:
        config = Config(
            seed=draw.randrange(10**6),
            columns=6,
            rows=16,
            planner=draw.choice(["rules", "priority", "astar", "bfs"]),
            potholes=draw.choice([10, 22]),
            vehicles=draw.choice([8, 16]),
            attentive=draw.choice([0.0, 1.0]),
        ).with_parts(**parts)
        timeline = Timeline(config)
        for _ in range(draw.randrange(8)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING:
            count -= 1
            yield timeline


def driven(timeline: Timeline) -> World:
    """How the present episode of a session ends when it goes on; the session itself stays as it is."""
    return ended(timeline.state)


def ended(state: SimState) -> World:
    """How an episode ends from a state on."""
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state.world


def some_way(state: SimState, arrive: bool) -> bool:
    """Whether some way arrives, or keeps clear to the end: every cell tried, tick by tick, by the rules.

    Only for roads on which nobody reacts to the ego: what others do is then the same whatever it does.
    """
    worlds = {state.world.av: state.world}
    dynamics = state.config.ego_dynamics(state.world.road)
    while worlds:
        after: dict[int, World] = {}
        for world in worlds.values():
            for move in MOVES:
                if dynamics.target(world.av, move) is None:
                    continue
                there = next_world(world, (move,), state.config)
                if there.outcome is Outcome.SUCCESS or (there.outcome is Outcome.STUCK and not arrive):
                    return True
                if there.outcome is Outcome.RUNNING:
                    after[there.av] = there
        worlds = after
    return False


def test_a_move_is_safe_where_it_meets_nothing_and_driving_on_does_not_crash() -> None:
    verdicts = set()
    for timeline in moments(25):
        for move in Move:
            found = safe_move(timeline, move)
            state = timeline.state
            if state.config.ego_dynamics(state.world.road).target(state.world.av, move) is None:
                assert found.off_road
                assert not found.safe
                continue
            there = next_world(state.world, (move,), state.config)
            if there.outcome is Outcome.CRASH:
                assert found.hit == there.cause
                assert not found.safe
            elif there.outcome is Outcome.RUNNING:
                after = replace(state.with_ego(watch=NOTHING_KEPT), world=there)
                assert found.safe is (ended(after).outcome is not Outcome.CRASH)
            verdicts.add(found.safe)
    assert verdicts == {True, False}


def test_an_arrival_is_when_it_is_told_to_be() -> None:
    arrived = 0
    for timeline in moments(30):
        found, end = arrival(timeline), driven(timeline)
        if end.outcome is Outcome.SUCCESS:
            arrived += 1
            ticks = end.tick - timeline.tick
            assert found.confidence.arrives == 1.0
            assert found.confidence.arrival_ticks == (ticks, ticks)
            continue
        assert found.confidence.arrives == 0.0
        if found.instead is not None:
            going = timeline.copy()
            going.apply(1, [Set(parameter="planner", value=found.instead.planner)])
            assert driven(going).outcome is Outcome.SUCCESS
        if found.plan is not None:
            world = timeline.state.world
            for move in found.plan:
                world = next_world(world, (move,), timeline.config)
            assert world.outcome is Outcome.SUCCESS
    assert 0 < arrived < 30


def test_a_crash_ahead_comes_and_what_avoids_it_leaves_a_way() -> None:
    ahead = avoided = 0
    for timeline in moments(60, attentive=0.0, planner="priority", vehicles=20):
        found, end = crash_ahead(timeline), driven(timeline)
        assert (found.last is not None) is (end.outcome is Outcome.CRASH)
        if found.last is None:
            continue
        ahead += 1
        assert found.foresight.story.cause == end.cause
        last = found.avoidable.last
        if last is None:
            assert found.avoidable.proved
            assert not some_way(timeline.state, arrive=False)
            continue
        avoided += 1
        assert last.tick >= timeline.tick
        going = timeline.copy()
        while going.tick < last.tick:
            going.advance()
        state = going.state
        there = next_world(state.world, (last.instead,), state.config)
        assert there.outcome is not Outcome.CRASH
        assert some_way(SimState(state.config, there), arrive=False)
    assert ahead > 3
    assert avoided > 0


def test_stuck_is_where_driving_on_ends_so_or_no_way_leads_on() -> None:
    told = set()
    for timeline in moments(40, attentive=0.0):
        found, end = stuck_ahead(timeline), driven(timeline)
        way = some_way(timeline.state, arrive=True)
        if found.outlook is not None:
            assert found.outlook.open is way
        assert found.stuck is (end.outcome is Outcome.STUCK or not way)
        told.add(found.stuck)
    assert told == {True, False}


@pytest.mark.parametrize("aim", ["arrive", "avoid"])
def test_a_change_that_helps_does_and_no_smaller_one_does(aim: str) -> None:
    helped = 0
    wanted = {"arrive": (Outcome.SUCCESS,), "avoid": (Outcome.SUCCESS, Outcome.STUCK)}[aim]
    for timeline in moments(40, attentive=0.0, planner="priority"):
        found = repair(timeline, aim)  # type: ignore[arg-type]
        assert found.reached is (driven(timeline).outcome in wanted)
        if found.removed:
            helped += 1
            going = timeline.copy()
            going.apply(
                1,
                [Remove(kind=kind_of(id).value, count=1, where=Where(id=id)) for id in found.removed],
            )
            assert driven(going).outcome in wanted
            for id in found.removed if len(found.removed) > 1 else ():
                rest = tuple(each for each in found.removed if each != id)
                assert ended(without(timeline.state, rest)).outcome not in wanted
        if found.planner is not None:
            going = timeline.copy()
            going.apply(1, [Set(parameter="planner", value=found.planner.planner)])
            assert driven(going).outcome in wanted
    assert helped > 0


def test_every_planner_does_here_what_it_does_when_it_is_set() -> None:
    for timeline in moments(12):
        found = planners_here(timeline)
        for drive in (found.own, *found.others):
            going = timeline.copy()
            going.apply(1, [Set(parameter="planner", value=drive.planner)])
            first = going.advance().decision
            assert first is not None
            assert first.move is drive.first
            end = driven(going)
            story = drive.foresight.story
            assert (end.outcome, end.ended) == (story.outcome, story.end)
        best = found.best[0].foresight
        assert all(best.arrives >= each.foresight.arrives for each in found.others)


def test_what_a_planner_would_have_done_is_what_it_does_from_there() -> None:
    differs = 0
    for timeline in moments(15):
        before = timeline.state
        move = next(each for each in (Move.LEFT, Move.RIGHT, Move.STAY) if _possible(before, each))
        timeline.apply(1, [SetMode(mode=Mode.MANUAL), Drive(move=move)])
        asked_at = timeline.tick
        timeline.advance()
        found = own_move(timeline)
        assert found.by_person
        assert found.made.tick == asked_at
        would = step(before)
        assert would.decision is not None
        assert found.would is would.decision.move
        end = ended(would.state)
        story = found.after_would.story
        assert (end.outcome, end.ended) == (story.outcome, story.end)
        differs += not found.same
    assert differs > 0


def test_nothing_lies_ahead_of_an_episode_that_has_ended() -> None:
    timeline = next(moments(1))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    for ask in (arrival, crash_ahead, stuck_ahead, planners_here):
        with pytest.raises(QuestionError, match="nothing_ahead"):
            ask(timeline)


def _possible(state: SimState, move: Move) -> bool:
    return state.config.ego_dynamics(state.world.road).target(state.world.av, move) is not None
