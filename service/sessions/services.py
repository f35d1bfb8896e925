"""What every session of one service shares."""

from __future__ import annotations

from dataclasses import dataclass

from service.jobs import JobRunner
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.scheduler.clock import Clock
from service.settings import Settings
from service.store import Store


@dataclass(frozen=True, slots=True)
class SessionServices:
    """The store, the clock, the narrator and the settings that a session works with."""

    store: Store
    clock: Clock
    narrator: NarratorProtocol
    settings: Settings
    jobs: JobRunner | None = None
    """what runs evaluations; None: they are refused"""
