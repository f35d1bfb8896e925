"""Reachability: whether a session's vehicle can still arrive, for each road and each change of it.

A search that takes longer than a fraction of a millisecond runs in a thread. A new road can appear by itself,
at a tick: its result is announced when the search ends, unless the road has changed again. A change waits for
the search, because its reply contains the result. Nothing is stored: the result follows from the state, so
log lines about it are transient (`service.sessions.log`).
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Hashable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass

from anyio import to_thread

from service.sessions.bookmarks import Jumped
from service.sessions.facts import Fact, Undone
from sim.events import Event, EventType
from sim.oracle.outlook import OPEN, Outlook, outlook, quickly_open
from sim.state import SimState
from sim.types import Outcome

_WORKER = ThreadPoolExecutor(max_workers=1, thread_name_prefix="outlook")


@dataclass(frozen=True, slots=True)
class RoadOutlook:
    """The result of a search for one road; `found` is None where the search gave up."""

    road: Hashable
    episode: tuple[int, int]
    found: Outlook | None


class ReachabilityMonitor:
    """What is known of one session's road. All methods are for the event loop's thread."""

    def __init__(self, present: Callable[[], SimState], tell: Callable[[Event], None]) -> None:
        """`present`: the state now; `tell`: called with the event for a road that began by itself."""
        self._present = present
        self._tell = tell
        self._known: RoadOutlook | None = None
        self._searching: asyncio.Future[Outlook | None] | None = None
        self._waiting: SimState | None = None

    def start_road(self, run: SimState) -> None:
        """Begin to search a road that began with a tick; needs a running loop."""
        if quickly_open(run):
            self._known = _road_outlook(run, OPEN)
        elif self._searching is None:
            self._search(run)
        else:
            self._waiting = run  # in place of another that waited, which is gone by now

    async def wait_until_idle(self) -> None:
        """Wait until no search is under way."""
        while self._searching is not None:
            await asyncio.wait([self._searching])
            await asyncio.sleep(0)

    async def after_change(self, run: SimState, facts: Sequence[Fact]) -> RoadOutlook | None:
        """The result for the state after a change; None where the change did not concern the road."""
        back = any(isinstance(fact, Undone | Jumped) for fact in facts)
        if not back and _road_key(run) == _road_key(self._present()):
            return None
        if run.world.outcome is not Outcome.RUNNING:
            return None
        if quickly_open(run):
            return _road_outlook(run, OPEN)
        return _road_outlook(run, await to_thread.run_sync(outlook, run))

    def event_for(self, seen: RoadOutlook, run: SimState) -> Event | None:
        """The event to announce for a result, given what is known; `run` is the state it was found in."""
        before, found = self._known, seen.found
        if found is None:
            return None
        was = before.found if before is not None and before.episode == seen.episode else None
        closed = was is not None and not was.open
        world = run.world
        if found.open:
            return Event(world.tick, EventType.WAY_OPEN, world.episode) if closed else None
        if closed and was == found:
            return None
        how = "late" if found.late else None
        return Event(world.tick, EventType.NO_WAY, world.episode, found.ids, how=how)

    def remember(self, seen: RoadOutlook) -> None:
        """Take a result as known."""
        self._known = seen

    def _search(self, run: SimState) -> None:
        looking = asyncio.get_running_loop().run_in_executor(_WORKER, outlook, run)
        self._searching = looking
        looking.add_done_callback(lambda done: self._search_ended(run, done))

    def _search_ended(self, run: SimState, done: asyncio.Future[Outlook | None]) -> None:
        self._searching = None
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            self._search(waiting)
        if done.cancelled():
            return
        with suppress(ReferenceError):  # nobody has the session any more
            self._take(_road_outlook(run, done.result()))

    def _take(self, seen: RoadOutlook) -> None:
        """Take a result as known, and tell what is new about it, if it is about the present road."""
        now = self._present()
        if seen.road == _road_key(now) and now.world.outcome is Outcome.RUNNING:
            event = self.event_for(seen, now)
            self.remember(seen)
            if event is not None:
                self._tell(event)


def _road_outlook(run: SimState, found: Outlook | None) -> RoadOutlook:
    return RoadOutlook(_road_key(run), (run.world.episode, run.world.episode_start), found)


def _road_key(run: SimState) -> Hashable:
    """Equal for states of one road between which nothing changed that matters to reachability."""
    world, config = run.world, run.config
    drawn = (world.episode, world.episode_start, run.edits, world.fixed)
    movers = config.behaviour, config.courtesy, config.attentive
    return *drawn, *movers, config.collision, config.dynamics
