"""What was planned in a drive, how often that changed, what the drawn path is: each against its own run."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.http.routes.forecast import _drive_on
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.actions import SetMode
from sim.decide import decide
from sim.explain.plan_course import plan_course, way_then
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome
from tests.narration.test_course import NARRATORS, driven
from tests.support.narration_checks import ids_in, looks_like_sentences

FOG = {"sensor": "camera", "weather": "fog", "vehicles": 30}


def asked(timeline: Timeline, code: str, supposes: str | None = None, **parts: Any) -> dict[str, Any]:
    told: dict[str, Any] = NARRATORS[code].answer(Asked(Ask(**parts), timeline, supposes))
    assert looks_like_sentences(told["text"]), told["text"]
    assert len(told["text"].split()) <= MOST_WORDS, told["text"]
    assert ids_in(told["text"]) == set(), told["text"]
    return told


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "bfs"])
def test_a_planned_way_costs_what_the_decision_says_and_leads_to_the_goal(planner: str) -> None:
    for seed in range(4):
        timeline = driven(4, seed=seed, planner=planner, **FOG)
        found = way_then(timeline)
        decision = decide(found.state)
        assert found.way is not None
        assert decision is not None
        assert found.way.moves[0] is decision.move
        assert found.way.cost == decision.chosen.cost
        assert found.way.cells[-1][1] == 0


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "bfs"])
def test_with_perfect_sight_and_nobody_reacting_the_first_plan_is_driven(planner: str) -> None:
    for seed in range(4):
        timeline = driven(200, seed=seed, planner=planner)
        if timeline.state.world.outcome is not Outcome.SUCCESS:
            continue
        assert plan_course(timeline).changes == ()
        first = way_then(timeline, 0)
        assert first.way is not None
        assert first.kept == len(first.way.moves) == timeline.tick


def test_a_plan_that_was_left_was_driven_as_far_as_it_was_kept() -> None:
    changed = 0
    for seed in range(6):
        timeline = driven(60, seed=seed, planner="astar", **FOG)
        course = plan_course(timeline)
        ticks = [each.tick for each in course.changes]
        for tick in range(min(3, timeline.tick)):
            found = way_then(timeline, tick)
            if found.way is None:
                continue
            made = [timeline.decided(timeline.at(each)) for each in range(tick, tick + found.kept)]
            assert [each.move for each in made if each] == list(found.way.moves[: found.kept])
            if found.left:
                assert any(tick < each <= tick + found.kept for each in ticks)
        changed += len(ticks)
        for each in course.changes:
            if each.why == "blocked" and each.by is not None:
                assert each.cells or each.later == 0
    assert changed


@pytest.mark.parametrize("code", NARRATORS)
def test_how_often_the_plan_changed_begins_with_the_count(code: str) -> None:
    timeline = next(
        each
        for each in (driven(60, seed=seed, planner="astar", **FOG) for seed in range(9))
        if len(plan_course(each).changes) > 1
    )
    told = asked(timeline, code, about="planners", what="plan_changes")
    assert f" {len(told['changes'])}" in told["text"].partition(".")[0]
    yes = asked(timeline, code, "whether", about="planners", what="plan_changes")
    assert yes["text"].startswith(("Yes", "Ja"))
    steady = driven(9, seed=1, planner="astar")
    assert asked(steady, code, about="planners", what="plan_changes")["changes"] == []
    rules = asked(driven(9, seed=1, planner="priority"), code, about="planners", what="plan_changes")
    assert rules["plans_ways"] is False
    asked(driven(0, seed=1, planner="astar"), code, about="planners", what="plan_changes")


def test_moves_of_a_person_are_why_a_plan_was_left() -> None:
    timeline = driven(3, seed=2, planner="astar")
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    for _ in range(3):
        timeline.advance()
    assert timeline.state.mode is Mode.MANUAL
    assert {each.why for each in plan_course(timeline).changes} <= {"by_person", "blocked", "dearer"}
    assert any(each.why == "by_person" for each in plan_course(timeline).changes)


@pytest.mark.parametrize("code", NARRATORS)
def test_the_plan_of_a_tick_tells_its_moves(code: str) -> None:
    timeline = driven(12, seed=4, planner="astar", **FOG)
    told = asked(timeline, code, about="planners", what="plan", tick=3)
    assert told["at"] == 3
    assert str(len(told["moves"])) in told["text"]
    alone = asked(driven(12, seed=4, planner="priority"), code, about="planners", what="plan", ticks=2)
    assert len(alone["moves"]) == 1
    ended = driven(200, seed=4, planner="astar")
    last = asked(ended, code, about="planners", what="plan")
    assert last["at"] == ended.tick - 1
    assert last["moves"] is None or Move(last["moves"][0])


def test_the_path_that_is_drawn_comes_true_if_nothing_is_said() -> None:
    for seed in range(3):
        timeline = driven(5, seed=seed, planner="priority", attentive=0.5, courtesy=0.5, vehicles=30)
        path = _drive_on(timeline.state, 8)
        came = []
        for _ in path:
            timeline.advance()
            came.append(timeline.state.world.road.cell(timeline.state.world.av))
        assert came == path


@pytest.mark.parametrize("code", NARRATORS)
def test_what_the_path_shows_goes_by_who_drives(code: str) -> None:
    timeline = driven(3, seed=2)
    first = asked(timeline, code, about="world", what="path_view")
    why = asked(timeline, code, "none", about="world", what="path_view")
    assert first["drawn"] is why["drawn"] is True
    assert first["text"] != why["text"]
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    assert asked(timeline, code, "none", about="world", what="path_view")["drawn"] is False
    ended = driven(200, seed=2)
    assert asked(ended, code, about="world", what="path_view")["drawn"] is False
    stuck = driven(400, seed=5, planner="astar", barriers=60)
    if stuck.state.world.outcome is Outcome.STUCK:
        assert "A*" in asked(stuck, code, about="world", what="path_view")["text"]


@pytest.mark.parametrize("code", NARRATORS)
def test_a_line_of_the_log_is_told_as_the_log_has_it(code: str) -> None:
    for seed, ticks in ((1, 9), (2, 200)):
        timeline = driven(ticks, seed=seed, planner="priority", vehicles=40)
        told = asked(timeline, code, about="world", what="log_line")
        state = timeline.at(timeline.tick - 1)
        decision = timeline.decided(state)
        assert decision is not None
        assert told["line"] == NARRATORS[code].decision(decision, state)
        assert told["line"] in told["text"]
    assert asked(driven(0), code, about="world", what="log_line")["line"] is None
