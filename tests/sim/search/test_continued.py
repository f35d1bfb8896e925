"""What is kept of earlier searches changes no decision."""

from __future__ import annotations

import random

import pytest

from sim.config import Config
from sim.decide import decide
from sim.explain.alternatives import after_move
from sim.explain.episode_rollout import rollout
from sim.search import compiled_costs
from sim.search.continued import continued, forget
from sim.search.costs import weights
from sim.search.reachability import steps_left
from sim.session.timeline import Timeline
from sim.types import Move, Outcome


def drives(planner: str, count: int) -> list[Timeline]:
    draw = random.Random(planner)
    made = []
    for _ in range(count):
        rows = draw.choice([8, 14])
        config = Config(
            seed=draw.randrange(2**32),
            columns=draw.choice([5, 8]),
            rows=rows,
            potholes=draw.choice([2, rows, 2 * rows]),
            vehicles=draw.choice([4, rows, 3 * rows // 2]),
            pedestrians=draw.choice([0, 3]),
            courtesy=draw.choice([0.0, 0.0, 0.5]),
            preferences=draw.choice([(), ("cautious",), ("fastest",)]),
            planner=planner,
        )
        made.append(Timeline(config))
    return made


@pytest.mark.parametrize("planner", ["bfs", "dijkstra", "astar"])
def test_decisions_of_a_drive_are_those_of_each_moment_by_itself(planner: str) -> None:
    looked = 0
    for timeline in drives(planner, 30):
        state = timeline.state
        forget()
        begins = [state, *(after_move(state, move) for move in (Move.FORWARD, Move.STAY))]
        ticks = [
            each for begin in begins for each in rollout(begin) if begin.world.outcome is Outcome.RUNNING
        ]
        for before, tick in ticks:
            forget()
            alone = decide(before)
            assert alone is not None
            assert tick.decision is not None
            assert (alone.move, alone.options) == (tick.decision.move, tick.decision.options)
            looked += 1
    assert looked > 300


def test_a_later_tick_is_looked_up_only_while_all_goes_on_as_foretold(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(compiled_costs, "_found", None)  # else nothing is searched for, and nothing kept
    config = Config(seed=5, columns=6, rows=12, potholes=4, vehicles=8, planner="dijkstra")
    timeline = Timeline(config)
    forget()
    first = timeline.advance()
    assert first is not None
    forecast = next(iter(first.steps.values())).forecast
    later = next(iter(rollout(timeline.state)))[1]
    expected = next(iter(later.steps.values())).forecast
    limit = steps_left(config, expected.episode_tick)
    found = continued("swept", expected, weights(config), limit)
    assert found is not None
    assert found[1] == expected.episode_tick - forecast.episode_tick
    assert continued("swept", expected, weights(config.with_parts(preferences=("cautious",))), limit) is None
    assert continued("swept", expected, weights(config), limit - 1) is None
