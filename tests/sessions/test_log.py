"""The log against a plain list that forgets nothing."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from service.sessions.log import EventLog


@given(
    written=st.integers(0, 60), kept=st.integers(1, 30), after=st.integers(0, 80), limit=st.integers(1, 40)
)
def test_reading_on_gives_the_next_lines_that_are_kept(
    written: int, kept: int, after: int, limit: int
) -> None:
    log = EventLog(kept)
    everything = [log.add(n, "moved", f"line {n}") for n in range(written)]

    still_there = everything[max(0, written - kept) :]
    assert log.after(after, limit) == [line for line in still_there if line.number > after][:limit]
    assert log.latest(limit) == still_there[-limit:]
    assert log.last_number == written
    assert log.first_number == (still_there[0].number if still_there else written + 1)


@given(kept=st.integers(5, 30), page=st.integers(1, 5))
def test_whoever_reads_often_enough_misses_nothing(kept: int, page: int) -> None:
    log, seen, last = EventLog(kept), [], 0
    for n in range(100):
        log.add(n, "moved", str(n))
        if n % page == 0:
            lines = log.after(last, 1_000)
            seen += [line.number for line in lines]
            last = lines[-1].number
    assert seen == list(range(1, last + 1))
