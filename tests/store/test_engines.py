"""How a database is held: what one has left open is not kept by the next."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from service.store import EntryRecord, SessionRecord, SqlStore


async def test_what_nobody_has_ended_is_not_kept_by_the_next(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.create(
        SessionRecord(id="a", name=None, created_at=datetime(2026, 3, 29, tzinfo=UTC), config={})
    )
    assert store._engine is not None
    async with store._engine.connect() as connection:
        raw = (await connection.get_raw_connection()).driver_connection
        assert raw is not None
        await raw.execute("DELETE FROM sessions")  # past all that ends what it began
        assert raw.in_transaction
    await store.append("a", EntryRecord(sequence=1, tick=3, text=None, actions=[]))
    assert await store.count() == 1
    await store.close()
