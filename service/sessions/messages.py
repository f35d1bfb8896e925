"""The messages of the stream, each made and encoded once for all watchers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from service.sessions.log import LogEvent
from service.sessions.watchers import Missed
from service.wire.decision import brief_decision_json
from service.wire.encode import encoded
from service.wire.state import Json, Standing, metrics_json, state_json
from sim.edit import Change
from sim.kinds import Cell, Kind
from sim.plan import Decision
from sim.run import Run
from sim.world import World

PROTOCOL = 1
"""Raised when a message changes its meaning; new keys do not raise it."""


def hello_message(
    session: Json, state: Json, log: Sequence[LogEvent], decision: Json | None, sequence: int
) -> bytes:
    """The first message on a socket."""
    return encoded(
        {
            "type": "hello",
            "protocol": PROTOCOL,
            "session": session,
            "state": state,
            "log": log,
            "decision": decision,
            "sequence": sequence,
        }
    )


def tick_message(
    standing: Standing,
    before: Run,
    after: Run,
    decision: Decision | None,
    narration: str | None,
    lines: Sequence[LogEvent],
) -> bytes:
    """One tick: what moved, or the whole state where a new road began."""
    world = after.world
    message: Json = {
        "type": "tick",
        "tick": world.tick,
        "sequence": standing.sequence,
        "episode": world.episode,
        "status": world.outcome,
    }
    if world.episode != before.world.episode:
        message["state"] = state_json(standing, after)
    else:
        message |= motion_json(before.world, world)
    return encoded(
        message
        | {
            "decision": None if decision is None else brief_decision_json(decision),
            "narration": narration,
            "events": lines,
            "metrics": metrics_json(after.metrics),
            "digest": world.digest(),
        }
    )


def changed_message(
    standing: Standing,
    run: Run,
    text: str | None,
    reply: str,
    changes: Sequence[Change],
    lines: Sequence[LogEvent],
    views: Mapping[str, bool] | None = None,
) -> bytes:
    """A change that was accepted, whoever made it; `views` are those to be shown (true) or hidden."""
    told: Json = {"views": views} if views else {}
    return encoded(
        told
        | {
            "type": "changed",
            "sequence": standing.sequence,
            "text": text,
            "reply": reply,
            "changes": changes,
            "events": lines,
            "state": state_json(standing, run),
        }
    )


def state_message(standing: Standing, run: Run, missed: Missed | None) -> bytes:
    """All there is to go on from, for a reader that missed some ticks."""
    told = None if missed is None else [missed.first_tick, missed.last_tick]
    return encoded({"type": "state", "missed": told, "state": state_json(standing, run)})


def motion_json(before: World, after: World) -> dict[str, Any]:
    """Where things went and which way they turned, by id; what stood still is left out."""
    was = {name: index for index, name in before.movers.items()}
    moved: dict[str, Cell] = {}
    turned: dict[str, str] = {}
    for index, name in after.movers.items():
        old = was.get(name)
        if old != index:
            moved[name] = after.road.cell(index)
        faces_right = after.right >> index & 1
        if old is not None and before.right >> old & 1 != faces_right:
            turned[name] = "right" if faces_right else "left"
    vehicles = {after.id_at(index, Kind.AV): after.road.cell(index) for index in after.avs}
    return {"vehicles": vehicles, "moved": moved, "turned": turned}
