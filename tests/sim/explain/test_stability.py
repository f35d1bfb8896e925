"""What a planner does not look at changes no word of its explanation."""

from __future__ import annotations

import random
from collections.abc import Iterable

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Add, Remove, Where, WorldAction
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Move
from tests.support.moments import moments

NARRATOR = Narrator.load()
FAR_ROWS = 5
"""Rows from the vehicle beyond which nothing can matter to a planner that looks one tick ahead."""


def told(state: SimState, ask: Ask) -> str:
    """The answer about the decision that is taken in this state."""
    timeline = Timeline(state.config)
    timeline.state = state
    timeline._recent.append(state)
    timeline.state = step(state).state
    return str(NARRATOR.answer(Asked(ask, timeline))["text"])


def changed(state: SimState, rows: Iterable[int], draw: random.Random) -> SimState:
    """The run with some things added to these rows, or taken from them."""
    rows = list(rows)
    there = [thing for thing in state.world.things() if thing.cell[1] in rows]
    actions: list[WorldAction] = [
        Remove(kind=thing.kind.value, count=1, where=Where(id=thing.id))
        for thing in there
        if draw.random() < 0.5
    ]
    for _ in range(3 if rows else 0):
        kind = draw.choice([Kind.POTHOLE, Kind.VEHICLE, Kind.BARRIER, Kind.PEDESTRIAN])
        cell = (draw.randrange(state.world.road.columns), draw.choice(rows))
        actions.append(Add(kind=kind.value, count=1, where=Where(cell=cell)))
    for action in actions:
        try:
            state = apply(state, action).state
        except EditError:
            continue  # no room there
    return state


def test_what_is_far_changes_no_word_of_a_why() -> None:
    draw, compared = random.Random(3), 0
    for timeline in moments(300, seed=6):
        state = timeline.at(timeline.tick - 1)
        row = state.world.road.cell(state.world.av)[1]
        far = [r for r in range(1, state.world.road.rows - 1) if abs(r - row) >= FAR_ROWS]
        other = changed(state, far, draw)
        compared += other.world != state.world
        assert told(other, Ask(about="why")) == told(state, Ask(about="why"))
    assert compared > 200


def test_what_is_behind_changes_no_word_of_any_explanation() -> None:
    draw, compared = random.Random(4), 0
    for timeline in moments(150, seed=7):
        state = timeline.at(timeline.tick - 1)
        row = state.world.road.cell(state.world.av)[1]
        behind = list(range(row + 2, state.world.road.rows - 1))
        other = changed(state, behind, draw)
        compared += other.world != state.world
        for ask in (Ask(about="why"), *(Ask(about="why_not", move=move) for move in Move)):
            assert told(other, ask) == told(state, ask)
    assert compared > 60
