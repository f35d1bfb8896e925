"""Who was swayed by the ego, against why movers went as they did; what made trouble, against runs without."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from sim.config import Config
from sim.explain.episode_rollout import drive
from sim.explain.influence import influence, trouble
from sim.explain.other_movers import MoverReason, mover_move
from sim.explain.pattern import move_between
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Kind, Move, Outcome

SEEDS = range(16)
REACTS = (MoverReason.BRAKES, MoverReason.GIVES_WAY)


def driven(seed: int, ticks: int = 20, **more: object) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=16, pedestrians=3, potholes=4, seed=seed)
    timeline = Timeline(config.with_parts(**more))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("courtesy", [0.0, 0.7])
def test_who_is_swayed_is_who_brakes_or_gives_way(courtesy: float) -> None:
    some = 0
    for seed in SEEDS:
        timeline = driven(seed, courtesy=courtesy)
        found = influence(timeline)
        swayed = {(each.tick, each.id) for each in found.found}
        stop = timeline.state.world.ended or timeline.tick
        for before, after in pairwise(timeline.between(0, stop + 1)):
            move = move_between(before, after)
            if move is None:
                continue
            for thing in before.world.things():
                if thing.heading is None or thing.disabled:
                    continue
                reason = mover_move(before, (move,), thing.id).reason
                if reason in REACTS:
                    assert (before.world.tick, thing.id) in swayed
                elif reason is MoverReason.FREE:
                    assert (before.world.tick, thing.id) not in swayed
        some += len(swayed)
    assert some


def test_where_nobody_heeds_the_ego_nobody_is_swayed() -> None:
    for seed in SEEDS:
        found = influence(driven(seed, courtesy=0.0, attentive=0.0))
        assert found.found == ()
        assert not found.heeding


def test_trouble_is_counted_by_moves_and_run_again_without_the_thing() -> None:
    some = 0
    for seed in SEEDS:
        timeline = driven(seed)
        found = trouble(timeline)
        counts = [len(each.ticks) for each in found.found]
        assert counts == sorted(counts, reverse=True)
        assert found.retaken <= found.moves
        for each in found.found:
            for tick in each.ticks:
                assert timeline.at(tick).world.find(each.id) is not None
                decision = timeline.decision(tick)
                assert decision is not None
                assert decision.move is not Move.FORWARD
            assert each.without is not None
            world = found.state.world.without(frozenset((each.id,)))
            assert each.without == drive(replace(found.state, world=world)).story
            some += each.without.path != found.real.path
        cars = trouble(timeline, Kind.VEHICLE).found
        assert all(each.kind is Kind.VEHICLE for each in cars)
    assert some


def test_before_the_first_move_there_is_nothing_to_tell() -> None:
    with pytest.raises(QuestionError, match="nothing_yet"):
        influence(driven(0, 0))
