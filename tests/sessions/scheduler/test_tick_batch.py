"""Ticks that are told stage by stage: all that would have been told at once, in the same order."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from service.narration import Narrator
from service.sessions.scheduler.tick_batch import TickBatch
from service.sessions.scheduler.wheel_clock import BATCH_SIZE, WheelClock
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.subscribers import StreamMessage, Subscribers
from service.settings import Settings
from service.store import MemoryStore, SessionRecord
from sim.config import Config
from sim.session.timeline import Timeline
from tests.support.clock_time import Time
from tests.support.fakes import HandClock

WORDS = Narrator.load()
BEGAN = datetime(2026, 1, 1, tzinfo=UTC)


class Hearing:
    """A watcher that writes down what it is told, and after whom."""

    def __init__(self, name: str, diary: list[tuple[str, bytes]]) -> None:
        self.name, self.diary = name, diary

    def put(self, notice: StreamMessage) -> None:
        self.diary.append((self.name, notice.data))

    def end(self) -> None:
        pass


def sessions(
    clock: WheelClock | HandClock,
    count: int,
    diary: list[tuple[str, bytes]],
) -> list[Session]:
    made = []
    for seed in range(count):
        name = f"s{seed}"
        record = SessionRecord(id=name, name=None, created_at=BEGAN, config={})
        timeline = Timeline(Config(seed=seed, rows=10))
        session = Session(record, timeline, SessionServices(MemoryStore(), clock, WORDS, Settings()))
        session.subscribers._token = "t"
        session.subscribers.subscribe()
        session.subscribers._subscribers = {Hearing(name, diary)}  # type: ignore[arg-type]
        session.set_paused(False)
        made.append(session)
    return made


def served(clock: WheelClock, time: Time, seconds: float) -> None:
    for _ in range(round(seconds / 0.01)):
        time.now_s += 0.01
        clock.serve()


async def test_stage_by_stage_the_same_is_told() -> None:
    time, staged, plain = Time(), list[tuple[str, bytes]](), list[tuple[str, bytes]]()
    wheel, hand = WheelClock(time), HandClock()
    count = BATCH_SIZE + 8
    sessions(wheel, count, staged)
    time.now_s += 0.5 - 0.01
    sessions(hand, count, plain)
    served(wheel, time, 20.0)
    hand.tick(60)
    for seed in range(count):
        heard = [data for name, data in staged if name == f"s{seed}"]
        expected = [data for name, data in plain if name == f"s{seed}"]
        assert len(heard) >= 38
        assert heard == expected[: len(heard)]


async def test_something_else_is_told_after_the_ticks_before_it() -> None:
    diary: list[tuple[str, bytes]] = []
    (session,) = sessions(HandClock(), 1, diary)
    session.tick_batch.hold()
    session.tick()
    session.tick()
    assert diary == []
    session.announce("note", None, "Well.")
    assert [data[: 8 + 10] for _, data in diary] == [b'{"type":"tick","ti'] * 2 + [b'{"type":"changed",']
    session.tick()
    assert len(diary) == 4, "nothing is held any more"
    numbers = [int(data.rpartition(b"t.")[2].rstrip(b'"}')) for _, data in diary]
    assert numbers == [1, 2, 3, 4]


async def test_a_message_that_cannot_be_made_pauses_its_own_session_only() -> None:
    time, diary = Time(), list[tuple[str, bytes]]()
    clock = WheelClock(time)
    made = sessions(clock, 3, diary)

    class Wordless(Narrator):
        def decision(self, *_: object) -> str:
            raise RuntimeError("no words")

    made[1].narrator = Wordless(WORDS._sayings)
    served(clock, time, 1.2)
    assert [session.paused for session in made] == [False, True, False]
    assert [session.timeline.tick for session in made] == [2, 1, 2]
    assert [data[:15] for name, data in diary if name == "s1"] == [b'{"type":"change']
    assert sum(name == "s0" for name, _ in diary) == 2


def test_messages_before_one_that_cannot_be_made_are_told() -> None:
    subscribers, diary = Subscribers(), list[tuple[str, bytes]]()
    subscribers.subscribe()
    subscribers._subscribers = {Hearing("s", diary)}  # type: ignore[arg-type]
    stages = TickBatch(subscribers)

    def broken() -> bytes:
        raise RuntimeError("no words")

    stages.hold()
    stages.publish_tick(1, lambda: b"one")
    stages.publish_tick(2, broken)
    with pytest.raises(RuntimeError):
        stages.encode()
    stages.publish_now(2, lambda: b"failed")
    assert [data for _, data in diary] == [b"one", b"failed"]
