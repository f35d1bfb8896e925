"""A client of the service: `Client` waits for answers, `AsyncClient` is awaited; both answer the same.

Knows the service by its documented calls only; nothing of the service itself is imported here.
"""

from __future__ import annotations

from service.client.aio import AsyncClient, AsyncSession
from service.client.errors import (
    Ambiguous,
    Choice,
    Invalid,
    NotAllowed,
    NotFound,
    NotReachable,
    NotUnderstood,
    Refused,
    RoadtalkError,
    TimedOut,
    TooMany,
    Unavailable,
    UnexpectedAnswer,
    UnknownSession,
)
from service.client.messages import Changed, Gone, Hello, Message, Standing, Tick
from service.client.results import (
    Answer,
    CommandResult,
    Decision,
    Frame,
    LogEvent,
    Page,
    Recording,
    SessionInfo,
    SessionSummary,
    State,
    StepResult,
)
from service.client.sync import Client, Session

__all__ = [
    "Ambiguous",
    "Answer",
    "AsyncClient",
    "AsyncSession",
    "Changed",
    "Choice",
    "Client",
    "CommandResult",
    "Decision",
    "Frame",
    "Gone",
    "Hello",
    "Invalid",
    "LogEvent",
    "Message",
    "NotAllowed",
    "NotFound",
    "NotReachable",
    "NotUnderstood",
    "Page",
    "Recording",
    "Refused",
    "RoadtalkError",
    "Session",
    "SessionInfo",
    "SessionSummary",
    "Standing",
    "State",
    "StepResult",
    "Tick",
    "TimedOut",
    "TooMany",
    "Unavailable",
    "UnexpectedAnswer",
    "UnknownSession",
]
