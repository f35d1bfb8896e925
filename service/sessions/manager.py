"""All live sessions: made, found, brought back from the store, and let go.

A session that the store knows but that is not live (the service was restarted) is replayed when it
is asked for, and stands paused where it was.
"""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from functools import partial

import structlog
from anyio import to_thread

from service import actions as contract
from service.actions import Action
from service.problems import (
    FieldProblem,
    Invalid,
    NotRestorable,
    NotSaved,
    RecordingMismatch,
    TooManySessions,
    UnknownSession,
)
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.bookmarks import with_names
from service.sessions.fork import way_of
from service.sessions.persistence.replay import ReplayError, repeat, replay
from service.sessions.persistence.restore import woken
from service.sessions.persistence.snapshot_scheduler import Keeper
from service.sessions.preconditions import ANY_TERMS, Terms
from service.sessions.scheduler.eviction import Idleness, Sleeper
from service.sessions.scheduler.offload import REPLAY_S, STEPS_S, patiently
from service.sessions.scheduler.playback_speed import NORMAL
from service.sessions.session import CHANGES_NOTHING, Session, Surroundings
from service.sessions.transaction import Draft, check_ticks
from service.store import EntryRecord, KeptAnswer, MomentRecord, SessionRecord, StoreError
from sim.actions import Set
from sim.config import Config, ConfigError
from sim.rules.versions import NewerRulesError
from sim.session.timeline import Timeline

_LOG = structlog.get_logger(__name__)

END_S = 0.2
"""How long changes under way are waited for at a stop."""

