"""The language of a session."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "6"
down_revision = "5"


def upgrade() -> None:
    """Sessions from before are in the default language."""
    op.add_column("sessions", sa.Column("language", sa.String(16)))
