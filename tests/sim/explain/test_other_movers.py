"""What is said of other road users is so: each claim is held to a tick that is run by other code."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from sim.config import Config
from sim.explain import QuestionError
from sim.explain.other_movers import (
    LOOK_AHEAD,
    LOOK_BACK,
    MoverMove,
    MoverReason,
    latest_move,
    mover_move,
    mover_way,
)
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from sim.world import World
from tests.support.refused import answered
from tests.support.roads import road, run_on
from tests.support.twin import braked_bodies, moved_bodies, position


def drives(count: int, seed: int = 0) -> Iterator[Timeline]:
    draw = random.Random(seed)
    for _ in range(count):
        columns, rows = draw.choice([4, 6, 8]), draw.choice([8, 14])
        config = Config(
            seed=draw.randrange(2**32),
            columns=columns,
            rows=rows,
            vehicles=draw.choice([4, columns * rows // 5]),
            potholes=draw.choice([0, 6]),
            barriers=draw.choice([0, 4]),
            pedestrians=draw.choice([0, 4]),
            courtesy=draw.choice([0.0, 0.0, 1.0]),
            attentive=draw.choice([0.0, 1.0]),
            planner=draw.choice(["priority", "rules"]),
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(2, rows)):
            timeline.advance()
        yield timeline


def goes(
    world: World, id: str, to: tuple[int, int], *, courteous: bool, attentive: bool
) -> tuple[object, str]:
    """Where the twin moves a mover, and which way it heads then; the ego goes `to`."""
    now = position(world)
    near = {
        body.cell for body in now.bodies if body.cell[1] == now.av[1] and abs(body.cell[0] - now.av[0]) == 1
    }
    later = moved_bodies(now, near if courteous else ())
    if to == now.av and attentive:
        later = braked_bodies(now, later, near)
    (body,) = (body for body in later if body.id == id)
    return body.cell, body.heading


def told(timeline: Timeline, seed: int) -> Iterator[tuple[MoverMove, tuple[int, int]]]:
    """What is said of some movers of past ticks, with where the ego went."""
    draw = random.Random(seed)
    for tick in range(timeline.tick):
        state = timeline.at(tick)
        if state.world.outcome is not Outcome.RUNNING or not state.world.movers:
            continue
        after = timeline.led_to(state).state.world
        made = next(move for move in Move if state.world.road.moved(state.world.av, move) == after.av)
        for id in draw.sample(sorted(state.world.movers.values()), min(4, len(state.world.movers))):
            yield mover_move(state, (made,), id), after.road.cell(after.av)


def test_what_moved_a_mover_is_so_when_a_twin_runs_the_tick() -> None:
    reasons = dict.fromkeys(MoverReason, 0)
    for number, timeline in enumerate(drives(40)):
        config = timeline.state.config
        react = {"courteous": config.courtesy > 0, "attentive": config.attentive > 0}
        for found, to in told(timeline, number):
            world = found.before.world
            reasons[found.reason] += 1
            real = found.now.cell, found.now.heading
            assert goes(world, found.id, to, **react) == real
            if found.ids and not found.together:
                for id in found.ids:
                    assert goes(world.without([id]), found.id, to, **react) != real
            elif found.ids:
                assert goes(world.without(found.ids), found.id, to, **react) != real
                for id in found.ids:
                    assert goes(world.without([id]), found.id, to, **react) == real
            if found.ids and found.otherwise is not None:
                gone = found.ids if found.together else found.ids[:1]
                then = goes(world.without(gone), found.id, to, **react)
                assert then == (found.otherwise.cell, found.otherwise.heading)
            if found.reason is MoverReason.GIVES_WAY:
                assert goes(world, found.id, to, courteous=False, attentive=react["attentive"]) != real
            if found.reason is MoverReason.BRAKES:
                assert goes(world, found.id, to, courteous=react["courteous"], attentive=False) != real
            if found.reason is MoverReason.FREE:
                assert (found.move, found.turned) == (Move(str(found.was.heading)), False)
            if found.reason is MoverReason.EDGE:
                assert found.was.cell[0] == (0 if found.was.heading == "left" else world.road.columns - 1)
    rare = {MoverReason.GIVES_WAY, MoverReason.BRAKES, MoverReason.HELD}
    assert all(reasons[each] >= 5 for each in MoverReason if each not in rare), reasons
    assert sum(reasons[each] for each in rare) > 0


def test_a_mover_goes_where_it_was_said_to_go() -> None:
    turns = 0
    for timeline in drives(25, seed=1):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        for id in sorted(timeline.state.world.movers.values())[:4]:
            way = mover_way(timeline, id)
            copy = timeline.copy()
            for number, move in enumerate(way.steps):
                was = copy.state.world.find(id)
                copy.advance()
                now = copy.state.world.find(id)
                assert was is not None
                assert now is not None
                assert now.cell[0] - was.cell[0] == {Move.LEFT: -1, Move.RIGHT: 1, Move.STAY: 0}[move]
                first_turn = way.turn is not None and way.turn.tick == timeline.tick + number
                if first_turn:
                    assert was.heading != now.heading
                    turns += 1
                elif way.turn is None or number < way.turn.tick - timeline.tick:
                    assert was.heading == now.heading
            assert len(way.steps) == LOOK_AHEAD or way.ended
    assert turns > 20


def test_the_latest_tick_with_a_move_is_found_and_others_are_named() -> None:
    for timeline in drives(20, seed=2):
        for id in sorted(timeline.state.world.movers.values())[:3]:
            for move in (Move.LEFT, Move.RIGHT, Move.STAY):
                found, code = answered(latest_move, timeline, id, move)
                if found is None:
                    assert code in ("never_did", "not_there", "nothing_yet")
                    continue
                assert found.move is move
                assert timeline.tick - found.tick <= LOOK_BACK
                for tick in range(found.tick + 1, timeline.tick):
                    state = timeline.at(tick)
                    if state.world.outcome is Outcome.RUNNING and state.world.find(id) is not None:
                        assert latest_move(timeline, id, None, tick).move is not move


@pytest.mark.parametrize(
    ("rows", "reason", "ids"),
    [
        (("......", ">.....", "......", "..A..."), MoverReason.FREE, ()),
        (("......", "<.....", "......", "..A..."), MoverReason.EDGE, ()),
        (("......", ">#....", "......", "..A..."), MoverReason.BLOCKED, ("barrier-1",)),
        (("......", ".>.<..", "......", "..A..."), MoverReason.BLOCKED, ("vehicle-2",)),
        (("......", "}.....", "......", "..A..."), MoverReason.HELD, ("pothole-1",)),
        (("......", ").....", "......", "..A..."), MoverReason.RESTS, ()),
    ],
)
def test_each_reason_is_told(rows: tuple[str, ...], reason: MoverReason, ids: tuple[str, ...]) -> None:
    state = run_on(road(*rows))
    id = "pedestrian-1" if reason is MoverReason.RESTS else "vehicle-1"
    found = mover_move(state, (Move.STAY,), id)
    assert (found.reason, found.ids) == (reason, ids)


def test_what_does_not_move_or_is_not_there_is_refused() -> None:
    state = run_on(road("......", "o.....", "......", "..A..."))
    for id, code in (("pothole-1", "never_moves"), ("vehicle-9", "not_there")):
        with pytest.raises(QuestionError) as refused:
            mover_move(state, (Move.STAY,), id)
        assert refused.value.code == code
