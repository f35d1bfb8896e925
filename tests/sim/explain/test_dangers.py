"""What is most dangerous, against moves that are really made; the worst case, against what comes."""

from __future__ import annotations

import pytest

from sim.actions import Drive, SetMode
from sim.config import Config
from sim.explain.dangers import HORIZON, dangers, worst_case
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Kind, Mode, Move, Outcome

SEEDS = range(14)


def begun(seed: int, ticks: int = 5, **more: object) -> Timeline:
    config = Config(columns=6, rows=24, vehicles=14, pedestrians=4, potholes=4, seed=seed)
    timeline = Timeline(config.with_parts(**more))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def end_of(timeline: Timeline) -> Outcome:
    """How it stands now."""
    return timeline.state.world.outcome


def hit_by(timeline: Timeline, move: Move) -> tuple[int, tuple[str, ...]] | None:
    """What a person hits who asks for a move and then for straight on, where nothing is held back."""
    driven = timeline.copy()
    config = driven.state.config.ego_dynamics(driven.state.world.road)
    for ticks in range(1, HORIZON + 1):
        now = move if ticks == 1 or move is Move.STAY else Move.FORWARD
        before = driven.state
        end = config.target(before.world.av, now)
        if end is None:
            return None
        driven.apply(1, (SetMode(mode=Mode.MANUAL), Drive(move=now)))
        driven.advance()
        if driven.state.world.outcome is not Outcome.RUNNING:
            cause = driven.state.world.cause
            return None if cause is None else (ticks, cause.ids)
        if driven.state.world.av != end:  # held back: something is in the way of it
            return ticks, ()
    return None


@pytest.mark.parametrize("seed", SEEDS)
def test_moves_that_are_told_to_meet_something_are_held_back_or_crash_then(seed: int) -> None:
    timeline = begun(seed)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        with pytest.raises(QuestionError):
            dangers(timeline)
        return
    found = dangers(timeline)
    met = {move: each.ticks for each in found.found for move in each.moves}
    every = {move for each in found.found for move in each.all_moves}
    for move in Move:
        really = hit_by(timeline, move)
        if move in met:
            assert really is not None
            assert really[0] == met[move]
        elif move not in every:
            assert really is None


@pytest.mark.parametrize("seed", SEEDS)
def test_what_the_drive_itself_hits_comes_first(seed: int) -> None:
    timeline = begun(seed, 3, sensor="radar", weather="fog")
    if timeline.state.world.outcome is not Outcome.RUNNING:
        return
    found = dangers(timeline)
    for _ in range(HORIZON):
        if timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
    world = timeline.state.world
    if world.outcome is Outcome.CRASH and world.cause is not None:
        assert found.found[0].id in world.cause.ids
        assert found.found[0].hit_after is not None
    else:
        assert all(each.hit_after is None for each in found.found)


def test_those_of_one_kind_are_among_all() -> None:
    timeline = begun(2)
    every = [each.id for each in dangers(timeline).found]
    cars = [each.id for each in dangers(timeline, Kind.VEHICLE).found]
    assert cars == [id for id in every if id.startswith("vehicle")]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_worst_case_is_no_better_than_what_comes(seed: int) -> None:
    timeline = begun(seed, 4)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        return
    shorter, longer = worst_case(timeline, 1), worst_case(timeline, 6)
    assert longer.may_crash or not shorter.may_crash
    for _ in range(6):
        if timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
    if end_of(timeline) is Outcome.CRASH:
        assert longer.sure_after is not None
        assert longer.sure_after.ticks < 6 or not longer.sure_after.to_the_end or not longer.may_crash
        assert longer.by_rules.crashes > 0.0
    else:
        assert longer.by_rules.crashes == 0.0


def test_the_worst_case_differs_from_road_to_road() -> None:
    found = [
        worst_case(begun(seed), 6) for seed in SEEDS if begun(seed).state.world.outcome is Outcome.RUNNING
    ]
    assert {each.may_crash for each in found} == {True, False} or any(each.may_hit for each in found)