SNAPSHOTS_S = 0.15
"""How long snapshots are kept at a stop."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """What a recording says beside its configuration."""

    entries: Sequence[EntryRecord]
    tick: int
    digest: str


class SessionManager:
    """The sessions of one service."""

    def __init__(self, around: Surroundings) -> None:
        self._around = around
        self._live: dict[str, Session] = {}
        self._waking: dict[str, asyncio.Task[Session]] = {}
        self._making = 0
        self._kept = 0
        self.idleness = Idleness()
        self.keeper = Keeper(around.store, around.settings)

    @property
    def live(self) -> int:
        """How many sessions are live."""
        return len(self._live)

    @property
    def sleeping(self) -> int:
        """How many are kept and not live."""
        return max(0, self._kept - len(self._live))

    async def open(self) -> None:
        """Count what is kept; nobody else adds to it from now on. Raises `StoreError`."""
        self._kept = await self._around.store.count()

    @property
    def watchers(self) -> int:
        """How many readers watch them."""
        return sum(len(session.watchers) for session in self._live.values())

    async def create(
        self,
        name: str | None,
        config: Config,
        *,
        paused: bool,
        language: str = DEFAULT_LANGUAGE,
        recorded: Recorded | None = None,
        answer: Callable[[Session], KeptAnswer] | None = None,
    ) -> Session:
        """A new session, stored, with an `answer` to be kept. With a recording it is replayed first.

        Raises `GenerationError`, `TooManySessions`, `NotSaved`,
        `RecordingMismatch` or `Invalid` for a recording that
        cannot be replayed.
        """
        self._check_room()
        self._making += 1
        try:
            record = SessionRecord(
                id=secrets.token_urlsafe(16),
                name=name,
                created_at=datetime.now(UTC),
                config=asdict(config),
                paused=paused and recorded is None,
                tick=recorded.tick if recorded else 0,
                language=language,
            )
            # Looking for a road that can be driven may take many draws.
            timeline = await asyncio.to_thread(Timeline, config) if config.solvable else Timeline(config)
            session = Session(record, timeline, self._around)
            if recorded is not None:
                await self._replay(session, recorded)
            session.paused = paused
            kept = () if answer is None else (answer(session),)
            entries = recorded.entries if recorded else ()
            try:
                session.record = await self._around.store.create(
                    record, with_names(entries, session.history.saved.values()), *kept
                )
            except StoreError as error:
                _LOG.error("a session was not saved", error=str(error))
                raise NotSaved from error
        finally:
            self._making -= 1
        self._live[session.id] = session
        self._kept += 1
        self.keeper.join(session)
        session.set_paused(paused)
        session.outlooks.begun(session.run)
        await session.outlooks.settled()
        return session

    async def fork(
        self,
        parent: Session,
        at_tick: int | None,
        actions: tuple[Action, ...] = (),
        *,
        name: str | None = None,
        paused: bool | None = None,
        answer: Callable[[Session], KeptAnswer] | None = None,
        field: str = "at_tick",
    ) -> Session:
        """A new session that is `parent` up to a tick, and then changed; stored.

        Raises a `ProblemError`; for a tick that has not come yet it names `field`.
        """
        check_ticks(actions, self._around.settings.max_step_ticks, parent.language)
        now = parent.timeline.tick
        tick = now if at_tick is None else at_tick
        if tick > now:
            message = refusals(parent.language).session("tick_not_come", now=now)
            raise Invalid(f"{field}: {message}.", errors=[FieldProblem(field, message)])
        self._check_room()
        self._making += 1
        try:
            pace, begins = parent.pace, parent.paused if paused is None else paused
            mixed, timeline = parent.mixed.copy(), parent.timeline.copy()
            way = await to_thread.run_sync(way_of, parent.id, mixed, timeline, tick)
            record = SessionRecord(
                id=secrets.token_urlsafe(16),
                name=name,
                created_at=datetime.now(UTC),
                config=parent.record.config,
                paused=begins,
                tick=tick,
                branch=way.branch,
                language=parent.language,
            )
            session = Session(record, way.timeline, self._around)
            session.begin_with(way)
            session.mixed = {each["sequence"] for each in way.branch.instead}
            said = [] if pace == NORMAL else [(Set(parameter="playback_speed", value=pace),)]
            entries: list[EntryRecord] = []
            if all(isinstance(action, CHANGES_NOTHING) for action in actions):
                draft = Draft(
                    session.timeline, session.paused, session.history, session.pace, session.language
                )
                draft.perform(session.sequence + 1, actions)  # possible, and nothing to be kept, as ever
                actions = ()
            for each in (*said, *((actions,) if actions else ())):
                entries.append(
                    EntryRecord(
                        sequence=session.sequence + 1,
                        tick=session.timeline.tick,
                        text=None,
                        actions=contract.dump(each),
                    )
                )
                again = partial(repeat, session, session.words, entries[-1])
                await to_thread.run_sync(patiently(STEPS_S, again))
            session.record = replace(record, tick=session.timeline.tick)
            session.paused = session.paused if paused is None else paused
            kept = () if answer is None else (answer(session),)
            try:
                session.record = await self._around.store.create(
                    session.record, with_names(entries, session.history.saved.values()), *kept
                )
            except StoreError as error:
                _LOG.error("a fork was not saved", error=str(error))
                raise NotSaved from error
        finally:
            self._making -= 1
        self._live[session.id] = session
        self._kept += 1
        self.keeper.fork(session)
        session.set_paused(session.paused)
        session.outlooks.begun(session.run)
        await session.outlooks.settled()
        return session

    async def get(self, session_id: str) -> Session:
        """The session with this id, brought back if need be. Raises `UnknownSession`."""
        live = self._live.get(session_id)
        if live is not None:
            self.idleness.used(session_id)
            return live
        # All who ask at once wait for the same replay.
        task = self._waking.get(session_id)
        if task is None:
            task = asyncio.ensure_future(self._wake(session_id))
            self._waking[session_id] = task
            task.add_done_callback(lambda _: self._waking.pop(session_id, None))
        return await asyncio.shield(task)

    async def newest(self, limit: int, before: int | None) -> list[tuple[SessionRecord, Session | None]]:
        """Kept sessions, newest first, each with its live self if it has one."""
        records = await self._around.store.newest(limit, before)
        return [(record, self._live.get(record.id)) for record in records]

    async def moments(self, limit: int, before: int | None) -> Sequence[MomentRecord]:
        """Named moments of all sessions, newest first."""
        return await self._around.store.moments(limit, before)

    async def entries(self, session: Session) -> Sequence[EntryRecord]:
        """What was said to a session, as stored."""
        return await self._around.store.entries(session.id)

    async def delete(self, session_id: str, terms: Terms = ANY_TERMS) -> None:
        """End a session and forget it, after what is being done to it. Raises `UnknownSession` or `Stale`."""
        live = self._live.get(session_id)
        if live is None and terms.sequences is not None:
            live = await self.get(session_id)
        if live is None:
            found = await self._around.store.delete(session_id)
        else:
            async with live.held(terms):
                found = await self._around.store.delete(session_id)
                if found:
                    live.retire()  # before those that wait have their turn
        if not found:
            raise UnknownSession
        self._kept -= 1
        self.idleness.forget(session_id)
        self.keeper.forget(session_id)
        session = self._live.pop(session_id, None)
        if session is not None:
            await session.end()
            session.watchers.end()

    def sleeper(self) -> Sleeper:
        """What lets go of sessions that nobody needs."""
        settings = self._around.settings
        return Sleeper(
            lambda: list(self._live.values()),
            self._let_go,
            self.idleness,
            after_s=settings.sleep_after_s,
            running=settings.sleep_running,
        )

    async def _let_go(self, sessions: list[Session], still: Callable[[Session], bool]) -> int:
        """Let go of sessions, their ticks stored first; those that somebody came for meanwhile stay."""
        for session in sessions:
            self._around.clock.remove(session)
        let_go = 0
        try:
            await self._around.store.save_ticks({each.id: each.timeline.tick for each in sessions})
            for session in sessions:
                if self._live.get(session.id) is session and still(session):
                    session.retire()
                    self.keeper.leave(session)
                    del self._live[session.id]
                    self.idleness.forget(session.id)
                    let_go += 1
        finally:
            for session in sessions:
                if self._live.get(session.id) is session and not session.paused:
                    self._around.clock.add(session)
        return let_go

    async def close(self, within_s: float = END_S) -> None:
        """Remember where every clock stood; of sessions still being changed after `within_s`, nothing."""
        ending = {asyncio.ensure_future(session.end()): session for session in self._live.values()}
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
            await self._around.store.save_ticks(ticks)
        except StoreError as error:
            _LOG.error("where clocks stood was not saved", error=str(error))
        else:
            await self.keeper.close((ending[each] for each in ended), SNAPSHOTS_S)

    async def _wake(self, session_id: str) -> Session:
        try:
            record = await self._around.store.get(session_id)
        except StoreError as error:
            _LOG.error("a kept session cannot be read", session=session_id, error=str(error))
            raise NotRestorable from error
        if record is None:
            raise UnknownSession
        self._check_room()
        try:
            entries = await self._around.store.entries(session_id)
            snapshot = await self.keeper.find(session_id)
            back = partial(woken, record, entries, snapshot, self._around)
            session, unfit = await to_thread.run_sync(patiently(REPLAY_S, back))
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
            self.keeper.used(session_id, unfit)
        self.idleness.used(session_id)
        self._live[session_id] = session
        self.keeper.join(session)
        session.outlooks.begun(session.run)
        return session

    async def _replay(self, session: Session, recorded: Recorded) -> None:
        try:
            words, most = session.words, self._around.settings.max_recording_ticks
            again = partial(replay, session, words, recorded.entries, recorded.tick, most=most)
            await to_thread.run_sync(patiently(REPLAY_S, again))
        except ReplayError as error:
            at = error.position
            field = f"recording.entries.{at}" if at < len(recorded.entries) else "recording.tick"
            if error.differs:
                raise RecordingMismatch(
                    f"{error} It was changed, or made by other rules.",
                    errors=[FieldProblem(f"{field}.digest", str(error))],
                ) from error
            raise Invalid(
                "The recording cannot be replayed.", errors=[FieldProblem(field, str(error))]
            ) from error
        if session.timeline.tick != recorded.tick:
            ends = session.timeline.tick
            raise RecordingMismatch(f"Replayed, it ends at tick {ends}, not at {recorded.tick}.")
        digest = session.run.world.digest()
        if digest != recorded.digest:
            raise RecordingMismatch(
                f"Replayed, it ends in {digest}, not in {recorded.digest}: "
                "it was changed, or made by other rules."
            )

    def _check_room(self) -> None:
        most = self._around.settings.max_sessions
        if len(self._live) + self._making >= most:
            raise TooManySessions(
                f"{most} sessions are live, which is the limit here. Delete one and try again."
            )
