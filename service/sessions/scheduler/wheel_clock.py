"""The clock of a running service: a timer wheel for all live sessions, with one timer and no thread.

Deadlines are rounded up to slots of 2 ms, so that sessions due together wake the event loop once. Time is the
monotonic clock, not the loop's own, which stands still during a turn of the loop.

- **Late sessions** (after a stalled machine) go on from now: missed ticks are not made up for.
- **Overload**: when all sessions together stay late, every deadline is postponed by the backlog, so that a
  service near its limit is late once and not for minutes. Lateness counts from the first deadline.
- **Spreading**: a session that starts where a slot is full gets a slot a little later, so that sessions that
  start together are not due together for ever.
- **Unthrottled sessions** (`max` speed) have no deadline. They take turns in a share of the time that is
  theirs all together, after all that is due.
- **Batches**: sessions that are due together first all tick, then encode their messages, then send them
  (`service.sessions.scheduler.tick_batch`).

What a tick is, and how it fails, is the `Ticker`'s to know.
"""

from __future__ import annotations

import asyncio
import heapq
import math
import time
from array import array
from collections.abc import Callable

import structlog

from service.sessions.scheduler.clock import SLOT_S, Lateness, Ticker, TickOutput

_LOG = structlog.get_logger(__name__)

TURN_S = 0.005
"""Longest time that ticks hold the event loop before requests get a turn."""

SLOT_CAPACITY = 4
"""A slot with so many tickers is full: a new ticker takes another slot, if there is one."""

UNTHROTTLED_TURN_S = 0.002
"""Longest time that unthrottled tickers hold the event loop, all together."""

UNTHROTTLED_PAUSE_S = 0.001
"""Shortest pause between their turns; a turn that took longer is followed by as long a pause."""

UNTHROTTLED_MAX_WAIT_S = 0.1
"""They get a turn after so long even if the clock is behind."""

POSTPONE_MARGIN_S = 0.02
"""Half of this is the lateness that is left when deadlines are postponed."""

OVERLOAD_LATENESS_S = 0.05
"""Up to this lateness the clock catches up, since postponing all would make more ticks late."""

OVERLOAD_AFTER_S = 0.2
"""A clock that is later than that for so long postpones all deadlines."""

BATCH_SIZE = 32
"""Largest number of ticks before their output is sent."""

LATENESS_SAMPLES = 4_096
"""Number of latest ticks in the figures of lateness."""


