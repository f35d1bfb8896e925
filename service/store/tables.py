"""The tables in their current version; `migrations` upgrades older ones."""

from __future__ import annotations

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    DateTime,
    ForeignKey,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
    false,
)

VERSION = 8
"""Of the schema; the number of the last migration."""

METADATA = MetaData()

SESSIONS = Table(
    "sessions",
    METADATA,
    Column("number", Integer, primary_key=True, autoincrement=True),
    Column("id", String(64), nullable=False, unique=True),
    Column("name", String(80)),
    Column("created_at", DateTime, nullable=False, comment="UTC"),
    Column("config", JSON, nullable=False),
    Column("paused", Boolean, nullable=False, comment="how it began"),
    Column("tick", Integer, nullable=False),
    Column("language", String(16), comment="of its log; none for what was kept before version 6"),
    Column("parent", String(64), index=True, comment="what a fork's log begins with: see `base.Branch`"),
    Column("parent_sequence", Integer),
    Column("parent_tick", Integer),
    Column("standing", Text),
    Column("instead", JSON),
    Column("used_at", DateTime, index=True, comment="UTC; when it was last used, to within an hour"),
    Column("unseen", Boolean, nullable=False, server_default=false(), comment="deleted, but for its forks"),
    sqlite_autoincrement=True,
)

ENTRIES = Table(
    "entries",
    METADATA,
    Column("session_id", ForeignKey("sessions.id", ondelete="CASCADE"), primary_key=True),
    Column("sequence", Integer, primary_key=True, autoincrement=False),
    Column("tick", Integer, nullable=False),
    Column("text", Text),
    Column("actions", JSON, nullable=False),
    Column("digest", String(32), comment="of the world after it; none for what was kept before version 3"),
    Column("paused", Boolean, comment="whether time stood still, where the log does not tell"),
)

SNAPSHOTS = Table(
    "snapshots",
    METADATA,
    Column("session_id", ForeignKey("sessions.id", ondelete="CASCADE"), primary_key=True),
    Column("sequence", Integer, nullable=False),
    Column("tick", Integer, nullable=False),
    Column("version", String(64), nullable=False, comment="of its form, and of the program that made it"),
    Column("checksum", String(32), nullable=False, comment="of all the rest"),
    Column("body", LargeBinary, nullable=False, comment="JSON, deflated"),
)

MOMENTS = Table(
    "moments",
    METADATA,
    Column("number", Integer, primary_key=True, autoincrement=True),
    Column("session_id", ForeignKey("sessions.id", ondelete="CASCADE"), nullable=False),
    Column("name", String(80), nullable=False, index=True),
    Column("sequence", Integer, nullable=False),
    Column("tick", Integer, nullable=False),
    UniqueConstraint("session_id", "name", name="uq_moments_name"),
    sqlite_autoincrement=True,
)

PHRASES = Table(
    "phrases",
    METADATA,
    Column("owner", String(64), primary_key=True),
    Column("language", String(16), primary_key=True),
    Column("key", String(200), primary_key=True, comment="its words, as they are compared"),
    Column("phrase", String(80), nullable=False),
    Column("meaning", JSON, nullable=False),
)

IDEMPOTENCY = Table(
    "idempotency",
    METADATA,
    Column("key", String(255), primary_key=True),
    Column("request", String(64), nullable=False, comment="digest of what was asked"),
    Column("at", BigInteger, nullable=False, index=True, comment="seconds since 1970"),
    Column("status", Integer, nullable=False),
    Column("headers", JSON, nullable=False),
    Column("body", LargeBinary, nullable=False),
)

SECRETS = Table(
    "secrets",
    METADATA,
    Column("name", String(64), primary_key=True),
    Column("value", LargeBinary, nullable=False, comment="random, and never told"),
)

JOBS = Table(
    "jobs",
    METADATA,
    Column("number", Integer, primary_key=True, autoincrement=True),
    Column("id", String(64), nullable=False, unique=True),
    Column("kind", String(16), nullable=False),
    Column("state", String(16), nullable=False),
    Column("created_at", DateTime, nullable=False, comment="UTC"),
    Column("spec", JSON, nullable=False, comment="what is to be done"),
    Column("done", Integer, nullable=False, comment="pieces of work that are finished"),
    Column("total", Integer, nullable=False),
    Column("result", JSON, comment="once it is done"),
    Column("error", Text, comment="why it failed"),
    sqlite_autoincrement=True,
)

JOB_PARTS = Table(
    "job_parts",
    METADATA,
    Column("job_id", ForeignKey("jobs.id", ondelete="CASCADE"), primary_key=True),
    Column("key", String(64), primary_key=True, comment="of the piece of work"),
    Column("body", LargeBinary, nullable=False, comment="what it came to"),
)
