"""The service's health: whether it is alive, whether its store answers, and how late its ticks are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from service.contract.model import Answered, DocumentedAs, Model


@dataclass(frozen=True, slots=True)
class Lateness(Model):
    """How long after their deadline the latest ticks began."""

    ticks: int
    p50_ms: float
    p99_ms: float
    max_ms: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ShardHealth(Model):
    """One of several processes that hold sessions."""

    shard: int
    state: Annotated[str, DocumentedAs(Literal["up", "down"])]
    """`down`: it is being replaced; its sessions come back with it."""
    address: str | None
    """Where it listens for the service's entry; None while it is down."""
    process: int | None
    restarts: int
    sessions: int
    watchers: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Health(Answered):
    """The service is alive, and what it holds."""

    status: Annotated[str, DocumentedAs(Literal["ok"])]
    version: str
    sessions: int
    watchers: int
    tick_lateness: Lateness
    shards: tuple[ShardHealth, ...] = ()
    """Empty where one process holds all sessions."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ready(Answered):
    """The store answers."""

    status: Annotated[str, DocumentedAs(Literal["ready"])]
