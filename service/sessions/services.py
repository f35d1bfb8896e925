"""What every session of one service shares."""

from __future__ import annotations

from dataclasses import dataclass, field

from service.jobs import JobRunner
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.scheduler.clock import Clock
from service.settings import Settings
from service.sharding import SINGLE, Shard
from service.store import Store
from service.work.executor import WorkExecutor


@dataclass(frozen=True, slots=True)
class SessionServices:
    """The store, the clock, the narrator, the settings and the executor that a session works with."""

    store: Store
    clock: Clock
    narrator: NarratorProtocol
    settings: Settings
    jobs: JobRunner | None = None
    """what runs evaluations; None: they are refused"""
    shard: Shard = SINGLE
    """which part of all sessions this is"""
    work: WorkExecutor = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "work", WorkExecutor(self.settings))
