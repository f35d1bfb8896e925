"""A client of the service: `Client` waits for answers, `AsyncClient` is awaited; both answer the same.

Knows the service by its documented calls; answers are the models of `service.contract`.
"""

from __future__ import annotations

from service.client.async_client import AsyncClient
from service.client.async_session import AsyncSession
from service.client.backup import Backup
from service.client.call import DEFAULT_URL
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
from service.client.recording import Recording
from service.client.sync_client import Client
from service.client.sync_session import Session
from service.contract.advice import Advice
from service.contract.command import Answer, CommandResult, StepResult
from service.contract.counterfactual import Counterfactual
from service.contract.decision import BlockedMove, Decision
from service.contract.forecast import Expected, Judged
from service.contract.language import LanguageGuide as Guide
from service.contract.model import Page
from service.contract.session import Link, Parent, SavedMoment, SavedMoments, SessionMoment, SessionSummary
from service.contract.session import Session as SessionInfo
from service.contract.state import State
from service.contract.ticket import Ticket
from service.contract.timeline import LogEvent, Moment, Moments, RoadChange, RoadChanges
from service.contract.timeline import TimelinePage as Timeline

__all__ = [
    "DEFAULT_URL",
    "Advice",
    "Ambiguous",
    "Answer",
    "AsyncClient",
    "AsyncSession",
    "Backup",
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
