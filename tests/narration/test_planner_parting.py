"""Two planners compared: where they part, what each makes of the other's move, and what it led to."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask, Evaluate
from service.grammar import Language, Understood
from service.narration.planners import Planners
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.planners import planners_here
from sim.planner_names import BUILT_IN
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

PAIRS = [("rules", "astar"), ("priority", "rules"), ("astar", "bfs"), ("dijkstra", "astar")]


def compared(timeline: Timeline, other: Any) -> dict[str, Any]:
    ask = Ask(about="planners", what="compare", planners=(other,))
    return Planners(Sayings.load()).answer(Asked(ask, timeline))


def first_difference(timeline: Timeline, other: str) -> int | None:
    """By driving both beside each other."""
    one = timeline.state
    two = SimState.start(one.config.with_parts(planner=other), one.world)
    while one.world.outcome is two.world.outcome is Outcome.RUNNING:
        a, b = step(one), step(two)
        assert a.decision is not None
        assert b.decision is not None
        if a.decision.move is not b.decision.move:
            return one.world.tick
        one, two = a.state, b.state
    return None


@pytest.mark.parametrize("pair", PAIRS, ids="-".join)
@pytest.mark.parametrize("seed", range(3))
def test_the_first_tick_they_differ_with_both_verdicts(pair: tuple[str, str], seed: int) -> None:
    own, other = pair
    timeline = Timeline(Config(planner=own, seed=seed, rows=16))
    found = compared(timeline, other)
    tick = first_difference(timeline, other)
    if tick is None:
        assert found["parting"] is None
        assert "They part" not in found["text"]
        return
    parting = found["parting"]
    assert parting["at_tick"] == tick
    assert (parting["own"]["planner"], parting["other"]["planner"]) == pair
    assert parting["own"]["move"] is not parting["other"]["move"]
    config = timeline.state.config
    when = f"after {tick * config.step_seconds:g} s" if tick else "at once"
    assert f"They part {when}: " in found["text"]
    for one, another in (("own", "other"), ("other", "own")):
        texts = {each["move"]: each["text"] for each in parting[one]["options"]}
        text = texts[parting[another]["move"]]
        if text.startswith("free, costs"):  # charges are told as seconds
            text = "free, costs as much as"
        assert text in found["text"]


def test_one_that_drives_alike_never_parts() -> None:
    timeline = Timeline(Config(planner="astar", seed=1, rows=6, vehicles=0, potholes=0))
    found = planners_here(timeline, ["dijkstra"])
    assert found.decided(found.others[0]) is None


def test_with_several_others_none_is_singled_out() -> None:
    ask = Ask(about="planners", what="compare")
    found = Planners(Sayings.load()).answer(Asked(ask, Timeline(Config(rows=10))))
    assert found["parting"] is None


@pytest.mark.parametrize("code", ["en", "de"])
def test_it_says_how_to_run_the_road_many_times(code: str) -> None:
    timeline, language, sayings = Timeline(Config(seed=1)), Language.load(code), Sayings.load(code)
    others: list[Any] = sorted(set(BUILT_IN) - {timeline.state.config.planner})
    for other in others:
        ask = Ask(about="planners", what="compare", planners=(other,))
        text = Planners(sayings).answer(Asked(ask, timeline))["text"]
        told = text.replace("„", "“").replace("”", "“").split("“")[-2]
        parsed = language.parse(told)
        assert isinstance(parsed, Understood), text
        (evaluation,) = parsed.actions
        assert isinstance(evaluation, Evaluate)
        assert (evaluation.runs, evaluation.road, evaluation.planners) == (100, "this", (other,))
