"""How long the clock has the loop wait."""

from __future__ import annotations

import asyncio
from typing import cast

import pytest

from service.sessions.scheduler.clock import SLOT_S
from service.sessions.scheduler.wheel_clock import WheelClock
from tests.support.clock_time import Counter, Time


def test_a_slot_is_waited_for_in_whole_milliseconds_and_never_looked_at_before() -> None:
    """Loops round what is less: then it would be looked at again and again until it is due."""

    class Loop:
        def __init__(self) -> None:
            self.waits_s: list[float] = []

        def call_later(self, wait_s: float, _: object) -> asyncio.Handle:
            self.waits_s.append(wait_s)
            return cast(asyncio.Handle, self)

        def cancel(self) -> None:
            pass

    time, loop = Time(), Loop()
    for part in range(20):
        time.now_s = 100.0 + part * 0.00019
        clock = WheelClock(time)
        clock._loop = cast(asyncio.AbstractEventLoop, loop)
        clock.add(Counter(time, 0.5))
        (wait_s,) = loop.waits_s
        (slot,) = clock._slots
        assert wait_s * 1e3 == pytest.approx(round(wait_s * 1e3))
        assert -1e-9 <= time.now_s + wait_s - slot * SLOT_S < 0.001
        loop.waits_s.clear()
