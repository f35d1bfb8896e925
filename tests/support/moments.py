"""Moments in random worlds, and a checker that knows edits and ticks but not the explainer."""

from __future__ import annotations

import random
from collections.abc import Iterator

from sim.actions import Remove, Where, WorldAction
from sim.config import Config
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome, kind_of


def moments(count: int, seed: int = 0, planner: str = "priority") -> Iterator[Timeline]:
    """Timelines that have just taken a decision, on roads from empty to crowded, with wishes or without."""
    draw = random.Random(seed)
    found = 0
    while found < count:
        columns, rows = draw.choice([4, 8, 11]), draw.choice([8, 30])
        if planner in ("astar", "dijkstra"):
            columns, rows = draw.choice([4, 8]), draw.choice([8, 12])
        config = Config(
            seed=draw.randrange(2**32),
            columns=columns,
            rows=rows,
            potholes=draw.choice([None, 0, rows * columns // 12, rows * columns // 6]),
            vehicles=draw.choice([None, 0, rows * columns // 8, rows * columns // 4]),
            pedestrians=draw.choice([0, 2]),
            barriers=draw.choice([0, 2]),
            courtesy=draw.choice([0.0, 0.0, 0.5]),
            planner=planner,
        )
        if planner != "priority":
            wishes = draw.choice([(), ("cautious",), ("avoid_potholes", "smooth_ride"), ("fastest",)])
            config = config.with_parts(preferences=wishes, safety_buffer=draw.choice([1, 1, 2]))
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, rows)):
            timeline.advance()
        decision = timeline.decision(timeline.tick - 1)
        if decision is not None and timeline.at(timeline.tick - 1).world.outcome is Outcome.RUNNING:
            found += 1
            yield timeline


def move_after(
    state: SimState, *, removed: tuple[str, ...] = (), change: tuple[WorldAction, ...] = ()
) -> Move:
    """The move a run makes after a person has taken things away or made other changes."""
    for name in removed:
        state = apply(state, Remove(kind=kind_of(name).value, count=1, where=Where(id=name))).state
    for action in change:
        state = apply(state, action).state
    decision = step(state).decision
    assert decision is not None
    return decision.move


def all_ids(state: SimState) -> set[str]:
    """Everything on the road."""
    return {thing.id for thing in state.world.things()}
