"""What was in its cell already is said to be driven into; what came into the same cell then, to have come."""

from __future__ import annotations

from collections import Counter

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Move, Outcome

NARRATOR = Narrator.load()
SEEDS = range(90)


def crashed(seed: int) -> Timeline:
    sensor = ("radar", "camera", "perfect")[seed % 3]
    config = Config(vehicles=80, potholes=8, pedestrians=3, seed=seed)
    timeline = Timeline(config.with_parts(weather="rain", sensor=sensor, planner="priority"))
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < 60:
        timeline.advance()
    return timeline


def begun(timeline: Timeline, tick: int) -> Timeline:
    """The same drive up to a tick."""
    again = Timeline(timeline.config)
    while again.tick < tick:
        again.advance()
    return again


def test_who_came_into_the_cell_of_a_crash_was_not_in_it_before() -> None:
    counted: Counter[bool] = Counter()
    for timeline in map(crashed, SEEDS):
        world = timeline.state.world
        cause = world.cause
        if world.outcome is not Outcome.CRASH or cause is None or cause.how != "hit":
            continue
        before = timeline.at(world.tick - 1)
        thing = before.world.find(next(each for each in cause.ids if each != "av-1"))
        decision = timeline.decided(before)
        if thing is None or not thing.kind.moves or decision is None or decision.move is Move.STAY:
            continue
        text = NARRATOR.answer(Asked(Ask(about="why"), timeline))["text"]
        counted[thing.cell == cause.cell] += 1
        assert ("came into the same cell" in text) is (thing.cell != cause.cell), text
        ahead = NARRATOR.answer(Asked(Ask(about="outlook", what="crash"), begun(timeline, world.tick - 1)))
        if "into the same cell" in ahead["text"]:
            assert thing.cell != cause.cell, ahead["text"]
    assert min(counted[True], counted[False]) >= 3, counted
