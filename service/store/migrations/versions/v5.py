"""Snapshots, which only save time, and whether time stood still where the log does not tell."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "5"
down_revision = "4"


def upgrade() -> None:
    """There are none yet; entries from before are as their log tells."""
    op.add_column("entries", sa.Column("paused", sa.Boolean))
    op.create_table(
        "snapshots",
        sa.Column(
            "session_id", sa.String(64), sa.ForeignKey("sessions.id", ondelete="CASCADE"), primary_key=True
        ),
        sa.Column("sequence", sa.Integer, nullable=False),
        sa.Column("tick", sa.Integer, nullable=False),
        sa.Column("version", sa.String(64), nullable=False),
        sa.Column("checksum", sa.String(32), nullable=False),
        sa.Column("body", sa.LargeBinary, nullable=False),
    )
