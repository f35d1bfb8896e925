"""Runs jobs one after the other, in processes of their own, and keeps each piece that is finished.

A job is stored before it is acknowledged. After a stop or a crash of the service it goes on where it was:
pieces that are kept are not run again, and one that was under way is run anew. Live sessions go first: the
processes have a low priority, and one core is left free where there are several.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from enum import StrEnum
from functools import partial
from threading import Event
from typing import Any, Final

import structlog
from anyio import CapacityLimiter, to_thread

from service.jobs.kind import JobKind, Piece, Spec
from service.problems import NotSaved, QuotaExceeded, UnknownJob
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sharding import SINGLE, Shard
from service.store import JobRecord, Store, StoreError
from sim.evaluate.executor import CancelledError, Executor, LocalProcesses, run_all

_LOG = structlog.get_logger(__name__)

MAX_WAITING: Final = 20
"""Jobs that wait or run at most."""
NEWEST: Final = 100
"""Jobs among which the latest one of a session is looked for."""
_ID_BYTES: Final = 12
_SPARE_BYTES: Final = 8_000_000
"""Room on the disk beside what pieces take: for the result, and for what else is stored meanwhile."""
_MB: Final = 1_000_000


class JobState(StrEnum):
    """How a job stands."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def ended(self) -> bool:
        """Whether nothing more happens."""
        return self in (JobState.DONE, JobState.FAILED, JobState.CANCELLED)


def processes_for(cores: int | None) -> int:
    """How many processes work on a job: all cores but one, and at least one."""
    return max(1, (cores or 1) - 1)


