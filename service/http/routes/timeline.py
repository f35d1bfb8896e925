"""A whole run at a glance and at a touch: `timeline`, `changes`, `moments`.

`state` and `decisions` tell one tick in full. Who shows a run of thousands needs a letter a tick and the
places that matter; who drags along it needs several worlds at once. Both come in pages, replayed beside
the event loop. Leaves out what was undone: it is no part of the run any more.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby, pairwise
from typing import Annotated, Any, Literal

from anyio import to_thread
from fastapi import APIRouter, Query, Response
from pydantic import Field

from service import actions as contract
from service.contract.encode.state import Standing, state_json
from service.contract.parts import Answered, CellPair, Decision, State
from service.contract.requests import Tick
from service.http.deps import Here, TheSession
from service.http.errors import documented, invalid
from service.http.responses import StrictRoute, json_response
from service.http.session_json import told_decision
from service.problems import FieldProblem, Invalid, NotRestorable, NotSaved, UnknownSession
from service.sessions.narrator_protocol import Words
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Cell, Move, Outcome

router = APIRouter(tags=["time"], route_class=StrictRoute)

MOST_TICKS = 1_000
"""Ticks in a page of a timeline."""
MOST_MOMENTS = 64
"""Worlds in a page of moments."""
MOST_CHANGES = 1_000

_MOST = 2**53 - 1
_LETTERS = {
    Move.FORWARD: "F",
    Move.LEFT: "L",
    Move.RIGHT: "R",
    Move.FORWARD_LEFT: "l",
    Move.FORWARD_RIGHT: "r",
    Move.STAY: "s",
}
_BY_OFFSET = {move.offset: letter for move, letter in _LETTERS.items()}
_HELD = "-"
"""The letter of a tick at which a result stood."""
_ALWAYS = (UnknownSession, Invalid, NotRestorable)


class TimelineMark(Answered):
    """A tick that matters."""

    tick: Tick
    kind: Literal["crash", "success", "stuck", "near_miss", "episode"] = Field(
        description="`near_miss`: something that moves came into the cell that the vehicle had just left, "
        "and would have hit it had it stayed. `episode`: one begins."
    )
    ids: list[str]
    cell: CellPair | None


class TimelinePage(Answered):
    """A stretch of a run."""

    first: Tick = Field(alias="from")
    now: Tick = Field(description="The session's present tick.")
    moves: str = Field(
        description="A letter for each tick from `from` on: F forward, L left, R right, l forward left, "
        "r forward right, s stay, - where the result of an episode stood."
    )
    marks: list[TimelineMark]
    more: bool


class RoadChange(Answered):
    """Something said or done that changed the road, and still stands."""

    tick: Tick
    sequence: int
    text: str = Field(description="As it was said; of typed actions, what says the same.")
    said: bool = Field(description="Whether it was said, rather than done by typed actions.")


class RoadChanges(Answered):
    """The newest changes that stand, oldest first."""

    items: list[RoadChange]
    more: bool = Field(description="Whether older ones are left out.")


class Moment(Answered):
    """A world, with the decision that led to it."""

    state: State
    decision: Decision | None


class Moments(Answered):
    """Several ticks in a row."""

    items: list[Moment]
    now: Tick = Field(description="The session's present tick.")


@router.get(
    "/sessions/{session_id}/timeline",
    response_model=TimelinePage,
    summary="A stretch of the run at a glance",
    responses=documented(*_ALWAYS),
)
async def timeline(
    session: TheSession,
    first: Annotated[int, Query(alias="from", ge=0, le=_MOST, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_TICKS)] = 500,
) -> Response:
    """How it moved at each tick, and where something ended, began or nearly happened.

    What was said is in `changes`.
    """
    way = session.timeline.copy()
    _check(first, way.tick)
    stop = min(way.tick, first + limit)
    moves, marks = await to_thread.run_sync(_seen, way, first, stop)
    return json_response(
        {"from": first, "now": way.tick, "moves": moves, "marks": marks, "more": stop < way.tick}
    )


@router.get(
    "/sessions/{session_id}/changes",
    response_model=RoadChanges,
    summary="What was said and stands",
    responses=documented(*_ALWAYS, NotSaved),
)
async def changes(
    session: TheSession, here: Here, limit: Annotated[int, Query(ge=1, le=MOST_CHANGES)] = 200
) -> Response:
    """Every change of the road that was not undone, with its tick: what makes this run what it is.

    Where it differs from what it was, the run is another from that tick on.
    """
    entries = list(session.timeline.entries)
    said = {entry.sequence: entry.text for entry in await here.manager.entries(session)}
    groups = [list(group) for _, group in groupby(entries, key=lambda each: (each.sequence, each.tick))]
    items = []
    for group in groups[-limit:]:
        sequence, text = group[0].sequence, said.get(group[0].sequence)
        if text is None:
            dumped = contract.dump(tuple(entry.action for entry in group))
            told = here.listener.phrasebook.told(contract.load(dumped), session.language)
        else:
            told = text
        items.append({"tick": group[0].tick, "sequence": sequence, "text": told, "said": text is not None})
    return json_response({"items": items, "more": len(groups) > limit})


@router.get(
    "/sessions/{session_id}/moments",
    response_model=Moments,
    summary="Several ticks in full",
    responses=documented(*_ALWAYS),
)
async def moments(
    session: TheSession,
    first: Annotated[int, Query(alias="from", ge=0, le=_MOST, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_MOMENTS)] = 16,
) -> Response:
    """Worlds in a row, each with the decision that led to it, as a reader of the stream had them."""
    way, standing = session.timeline.copy(), session.standing
    _check(first, way.tick)
    stop = min(way.tick + 1, first + limit)
    items = await to_thread.run_sync(lambda: list(_moments(session.words, standing, way, first, stop)))
    return json_response({"items": items, "now": way.tick})


def _check(first: int, now: int) -> None:
    if first > now:
        raise invalid([FieldProblem("from", f"has not come yet: it is tick {now}")])


def _moments(
    words: Words, standing: Standing, way: Timeline, first: int, stop: int
) -> Iterator[dict[str, Any]]:
    before: SimState | None = None
    for run in way.between(max(0, first - 1), stop):
        if run.world.tick >= first:
            decision = None if before is None else way.decided(before)
            told = None
            if before is not None and decision is not None:
                told = told_decision(words, before, decision)
            yield {"state": state_json(standing, run), "decision": told}
        before = run


def _seen(way: Timeline, first: int, stop: int) -> tuple[str, list[dict[str, Any]]]:
    """A letter for each tick from `first` up to but without `stop`, and the marks of these ticks.

    Up to the present, its own marks come along.
    """
    said_at = {entry.tick for entry in way.entries}
    runs = list(way.between(max(0, first - 1), min(stop, way.tick) + 1))
    letters = []
    marks = _own_marks(runs[0]) if first == 0 else []
    for before, after in pairwise(runs):
        tick = before.world.tick
        if tick >= first:
            letters.append(_letter(way, before, after, by_itself=tick + 1 not in said_at))
        if first <= tick + 1 < stop or tick + 1 == way.tick:
            marks += _near_miss(before, after) + _own_marks(after)
    return "".join(letters), marks


def _letter(way: Timeline, before: SimState, after: SimState, *, by_itself: bool) -> str:
    """How the vehicle moved; what was said on arriving may have put it elsewhere (not `by_itself`)."""
    if before.world.outcome is not Outcome.RUNNING:
        return _HELD
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
