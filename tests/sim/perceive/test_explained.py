"""Explanations with sensors that err: causes are what was seen, proofs stand on what is there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import pytest

from sim.actions import SetCount
from sim.decide import sense
from sim.explain import QuestionError, why, why_not
from sim.explain.alternatives import stakes
from sim.explain.confidence import Method, confidence
from sim.explain.crash import Crash, why_crashed
from sim.explain.episode_rollout import route_ahead, story
from sim.explain.facts import Explanation
from sim.explain.misperception import misperception
from sim.explain.side_by_side import compare_change, compare_move
from sim.explain.summary import summary
from sim.explain.what_if import what_if
from sim.forecast import Forecast, predict
from sim.oracle import certify, least_cost, least_ticks, regret
from sim.oracle.outlook import outlook
from sim.perceive import Percept
from sim.plan import planner_named
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step
from sim.types import Kind, Move, Outcome
from sim.world.boards import BOARDED
from tests.support.rides import rides
from tests.support.roads import road, run_on
from tests.support.sensors import NAMES

DRAWN = 120
"""Futures drawn for one moment."""


def decided(state: SimState, percept: Percept) -> Move:
    """What the planner makes of a percept, by no other way than its own two functions."""
    planner = planner_named(state.config.planner)
    assert planner is not None
    return planner.decide(predict(percept, planner.horizon(state.config)), state.config).move


def seen_by(state: SimState, *, only: Iterable[str] | None = None, gone: Iterable[str] = ()) -> Percept:
    """What is seen in a state, cut down thing by thing."""
    percept, dropped = sense(state)[0], set(gone)
    kept = {thing.id for thing in percept.things()} if only is None else set(only)
    for thing in percept.things():
        if thing.id in dropped or thing.id not in kept:
            bit = 1 << state.world.road.index(thing.cell)
            table = "hazards" if thing.kind.fixed else "movers"
            names = {cell: name for cell, name in getattr(percept, table).items() if name != thing.id}
            marks = () if thing.kind.fixed else ("right", "left", "yielding", "attentive")
            cleared = {mark: getattr(percept, mark) & ~bit for mark in marks}
            boards = percept.boards
            if thing.kind in BOARDED:
                boards = boards.with_kind(thing.kind, boards[thing.kind] & ~bit)
            percept = replace(percept, boards=boards, **{table: names}, **cleared)
    return percept


def check_why(state: SimState, explanation: Explanation) -> None:
    """Every claim of a why, by running the planner on percepts that are cut down by hand."""
    fact, percept = explanation.decision.move, sense(state)[0]
    causes = [cause.id for cause in explanation.causes]
    for cause in explanation.causes:
        thing = percept.find(cause.id)
        assert thing is not None
        assert (thing.kind, thing.cell) == (cause.kind, cause.cell)
        real = state.world.find(cause.id)
        assert cause.real is (real is not None and real.cell == thing.cell)
        assert (decided(state, seen_by(state, gone=[cause.id])) is not fact) is cause.necessary
        assert not cause.group or decided(state, seen_by(state, gone=cause.group)) is not fact
    if explanation.verified.sufficient is not None:  # None: not everything was tried
        assert explanation.verified.sufficient is (decided(state, seen_by(state, only=causes)) is fact)
        assert explanation.verified.necessary is all(cause.necessary for cause in explanation.causes)
    check_flips(state, explanation)


def check_flips(state: SimState, explanation: Explanation) -> None:
    """Every counterfactual: the road is changed, the sensor looks again, and what must not be seen is not."""
    for flip in explanation.counterfactuals:
        changed = state
        for action in flip.change:
            changed = apply(changed, action).state
        assert decided(changed, seen_by(changed, gone=flip.undetected)) is flip.move


def same_proofs(state: SimState, made: Move) -> None:
    """Proofs come to the same whatever the sensor."""
    clear = replace(state.with_ego(belief=None), config=state.config.with_parts(sensor="perfect"))
    for proof in (certify, least_ticks, least_cost, outlook):
        assert proof(state) == proof(clear)
    assert regret(state, made) == regret(clear, made)


@pytest.mark.parametrize("sensor", NAMES)
def test_why_names_what_was_seen_and_every_claim_holds(sensor: str) -> None:
    phantoms = named = 0
    for timeline in rides(sensor, 40, seed=1, preferences=()):
        explanation = why(timeline)
        state = timeline.at(explanation.decision.tick)
        check_why(state, explanation)
        named += len(explanation.causes)
        phantoms += sum(not cause.real for cause in explanation.causes)
        for foil in Move:
            if foil is not explanation.decision.move:
                found = why_not(timeline, foil)
                check_flips(state, found)
                assert found.stakes is None or found.stakes == alternatives_by_truth(state, found)
    assert named
    assert sensor in ("missing", "dropping", "phantom") or phantoms


def alternatives_by_truth(state: SimState, explanation: Explanation) -> object:
    """The same stakes, asked for again; the crash of a first move is by the truth."""
    assert explanation.foil is not None
    found = stakes(state, explanation.decision, explanation.foil)
    assert found is not None
    after = next_world(state.world, (explanation.foil,), state.config)
    if after.outcome is not Outcome.RUNNING:
        assert found.would is not None
        assert found.would.outcome is after.outcome
    elif found.would is not None:
        assert found.would.ticks > after.episode_tick
    return found


@pytest.mark.parametrize("sensor", NAMES)
def test_no_proof_believes_a_sensor_and_nothing_raises(sensor: str) -> None:
    for timeline in rides(sensor, 25, seed=2):
        state = timeline.at(timeline.tick - 1)
        decision = timeline.decided(state)
        assert decision is not None
        same_proofs(state, decision.move)
        change = [SetCount(kind="pothole", count=3)]
        found = what_if(timeline, change, timeline.tick - 1)
        assert found.real.digest == story(state).digest
        compare_change(timeline, timeline.tick - 1, change)
        other = next(
            option.move
            for option in decision.options
            if option.cell is not None and option.move is not decision.move
        )
        compare_move(timeline, timeline.tick - 1, other)
        route_ahead(timeline.state)
        end = timeline.state
        while end.world.outcome is Outcome.RUNNING:
            end = step(end).state
        real = stakes(state, decision, other)
        assert real is not None
        assert real.real is not None
        assert (real.real.outcome, real.real.ticks) == (end.world.outcome, end.world.episode_tick)
        told = summary(end)
        best = least_ticks(
            (end.record.start and replace(end.with_ego(belief=None), world=end.record.start)) or end
        )
        assert told.best is None or told.best == best


@pytest.mark.parametrize("sensor", NAMES)
def test_confidence_is_how_often_the_session_itself_arrives(sensor: str) -> None:
    for timeline in rides(sensor, 12, seed=3, courtesy=0.0, attentive=1.0):
        try:
            found = confidence(timeline)
        except QuestionError:
            continue
        end = timeline.state
        while end.world.outcome is Outcome.RUNNING:
            end = step(end).state
        assert found.arrives == float(end.world.outcome is Outcome.SUCCESS)
        assert not found.chance


@pytest.mark.parametrize("sensor", ["haunted", "missing", "delayed", "dropping"])
def test_confidence_is_the_share_of_futures_that_arrive_where_reactions_are_drawn(sensor: str) -> None:
    """Against futures drawn by other seeds: none of these sensors draws."""
    compared, off, spread = 0, 0.0, 0.0
    for timeline in rides(sensor, 40, seed=4, courtesy=0.5, attentive=0.5, planner="rules", vehicles=20):
        state = timeline.state
        if state.world.outcome is not Outcome.RUNNING:
            continue
        found = confidence(timeline)
        assert 0.0 <= found.low <= found.arrives <= found.high <= 1.0
        if found.method is not Method.ALL_FUTURES:
            continue
        arrived = 0
        for seed in range(DRAWN):
            end = step(state).state  # what comes next is seen already
            end = replace(end, config=end.config.with_parts(seed=seed))
            while end.world.outcome is Outcome.RUNNING:
                end = step(end).state
            arrived += end.world.outcome is Outcome.SUCCESS
        compared += 1
        off += arrived - DRAWN * found.arrives
        spread += DRAWN * found.arrives * (1.0 - found.arrives)
        assert abs(arrived - DRAWN * found.arrives) <= 5.0 * max(1.0, spread) ** 0.5
        if compared == 10:
            break
    assert compared >= 4
    assert abs(off) <= 4.0 * max(1.0, spread) ** 0.5


def crashes(sensor: str, count: int) -> Iterable[tuple[Timeline, Crash]]:
    """Crashes of rides with a sensor."""
    found = 0
    for timeline in rides(sensor, 400, seed=5, courtesy=0.0, vehicles=16, potholes=12, rows=12, columns=8):
        for _ in range(40):
            if timeline.state.world.outcome is Outcome.RUNNING:
                timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            found += 1
            yield timeline, why_crashed(timeline)
        if found == count:
            return


@pytest.mark.parametrize("sensor", ["missing", "delayed", "dropping", "noisy"])
def test_a_crash_hangs_on_what_was_there_and_it_is_said_what_was_not_seen(sensor: str) -> None:
    told = missed = 0
    for timeline, crash in crashes(sensor, 12):
        told += 1
        state = timeline.at(crash.explanation.decision.tick)
        truth = Forecast.of_truth(state.world, state.config, 1)
        percept, world = sense(state)[0], state.world
        for option in crash.met:
            end = world.road.moved(world.av, option.move)
            assert (option.verdict == "free") is truth.will_be_free(world.av, end)
        assert {*crash.free} == {option.move for option in crash.met if option.verdict == "free"}
        assert crash.explanation.decision.move not in crash.free
        for name in crash.cause.ids:
            seen = percept.find(name)
            there = world.find(name)
            assert there is not None
            assert (name in crash.missed) is (seen is None or seen.cell != there.cell)
            missed += name in crash.missed
        assert crash.explanation.verified.sufficient is True
        for cause in crash.explanation.causes:
            if cause.group:
                gone = frozenset(cause.group)
                changed = replace(state, world=world.without(gone))
                move = decided(changed, seen_by(changed, gone=gone))
                assert next_world(changed.world, (move,), state.config).outcome is not Outcome.CRASH
    assert told >= 5
    assert missed


PHANTOM = road(
    "........",
    "........",
    "........",
    "........",
    "........",
    "........",
    "...A....",
    "........",
)


def imagining() -> Timeline:
    """A vehicle on an empty road that has just gone round a pothole that only its sensor sees, at (3, 5)."""
    timeline = Timeline(run_on(PHANTOM, planner="rules", sensor="phantom").config)
    timeline.state = run_on(PHANTOM, planner="rules", sensor="phantom")
    timeline.advance()
    return timeline


def test_a_phantom_is_named_as_the_cause_and_no_proof_goes_round_it() -> None:
    timeline = imagining()
    explanation = why(timeline)
    state = explanation.moment
    assert explanation.decision.move is not Move.FORWARD
    (cause,) = explanation.causes
    assert (cause.id, cause.kind, cause.cell, cause.real) == ("pothole-p1", Kind.POTHOLE, (3, 5), False)
    verified = explanation.verified
    assert verified.necessary is verified.sufficient is verified.minimal is True
    (flip,) = explanation.counterfactuals
    assert (flip.change, flip.move, flip.undetected) == ((), Move.FORWARD, ("pothole-p1",))
    assert certify(state).plan == (Move.FORWARD,) * 6  # type: ignore[union-attr]
    assert least_ticks(state) == 6
    assert regret(state, Move.STAY).ticks == 1
    found = why_not(timeline, Move.FORWARD)
    assert [(each.id, each.real) for each in found.causes] == [("pothole-p1", False)]
    assert found.stakes is not None
    assert found.stakes.would is not None
    assert found.stakes.would.outcome is Outcome.SUCCESS
    assert misperception(state).phantoms[0].id == "pothole-p1"
    assert not misperception(state).missed
    told = what_if(timeline, (), 0, undetected=["pothole-p1"])
    assert told.first_difference is not None
    assert told.first_difference.changed is Move.FORWARD


def test_without_a_memory_of_it_a_thing_that_is_gone_is_seen_no_more() -> None:
    """Of what a sensor remembers, no change of the road rids it: the counterfactual says so."""
    undone = 0
    for timeline in rides("delayed", 60, seed=6, vehicles=0, potholes=16):
        explanation = why(timeline)
        for flip in explanation.counterfactuals:
            undone += bool(flip.undetected)
            assert not flip.undetected or {*flip.undetected} <= {*flip.removed}
    assert undone
