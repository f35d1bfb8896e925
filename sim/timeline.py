"""Time that can be walked: a configuration and the actions with the tick at which each took effect.

That list *is* the session; every state is derived from it by replay, and snapshots along the way
only save time. Undoing is rewriting the list without a change, which is then as if never said.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from sim.actions import WorldAction
from sim.config import Config
from sim.edit import Applied, apply
from sim.plan import Decision
from sim.run import Run, Tick, advance, decide

SNAPSHOT_TICKS = 64
MAX_SNAPSHOTS = 256
RECENT_RUNS = 8
"""States kept as they were, for questions about what has just been done."""


class PlannerSilentError(Exception):
    """A planner from another package did not answer in time."""

    def __init__(self, planner: str, fault: str) -> None:
        super().__init__(f"The planner {planner} {fault}")
        self.planner = planner
        self.fault = fault


@dataclass(frozen=True, slots=True)
class Entry:
    """One action of the log. Entries of one `sequence` were said together."""

    sequence: int
    tick: int
    action: WorldAction


@dataclass(frozen=True, slots=True)
class _Snapshot:
    """The state on reaching a tick, before the actions of that tick; `entries` were applied."""

    tick: int
    run: Run
    entries: int


class Timeline:
    """A session's log and its present state. `copy()` is cheap: states are values and shared."""

    def __init__(self, config: Config) -> None:
        """A session at tick 0."""
        self.config = config
        self.run = Run.start(config)
        self.entries: list[Entry] = []
        self._interval = SNAPSHOT_TICKS
        self._snapshots = [_Snapshot(0, self.run, 0)]
        self._recent: deque[Run] = deque(maxlen=RECENT_RUNS)

    @property
    def tick(self) -> int:
        """The present tick."""
        return self.run.world.tick

    def copy(self) -> Timeline:
        """A timeline that goes its own way from here."""
        twin = Timeline.__new__(Timeline)
        twin.config = self.config
        twin.run = self.run
        twin.entries = list(self.entries)
        twin._interval = self._interval
        twin._snapshots = list(self._snapshots)
        twin._recent = self._recent.copy()
        return twin

    def advance(self) -> Tick:
        """One tick on. Raises `PlannerSilentError`; nothing has then changed.

        A planner that did not answer in time may answer when the tick is run again, so a tick without its
        answer must not become part of what is replayed.
        """
        tick = advance(self.run)
        if tick.decision is not None and tick.decision.timed_out:
            raise PlannerSilentError(tick.decision.planner, tick.decision.fault or "")
        self._recent.append(self.run)
        self._arrive(tick.run)
        return tick

    def apply(self, sequence: int, actions: Sequence[WorldAction]) -> list[Applied]:
        """Change the world at the present tick; all of the actions or, on `EditError`, none."""
        run, done = self.run, []
        for action in actions:
            applied = apply(run, action)
            run = applied.run
            done.append(applied)
        self.run = run
        self.entries += [Entry(sequence, self.tick, action) for action in actions]
        return done

    def rewrite(self, entries: list[Entry], since: int) -> None:
        """Make `entries` the log, as if nothing else had ever been said, and replay to the present tick.

        The new log may differ from the old at tick `since` and later; the time taken is that of
        the ticks since then.
        """
        present = self.tick
        self.entries = entries
        self._recent.clear()
        self._snapshots = [shot for shot in self._snapshots if shot.tick <= since]
        run, position = self._nearest(since)
        while True:
            run, position = self._apply_due(run, position)
            self.run = run
            if run.world.tick == present:
                return
            run = advance(run).run
            if run.world.tick % self._interval == 0 and run.world.tick > self._snapshots[-1].tick:
                self._snapshots.append(_Snapshot(run.world.tick, run, position))

    def rewind(self, tick: int) -> None:
        """Make a past tick the present; what was said or happened after it is gone. Raises `IndexError`."""
        run = self.at(tick)
        if tick == self.tick:
            return
        self.run = run
        self.entries = self.entries[: bisect_right(self.entries, tick, key=lambda entry: entry.tick)]
        self._snapshots = [shot for shot in self._snapshots if shot.tick <= tick]
        self._recent.clear()

    def ticks_to(self, tick: int) -> int:
        """How many ticks are run again to know the state at a past one. Raises `IndexError`."""
        self._check(tick)
        return tick - self._nearest(tick)[0].world.tick

    def at(self, tick: int) -> Run:
        """The state at a past tick, after the actions of that tick. Raises `IndexError`."""
        self._check(tick)
        if tick == self.tick:
            return self.run
        back = tick - self.tick + len(self._recent)
        if back >= 0:
            return self._recent[back]
        return next(self.between(tick, tick + 1))

    def between(self, first: int, stop: int) -> Iterator[Run]:
        """The states from tick `first` up to but without `stop`, replayed in one go. Raises `IndexError`."""
        if first == stop:
            return
        for tick in (first, stop - 1):
            self._check(tick)
        run, position = self._nearest(first)
        while run.world.tick < stop:
            run, position = self._apply_due(run, position)
            if run.world.tick >= first:
                yield run
            run = advance(run).run

    def decision(self, tick: int) -> Decision | None:
        """The decision taken at a tick (None while a result stood), derived anew. Raises `IndexError`."""
        return decide(self.at(tick))

    def _check(self, tick: int) -> None:
        if not 0 <= tick <= self.tick:
            raise IndexError(f"tick {tick} is not between 0 and {self.tick}")

    def _arrive(self, run: Run) -> None:
        self.run = run
        if run.world.tick % self._interval == 0:
            self._snapshots.append(_Snapshot(run.world.tick, run, len(self.entries)))
            if len(self._snapshots) > MAX_SNAPSHOTS:
                self._interval *= 2
                self._snapshots = [shot for shot in self._snapshots if shot.tick % self._interval == 0]

    def _nearest(self, tick: int) -> tuple[Run, int]:
        shot = self._snapshots[bisect_right(self._snapshots, tick, key=lambda shot: shot.tick) - 1]
        return shot.run, shot.entries

    def _apply_due(self, run: Run, position: int) -> tuple[Run, int]:
        while position < len(self.entries) and self.entries[position].tick == run.world.tick:
            run = apply(run, self.entries[position].action).run
            position += 1
        return run, position
