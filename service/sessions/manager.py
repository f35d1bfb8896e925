"""The session manager: creates, finds, restores, forks and deletes sessions.

A stored session that is not live (after a restart, or evicted) is restored when it is asked for, paused at
its last tick.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from datetime import UTC, datetime
from functools import partial

import structlog

from service.actions import Action
from service.problems import (
    FieldProblem,
    Invalid,
    NotOfThisShard,
    NotRestorable,
    NotSaved,
    TooManySessions,
    UnknownSession,
)
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.bookmarks import attach_names
from service.sessions.build_fork import build_fork
from service.sessions.persistence.recording import Recording, replay_recording
from service.sessions.persistence.replay import ReplayError
from service.sessions.persistence.replay_elsewhere import replay_log
from service.sessions.persistence.restore import restore
from service.sessions.persistence.seal import SECRET, Seal
from service.sessions.persistence.snapshot_records import UnfitError
from service.sessions.persistence.snapshot_scheduler import SnapshotScheduler
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.scheduler.eviction import Evictor, IdleTimes, RoomMaker
from service.sessions.scheduler.offload import REPLAY_S, run_in_thread, uses_installed_planner
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.transaction import check_step_ticks
from service.sessions.work_estimate import log_units
from service.sharding import shard_of
from service.store import (
    BookmarkRecord,
    EntryRecord,
    SessionRecord,
    SnapshotRecord,
    StoredResponse,
    StoreError,
)
from service.work.asker import of_nobody
from service.work.executor import WorkExecutor
from service.work.units import THREAD
from sim.config import Config, ConfigError
from sim.rules.versions import NewerRulesError
from sim.session.saved_config import saved_config
from sim.session.timeline import Timeline

_LOG = structlog.get_logger(__name__)

LARGE_ROAD_CELLS = 2_000
"""Roads of more cells are drawn in a thread."""

CLOSE_TIMEOUT_S = 0.2
"""Time for changes under way to finish at a stop."""

SNAPSHOT_TIMEOUT_S = 0.15
"""Time for saving snapshots at a stop."""


class SessionManager:
    """The sessions of one service."""

    def __init__(self, services: SessionServices) -> None:
        self._services = services
        self._live: dict[str, Session] = {}
        self._restoring: dict[str, asyncio.Task[Session]] = {}
        self._expiring: set[str] = set()
        self._creating = 0
        self._stored_count = 0
        self.seal: Seal | None = None
        """that of the recordings made here, once the store is open"""
        self.idle_times = IdleTimes()
        self.snapshots = SnapshotScheduler(services.store, services.settings)

    @property
    def work(self) -> WorkExecutor:
        """The executor of dear work."""
        return self._services.work

    @property
    def live_sessions(self) -> Mapping[str, Session]:
        """The live sessions by id."""
        return self._live

    @property
    def live_count(self) -> int:
        """The number of live sessions."""
        return len(self._live)

    @property
    def evicted_count(self) -> int:
        """The number of sessions that are stored and not live."""
        return max(0, self._stored_count - len(self._live))

    async def open(self) -> None:
        """Count the stored sessions; only this manager adds to them from now on. Raises `StoreError`."""
        self._stored_count = await self._services.store.count()
        self.seal = Seal(await self._services.store.secret(SECRET))

    @property
    def subscriber_count(self) -> int:
        """The number of subscribers of all sessions."""
        return sum(len(session.subscribers) for session in self._live.values())

    async def create(
        self,
        name: str | None,
        config: Config,
        *,
        paused: bool,
        language: str = DEFAULT_LANGUAGE,
        recorded: Recording | None = None,
        answer: Callable[[Session], StoredResponse] | None = None,
    ) -> Session:
        """Create and store a session, with the response to store (`answer`); a recording is replayed first.

        Raises `GenerationError`, `TooManySessions`, `NotSaved`, or `RecordingMismatch` or `Invalid` for a
        recording that cannot be replayed.
        """
        await self._make_room()
        self._creating += 1
        try:
            record = SessionRecord(
                id=self._services.shard.new_id(),
                name=name,
                created_at=datetime.now(UTC),
                config=asdict(config),
                paused=paused and recorded is None,
                tick=recorded.tick if recorded else 0,
                language=language,
            )
            # Looking for a road that can be driven may take many draws.
            slow = config.solvable or config.columns * config.rows > LARGE_ROAD_CELLS
            timeline = await self.work.in_thread(Timeline, config) if slow else Timeline(config)
            session = Session(record, timeline, self._services)
            if recorded is not None:
                session = await replay_recording(session, recorded, self._services)
            session.paused = paused
            await self._store(session, recorded.entries if recorded else (), answer)
        finally:
            self._creating -= 1
        self.snapshots.add(session)
        await self._start(session)
        return session

    async def fork(
        self,
        parent: Session,
        at_tick: int | None,
        actions: tuple[Action, ...] = (),
        *,
        name: str | None = None,
        paused: bool | None = None,
        answer: Callable[[Session], StoredResponse] | None = None,
        field: str = "at_tick",
    ) -> Session:
        """Create and store a session that is `parent` up to a tick, with changes of its own.

        Raises a `ProblemError`; for a future tick it names `field`.
        """
        check_step_ticks(actions, self._services.settings.max_step_ticks, parent.language)
        now = parent.timeline.tick
        tick = now if at_tick is None else at_tick
        if tick > now:
            message = refusals(parent.language).session("tick_not_come", now=now)
            raise Invalid(f"{field}: {message}.", errors=[FieldProblem(field, message)])
        await self._make_room()
        self._creating += 1
        try:
            session, entries = await build_fork(parent, tick, actions, name, paused, self._services)
            await self._store(session, entries, answer)
        finally:
            self._creating -= 1
        self.snapshots.add_fork(session)
        await self._start(session)
        return session

    async def _store(
        self,
        session: Session,
        entries: Sequence[EntryRecord],
        answer: Callable[[Session], StoredResponse] | None,
    ) -> None:
        """Store a new session, with the response to the request that asked for it. Raises `NotSaved`."""
        kept = () if answer is None else (answer(session),)
        try:
            session.record = await self._services.store.create(
                session.record, attach_names(entries, session.undo_stack.bookmarks.values()), *kept
            )
        except StoreError as error:
            _LOG.error("a session was not saved", error=str(error))
            raise NotSaved from error

    async def _start(self, session: Session) -> None:
        """Make a stored session live, and wait until it is known whether its vehicle can arrive."""
        self._live[session.id] = session
        self.idle_times.touch(session.id)
        self._stored_count += 1
        session.set_paused(session.paused)
        session.reachability.start_road(session.run)
        await session.reachability.wait_until_idle()

    async def get(self, session_id: str) -> Session:
        """The session with this id, restored if not live. Raises `UnknownSession` or `NotOfThisShard`."""
        live = self._live.get(session_id)
        if live is not None:
            self.idle_times.touch(session_id)
            return live
        self._check_shard(session_id)
        if session_id in self._expiring:
            raise UnknownSession
        # All who ask at once wait for the same replay.
        task = self._restoring.get(session_id)
        if task is None:
            with of_nobody():  # not cancelled with the first who asks
                task = asyncio.ensure_future(self._restore(session_id))
            self._restoring[session_id] = task
            task.add_done_callback(lambda _: self._restoring.pop(session_id, None))
        return await asyncio.shield(task)

    async def newest(self, limit: int, before: int | None) -> list[tuple[SessionRecord, Session | None]]:
        """Stored sessions, newest first, each with its live session if there is one."""
        records = await self._services.store.newest(limit, before)
        return [(record, self._live.get(record.id)) for record in records]

    async def bookmarks(self, limit: int, before: int | None) -> Sequence[BookmarkRecord]:
        """Bookmarks of all sessions, newest first."""
        return await self._services.store.bookmarks(limit, before)

    async def entries(self, session: Session) -> Sequence[EntryRecord]:
        """The stored entries of a session."""
        return await self._services.store.entries(session.id)

    async def rename(self, session_id: str, name: str | None) -> Session:
        """Give a session another name, or none. Raises `UnknownSession`."""
        session = await self.get(session_id)
        if not await self._services.store.rename(session_id, name):
            raise UnknownSession
        session.record = replace(session.record, name=name)
        return session

    async def delete(self, session_id: str, preconditions: Preconditions = NO_PRECONDITIONS) -> None:
        """Delete a session after the change under way. Raises `UnknownSession` or `PreconditionFailed`."""
        self._check_shard(session_id)
        live = self._live.get(session_id)
        if live is None and preconditions.sequences is not None:
            live = await self.get(session_id)
        if live is None:
            found = await self._services.store.delete(session_id)
        else:
            async with live.locked(preconditions):
                found = await self._services.store.delete(session_id)
                if found:
                    live.retire()  # before those that wait have their turn
        if not found:
            raise UnknownSession
        self._stored_count -= 1
        self.idle_times.forget(session_id)
        self.snapshots.forget(session_id)
        session = self._live.pop(session_id, None)
        if session is not None:
            await session.close()
            session.subscribers.close()

    async def expire(self, session_id: str) -> bool:
        """Delete a stored session unless somebody uses it; returns whether it was deleted."""
        if session_id in self._live or session_id in self._restoring or not self.owns(session_id):
            return False
        self._expiring.add(session_id)
        try:
            found = await self._services.store.delete(session_id)
        finally:
            self._expiring.discard(session_id)
        if found:
            self._stored_count -= 1
            self.snapshots.forget(session_id)
        return found

    def owns(self, session_id: str) -> bool:
        """Whether a session lives here, if there is one of this id."""
        return self._services.shard.owns(session_id)

    def _check_shard(self, session_id: str) -> None:
        """Raise `NotOfThisShard`: a session that were live in two processes would have two logs."""
        if not self.owns(session_id):
            raise NotOfThisShard(shard_of(session_id, self._services.shard.count))

    def evictor(self) -> Evictor:
        """The evictor of idle sessions."""
        settings = self._services.settings
        return Evictor(
            lambda: list(self._live.values()),
            self.evict,
            self.idle_times,
            after_s=settings.sleep_after_s,
            running=settings.sleep_running,
        )

    async def evict(self, sessions: list[Session], still: Callable[[Session], bool]) -> int:
        """Store the ticks of sessions, then drop those that are `still` unused; returns how many."""
        for session in sessions:
            self._services.clock.remove(session)
        let_go = 0
        try:
            await self._services.store.save_ticks({each.id: each.timeline.tick for each in sessions})
            for session in sessions:
                if self._live.get(session.id) is session and still(session):
                    session.retire()
                    self.snapshots.remove(session)
                    del self._live[session.id]
                    self.idle_times.forget(session.id)
                    let_go += 1
        finally:
            for session in sessions:
                if self._live.get(session.id) is session and not session.paused:
                    self._services.clock.add(session)
        return let_go

    async def close(self, within_s: float = CLOSE_TIMEOUT_S) -> None:
        """Stop all sessions and store their ticks, except of those still being changed after `within_s`."""
        ending = {asyncio.ensure_future(session.close()): session for session in self._live.values()}
        self._live.clear()
        if not ending:
            return
        ended, late = await asyncio.wait(ending, timeout=within_s)
        for task in late:
            task.cancel()
        if late:
            # A change under way may yet be stored, and say otherwise where time stands.
            _LOG.warning("sessions were still being changed at the stop", count=len(late))
        ticks = {ending[each].id: ending[each].timeline.tick for each in ended}
        try:
            await self._services.store.save_ticks(ticks)
        except StoreError as error:
            _LOG.error("where clocks stood was not saved", error=str(error))
        else:
            await self.snapshots.close((ending[each] for each in ended), SNAPSHOT_TIMEOUT_S)

    async def _restore(self, session_id: str) -> Session:
        try:
            record = await self._services.store.get(session_id)
        except StoreError as error:
            _LOG.error("a kept session cannot be read", session=session_id, error=str(error))
            raise NotRestorable from error
        if record is None:
            raise UnknownSession
        await self._make_room()
        try:
            entries = await self._services.store.entries(session_id)
            snapshot = await self.snapshots.find(session_id)
            session, unfit = await self._bring_back(record, entries, snapshot)
        except ReplayError as error:
            sequence = entries[error.position].sequence if error.position < len(entries) else None
            _LOG.error(
                "a kept session cannot be replayed", session=session_id, entry=sequence, error=str(error)
            )
            raise NotRestorable(sequence) from error
        except NewerRulesError as error:
            _LOG.error("a kept session is of newer rules", session=session_id, rules=error.rules)
            raise NotRestorable(reason=refusals(record.language).newer_rules(error, "session")) from error
        except (ConfigError, TypeError, StoreError) as error:
            _LOG.error("a kept session cannot be replayed", session=session_id, error=str(error))
            raise NotRestorable from error
        if snapshot is not None:
            self.snapshots.record_use(session_id, unfit)
        self.idle_times.touch(session_id)
        self._live[session_id] = session
        self.snapshots.add(session)
        session.reachability.start_road(session.run)
        return session

    async def _bring_back(
        self, record: SessionRecord, entries: Sequence[EntryRecord], snapshot: SnapshotRecord | None
    ) -> tuple[Session, UnfitError | None]:
        """See `restore`; a long log without a snapshot is replayed in a process, whatever it costs."""
        config = saved_config(record.config)
        long = snapshot is None and record.branch is None
        units = await self.work.in_thread(log_units, config, entries, record.tick) if long else 0
        back = partial(restore, record, entries, snapshot, self._services)
        if uses_installed_planner(config, entries):
            return await run_in_thread(True, REPLAY_S, back)
        if units <= THREAD:
            return await self.work.in_thread(back)
        done = await self.work.in_process(
            units, replay_log, record, entries, record.tick, self._services.narrator, self._services.settings
        )
        return done.revive(record, self._services), None

    async def _make_room(self) -> None:
        """Evict the sessions idle longest if the limit is reached. Raises `TooManySessions`."""
        settings = self._services.settings
        most = settings.max_sessions
        while (over := len(self._live) + self._creating - most + 1) > 0:
            room = RoomMaker(self._live.values(), self.idle_times, settings.sleep_after_s)
            leaving = room.longest_idle(over)
            try:
                evicted = await self.evict(leaving, room.may_leave) if leaving else 0
            except StoreError as error:
                raise NotSaved from error
            if not evicted:
                raise TooManySessions(most, room.wait_s())
