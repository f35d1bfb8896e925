"""Rings are found: new ones at once, old ones when memory has grown."""

from __future__ import annotations

import gc
import subprocess
import sys
import weakref
from collections.abc import Iterator

import pytest

from service.gc_tuning import (
    FULL_EVERY_S,
    GROWTH,
    LEAST_GROWTH_MB,
    MEMORY_CHECK_S,
    Collector,
    resident_mb,
)


class Ring:
    """Holds itself."""

    def __init__(self) -> None:
        self.own = self


@pytest.fixture(autouse=True)
def by_hand() -> Iterator[None]:
    gc.disable()
    yield
    gc.enable()


def lost(*, old: bool) -> weakref.ref[Ring]:
    """A ring that nobody holds; an old one has been looked through while somebody did."""
    ring = Ring()
    if old:
        gc.collect(0)
        gc.collect(1)
    return weakref.ref(ring)


class Machine:
    def __init__(self) -> None:
        self.now_s, self.memory_mb = 100.0, 1000.0
        self.collector = Collector(lambda: self.now_s, lambda: self.memory_mb)


def test_a_new_ring_is_found_at_the_next_turn() -> None:
    ring = lost(old=False)
    assert Machine().collector.collect() == 0
    assert ring() is None


def test_an_old_one_when_memory_has_grown() -> None:
    machine, ring = Machine(), lost(old=True)
    machine.now_s += MEMORY_CHECK_S
    assert machine.collector.collect() == 0
    machine.memory_mb *= GROWTH + 0.01
    machine.now_s += MEMORY_CHECK_S / 2
    assert machine.collector.collect() == 0, "memory is not looked at each time"
    assert ring() is not None
    machine.now_s += MEMORY_CHECK_S / 2
    assert machine.collector.collect() == 2
    assert ring() is None
    machine.now_s += MEMORY_CHECK_S
    assert machine.collector.collect() == 0, "what it is then is what it grows from"


def test_memory_that_stands_is_never_looked_through() -> None:
    machine, ring = Machine(), lost(old=True)
    machine.memory_mb += LEAST_GROWTH_MB - 1
    for _ in range(3):
        machine.now_s += FULL_EVERY_S
        assert machine.collector.collect() == 0
    assert ring() is not None


def test_twice_a_little_is_no_growth() -> None:
    machine = Machine()
    machine.memory_mb = 100.0
    for held, whole in ((100.0, 0), (210.0, 0), (357.0, 2)):
        machine.memory_mb = held
        machine.now_s += MEMORY_CHECK_S
        assert machine.collector.collect() == whole


def test_an_old_one_after_some_minutes_where_memory_has_grown() -> None:
    machine, ring = Machine(), lost(old=True)
    machine.memory_mb += LEAST_GROWTH_MB
    machine.now_s += FULL_EVERY_S - 1
    assert (machine.collector.collect(), ring() is None) == (0, False)
    machine.now_s += MEMORY_CHECK_S
    assert (machine.collector.collect(), ring() is None) == (2, True)


def test_what_live_sessions_need_is_no_growth() -> None:
    machine = Machine()
    needed_mb = 0.0
    machine.collector = Collector(lambda: machine.now_s, lambda: machine.memory_mb, lambda: needed_mb)
    for more_mb, of_sessions, whole in (
        (1000.0, 1000.0, 0),
        (450.0, 0.0, 0),
        (100.0, 0.0, 2),
        (0.0, -1000.0, 2),
    ):
        machine.memory_mb += more_mb
        needed_mb += of_sessions
        machine.now_s += MEMORY_CHECK_S
        assert machine.collector.collect() == whole


def test_memory_that_shrinks_is_what_it_grows_from() -> None:
    machine = Machine()
    for held_now, whole in ((1450.0, 0), (500.0, 0), (800.0, 2)):
        machine.memory_mb = held_now
        machine.now_s += MEMORY_CHECK_S
        assert machine.collector.collect() == whole


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems do not say")
def test_what_a_process_holds() -> None:
    program = (
        "from service.gc_tuning import resident_mb; a = resident_mb(); "
        "b = bytearray(50_000_000); print(resident_mb() - a)"
    )
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert 45 < float(told) < 60
    assert resident_mb() > 10
