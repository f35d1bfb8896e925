"""Forks that share their parent's log, and the names of moments by themselves."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "4"
down_revision = "3"


def upgrade() -> None:
    """No session from before has a parent; names are found in the logs."""
    for column in (
        sa.Column("parent", sa.String(64)),
        sa.Column("parent_sequence", sa.Integer),
        sa.Column("parent_tick", sa.Integer),
        sa.Column("standing", sa.Text),
        sa.Column("instead", sa.JSON),
        sa.Column("unseen", sa.Boolean, nullable=False, server_default=sa.false()),
    ):
        op.add_column("sessions", column)
    op.create_index("ix_sessions_parent", "sessions", ["parent"])
    moments = op.create_table(
        "moments",
        sa.Column("number", sa.Integer, primary_key=True, autoincrement=True),
        sa.Column(
            "session_id", sa.String(64), sa.ForeignKey("sessions.id", ondelete="CASCADE"), nullable=False
        ),
        sa.Column("name", sa.String(80), nullable=False),
        sa.Column("sequence", sa.Integer, nullable=False),
        sa.Column("tick", sa.Integer, nullable=False),
        sa.UniqueConstraint("session_id", "name", name="uq_moments_name"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_moments_name", "moments", ["name"])
    found = _found(op.get_bind())
    if found:
        op.bulk_insert(moments, found)


def _found(connection: sa.Connection) -> list[dict[str, Any]]:
    """Each name with the latest moment it was given to."""
    entries = sa.text(
        "SELECT e.session_id, e.sequence, e.tick, e.actions FROM entries e "
        "JOIN sessions s ON s.id = e.session_id WHERE CAST(e.actions AS TEXT) LIKE '%\"save\"%' "
        "ORDER BY s.number, e.sequence"
    )
    moments: dict[tuple[str, str], dict[str, Any]] = {}
    for session, sequence, tick, kept in connection.execute(entries):
        actions = json.loads(kept) if isinstance(kept, str) else kept
        ticks = {name: each["tick"] for (of, name), each in moments.items() if of == session}
        for name, at in _named(actions, tick, ticks).items():
            moments.pop((session, name), None)
            moments[session, name] = {"session_id": session, "name": name, "sequence": sequence, "tick": at}
    return list(moments.values())


def _named(actions: Sequence[Mapping[str, Any]], tick: int, ticks: dict[str, int]) -> dict[str, int]:
    """The names an entry gave, each with the tick that time stood at by then."""
    named = {}
    for action in actions:
        match action["do"]:
            case "step":
                tick += action["ticks"]
            case "rewind":
                tick -= action["ticks"]
            case "load":
                tick = ticks.get(action["name"], tick)
            case "save":
                named[action["name"]] = ticks[action["name"]] = tick
    return named
