"""A planner that a program registers is explained as one that comes with the project: by traits, not by name.

Each built-in planner is registered once more under another name, drives the same roads and is asked the same
questions. All answers must be those of the original, but for the name and for how often a decision was run
again: where the compiled searches are loaded, the original's changes are tried many at once.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from service.sessions.outcome import is_slow_to_answer
from sim import planner_names
from sim.actions import Prefer, Set, WorldAction
from sim.batch import Batch
from sim.config import Config
from sim.explain import QuestionError, why, why_not
from sim.explain.alternatives import stakes
from sim.explain.confidence import confidence
from sim.explain.crash import led_to_crash, why_crashed
from sim.explain.episode_rollout import route_ahead, story
from sim.explain.side_by_side import compare_change, compare_move
from sim.explain.summary import summary
from sim.explain.what_if import what_if
from sim.oracle.certificate import certify
from sim.oracle.outlook import outlook
from sim.oracle.regret import regret
from sim.plan import planner_named, register, registry
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.support.roads import road, run_on

PREFIX = "copy_of_"
MADE = 30
"""Ticks driven of each road at most."""

ROADS: dict[str, dict[str, Any]] = {
    "crowded": {"columns": 5, "rows": 9, "seed": 3, "potholes": 6, "vehicles": 6, "pedestrians": 1},
    "cells": {"columns": 4, "rows": 8, "seed": 5, "vehicles": 7, "potholes": 2, "collision": "cell"},
    "courteous": {"columns": 4, "rows": 7, "seed": 8, "potholes": 3, "vehicles": 4, "courtesy": 0.5},
    "wishes": {
        "columns": 5,
        "rows": 8,
        "seed": 13,
        "potholes": 5,
        "vehicles": 3,
        "preferences": ("cautious", "avoid_potholes"),
        "safety_buffer": 2,
    },
    "braking": {"columns": 4, "rows": 7, "seed": 21, "vehicles": 6, "potholes": 0, "attentive": 0.5},
}


@pytest.fixture(autouse=True)
def _copies(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_names, "_registered", list(planner_names._registered))
    monkeypatch.setattr(registry, "_planners", dict(registry._planners))
    monkeypatch.setattr(registry, "_traits", dict(registry._traits))
    for name in planner_names.BUILT_IN:
        original = type(planner_named(name))
        register(type("Copy", (original,), {"name": f"{PREFIX}{name}"})())


@pytest.fixture(scope="module")
def narrator() -> Narrator:
    """One that knows the copies by the words of the originals."""
    sayings = Sayings.load()
    words = sayings.words("words", "planners")
    words |= {f"{PREFIX}{name}": words[name] for name in planner_names.BUILT_IN if name in words}
    return Narrator(sayings)


def named(value: object) -> str:
    """All that a value says but how much was tried for it, a copy by the name of what it is a copy of.

    Of planners that are compiled, many changes are tried at once.
    """
    return re.sub(r"((?:reruns|searched|tried)\W+)\d+", r"\1_", repr(value).replace(PREFIX, ""))


def tried(ask: Callable[..., object], *args: object) -> str:
    """An answer, or why there is none."""
    try:
        return named(ask(*args))
    except (QuestionError, EditError) as error:
        return named((type(error), error.args, vars(error)))


def driven(config: Config) -> Timeline:
    """The first episode, or its beginning."""
    timeline = Timeline(config)
    for _ in range(MADE):
        timeline.advance()
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
    return timeline


def both(name: str, **parts: Any) -> tuple[Timeline, Timeline]:
    return driven(Config(planner=name, **parts)), driven(Config(planner=f"{PREFIX}{name}", **parts))


def changes(name: str) -> tuple[tuple[WorldAction, ...], ...]:
    """By a planner other than the one that drives, so that names stay apart."""
    other = "bfs" if name != "bfs" else "rules"
    return (Prefer(preference="cautious"),), (Set(parameter="planner", value=other),)


def answers(timeline: Timeline, name: str) -> Iterator[tuple[str, str]]:
    """Every question of `sim.explain` and `sim.oracle`, with its answer."""
    for tick in range(timeline.tick):
        state = timeline.at(tick)
        decision = timeline.decided(state)
        yield f"decision {tick}", named(decision)
        yield f"why {tick}", tried(why, timeline, tick)
        yield f"outlook {tick}", tried(outlook, state)
        if decision is None:
            continue
        for move in (option.move for option in decision.options if option.cell is not None):
            yield f"regret {tick} {move}", tried(regret, state, move, 300)
        if tick % 4 == 0:
            for move in Move:
                yield f"why not {move} {tick}", tried(why_not, timeline, move, tick)
                yield f"stakes {move} {tick}", tried(stakes, state, decision, move)
            yield f"story {tick}", tried(story, state)
            yield f"route {tick}", tried(route_ahead, state)
            yield f"certificate {tick}", tried(certify, state)
            yield f"side {tick}", tried(compare_move, timeline, tick, Move.STAY)
            for change in changes(name):
                yield f"what if {change} {tick}", tried(what_if, timeline, change, tick)
                yield f"side {change} {tick}", tried(compare_change, timeline, tick, change)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        yield "summary", tried(summary, timeline.state)
    if led_to_crash(timeline, None):
        yield "crash", tried(why_crashed, timeline)


@pytest.mark.parametrize("roads", ROADS)
@pytest.mark.parametrize("name", planner_names.BUILT_IN)
def test_every_proof_is_the_same(name: str, roads: str) -> None:
    one, other = both(name, **ROADS[roads])
    assert one.state.world.digest() == other.state.world.digest()
    for (question, answer), (_, again) in zip(answers(one, name), answers(other, name), strict=True):
        assert again == answer, question


@pytest.mark.parametrize("roads", ROADS)
@pytest.mark.parametrize("name", planner_names.BUILT_IN)
def test_confidence_is_the_same(name: str, roads: str) -> None:
    """The figure, the work done for it and the share of futures that are shut off."""
    for ticks in (0, 3):
        one, other = (Timeline(Config(planner=each, **ROADS[roads])) for each in (name, f"{PREFIX}{name}"))
        for timeline in (one, other):
            for _ in range(ticks):
                timeline.advance()
        assert tried(confidence, other) == tried(confidence, one)


@pytest.mark.parametrize("roads", ROADS)
@pytest.mark.parametrize("name", planner_names.BUILT_IN)
def test_every_sentence_is_the_same(name: str, roads: str, narrator: Narrator) -> None:
    def told(timeline: Timeline) -> Iterator[object]:
        for tick in range(timeline.tick):
            state = timeline.at(tick)
            if (decision := timeline.decided(state)) is not None:
                yield narrator.decision(decision, state)
                yield tried(narrator.answer, Asked(Ask(about="why", tick=tick), timeline))
        asks = [Ask(about=about) for about in ("why", "next", "scene", "status", "metrics", "maintenance")]
        asks += [Ask(about=about) for about in ("confidence", "help")]
        asks += [Ask(about="why_not", move=move) for move in Move]
        asks += [Ask(about="what_if", change=change) for change in changes(name)]
        for ask in asks:
            fact = Asked(ask, timeline)
            yield is_slow_to_answer(timeline.state.config.planner, (fact,))
            yield tried(narrator.answer, fact)
        for wish in changes(name)[0]:
            yield narrator.reply(tuple(timeline.copy().apply(9, [wish])))

    one, other = both(name, **ROADS[roads])
    assert [named(each) for each in told(other)] == [named(each) for each in told(one)]


@pytest.mark.parametrize("name", planner_names.BUILT_IN)
def test_a_livelock_ends_at_the_same_tick(name: str) -> None:
    """At once where a situation that repeats proves one, else at the limit."""
    world = road("....", "####", "#A#.", "....")
    ends = []
    for each in (name, f"{PREFIX}{name}"):
        timeline = Timeline(Config(columns=4, rows=4, planner=each))
        timeline.state = run_on(world, planner=each)
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        ends.append((timeline.tick, timeline.state.world.digest(), timeline.state.world.outcome))
    assert ends[0] == ends[1]
    assert ends[0][2] is Outcome.STUCK
    early = registry.traits_of(name).local
    assert (ends[0][0] < run_on(world).config.max_ticks) is early


@pytest.mark.parametrize("name", planner_names.BUILT_IN)
def test_work_is_counted_alike(name: str) -> None:
    """On which it depends where snapshots are kept, and how long a session takes to come back."""
    counted = []
    for each in (name, f"{PREFIX}{name}"):
        timeline = Timeline(Config(columns=4, rows=6, potholes=2, planner=each))
        for _ in range(300):
            timeline.advance()
        counted.append((timeline.worked, timeline.work_since(0), [shot.tick for shot in timeline._snapshots]))
    assert counted[0] == counted[1]
    assert counted[0][0] == 300 * registry.traits_of(name).work


def test_a_batch_says_whom_it_is_driven_by() -> None:
    batch = Batch([Config(rows=5)])
    with pytest.raises(ValueError, match="priority, rules, bfs, weighted, astar or dijkstra"):
        batch.run(1, f"{PREFIX}priority")  # type: ignore[arg-type]


def test_a_planner_that_is_not_deterministic_is_not_registered() -> None:
    original = type(planner_named("rules"))
    traits = dataclasses.replace(original.traits, deterministic=False)  # type: ignore[union-attr]
    dice = type("Dice", (original,), {"name": "dice", "traits": traits})
    with pytest.raises(ValueError, match="not deterministic"):
        register(dice())
    assert not planner_names.known("dice")


@pytest.mark.parametrize("name", ["exact", "bfs", "dwa", f"{PREFIX}rules"])
def test_a_name_that_is_taken_is_refused(name: str) -> None:
    original = type(planner_named("rules"))
    with pytest.raises(ValueError, match="already"):
        register(type("Other", (original,), {"name": name})())
