"""The clock against a time that is set by hand, and once on the real loop."""

from __future__ import annotations

import asyncio
from collections import Counter as Counter_

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.sessions.scheduler.clock import SLOT_S, Lateness
from service.sessions.scheduler.wheel_clock import (
    POSTPONE_MARGIN_S,
    SLOT_CAPACITY,
    UNTHROTTLED_TURN_S,
    WheelClock,
)
from tests.support.clock_time import Counter, Time


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
        assert (
            (4.0 - (4 + len(periods_s) // SLOT_CAPACITY) * SLOT_S) / counter.period_s - 1
            < len(counter.ticks)
            <= 4.0 / counter.period_s + 1e-6
        )
        late_s = [at - (100.0 + counter.period_s * (n + 1)) for n, at in enumerate(counter.ticks)]
        # Up to a slot for the deadline, one for when it is looked at; where many begin at once, some begin at
        # the next slot, or one later still for as many as fill it.
        begin_s = (1 + len(periods_s) // SLOT_CAPACITY) * SLOT_S if len(periods_s) > SLOT_CAPACITY else 0.0
        assert all(-1e-9 <= each <= begin_s + 2 * SLOT_S + 1e-9 for each in late_s), "neither early nor late"
        spread_s = max(late_s, default=0.0) - min(late_s, default=0.0)
        assert spread_s <= 2 * SLOT_S + 1e-9, "and always as much"


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
    await asyncio.wait_for(done.wait(), 60)
    clock.stop()
    assert clock.lateness().ticks >= 3


def test_lateness_of_known_samples() -> None:
    assert Lateness.from_samples([]) == Lateness(0, 0.0, 0.0, 0.0)
    assert Lateness.from_samples([n / 1000 for n in range(101)]) == Lateness(101, 50.0, 99.0, 100.0)


def test_many_that_begin_at_once_are_spread_over_their_period() -> None:
    time = Time()
    clock = WheelClock(time)
    counters = [Counter(time, 0.5) for _ in range(2_000)]
    for counter in counters:
        clock.add(counter)
    run(clock, time, 3.0)
    at_once = Counter_(round(counter.ticks[-1], 6) for counter in counters)
    assert max(at_once.values()) <= 2_000 / (0.5 / SLOT_S) + SLOT_CAPACITY
    assert all(5 <= len(counter.ticks) <= 6 for counter in counters), (
        "a first tick waits a period more at most"
    )
    for counter in counters:
        assert counter.ticks[-1] - counter.ticks[-2] == pytest.approx(0.5, abs=2 * SLOT_S)


def test_after_lost_time_those_that_were_spread_stay_spread() -> None:
    time = Time()
    clock = WheelClock(time)
    early, late = Counter(time, 0.5), Counter(time, 0.5)
    clock.add(early)
    time.now_s += 0.2
    clock.add(late)
    time.now_s += 7.33
    clock.serve()
    run(clock, time, 2.0)
    apart = late.ticks[-1] - early.ticks[-1]
    assert min(apart % 0.5, -apart % 0.5) == pytest.approx(0.2, abs=2 * SLOT_S)
    assert early.ticks[1] - early.ticks[0] >= 0.24, "none follows on the heels of a late one"


EVERYWHERE = SLOT_CAPACITY * 250
"""So many that tick every half a second are in all its slots alike."""


class Laborious(Counter):
    """Needs so much of its period for a tick."""

    def __init__(self, time: Time, period_s: float, cost_s: float) -> None:
        super().__init__(time, period_s)
        self.cost_s = cost_s

    def tick(self) -> None:
        super().tick()
        self.time.now_s += self.cost_s


def stalled(load: float) -> tuple[list[float], int]:
    """A service that is busy for this share of the time stands still for 0.3 s: lateness, and late ticks."""
    time, late_s = Time(), list[float]()
    clock = WheelClock(time, late_s.append)
    for _ in range(EVERYWHERE):
        clock.add(Laborious(time, 0.5, load * 0.5 / EVERYWHERE))
    while time.now_s < 102.0:
        time.now_s += SLOT_S / 4
        clock.serve()
    before = len(late_s)
    time.now_s += 0.3
    while time.now_s < 110.0:
        time.now_s += SLOT_S / 4
        clock.serve()
    after_s = late_s[before:]
    return after_s, sum(each > POSTPONE_MARGIN_S for each in after_s)


def test_what_is_caught_up_with_soon_is_no_lost_time() -> None:
    late_s, too_late = stalled(0.2)
    assert len(late_s) == pytest.approx(2 * EVERYWHERE * 8.0, abs=10)
    assert too_late <= EVERYWHERE


def test_near_its_limit_a_service_is_late_once_for_each_and_not_for_long() -> None:
    late_s, too_late = stalled(0.8)
    assert EVERYWHERE < too_late <= 2 * EVERYWHERE, "all of them, and those until it was given up"
    assert max(late_s) == pytest.approx(0.3, abs=0.01), "counted from when it was first due"
    assert max(late_s[2 * EVERYWHERE :]) <= POSTPONE_MARGIN_S
    assert len(late_s) == pytest.approx(2 * EVERYWHERE * 7.75, abs=EVERYWHERE / 5), "what was given up"


class Busy(Counter):
    """Takes time to tick."""

    def tick(self) -> None:
        super().tick()
        self.time.now_s += 0.001


def played(hurried: int) -> tuple[list[Busy], Counter, WheelClock]:
    """A second of so many that tick as often as can be, beside one that keeps a pace."""
    time = Time()
    clock = WheelClock(time)
    eager, steady = [Busy(time, SLOT_S) for _ in range(hurried)], Counter(time, 0.05)
    for ticker in (*eager, steady):
        clock.add(ticker)
    while time.now_s < 101.0:
        before = time.now_s
        clock.serve()
        if time.now_s == before:
            time.now_s += 0.000_25
    return eager, steady, clock


@pytest.mark.parametrize("hurried", [1, 10, 60])
def test_those_in_a_hurry_share_half_the_time_at_most_and_hold_up_nobody(hurried: int) -> None:
    eager, steady, clock = played(hurried)
    done = [len(ticker.ticks) for ticker in eager]
    assert 350 <= sum(done) <= 550, "of a thousand that there would be time for"
    assert max(done) - min(done) <= 1, "each in its turn"
    assert len(steady.ticks) in (19, 20)
    assert clock.lateness().max_ms <= 1e3 * (UNTHROTTLED_TURN_S + 0.001 + 2 * SLOT_S)
    assert clock.lateness().ticks == len(steady.ticks), "as often as can be has no deadline"


def test_one_in_a_hurry_may_leave_while_another_ticks() -> None:
    time = Time()
    clock = WheelClock(time)

    class Jealous(Counter):
        def tick(self) -> None:
            super().tick()
            clock.remove(other)

    other, jealous = Counter(time, SLOT_S), Jealous(time, SLOT_S)
    for ticker in (jealous, other):
        clock.add(ticker)
    run(clock, time, 0.1)
    assert other.ticks == []
    assert len(jealous.ticks) > 10


def test_those_in_a_hurry_are_not_forgotten_where_what_is_due_is_never_done() -> None:
    time = Time()

    class Slow(Counter):
        def tick(self) -> None:
            super().tick()
            self.time.now_s += 0.02

    clock = WheelClock(time)
    slow, eager = [Slow(time, 0.05) for _ in range(5)], Busy(time, SLOT_S)
    for ticker in (*slow, eager):
        clock.add(ticker)
    while time.now_s < 103.0:
        clock.serve()
        time.now_s += 0.000_5
    assert 15 <= sum(at > 100.2 for at in eager.ticks) <= 150, "of a millisecond each, in 2.8 s"


def test_one_may_change_between_a_pace_and_a_hurry() -> None:
    time = Time()
    clock, counter = WheelClock(time), Counter(time, 0.5)
    clock.add(counter)
    for period_s, ticks in ((SLOT_S, 20), (0.5, 2)):
        clock.remove(counter)
        counter.period_s = period_s
        counter.ticks.clear()
        clock.add(counter)
        run(clock, time, 1.1)
        assert len(counter.ticks) >= ticks
    assert len(counter.ticks) == 2


class Stalls(Counter):
    """Holds everything up at each of its ticks."""

    def __init__(self, time: Time, period_s: float, stall_s: float) -> None:
        super().__init__(time, period_s)
        self.stall_s = stall_s

    def tick(self) -> None:
        super().tick()
        self.time.now_s += self.stall_s


def test_stalls_in_a_row_are_not_counted_twice() -> None:
    """A slot that is empty already is not late: deadlines are put off for what is left alone."""
    time = Time()
    clock = WheelClock(time)
    first, second, other = Stalls(time, 1.0, 0.25), Stalls(time, 1.0, 0.25), Counter(time, 1.0)
    for ticker, then_s in ((first, 0.2), (second, 0.26), (other, 0.0)):
        clock.add(ticker)
        time.now_s += then_s
    time.now_s = 101.0 + SLOT_S
    clock.serve()
    clock.serve()
    assert (len(first.ticks), len(second.ticks), len(other.ticks)) == (1, 1, 0)
    assert clock._postponed_s == 0.0
    clock.serve()
    assert other.ticks[0] - 101.46 < 0.05


def test_the_first_slot_is_never_an_emptied_one() -> None:
    time = Time()
    clock = WheelClock(time)
    clock.add(Stalls(time, 10.0, 5.0))
    time.now_s += 10.0 + SLOT_S
    clock.serve()
    assert all(clock._slots[slot] for slot in clock._order)
    assert clock._behind_since is None  # nothing else was due
