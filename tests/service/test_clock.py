"""The clock against a time that is set by hand, and once on the real loop."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.sessions.clock import SLOT_S, Lateness, WheelClock


class Time:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


class Counter:
    """Remembers when it was ticked."""

    def __init__(self, time: Time, period_s: float, fails: bool = False) -> None:
        self.time, self.period_s, self.fails = time, period_s, fails
        self.ticks: list[float] = []
        self.failures: list[Exception] = []

    def tick(self) -> None:
        self.ticks.append(self.time.now_s)
        if self.fails:
            raise RuntimeError("no road")

    def tick_failed(self, error: Exception) -> None:
        self.failures.append(error)


def run(clock: WheelClock, time: Time, seconds: float, step_s: float = SLOT_S) -> None:
    for _ in range(round(seconds / step_s)):
        time.now_s += step_s
        clock.serve()


@given(periods_s=st.lists(st.floats(0.02, 2.0), min_size=1, max_size=20))
def test_each_ticks_at_its_own_pace(periods_s: list[float]) -> None:
    time = Time()
    clock = WheelClock(time)
    counters = [Counter(time, period_s) for period_s in periods_s]
    for counter in counters:
        clock.add(counter)
    run(clock, time, 4.0)
    for counter in counters:
        assert (4.0 - 3 * SLOT_S) / counter.period_s - 1 < len(counter.ticks) <= 4.0 / counter.period_s + 1e-6
        late_s = [at - (100.0 + counter.period_s * (n + 1)) for n, at in enumerate(counter.ticks)]
        assert all(-1e-9 <= each <= 2 * SLOT_S + 1e-9 for each in late_s), "never early, never two slots late"


def test_adding_twice_does_not_tick_twice() -> None:
    time = Time()
    clock, counter = WheelClock(time), Counter(time, 0.5)
    clock.add(counter)
    clock.add(counter)
    run(clock, time, 2.1)
    assert len(counter.ticks) == 4


def test_removed_is_removed_and_may_come_back() -> None:
    time = Time()
    clock, counter = WheelClock(time), Counter(time, 0.5)
    clock.add(counter)
    run(clock, time, 0.3)
    clock.remove(counter)
    clock.remove(counter)
    clock.add(counter)
    run(clock, time, 0.45)
    assert counter.ticks == [], "the first tick is a whole period after coming back"
    run(clock, time, 0.1)
    assert len(counter.ticks) == 1


def test_lost_time_is_not_made_up_for() -> None:
    time = Time()
    clock, counter = WheelClock(time), Counter(time, 0.5)
    clock.add(counter)
    time.now_s += 60.0
    clock.serve()
    run(clock, time, 1.01)
    assert len(counter.ticks) == 3
    assert clock.lateness().max_ms == pytest.approx(59_500, rel=0.001)


def test_a_failing_ticker_leaves_and_the_others_go_on() -> None:
    time = Time()
    clock, broken, sound = WheelClock(time), Counter(time, 0.5, fails=True), Counter(time, 0.5)
    clock.add(broken)
    clock.add(sound)
    run(clock, time, 2.1)
    assert (len(broken.ticks), len(sound.ticks)) == (1, 4)
    assert [str(error) for error in broken.failures] == ["no road"]


def test_a_long_turn_is_cut_so_that_requests_get_theirs() -> None:
    time = Time()

    class Slow(Counter):
        def tick(self) -> None:
            super().tick()
            self.time.now_s += 0.004

    clock = WheelClock(time)
    slow = [Slow(time, 0.5) for _ in range(6)]
    for ticker in slow:
        clock.add(ticker)
    time.now_s += 0.502
    clock.serve()
    first_turn = sum(len(ticker.ticks) for ticker in slow)
    for _ in range(5):
        clock.serve()
    assert first_turn == 2
    assert [len(ticker.ticks) for ticker in slow] == [1] * 6, "nobody is forgotten"


async def test_the_real_loop_drives_it() -> None:
    clock = WheelClock()
    clock.start()
    done = asyncio.Event()

    class Three(Counter):
        def tick(self) -> None:
            super().tick()
            if len(self.ticks) == 3:
                done.set()

    ticker = Three(Time(), 0.02)
    clock.add(ticker)
    await asyncio.wait_for(done.wait(), 5)
    clock.stop()
    assert clock.lateness().ticks >= 3


def test_lateness_of_known_samples() -> None:
    assert Lateness.of([]) == Lateness(0, 0.0, 0.0, 0.0)
    assert Lateness.of([n / 1000 for n in range(101)]) == Lateness(101, 50.0, 99.0, 100.0)
