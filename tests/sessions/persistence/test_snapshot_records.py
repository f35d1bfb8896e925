"""By a snapshot a session comes back as by its whole log; and a bad snapshot is no matter."""

from __future__ import annotations

import asyncio
import zlib
from copy import deepcopy
from dataclasses import replace
from typing import Any

import orjson
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.problems import NotRestorable
from service.sessions.persistence import snapshot_records as module
from service.sessions.persistence.snapshot_records import UnfitError, unpack
from service.sessions.session import Session
from service.store import MemoryStore, SnapshotRecord
from sim.config import Config
from tests.support.session_talk import load, rewind, save
from tests.support.sessions import ADD, ADD_CARS, UNDO, Service, do
from tests.support.snapshots import TALK, all_of, back, compared, said

ASK = {"do": "ask", "about": "why"}

Said = list[tuple[int, list[dict[str, object]]]]


@settings(max_examples=60, deadline=None)
@given(
    talk=TALK,
    kept=st.sampled_from([10, 400]),
    ends=st.sets(st.integers(0, 12), max_size=3),
    asked=st.sets(st.integers(0, 12), max_size=3),
    snapshot_at=st.integers(0, 12),
    fork_at=st.none() | st.integers(0, 12),
    running=st.booleans(),
)
def test_by_a_snapshot_it_is_what_it_is_by_its_log(
    talk: Said,
    kept: int,
    ends: set[int],
    asked: set[int],
    snapshot_at: int,
    fork_at: int | None,
    running: bool,
) -> None:
    """Whatever was said, asked, forked and ended meanwhile, and wherever the snapshot was taken."""

    async def one() -> None:
        given = {"log_events": kept, "snapshot_work": 10**6}
        service = Service(**given)
        session = await service.session(paused=not running)
        for number, (ticks, actions) in enumerate(talk):
            service.clock.tick(ticks)
            await said(session, actions)
            if number in asked:
                await said(session, [ASK])
                session.announce("taught", None, "Something was taught.")
            if number == fork_at:
                session = await service.manager.fork(session, session.timeline.tick * 2 // 3, paused=True)
            if number == snapshot_at:
                service.manager.snapshots.take(session)
                await service.manager.snapshots.flush()
            if number in ends:
                service = Service(service.store, **given)  # as after a kill
                session = await service.manager.get(session.id)
        if await service.store.snapshot(session.id) is None:
            service.manager.snapshots.take(session)
            await service.manager.snapshots.flush()
            # It is taken where the clock stands; a service that ends stores that.
            await service.store.save_ticks({session.id: session.timeline.tick})
        record = await service.store.snapshot(session.id)
        assert record is not None
        entries = await service.store.entries(session.id)
        later = [each.tick for each in entries if each.sequence > record.sequence]
        until = later[0] if later else (await service.store.get(session.id)).tick
        if record.tick <= until:
            await compared(service.store, session.id, **given)
        else:  # the clock had run on, and was killed
            service = Service(service.store, **given)
            await service.manager.get(session.id)
            assert service.manager.snapshots.counts == {"unfit": 1}

    asyncio.run(one())


async def talked(**given: int) -> tuple[Service, Session]:
    service = Service(snapshot_work=10**6, **given)
    session = await service.session(paused=True)
    for actions in ([ADD], [{"do": "step", "ticks": 9}, ADD_CARS], [save("a")], [rewind(4)], [ADD], [UNDO]):
        await do(session, *actions)
    service.manager.snapshots.take(session)
    await service.manager.snapshots.flush()
    await do(session, {"do": "step", "ticks": 5}, ADD)
    await do(session, load("a"))
    return service, session


async def test_what_follows_a_snapshot_is_done_again() -> None:
    service, session = await talked()
    record = await service.store.snapshot(session.id)
    assert record is not None
    assert (record.sequence, session.sequence) == (6, 8)
    await compared(service.store, session.id)


async def used_or_not(store: MemoryStore, session: str) -> tuple[bool, Session]:
    service = Service(deepcopy(store), snapshot_work=10**6)
    found = await service.manager.get(session)
    return service.manager.snapshots.counts["used"] == 1, found


async def test_a_bit_that_is_another_makes_it_none() -> None:
    service, session = await talked()
    good = await service.store.snapshot(session.id)
    assert good is not None
    other = all_of(await back(service.store, session.id, short=False))
    assert await used_or_not(service.store, session.id)
    for place in range(0, len(good.body), max(1, len(good.body) // 60)):
        body = bytearray(good.body)
        body[place] ^= 1 << place % 8
        await service.store.save_snapshot(replace(good, body=bytes(body)))
        used, found = await used_or_not(service.store, session.id)
        assert not used
        assert all_of(found) == other
    for body in (b"", good.body[:-1], good.body + b"\0", zlib.compress(b"{}"), zlib.compress(b"[[[")):
        await service.store.save_snapshot(replace(good, body=body))
        assert not (await used_or_not(service.store, session.id))[0]


@pytest.mark.parametrize(
    "change",
    [
        {"sequence": 5},
        {"sequence": 7},
        {"tick": 4},
        {"tick": 6},
        {"version": "0.old"},
        {"checksum": "0" * 32},
    ],
    ids=str,
)
async def test_a_field_that_is_another_makes_it_none(change: dict[str, Any]) -> None:
    service, session = await talked()
    good = await service.store.snapshot(session.id)
    assert good is not None
    other = all_of(await back(service.store, session.id, short=False))
    bad = replace(good, **change)
    for record in (bad, bad if "checksum" in change else sealed_again(bad)):
        await service.store.save_snapshot(record)
        used, found = await used_or_not(service.store, session.id)
        assert not used
        assert all_of(found) == other


def sealed_again(record: SnapshotRecord) -> SnapshotRecord:
    parts = (record.session, record.sequence, record.tick, record.version)
    return replace(record, checksum=module._checksum(parts, record.body))


def values_of(record: SnapshotRecord) -> dict[str, Any]:
    return orjson.loads(zlib.decompress(record.body))  # type: ignore[no-any-return]


def changed(record: SnapshotRecord, path: list[Any], value: object) -> SnapshotRecord:
    """The record with a value in it changed, and a checksum that says it is whole."""
    values = values_of(record)
    place = values
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return sealed_again(replace(record, body=zlib.compress(orjson.dumps(values))))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (["session"], "another"),
        (["trail"], "00" * 16),
        (["trail"], "no digest"),
        (["held"], 399),
        (["planners"], {"nobody": "1"}),
        (["states", "worlds", 0, 9], "0"),
        (["states", "worlds", 0, 9], "not a board"),
        (["states", "worlds", 0, 2], -1),
        (["states", "worlds", 0, 5], "nowhere"),
        (["states", "digest"], "0" * 32),
        (["states", "configs", 0], {}),
        (["states", "configs", 0, "planner"], "unheard of"),
        (["states", "runs"], []),
        (["states"], None),
        (["timelines", 0, 2], 99),
        (["entries", 3], [{"do": "undo", "ticks": 5}]),
        (["logs"], []),
        (["snapshots"], [[10**6, 0]]),
        (["done"], None),
        (["conversation", "where"], {"cell": 5}),
        (["timeline"], 99),
    ],
    ids=str,
)
async def test_a_value_that_cannot_be_makes_it_none_though_its_checksum_is_right(
    path: list[Any], value: object
) -> None:
    service, session = await talked()
    good = await service.store.snapshot(session.id)
    assert good is not None
    other = all_of(await back(service.store, session.id, short=False))
    await service.store.save_snapshot(changed(good, path, value))
    used, found = await used_or_not(service.store, session.id)
    assert not used
    assert all_of(found) == other


async def test_another_world_than_the_log_names_makes_it_none() -> None:
    """Whole in itself, and wrong: the present is where a moment stands that was saved elsewhere."""
    service, session = await talked()
    good = await service.store.snapshot(session.id)
    record = await service.store.get(session.id)
    assert good is not None
    assert record is not None
    values = values_of(good)
    (_, _, elsewhere), *_ = values["saved"]
    wrong = changed(good, ["timelines", 0, 1], values["timelines"][elsewhere][1])
    ends = replace(wrong, tick=9)
    wrong = sealed_again(changed(ends, ["tick"], 9))
    entries = list(await service.store.entries(session.id))
    with pytest.raises(UnfitError, match=r"another world|beyond"):
        unpack(wrong, record, entries, 400)
    entries[5] = replace(entries[5], digest="0" * 32)
    with pytest.raises(UnfitError, match="another log"):
        unpack(good, record, entries, 400)


async def test_the_row_of_another_session_is_none_of_its_own() -> None:
    """Also where that one had the same said to it."""
    service, session = await talked()
    other = await service.session(paused=True)
    good = await service.store.snapshot(session.id)
    assert good is not None
    for actions in ([ADD], [{"do": "step", "ticks": 9}, ADD_CARS], [save("a")], [rewind(4)], [ADD], [UNDO]):
        await do(other, *actions)
    for record in (replace(good, session=other.id), sealed_again(replace(good, session=other.id))):
        service.store._snapshots[other.id] = record
        assert not (await used_or_not(service.store, other.id))[0]
    service.store._snapshots[other.id] = good
    assert not (await used_or_not(service.store, other.id))[0]


async def test_of_a_log_that_went_another_way_it_is_none() -> None:
    service, session = await talked()
    log = service.store._entries[session.id]
    log[5] = replace(log[5], text="another")
    assert not (await used_or_not(service.store, session.id))[0]
    for number in (5, 6, 7, 8):
        del log[number]
    assert not (await used_or_not(service.store, session.id))[0]


async def test_damage_in_the_log_is_told_as_without_a_snapshot() -> None:
    service, session = await talked()
    log = service.store._entries[session.id]
    log[2] = replace(log[2], digest="0" * 32)
    with pytest.raises(NotRestorable, match="entry 2"):
        await Service(service.store).manager.get(session.id)


async def test_another_program_makes_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    service, session = await talked()
    assert (await used_or_not(service.store, session.id))[0]
    monkeypatch.setattr(module, "version", lambda: "1.another")
    again = Service(service.store, snapshot_work=1)
    await again.manager.get(session.id)
    await again.manager.snapshots.flush()
    assert again.manager.snapshots.counts == {"unfit": 1, "kept": 1}
    assert (await used_or_not(service.store, session.id))[0]


async def test_a_log_of_another_length_is_written_anew() -> None:
    service, session = await talked()
    again = Service(deepcopy(service.store), log_events=20)
    await again.manager.get(session.id)
    assert again.manager.snapshots.counts["unfit"] == 1


async def test_the_sources_of_the_rules_make_the_version() -> None:
    found = module.version()
    assert found.startswith(f"{module.FORMAT}.")
    sources = [path for pattern in module._SOURCES for path in module._ROOT.glob(pattern)]
    assert {"world.py", "snapshot_codec.py", "table.py"} <= {path.name for path in sources}


async def test_states_on_the_way_are_fewer_where_there_would_be_too_many(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sim.session.timeline.SNAPSHOT_TICKS", 8)
    service = Service(snapshot_work=10**6)
    session = await service.session(Config(seed=5, potholes=3, vehicles=5), paused=True)
    for number in range(12):
        await do(session, {"do": "step", "ticks": 200}, ADD_CARS, save(f"moment {number % 3}"))
        await do(session, rewind(60))
    keeper = service.manager.snapshots
    keeper.take(session)
    await keeper.flush()
    large = await service.store.snapshot(session.id)
    assert large is not None
    monkeypatch.setattr("service.sessions.persistence.snapshot_codec.MAX_STATES", 8)
    monkeypatch.setattr(module, "MAX_BYTES", len(large.body) * 2 // 3)
    keeper.take(session)
    await keeper.flush()
    small = await service.store.snapshot(session.id)
    assert small is not None
    assert len(small.body) <= module.MAX_BYTES
    assert len(values_of(small)["snapshots"]) < len(values_of(large)["snapshots"]) / 2
    await compared(service.store, session.id)
    monkeypatch.setattr(module, "MAX_BYTES", 100)
    keeper.take(session)
    await keeper.flush()
    assert keeper.counts["failed"] == 1
    assert await service.store.snapshot(session.id) == small