class WheelClock:
    """The clock of a running service, on the event loop's timer.

    `now` returns seconds of a monotonic clock; `late` is called with the lateness of every tick in seconds.
    """

    def __init__(
        self, now: Callable[[], float] = time.monotonic, late: Callable[[float], None] | None = None
    ) -> None:
        self._now = now
        self._late = late
        self._loop: asyncio.AbstractEventLoop | None = None
        self._due: dict[Ticker, float] = {}
        self._postponed_s = 0.0
        self._postponed_lateness: dict[Ticker, float] = {}
        """the lateness of tickers whose deadline was postponed"""
        self._behind_since: float | None = None
        self._slots: dict[int, list[Ticker]] = {}
        self._order: list[int] = []
        self._ticked: list[tuple[Ticker, TickOutput]] = []
        self._unthrottled: dict[Ticker, None] = {}
        self._unthrottled_at = 0.0
        self._timer: asyncio.Handle | None = None
        self._timer_at = 0.0
        self._samples = array("d")
        self._next_sample = 0

    def start(self) -> None:
        """See `Clock.start`."""
        self._loop = asyncio.get_running_loop()
        self._arm()

    def stop(self) -> None:
        """See `Clock.stop`."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._loop = None

    def add(self, ticker: Ticker) -> None:
        """See `Clock.add`."""
        if ticker in self._due or ticker in self._unthrottled:
            return
        now, period = self._time(), ticker.period_s
        if period <= SLOT_S:
            if not self._unthrottled:
                self._unthrottled_at = now + period
            self._unthrottled[ticker] = None
        else:
            self._schedule(ticker, self._least_loaded(now + period, period))
        self._arm()

    def remove(self, ticker: Ticker) -> None:
        """See `Clock.remove`. Its entry in the wheel is skipped when the slot comes."""
        self._due.pop(ticker, None)
        self._postponed_lateness.pop(ticker, None)
        self._unthrottled.pop(ticker, None)

    def lateness(self) -> Lateness:
        """See `Clock.lateness`."""
        return Lateness.from_samples(self._samples)

    def serve(self) -> None:
        """Tick all that is due, for at most `TURN_S`; the rest is ticked in the next turn of the loop."""
        began = self._time()
        if self._serve_due(began):
            patience_s, self._behind_since = 0.0, None
        else:
            patience_s = UNTHROTTLED_MAX_WAIT_S
            self._fall_behind(self._time())
        self._send_output()
        if self._unthrottled and self._unthrottled_at + patience_s <= self._time():
            self._serve_unthrottled()

    def _time(self) -> float:
        """The time of the deadlines, which stood still wherever they were postponed."""
        return self._now() - self._postponed_s

    def _fall_behind(self, now: float) -> None:
        """Postpone all deadlines by the lateness of the first, when that has been large for long."""
        late_s = now - self._order[0] * SLOT_S
        if self._behind_since is None:
            self._behind_since = now
        elif late_s > OVERLOAD_LATENESS_S and now - self._behind_since > OVERLOAD_AFTER_S:
            self._behind_since = None
            # Not all of it, since what is still due comes before who is in a hurry; and in whole slots.
            given_up_s = SLOT_S * int((late_s - POSTPONE_MARGIN_S / 2) / SLOT_S)
            self._postponed_s += given_up_s
            self._unthrottled_at -= given_up_s
            for ticker in self._due:
                self._postponed_lateness[ticker] = self._postponed_lateness.get(ticker, 0.0) + given_up_s

    def _serve_due(self, began: float) -> bool:
        """Tick what is due; returns whether all of it was ticked."""
        order, due_at, now = self._order, self._due, began
        while order and order[0] * SLOT_S <= now:
            slot = order[0]
            tickers = self._slots[slot]
            while tickers:
                ticker = tickers.pop()
                due = due_at.get(ticker)
                # A ticker that was removed, or added anew for another time, is not due here.
                if due is not None and math.ceil(due / SLOT_S) == slot:
                    del due_at[ticker]
                    self._record(
                        now
                        - due
                        + (self._postponed_lateness.pop(ticker, 0.0) if self._postponed_lateness else 0.0)
                    )
                    # Put back first: a ticker that leaves the clock while ticking must find itself on it.
                    self._reschedule(ticker, due, now)
                    self._tick(ticker, getattr(ticker, "tick_batch", None))
                    if len(self._ticked) >= BATCH_SIZE:
                        self._send_output()
                now = self._time()  # once for each: when it ended is when the next one begins
                if now - began > TURN_S:
                    break
            if tickers:
                return False
            heapq.heappop(order)
            del self._slots[slot]
            if now - began > TURN_S:
                return not order or order[0] * SLOT_S > now
        return True

    def _serve_unthrottled(self) -> None:
        """Tick unthrottled tickers in turn, each at most once."""
        began = now = self._time()
        for ticker in list(self._unthrottled):
            if ticker not in self._unthrottled:
                continue  # what another did took it off the clock
            del self._unthrottled[ticker]
            self._reschedule(ticker, now, now)
            self._tick(ticker)
            now = self._time()
            if now - began > UNTHROTTLED_TURN_S:
                break
        self._unthrottled_at = now + max(UNTHROTTLED_PAUSE_S, now - began)

    def _reschedule(self, ticker: Ticker, due: float, now: float) -> None:
        period = ticker.period_s
        if period <= SLOT_S:
            self._unthrottled[ticker] = None
        else:
            late = now - due
            if late >= period:
                # Whole periods are left out, so that those that were spread stay spread.
                due += period * int(late / period + 0.5)
            self._schedule(ticker, due + period)

    def _tick(self, ticker: Ticker, stages: TickOutput | None = None) -> None:
        """Tick one ticker; the output of one that has a batch waits for `_send_output`."""
        try:
            if stages is not None:
                stages.hold()
                self._ticked.append((ticker, stages))
            ticker.tick()
        except Exception as error:
            self._handle_failure(ticker, error)

    def _send_output(self) -> None:
        """Encode, then send, the output of all that have ticked."""
        if self._ticked:
            telling, self._ticked = self._ticked, []
            for ticker, stages in telling:
                try:
                    stages.encode()
                except Exception as error:
                    self._handle_failure(ticker, error)
            for ticker, stages in telling:
                try:
                    stages.send()
                except Exception as error:
                    self._handle_failure(ticker, error)

    def _handle_failure(self, ticker: Ticker, error: Exception) -> None:
        _LOG.error("a tick failed", ticker=str(ticker), exc_info=error)
        self.remove(ticker)
        ticker.tick_failed(error)

    def _least_loaded(self, due: float, period: float) -> float:
        """A time from `due` on, within a period, in the slot with the fewest tickers.

        Tickers count that are due in that slot, or a period before it and so will be.
        """
        first, period_slots = math.ceil(due / SLOT_S), max(1, round(period / SLOT_S))
        found, fewest = first, math.inf
        for slot in range(first, first + period_slots):
            others = len(self._slots.get(slot, ())) + len(self._slots.get(slot - period_slots, ()))
            if others < fewest:
                found, fewest = slot, others
                if others < SLOT_CAPACITY:
                    break
        return due if found == first else found * SLOT_S

    def _schedule(self, ticker: Ticker, due: float) -> None:
        self._due[ticker] = due
        slot = math.ceil(due / SLOT_S)
        waiting = self._slots.get(slot)
        if waiting is None:
            self._slots[slot] = [ticker]
            heapq.heappush(self._order, slot)
        else:
            waiting.append(ticker)

    def _arm(self) -> None:
        """Set the one timer to the next deadline, unless it is set to that or an earlier one."""
        if self._loop is None or not (self._order or self._unthrottled):
            return
        at = self._order[0] * SLOT_S if self._order else math.inf
        exact = bool(self._unthrottled) and self._unthrottled_at < at
        if exact:
            at = self._unthrottled_at
        if self._timer is not None:
            if self._timer_at <= at:
                return
            self._timer.cancel()
        self._timer_at = at
        wait_s = max(0.0, at - self._time())
        # Loops count in whole milliseconds. Waited for in parts of one, a slot was looked at ten times over
        # before it was due. Slots begin with a millisecond, so this is not late.
        self._timer = self._loop.call_later(wait_s if exact else math.ceil(wait_s * 1e3) / 1e3, self._fire)

    def _fire(self) -> None:
        self._timer = None
        self.serve()
        self._arm()

    def _record(self, lateness_s: float) -> None:
        if self._late is not None:
            self._late(lateness_s)
        if len(self._samples) < LATENESS_SAMPLES:
            self._samples.append(lateness_s)
        else:
            self._samples[self._next_sample] = lateness_s
        self._next_sample = (self._next_sample + 1) % LATENESS_SAMPLES
