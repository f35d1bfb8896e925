"""The messages of the stream; each is encoded once for all subscribers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Final

import orjson

from service.contract.encode.decision import brief_decision_json
from service.contract.encode.json import encoded
from service.contract.encode.state import Json, SessionStatus, metrics_json, state_json
from service.sessions.log import LogEvent
from service.sessions.subscribers import MissedTicks
from sim.plan import Decision
from sim.session.edits import Change
from sim.state import SimState
from sim.types import Cell, Kind
from sim.world import World

PROTOCOL = 1
"""Version of the stream: increases when a message changes its meaning, not for new keys."""

_FIRST_AV: Final = f"{Kind.AV}-1"
_SIDES: Final = {"1": "right", "0": "left"}

_SMALL_ROAD: Final = 512
"""Roads of up to so many cells have a cached table of cells; many sizes of them take a few megabytes."""


def hello_message(
    session: Json, state: bytes, log: Sequence[LogEvent], decision: Json | None, sequence: int
) -> bytes:
    """The first message on a socket; `state` is JSON text."""
    return encoded(
        {
            "type": "hello",
            "protocol": PROTOCOL,
            "session": session,
            "state": orjson.Fragment(state),
            "log": log,
            "decision": decision,
            "sequence": sequence,
        }
    )


def tick_message(
    sequence: int,
    status: Callable[[], SessionStatus],
    before: SimState,
    after: SimState,
    decision: Decision | None,
    narration: str | None,
    lines: Sequence[LogEvent],
) -> bytes:
    """One tick: what moved, or the whole state where a new road began or a rule was done (with `status`)."""
    world = after.world
    if world.episode != before.world.episode or after.triggers != before.triggers:
        seen: Json = {"state": state_json(status(), after)}
    else:
        seen = motion_json(before.world, world)
    return encoded(
        {
            "type": "tick",
            "tick": world.tick,
            "sequence": sequence,
            "episode": world.episode,
            "status": world.outcome,
            **seen,
            "decision": None if decision is None else brief_decision_json(decision),
            "narration": narration,
            "events": lines,
            "metrics": metrics_json(after.metrics),
            "digest": world.digest(),
        }
    )


def changed_message(
    status: SessionStatus,
    run: SimState,
    text: str | None,
    reply: str,
    changes: Sequence[Change],
    lines: Sequence[LogEvent],
    views: Mapping[str, bool] | None = None,
) -> bytes:
    """An accepted change; `views` are those to be shown (true) or hidden (false)."""
    # The type stands first: readers of events take its name from there.
    told: Json = {
        "type": "changed",
        "sequence": status.sequence,
        "text": text,
        "reply": reply,
        "changes": changes,
        "events": lines,
        "state": state_json(status, run),
    }
    if views:
        told["views"] = views
    return encoded(told)


def state_message(state: bytes, missed: MissedTicks | None) -> bytes:
    """The whole state, for a subscriber that missed some ticks."""
    ticks = None if missed is None else [missed.first_tick, missed.last_tick]
    return encoded({"type": "state", "missed": ticks, "state": orjson.Fragment(state)})


def motion_json(before: World, after: World) -> dict[str, Any]:
    """New cells and headings by id; things that stood still are left out."""
    road, movers = after.road, after.movers
    names = [*movers.values()]
    olds: Iterable[int] = before.movers
    if names != [*before.movers.values()]:  # not two ticks of one road
        was = {name: index for index, name in before.movers.items()}
        olds = [was.get(name, -1) for name in names]
    small = road.columns * road.rows <= _SMALL_ROAD
    cells = _cells(road.columns, road.rows) if small else {index: road.cell(index) for index in movers}
    # As digits, lowest first: looking at one is much quicker than shifting a board.
    top = road.all + 1
    faced_right = bin(before.right | top)[:1:-1]
    faces_right = bin(after.right | top)[:1:-1]
    moved: dict[str, Cell] = {}
    turned: dict[str, str] = {}
    for old, index, name in zip(olds, movers, names, strict=True):
        if old != index:
            moved[name] = cells[index]
            if old < 0:
                continue  # it has come, and turned nowhere
        if faced_right[old] != faces_right[index]:
            turned[name] = _SIDES[faces_right[index]]
    avs = after.avs
    if len(avs) == 1:
        vehicles = {_FIRST_AV: road.cell(avs[0])}
    else:
        vehicles = {after.id_at(index, Kind.AV): road.cell(index) for index in avs}
    return {"vehicles": vehicles, "moved": moved, "turned": turned}


@lru_cache(maxsize=128)
def _cells(columns: int, rows: int) -> tuple[Cell, ...]:
    """Every cell of a road, by index."""
    return tuple((index % columns, index // columns) for index in range(columns * rows))
