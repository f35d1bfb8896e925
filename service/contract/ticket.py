"""Tickets: each lets one WebSocket in without an API key."""

from __future__ import annotations

from dataclasses import dataclass, field

from service.contract.model import Answered


@dataclass(frozen=True, slots=True, kw_only=True)
class Ticket(Answered):
    """Lets one socket in: its first message is `{"type": "auth", "ticket": ...}`."""

    ticket: str = field(repr=False)
    """To be sent as the first message of a socket."""
    good_for_s: int
    """Seconds within which it must be used."""
