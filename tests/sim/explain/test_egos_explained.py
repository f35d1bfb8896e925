"""Explanations of an ego by its id: what blocked it may be another ego, and every claim holds when re-run."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from sim.actions import Drive, Remove, SetMode
from sim.config import Config
from sim.decide import announced_before, decide_on, moves_where, sense
from sim.explain import QuestionError, Role, why, why_not
from sim.explain.alternatives import after_move
from sim.explain.confidence import confidence
from sim.explain.crash import why_crashed
from sim.explain.episode_rollout import rollout, route_ahead, story
from sim.explain.scene import describe_percept
from sim.explain.side_by_side import compare_change, compare_move
from sim.explain.summary import summary
from sim.explain.what_if import what_if
from sim.oracle import Blocked, Drivable, certify, least_cost, least_ticks, regret
from sim.oracle.certificate import opens
from sim.oracle.other_egos import UndeterminedError
from sim.oracle.outlook import OPEN, outlook
from sim.plan import Decision
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.serialization import Packer, Unpacker
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step, transition
from sim.types import Kind, Mode, Move, Outcome, is_ego
from sim.world import World
from tests.support.roads import road, run_on
from tests.support.two_egos import FIRST, SECOND, drawn

BEHIND = road(".....", ".....", ".....", "..A..", "..A..", ".....")
"""The second ego right behind the first."""
GAP = road(".......", ".......", "##A####", ".......", ".......", "..A....")
"""The first ego stands in the only gap."""


def held(world: World, planner: str = "rules", **parts: object) -> SimState:
    """The first ego is parked, the second drives."""
    state = SimState.start(run_on(world, planner=planner, attentive=1.0, **parts).config, world)
    return state.with_ego(FIRST, mode=Mode.MANUAL)


def ridden(state: SimState, ticks: int = 1) -> Timeline:
    timeline = Timeline(state.config, state)
    for _ in range(ticks):
        timeline.advance()
    return timeline


def redecided(state: SimState, decision: Decision, gone: frozenset[str]) -> Move:
    """The move had these not been seen; without the code that explains."""
    percept = sense(state, announced_before(state, decision.av), decision.av)[0]
    return decide_on(state, percept.without(gone), decision.av).move


@pytest.mark.parametrize("planner", ["rules", "priority", "bfs", "dijkstra", "astar"])
def test_why_names_the_ego_that_blocked_it(planner: str) -> None:
    timeline = ridden(held(BEHIND, planner))
    found = why(timeline, ego=SECOND)
    assert found.decision.av == SECOND
    assert found.decision.move is not Move.FORWARD
    (cause,) = found.causes
    assert (cause.id, cause.kind, cause.cell) == (FIRST, Kind.AV, (2, 3))
    assert (cause.role is Role.BLOCKS) is (planner in ("rules", "priority"))
    assert cause.necessary
    assert found.verified.sufficient
    assert found.verified.minimal
    assert redecided(found.moment, found.decision, frozenset({FIRST})) is Move.FORWARD
    (flip,) = found.counterfactuals
    assert (flip.move, flip.removed, flip.undetected, flip.change) == (Move.FORWARD, (FIRST,), (FIRST,), ())


def test_why_holds_on_random_roads() -> None:
    random, by_ego, announced = Random("explained"), 0, 0
    for _ in range(90):
        timeline = ridden(drawn(random, random.choice(("rules", "priority")), 3), random.randint(1, 5))
        for id in (FIRST, SECOND, "av-3"):
            try:
                found = why(timeline, ego=id)
            except QuestionError:
                continue
            state, decision = found.moment, found.decision
            assert decision == timeline.decision(decision.tick, id)
            by_ego += any(is_ego(cause.id) for cause in found.causes)
            announced += bool(announced_before(state, id))
            for cause in found.causes:
                if cause.necessary:
                    assert redecided(state, decision, frozenset({cause.id})) is not decision.move
            percept = sense(state, announced_before(state, id), id)[0]
            kept = percept.keeping({cause.id for cause in found.causes})
            assert (decide_on(state, kept, id).move is decision.move) is found.verified.sufficient
            for flip in found.counterfactuals:
                after = state
                for action in flip.change:
                    after = apply(after, action).state
                seen = sense(after, announced_before(after, id, gone=flip.undetected), id)[0]
                assert decide_on(after, seen.without(flip.undetected), id).move is flip.move
    assert by_ego > 3
    assert announced > 40


def test_default_is_the_first_ego() -> None:
    timeline = ridden(drawn(Random("default"), "rules"), 2)
    assert why(timeline) == why(timeline, ego=FIRST)
    assert story(timeline.state) == story(timeline.state, ego=FIRST)
    with pytest.raises(QuestionError, match="no_such_ego"):
        why(timeline, ego="av-7")


def test_why_not_names_the_ego_in_the_way() -> None:
    found = why_not(ridden(held(BEHIND)), Move.FORWARD, ego=SECOND)
    assert [cause.id for cause in found.causes] == [FIRST]
    assert found.verified.necessary
    assert found.counterfactuals[0].move is Move.FORWARD
    assert found.stakes is not None
    assert found.stakes.would is not None
    assert found.stakes.would.outcome is Outcome.CRASH
    assert found.stakes.would.ids == (FIRST,)
    assert found.stakes.dead_end
    assert found.stakes.real is not None
    assert found.stakes.real.outcome is Outcome.SUCCESS


def test_what_an_ego_announced_is_why_it_was_followed() -> None:
    """The second drives into the cell that the first, which decides before it, is leaving."""
    state = SimState.start(run_on(BEHIND, planner="rules").config, BEHIND)
    assert announced_before(state, SECOND) == {FIRST: Move.FORWARD}
    assert announced_before(state, FIRST) == {}
    found = why(ridden(state), ego=SECOND)
    assert (found.decision.move, found.causes) == (Move.FORWARD, ())
    (seen,) = describe_percept(sense(state, {FIRST: Move.FORWARD}, SECOND)[0], state.config).seen
    assert (seen.id, seen.kind, seen.rows, seen.walks) == (FIRST, Kind.AV, 1, False)


def test_those_after_an_ego_know_the_move_it_would_have_made() -> None:
    state = SimState.start(run_on(BEHIND, planner="rules").config, BEHIND)
    assert moves_where(state, Move.STAY)[SECOND] is not Move.FORWARD
    assert moves_where(state, Move.FORWARD)[SECOND] is Move.FORWARD
    assert after_move(state, Move.STAY).world.outcome is Outcome.RUNNING


def test_what_if_the_other_had_driven() -> None:
    timeline = ridden(held(BEHIND), 2)
    found = what_if(timeline, [SetMode(mode=Mode.AUTO, ego=FIRST)], 0, ego=SECOND)
    assert found.real.path[0] is not Move.FORWARD
    assert found.changed.path[:3] == (Move.FORWARD,) * 3
    assert found.first_difference is not None
    assert (found.first_difference.tick, found.first_difference.changed) == (0, Move.FORWARD)
    assert found.real.digest == story(timeline.at(0), ego=SECOND).digest
    driven = timeline.at(0).with_ego(FIRST, mode=Mode.AUTO)
    assert found.changed.digest == [*rollout(driven)][-1][1].state.world.digest()
    unseen = what_if(timeline, [], 0, (FIRST,), ego=SECOND)
    assert unseen.changed.path[0] is Move.STAY, "no move into an ego is made, seen or not"


def test_what_blocks_beside_a_parked_ego_is_proved() -> None:
    state = held(GAP)
    found = certify(state, ego=SECOND)
    assert isinstance(found, Blocked)
    assert len(found.ids) == 1
    assert found.minimal
    assert opens(state, found.ids, SECOND)
    assert opens(state, [FIRST], SECOND)
    assert not opens(state, (), SECOND)


def test_only_parked_egos_in_the_way_are_named() -> None:
    full = road("...", "...", "AAA", "...", "A..")
    state = SimState.start(run_on(full, attentive=1.0).config, full)
    for id in (FIRST, SECOND, "av-3"):
        state = state.with_ego(id, mode=Mode.MANUAL)
    found = certify(state, ego="av-4")
    assert isinstance(found, Blocked)
    assert found.minimal
    assert len(found.ids) == 1
    assert set(found.ids) <= {FIRST, SECOND, "av-3"}
    told = outlook(state, ego="av-4")
    assert told is not None
    assert (told.open, told.ids) == (False, found.ids)


def test_way_past_parked_egos_is_the_quickest_and_arrives() -> None:
    random, found, late = Random("quickest"), 0, 0
    for _ in range(40):
        state = drawn(random, "bfs").with_ego(FIRST, mode=Mode.MANUAL)
        ticks = least_ticks(state, ego=SECOND)
        proof = certify(state, ego=SECOND)
        assert (ticks is None) is isinstance(proof, Blocked)
        if ticks is None:
            late += 1
            continue
        assert isinstance(proof, Drivable)
        assert proof.ticks == ticks
        after = state
        for move in proof.plan:
            after = transition(after, {SECOND: move}).state
        assert after.world.outcome is Outcome.SUCCESS
        assert outlook(state, ego=SECOND) in (OPEN, None)
        move = step(state).steps[SECOND].decision.move
        assert (regret(state, move, ego=SECOND).ticks or 0) >= 0
        best = min(
            rest
            for each in Move
            if state.world.road.moved(state.world.avs[1], each) is not None
            if (rest := least_ticks(after_move(state, each, SECOND), ego=SECOND)) is not None
        )
        assert ticks == best + 1
        found += 1
    assert found > 25


def test_nothing_is_claimed_where_another_ego_drives() -> None:
    state = SimState.start(run_on(BEHIND).config, BEHIND)
    for asked in (certify, least_ticks, least_cost):
        with pytest.raises(UndeterminedError):
            asked(state)
    with pytest.raises(UndeterminedError):
        regret(state, Move.LEFT, ego=SECOND)
    assert outlook(state) is None
    timeline = ridden(state)
    end = [*rollout(state)][-1][1].state
    assert (summary(end).best, summary(end, ego=SECOND).certain) == (None, False)
    told = why_not(timeline, Move.LEFT, ego=SECOND).stakes
    assert told is not None
    assert told.ticks_lost is None


def test_summary_past_a_parked_ego() -> None:
    state = held(BEHIND, "bfs")
    end = [*rollout(state)][-1][1].state
    found = summary(end, ego=SECOND)
    assert (found.outcome, found.best, found.ticks) == (Outcome.SUCCESS, 4, 4)
    assert found.certain


def test_crash_of_another_than_the_first_is_explained() -> None:
    """Movers that do not brake run into whoever is asked to stay in their way."""
    random, seen = Random("crashes"), 0
    for _ in range(150):
        state = drawn(random, "priority", attentive=0.0).with_ego(FIRST, mode=Mode.MANUAL)
        timeline = Timeline(state.config, state)
        timeline.apply(0, [SetMode(mode=Mode.MANUAL, ego=SECOND)])
        while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < 30:
            timeline.advance()
        cause = timeline.state.world.cause
        if cause is None or cause.ego != SECOND:
            continue
        seen += 1
        crash = why_crashed(timeline)
        assert crash.explanation.decision.av == SECOND
        assert set(cause.ids) <= {each.id for each in crash.explanation.causes}
        without = crash.explanation.moment.world.without(frozenset(cause.ids))
        calm = replace(crash.explanation.moment, world=without)
        assert transition(calm, {}).state.world.cause != cause
        with pytest.raises(QuestionError, match="no_crash_then"):
            why_crashed(timeline, ego=FIRST)
    assert seen > 5


def test_crash_between_two_egos_is_watched_beside_what_was_done() -> None:
    timeline = ridden(held(BEHIND), 2)
    both = compare_move(timeline, 0, Move.FORWARD, ego=SECOND)
    assert both.changed.story.outcome is Outcome.CRASH
    assert both.changed.story.cause is not None
    assert both.changed.story.cause.ids == (FIRST, SECOND)
    assert both.changed.story.path == (Move.FORWARD,)
    assert both.real.story.outcome is Outcome.SUCCESS
    by_hand = transition(timeline.at(0), {SECOND: Move.FORWARD})
    assert by_hand.state.world.digest() == both.changed.story.digest
    assert (by_hand.events[0].ego, by_hand.events[0].ids) == (SECOND, (FIRST, SECOND))
    change = [SetMode(mode=Mode.AUTO)]
    assert compare_change(timeline, 0, change, ego=SECOND).changed.story.path[0] is Move.FORWARD


def test_route_and_confidence_are_of_the_ego() -> None:
    state = held(BEHIND)
    way = route_ahead(state, 9, ego=SECOND)
    assert not way.offered
    assert [each.av for each in way.decisions] == [SECOND] * len(way.decisions)
    assert way.outcome is Outcome.SUCCESS
    assert route_ahead(state).offered
    told = confidence(Timeline(state.config, state), ego=SECOND)
    assert (told.arrives, told.by_hand) == (1.0, False)
    assert told.arrival_ticks == (len(way.decisions),) * 2
    assert confidence(Timeline(state.config, state)).by_hand


def test_orders_to_an_ego_are_replayed_and_forked_to_the_same_digests() -> None:
    state = drawn(Random("orders"), "rules", 3)
    timeline, digests = Timeline(state.config, state), []
    said = {
        2: (SetMode(mode=Mode.MANUAL, ego=SECOND), Drive(move=Move.STAY, ego=SECOND)),
        4: (Drive(move=Move.FORWARD, ego="av-3"), Remove(kind="everything", count="all")),
        9: (SetMode(mode=Mode.AUTO, ego=SECOND), Drive(move=Move.STAY)),
    }
    for tick in range(40):
        if tick in said:
            timeline.apply(tick, said[tick])
        digests.append(timeline.state.world.digest())
        timeline.advance()
    assert timeline.at(3).ego(SECOND).mode is Mode.MANUAL
    assert timeline.at(3).mode is Mode.AUTO
    decision = timeline.decision(2, SECOND)
    assert decision is not None
    assert decision.asked is Move.STAY
    assert [each.world.digest() for each in timeline.between(0, 40)] == digests
    fork = timeline.copy()
    fork.rewind(20)
    fork.rewrite(fork.entries, 0)
    for tick in range(20, 40):
        assert fork.state.world.digest() == digests[tick]
        fork.advance()
    packer = Packer()
    number = packer.run(timeline.at(3))
    assert Unpacker(packer.packed()).runs[number] == timeline.at(3)


def test_changes_of_an_ego_are_told_with_its_id() -> None:
    state = drawn(Random("told"), "rules")
    assert [each.path for each in apply(state, SetMode(mode=Mode.MANUAL)).changes] == ["mode"]
    other = apply(state, SetMode(mode=Mode.MANUAL, ego=SECOND))
    assert [(each.path, each.after) for each in other.changes] == [("av-2.mode", Mode.MANUAL)]
    queued = apply(other.state, Drive(move=Move.LEFT, ego=SECOND))
    assert [each.path for each in queued.changes] == ["av-2.queue"]
    assert queued.state.queue == ()
    for action in (SetMode(mode=Mode.AUTO, ego="av-9"), Drive(move=Move.LEFT, ego="pothole-1")):
        with pytest.raises(EditError) as refused:
            apply(state, action)
        assert (refused.value.code, refused.value.field) == ("no_such_ego", "ego")


def test_one_ego_in_auto_config_has_the_same_default_figures() -> None:
    state = SimState.start(Config(seed=4))
    assert least_ticks(state) == least_ticks(state, ego=FIRST)
    assert certify(state) == certify(state, ego=FIRST)
