"""Commits of entries to SQLite in one call of the driver, on a thread of their own.

SQLAlchemy goes to the driver's thread and back for each statement, which takes the event loop several times
as long as all else that a command does. The rows are the same: their values pass through the types of the
tables.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Table
from sqlalchemy.dialects import sqlite

from service.store.log_writer import PendingEntry
from service.store.rows import bookmarks_to_rows, entry_to_row, response_to_row
from service.store.tables import ENTRIES, IDEMPOTENCY, MOMENTS


class RowInsert:
    """The statement that inserts rows of a table, and their values as the driver takes them."""

    def __init__(self, table: Table) -> None:
        dialect = sqlite.dialect()
        given = [column for column in table.columns if column.autoincrement is not True]
        names = ", ".join(f'"{column.name}"' for column in given)
        self.statement = f'INSERT INTO "{table.name}" ({names}) VALUES ({", ".join("?" * len(given))})'
        self._columns = [
            (column.name, column.type.dialect_impl(dialect).bind_processor(dialect)) for column in given
        ]

    def values(self, row: Mapping[str, Any]) -> tuple[Any, ...]:
        """A row as the statement takes it."""
        return tuple(row[name] if process is None else process(row[name]) for name, process in self._columns)


_ENTRY, _ANSWER, _MOMENT = RowInsert(ENTRIES), RowInsert(IDEMPOTENCY), RowInsert(MOMENTS)
_FORGET_MOMENT = f'DELETE FROM "{MOMENTS.name}" WHERE session_id = ? AND name = ?'


@dataclass(frozen=True, slots=True)
class EntryRows:
    """The rows of a batch of entries, ready to be written by any thread."""

    entries: Sequence[tuple[Any, ...]]
    answers: Sequence[tuple[Any, ...]]
    moments: Sequence[tuple[Any, ...]]
    renamed: Sequence[tuple[str, str]]
    """session and name of bookmarks that take the place of others"""

    @staticmethod
    def of(batch: Sequence[PendingEntry]) -> EntryRows:
        """The rows of some entries, in their order."""
        moments = [row for each in batch for row in bookmarks_to_rows(each.session, each.entry)]
        answers = [each.answer for each in batch if each.answer is not None]
        return EntryRows(
            [_ENTRY.values(entry_to_row(each.session, each.entry)) for each in batch],
            [_ANSWER.values(response_to_row(answer)) for answer in answers],
            [_MOMENT.values(row) for row in moments],
            [(row["session_id"], row["name"]) for row in moments],
        )

    def write(self, connection: sqlite3.Connection) -> None:
        """Commit them, all or none. Raises `sqlite3.Error`."""
        connection.execute("BEGIN IMMEDIATE")
        try:
            connection.executemany(_ENTRY.statement, self.entries)
            if self.moments:
                connection.executemany(_FORGET_MOMENT, self.renamed)
                connection.executemany(_MOMENT.statement, self.moments)
            if self.answers:
                connection.executemany(_ANSWER.statement, self.answers)
            connection.execute("COMMIT")
        except BaseException:
            with suppress(sqlite3.Error):
                connection.rollback()
            raise