class JobRunner:
    """The jobs of one service. All methods are for the event loop's thread."""

    def __init__(
        self,
        store: Store,
        kinds: Sequence[JobKind],
        executor: Callable[[], Executor] | None = None,
        shard: Shard = SINGLE,
    ) -> None:
        """`executor`: makes what runs the pieces; processes of this machine by default.

        `shard`: only its jobs are run here.
        """
        self._shard = shard
        self._store = store
        self._kinds = {kind.name: kind for kind in kinds}
        self._make_executor = executor or (lambda: LocalProcesses(shard.share(processes_for(os.cpu_count()))))
        self._waiting: list[str] = []
        self._live: dict[str, JobRecord] = {}
        """those that wait or run"""
        self._cancel = Event()
        self._running: str | None = None
        self._task: asyncio.Task[None] | None = None
        self._stopping = False
        self._thread = CapacityLimiter(1)
        self._ended: dict[str, asyncio.Event] = {}
        self.on_done: Callable[[JobRecord], None] = lambda _: None
        """told of every job that has a result"""

    async def open(self) -> None:
        """Take up the jobs that a stop or a crash has interrupted."""
        for state in (JobState.RUNNING, JobState.QUEUED):
            found = await self._store.jobs(MAX_WAITING * self._shard.count, state=state)
            for record in reversed([each for each in found if self._shard.owns(each.id)]):
                self._queue(replace(record, state=JobState.QUEUED))
        self._wake()

    async def close(self) -> None:
        """Stop; what is not finished goes on with the next start."""
        self._stopping = True
        self._cancel.set()
        if self._task is not None:
            await asyncio.wait([self._task])

    def new_id(self) -> str:
        """An unguessable id for a job."""
        return self._shard.new_id(_ID_BYTES)

    async def start(
        self, kind: str, spec: Spec, job_id: str | None = None, language: str = DEFAULT_LANGUAGE
    ) -> JobRecord:
        """Store a job and run it when its turn comes. Raises `QuotaExceeded` or `NotSaved`."""
        if len(self._live) >= MAX_WAITING:
            raise QuotaExceeded(refusals(language).session("too_many_jobs", most=MAX_WAITING))
        await self._check_room(self._kinds[kind].size(spec), language)
        record = JobRecord(
            id=job_id or self.new_id(),
            kind=kind,
            state=JobState.QUEUED,
            created_at=datetime.now(UTC),
            spec=spec,
            total=self._kinds[kind].total(spec),
        )
        try:
            record = await self._store.create_job(record)
        except StoreError as error:
            _LOG.error("a job was not saved", error=str(error))
            raise NotSaved from error
        self._queue(record)
        self._wake()
        return record

    async def get(self, job_id: str) -> JobRecord:
        """A job as it stands. Raises `UnknownJob` or `NotSaved`."""
        if job_id in self._live:
            return self._live[job_id]
        try:
            found = await self._store.job(job_id)
        except StoreError as error:
            raise NotSaved from error
        if found is None:
            raise UnknownJob
        return found

    async def newest(self, limit: int, before: int | None = None) -> Sequence[JobRecord]:
        """A page of jobs, newest first. Raises `NotSaved`."""
        try:
            return [self._live.get(job.id, job) for job in await self._store.jobs(limit, before)]
        except StoreError as error:
            raise NotSaved from error

    async def latest_of(self, session: str) -> JobRecord | None:
        """The latest job of a session; None where it is not among the newest. Raises `NotSaved`."""
        found = next((job for job in await self.newest(NEWEST) if job.spec.get("session") == session), None)
        if found is None:
            return None
        try:
            return await self.get(found.id)
        except UnknownJob:
            return None  # deleted meanwhile

    async def parts(self, job_id: str) -> Mapping[str, bytes]:
        """What the finished pieces of a job came to. Raises `NotSaved`."""
        try:
            return await self._store.job_parts(job_id)
        except StoreError as error:
            raise NotSaved from error

    async def cancel(self, job_id: str) -> bool:
        """Cancel a job, at once; whether it had not ended yet. Raises `UnknownJob` or `NotSaved`."""
        record = await self.get(job_id)
        if JobState(record.state).ended:
            return False
        if job_id not in self._live:
            raise UnknownJob  # it is run by another shard: only one of another count of shards could ask
        await self._end(replace(self._live[job_id], state=JobState.CANCELLED))
        if job_id == self._running:
            self._cancel.set()
        elif job_id in self._waiting:
            self._waiting.remove(job_id)
        return True

    async def delete(self, job_id: str) -> None:
        """Forget a job, which is cancelled first. Raises `UnknownJob` or `NotSaved`."""
        await self.cancel(job_id)
        try:
            await self._store.delete_job(job_id)
        except StoreError as error:
            raise NotSaved from error

    async def wait(self, job_id: str) -> JobRecord:
        """A job once it has ended. Raises `UnknownJob`."""
        if job_id in self._live:
            await self._ended.setdefault(job_id, asyncio.Event()).wait()
        return await self.get(job_id)

    # Within

    async def _check_room(self, size: int, language: str) -> None:
        """Raises `NotSaved` where the disk has no room for so many bytes of finished pieces."""
        room = await self._store.room()
        needed = 2 * size + _SPARE_BYTES  # SQLite writes them to its log first
        if room is not None and room < needed:
            parts = {"needed": -(-needed // _MB), "free": room // _MB}
            raise NotSaved(refusals(language).session("no_room_for_job", **parts))

    def _queue(self, record: JobRecord) -> None:
        self._live[record.id] = record
        self._waiting.append(record.id)

    def _wake(self) -> None:
        if self._waiting and self._task is None and not self._stopping:
            self._task = asyncio.create_task(self._work())

    async def _work(self) -> None:
        """Run what waits, until nothing does."""
        try:
            while self._waiting and not self._stopping:
                self._running = self._waiting.pop(0)
                self._cancel = Event()
                try:
                    await self._run(self._running)
                except Exception as error:
                    await self._fail(self._running, error)
                finally:
                    self._running = None
        finally:
            self._task = None
            self._wake()

    async def _run(self, job_id: str) -> None:
        record = replace(self._live[job_id], state=JobState.RUNNING)
        kind, cancel = self._kinds[record.kind], self._cancel
        parts = dict(await self._store.job_parts(job_id))
        await self._update(record)
        loop = asyncio.get_running_loop()

        def keep(piece: Piece, body: bytes) -> None:
            work = self._keep(job_id, piece, body)
            try:
                asyncio.run_coroutine_threadsafe(work, loop).result()
            except RuntimeError:  # the loop is closed: the piece is run again with the next start
                work.close()
                raise

        # In a thread, since it waits for other processes.
        result = await to_thread.run_sync(
            partial(_drive, self._make_executor, kind, record.spec, parts, keep, cancel), limiter=self._thread
        )
        if result is not None and job_id in self._live:
            done = replace(self._live[job_id], state=JobState.DONE, done=record.total, result=result)
            await self._end(done)
            self.on_done(done)

    async def _keep(self, job_id: str, piece: Piece, body: bytes) -> None:
        record = self._live.get(job_id)
        if record is None:
            return  # cancelled
        record = replace(record, done=min(record.total, record.done + piece.weight))
        await self._store.save_job_part(job_id, piece.key, body, record.done)
        if job_id in self._live:
            self._live[job_id] = record

    async def _fail(self, job_id: str, error: Exception) -> None:
        _LOG.error("a job failed", job=job_id, error=repr(error))
        if job_id not in self._live:
            return
        record = replace(self._live[job_id], state=JobState.FAILED, error=str(error) or type(error).__name__)
        try:
            await self._end(record)
        except NotSaved:
            self._forget(record)  # the store does not answer: it goes on with the next start

    async def _update(self, record: JobRecord) -> None:
        self._live[record.id] = record
        try:
            await self._store.update_job(record)
        except StoreError as error:
            raise NotSaved from error

    async def _end(self, record: JobRecord) -> None:
        await self._update(record)
        self._forget(record)

    def _forget(self, record: JobRecord) -> None:
        self._live.pop(record.id, None)
        if record.id in self._ended:
            self._ended.pop(record.id).set()


def _drive(
    make_executor: Callable[[], Executor],
    kind: JobKind,
    spec: Spec,
    parts: dict[str, bytes],
    keep: Callable[[Piece, bytes], None],
    cancel: Event,
) -> dict[str, Any] | None:
    """All pieces that are left, and the result; None where it was cancelled. For a thread."""
    executor = make_executor()

    def left() -> list[Piece]:
        return [piece for piece in kind.pieces(spec, parts) if piece.key not in parts]

    def done(piece: Piece, body: bytes) -> None:
        keep(piece, body)
        parts[piece.key] = body

    try:
        if not run_all(executor, kind.work(spec), left, done, cancel):
            return None
        results = [result for _, result in executor.run(_finish, [(kind.finish(spec), dict(parts))], cancel)]
        return None if cancel.is_set() or not results else results[0]
    except CancelledError:
        return None
    finally:
        executor.close()


def _finish(piece: tuple[Any, Mapping[str, bytes]], cancelled: Callable[[], bool]) -> dict[str, Any]:
    finish, parts = piece
    result: dict[str, Any] = finish(parts, cancelled)
    return result
