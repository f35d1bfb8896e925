"""The digest of the world after an entry."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "3"
down_revision = "2"


def upgrade() -> None:
    """Entries from before have none."""
    op.add_column("entries", sa.Column("digest", sa.String(32)))
