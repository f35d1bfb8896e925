"""When a session was last used, for retention; the secrets of a service."""

from __future__ import annotations

from datetime import UTC, datetime

import sqlalchemy as sa
from alembic import op

revision = "8"
down_revision = "7"


def upgrade() -> None:
    """Sessions from before count as used now: none is deleted because nobody wrote it down.

    Secrets are made when they are first asked for.
    """
    op.add_column("sessions", sa.Column("used_at", sa.DateTime))
    sessions = sa.table("sessions", sa.column("used_at", sa.DateTime))
    op.execute(sessions.update().values(used_at=datetime.now(UTC).replace(tzinfo=None)))
    op.create_index("ix_sessions_used_at", "sessions", ["used_at"])
    op.create_table(
        "secrets",
        sa.Column("name", sa.String(64), primary_key=True),
        sa.Column("value", sa.LargeBinary, nullable=False),
    )
