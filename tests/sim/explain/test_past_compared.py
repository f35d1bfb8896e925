"""Other moves, patterns, the riskiest moment and moments alike: each claim held to a re-run of its own."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import pytest

from sim.config import Config
from sim.decide import decide_on, sense
from sim.explain import QuestionError
from sim.explain.other_move import had_moved
from sim.explain.pattern import move_between, pattern
from sim.explain.query import SAID_OF, contrast
from sim.explain.riskiest import riskiest
from sim.explain.similar import APART, LEAST_ALIKE, around, similar
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step, transition
from sim.types import Mode, Move, Outcome
from tests.support.refused import answered
from tests.support.roads import road, run_on


def drives(count: int, seed: int = 0, **parts: object) -> Iterator[Timeline]:
    draw = random.Random(seed)
    for _ in range(count):
        columns, rows = draw.choice([5, 8]), draw.choice([10, 16])
        config = Config(
            seed=draw.randrange(2**32),
            columns=columns,
            rows=rows,
            vehicles=draw.choice([2, columns * rows // 6]),
            potholes=draw.choice([0, 8]),
            pedestrians=draw.choice([0, 2]),
            courtesy=0.0,
            planner=draw.choice(["priority", "rules", "astar"]),
        ).with_parts(**parts)
        timeline = Timeline(config)
        for _ in range(draw.randrange(3, rows)):
            timeline.advance()
        yield timeline


def driven_on(state: SimState, move: Move) -> tuple[Outcome, int]:
    """How it ends if the ego makes a move and the planner drives on; ticks of the episode."""
    world = next_world(state.world, (move,), state.config)
    ego = state.ego()
    now = replace(state.with_ego(ego.id, mode=Mode.AUTO, queue=()), world=world)
    while now.world.outcome is Outcome.RUNNING and now.world.episode_tick <= state.config.max_ticks + 1:
        now = step(now).state
    return now.world.outcome, now.world.episode_tick


def test_another_move_leads_where_it_is_said_to_lead() -> None:
    ends = dict.fromkeys(Outcome, 0)
    for timeline in drives(25):
        for tick in range(0, timeline.tick, 3):
            state = timeline.at(tick)
            if state.world.outcome is not Outcome.RUNNING:
                continue
            decision = timeline.decided(state)
            assert decision is not None
            for move in Move:
                found, code = answered(had_moved, timeline, move, tick)
                if found is None:
                    assert code == ("was_made" if move is decision.move else "no_cell")
                    assert code != "no_cell" or decision.option(move).cell is None
                    continue
                would, real = found.stakes.would, found.stakes.real
                assert would is not None
                assert real is not None
                outcome, ticks = driven_on(state, move)
                assert would.outcome is outcome
                if outcome is not Outcome.STUCK:  # a repeated situation is an end before time is up
                    assert would.ticks == ticks
                assert driven_on(state, decision.move)[0] is real.outcome
                ends[outcome] += 1
    assert ends[Outcome.CRASH] > 50
    assert ends[Outcome.SUCCESS] > 50


def test_a_contrast_is_of_the_tick_at_which_the_one_move_was_made() -> None:
    told = 0
    for timeline in drives(30, seed=1):
        for one, other in ((Move.LEFT, Move.RIGHT), (Move.RIGHT, Move.FORWARD), (Move.FORWARD, Move.STAY)):
            found, code = answered(contrast, timeline, one, other)
            if found is None:
                assert code in ("never_made", "was_made")
                continue
            made = found.decision.move
            assert made in SAID_OF.get(one, (one,))
            assert found.foil in SAID_OF.get(other, (other,))
            assert found.foil is not made
            assert timeline.decision(found.decision.tick).move is made  # type: ignore[union-attr]
            if made is not one:  # a diagonal is compared with the other diagonal
                assert found.foil is Move.FORWARD or found.foil.offset[1]
            told += 1
    assert told > 40


def test_a_pattern_counts_every_move_and_each_of_its_reasons_flips_the_decision() -> None:
    flips = 0
    for timeline in drives(30, seed=2):
        for move in (Move.LEFT, Move.RIGHT, Move.FORWARD, Move.STAY):
            found, code = answered(pattern, timeline, move)
            if found is None:
                assert code in ("never_made", "nothing_yet")
                continue
            alike = SAID_OF.get(move, (move,))
            decisions = [
                timeline.decision(tick)
                for tick in range(found.first, found.last)
                if timeline.at(tick).world.outcome is Outcome.RUNNING
            ]
            assert found.decided == len(decisions)
            assert found.made == sum(each is not None and each.move in alike for each in decisions)
            for each in found.instances:
                decision = timeline.decided(each.before)
                assert decision is not None
                assert decision.move in alike
                if each.ids:
                    without = decide_on(each.before, sense(each.before)[0].without(each.ids))
                    assert without.move is not decision.move
                    flips += 1
    assert flips > 40


def test_of_all_patterns_the_most_frequent_is_told() -> None:
    for timeline in drives(15, seed=3):
        states = list(timeline.between(timeline.state.world.episode_start, timeline.tick + 1))
        moves = [made for pair in pairwise(states) if (made := move_between(*pair)) is not None]
        sides = {each: side for side, both in SAID_OF.items() for each in both}
        counts = [sides.get(move, move) for move in moves if move is not Move.FORWARD]
        found, code = answered(pattern, timeline)
        if found is None:
            assert (code, counts) == ("nothing_yet" if not states[1:] else "always_straight", [])
            continue
        assert counts.count(found.move) == found.made == max(map(counts.count, counts))


def test_no_tick_is_riskier_than_the_riskiest() -> None:
    judged = 0
    for timeline in drives(40, seed=4, planner="priority"):
        states = list(timeline.between(0, timeline.tick + 1))
        found = riskiest(states)
        if found is None:
            continue
        ranks = []
        for before, after in pairwise(states):
            if before.world.outcome is not Outcome.RUNNING:
                continue
            moves = [m for m in Move if before.world.road.moved(before.world.av, m) is not None]
            free = [
                m for m in moves if next_world(before.world, (m,), before.config).outcome is not Outcome.CRASH
            ]
            ranks.append((after.world.outcome is not Outcome.CRASH, len(free)))
            if before.world.tick == found.tick:
                assert found.free == tuple(free)
                assert found.tried == tuple(moves)
        assert (not found.crashed, len(found.free)) == min(ranks)
        judged += len(ranks)
    assert judged > 200


def test_a_crash_is_riskier_than_anything_before_it() -> None:
    start = run_on(road("......", "......", "..#...", "......", "..A..."))
    states = [start]
    for move in (Move.FORWARD, Move.FORWARD):
        states.append(transition(states[-1], {"av-1": move}).state)
    found = riskiest(states)
    assert found is not None
    assert (found.crashed, found.tick, found.made) == (True, 1, Move.FORWARD)
    assert Move.FORWARD not in found.free


def test_moments_alike_have_the_same_move_and_share_what_is_said() -> None:
    pairs = 0
    for timeline in drives(30, seed=5):
        found, code = answered(similar, timeline, 3)
        if found is None:
            assert code == "nothing_yet"
            continue
        seen = around(found.before)
        ticks = [each.tick for each in found.found]
        for each in found.found:
            decision = timeline.decision(each.tick)
            assert decision is not None
            assert decision.move is found.move
            theirs = around(each.before)
            assert all(seen[at] is kind is theirs[at] for at, kind in each.shared)
            union = {*seen.items(), *theirs.items()}
            both = {*seen.items()} & {*theirs.items()}
            assert len(each.shared) == len(both)
            assert each.alike >= LEAST_ALIKE
            assert each.alike >= (len(both) / len(union) if union else 1.0)
            pairs += 1
        assert all(abs(one - other) >= APART for one, other in pairwise(sorted(ticks)))
        assert [each.alike for each in found.found] == sorted((e.alike for e in found.found), reverse=True)
    assert pairs > 10


@pytest.mark.parametrize("ask", [pattern, lambda timeline: similar(timeline, 3)])
def test_before_the_first_tick_there_is_nothing_to_compare(ask: object) -> None:
    with pytest.raises(QuestionError) as refused:
        ask(Timeline(Config(seed=3)))  # type: ignore[operator]
    assert refused.value.code == "nothing_yet"
