"""A server's database of the first version, with sessions in it, is brought up like a file."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from typing import Any

import asyncpg

from service.store import SqlStore
from service.store.tables import VERSION
from tests.support.old_databases import DATA, state_of
from tests.support.postgres import Server

TABLES = """
CREATE TABLE sessions (
    number SERIAL PRIMARY KEY,
    id VARCHAR(64) NOT NULL UNIQUE, name VARCHAR(80), created_at TIMESTAMP NOT NULL,
    config JSON NOT NULL, paused BOOLEAN NOT NULL, tick INTEGER NOT NULL
);
CREATE TABLE entries (
    session_id VARCHAR(64) REFERENCES sessions (id) ON DELETE CASCADE,
    sequence INTEGER, tick INTEGER NOT NULL,
    text TEXT, actions JSON NOT NULL, PRIMARY KEY (session_id, sequence)
);
CREATE TABLE phrases (
    owner VARCHAR(64), language VARCHAR(16), key VARCHAR(200), phrase VARCHAR(80) NOT NULL,
    meaning JSON NOT NULL, PRIMARY KEY (owner, language, key)
);
"""
"""As they were before versions were written down."""

KNOWN: dict[str, dict[str, Any]] = json.loads((DATA / "version1.json").read_text())


def literal(value: object) -> str:
    return "NULL" if value is None else "'" + str(value).replace("'", "''") + "'"


async def first_version(url: str) -> str:
    """Fill a database with what `version1.sqlite` holds and a name beside; the session that has it."""
    connection = await asyncpg.connect(url)
    await connection.execute(TABLES)
    with closing(sqlite3.connect(DATA / "version1.sqlite")) as file:
        for table in ("sessions", "entries"):
            rows = file.execute(f"SELECT * FROM {table}")
            columns = ", ".join(each[0] for each in rows.description)
            for row in rows:
                values = ", ".join(map(literal, row))
                await connection.execute(f"INSERT INTO {table} ({columns}) VALUES ({values})")
    await connection.execute("SELECT setval('sessions_number_seq', (SELECT MAX(number) FROM sessions))")
    named = literal(json.dumps([{"do": "save", "name": "hill"}]))
    session, stood = next(iter(KNOWN.items()))
    added = f"({literal(session)}, {stood['sequence'] + 1}, {stood['tick']}, NULL, {named})"
    await connection.execute(f"INSERT INTO entries VALUES {added}")
    await connection.close()
    return session


async def test_a_server_database_of_version_1_is_brought_up(postgres: Server) -> None:
    url = await postgres.database()
    named = await first_version(url)
    assert len(KNOWN) == 2
    for session, stood in KNOWN.items():
        state = (await state_of(url, session)).json()
        expected = stood | {"sequence": stood["sequence"] + (session == named)}
        assert {key: state[key] for key in stood} == expected
    connection = await asyncpg.connect(url)
    version = await connection.fetchval("SELECT version_num FROM alembic_version")
    await connection.close()
    assert version == str(VERSION)
    store = SqlStore(url)
    await store.open()
    found = [(each.session, each.name) for each in await store.bookmarks(9)]
    await store.close()
    assert found == [(named, "hill")]
