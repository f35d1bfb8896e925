"""A client of the service: `Client` waits for answers, `AsyncClient` is awaited; both answer the same.

Knows the service by its documented calls only; nothing of the service itself is imported here.
"""

from __future__ import annotations

from service.client.async_client import AsyncClient, AsyncSession
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
from service.client.media import Film, Frame, Picture
from service.client.messages import Changed, Gone, Hello, Message, Standing, Tick
from service.client.reading import Page
from service.client.results import (
    Answer,
    BlockedMove,
    CommandResult,
    Decision,
    Link,
    LogEvent,
    Parent,
    Recording,
    SavedMoment,
    SavedMoments,
    SessionInfo,
    SessionMoment,
    SessionSummary,
    State,
    StepResult,
    Ticket,
)
from service.client.runs import (
    Counterfactual,
    Expected,
    Judged,
    Moment,
    Moments,
    RoadChange,
    RoadChanges,
    Timeline,
)
from service.client.sync_client import Client, Session
from service.client.unbound import Advice, Guide

__all__ = [
    "Advice",
    "Ambiguous",
    "Answer",
    "AsyncClient",
    "AsyncSession",
    "BlockedMove",
    "Changed",
    "Choice",
    "Client",
    "CommandResult",
    "Counterfactual",
    "Decision",
    "Expected",
    "Film",
    "Frame",
    "Gone",
    "Guide",
    "Hello",
    "Invalid",
    "Judged",
    "Link",
    "LogEvent",
    "Message",
    "Moment",
    "Moments",
    "NotAllowed",
    "NotFound",
    "NotReachable",
    "NotUnderstood",
    "Page",
    "Parent",
    "Picture",
    "Recording",
    "Refused",
    "RoadChange",
    "RoadChanges",
    "RoadtalkError",
    "SavedMoment",
    "SavedMoments",
    "Session",
    "SessionInfo",
    "SessionMoment",
    "SessionSummary",
    "Standing",
    "State",
    "StepResult",
    "Tick",
    "Ticket",
    "TimedOut",
    "Timeline",
    "TooMany",
    "Unavailable",
    "UnexpectedAnswer",
    "UnknownSession",
]
