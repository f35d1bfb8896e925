"""`/sessions/{id}/timeline`: a letter a tick, and the ticks that matter, for runs of thousands of ticks.

In pages, replayed beside the event loop. What was undone is no part of the run any more and left out.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any

from fastapi import Query, Response

from service.contract.timeline import TimelinePage
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.http.ticks import check_tick
from service.problems import Invalid, NotRestorable, UnknownSession
from service.work.units import move_units, state_tick_units
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Cell, Move, Outcome

router = api_router("time")

MOST_TICKS = 1_000
"""Ticks in a page of a timeline."""

_LETTERS = {
    Move.FORWARD: "F",
    Move.LEFT: "L",
    Move.RIGHT: "R",
    Move.FORWARD_LEFT: "l",
    Move.FORWARD_RIGHT: "r",
    Move.STAY: "s",
}
_BY_OFFSET = {move.offset: letter for move, letter in _LETTERS.items()}
_NO_MOVE = "-"
"""The letter of a tick at which the result of an episode stood."""


@router.get(
    "/sessions/{session_id}/timeline",
    response_model=TimelinePage,
    summary="A stretch of the run at a glance",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_timeline(
    session: TheSession,
    here: Here,
    first: Annotated[int, Query(alias="from", ge=0, le=MAX_INTEGER, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_TICKS)] = 500,
) -> Response:
    """How it moved at each tick, and where something ended, began or nearly happened.

    What was said is in `changes`.
    """
    way = session.timeline.copy()
    check_tick(first, way.tick, "from")
    stop = min(way.tick, first + limit)
    changed = {entry.tick for entry in way.entries if first <= entry.tick <= stop}
    # Moves are noted, so that hardly a tick is decided again.
    units = (stop - first + way.work_to(first)) * move_units(way.state) + len(changed) * state_tick_units(
        way.state
    )
    moves, marks = await here.manager.work.run(units, _scan, way, first, stop)
    return json_response(
        {"from": first, "now": way.tick, "moves": moves, "marks": marks, "more": stop < way.tick}
    )


def _scan(way: Timeline, first: int, stop: int) -> tuple[str, list[dict[str, Any]]]:
    """A letter for each tick from `first` up to but without `stop`, and the marks of these ticks.

    Up to the present, its own marks come along.
    """
    changed_at = {entry.tick for entry in way.entries}
    runs = list(way.between(max(0, first - 1), min(stop, way.tick) + 1))
    letters = []
    marks = _own_marks(runs[0]) if first == 0 else []
    for before, after in pairwise(runs):
        tick = before.world.tick
        if tick >= first:
            letters.append(_letter(way, before, after, by_itself=tick + 1 not in changed_at))
        if first <= tick + 1 < stop or tick + 1 == way.tick:
            marks += _near_miss(before, after) + _own_marks(after)
    return "".join(letters), marks


def _letter(way: Timeline, before: SimState, after: SimState, *, by_itself: bool) -> str:
    """How the vehicle moved; what was said on arriving may have put it elsewhere (not `by_itself`)."""
    if before.world.outcome is not Outcome.RUNNING:
        return _NO_MOVE
    if by_itself:
        old, new = before.world, after.world
        (column, row), (new_column, new_row) = old.road.cell(old.av), new.road.cell(new.av)
        return _BY_OFFSET[new_column - column, new_row - row]
    decision = way.decided(before)
    assert decision is not None  # it was running
    return _LETTERS[decision.move]


def _near_miss(before: SimState, after: SimState) -> list[dict[str, Any]]:
    old, new = before.world, after.world
    if old.episode != new.episode or old.outcome is not Outcome.RUNNING or old.av == new.av:
        return []
    name = new.movers.get(old.av)
    if name is None or name not in old.movers.values():
        return []
    return [_mark(new.tick, "near_miss", (name,), new.road.cell(old.av))]


def _own_marks(run: SimState) -> list[dict[str, Any]]:
    """What the world of a tick is by itself: the end of an episode, or the beginning of one."""
    world = run.world
    marks = []
    if world.episode_start == world.tick:
        marks.append(_mark(world.tick, "episode"))
    if world.ended == world.tick:
        ids, cell = (world.cause.ids, world.cause.cell) if world.cause else ((), None)
        marks.append(_mark(world.tick, world.outcome, ids, cell))
    return marks


def _mark(tick: int, kind: str, ids: tuple[str, ...] = (), cell: Cell | None = None) -> dict[str, Any]:
    return {"tick": tick, "kind": kind, "ids": ids, "cell": cell}
