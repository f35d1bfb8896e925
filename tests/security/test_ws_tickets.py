"""Tickets of sockets that several processes know by their signature."""

from __future__ import annotations

import pytest
from pydantic import SecretStr

from service.contract.stream_requests import Auth
from service.security.ws_tickets import GOOD_FOR_S, SignedTickets


def tickets(now: list[float], secret: str = "a secret") -> SignedTickets:
    return SignedTickets(SecretStr(secret), lambda: now[0], lambda: 1_700_000_000 + now[0])


def test_one_process_issues_and_another_takes_it_once() -> None:
    now = [0.0]
    issuer, taker = tickets(now), tickets(now)
    ticket = issuer.issue()
    assert Auth(type="auth", ticket=ticket).ticket == ticket
    assert taker.take(ticket)
    assert not taker.take(ticket)
    late = issuer.issue()
    now[0] += GOOD_FOR_S + 1
    assert not taker.take(late)
    assert not taker.take(ticket), "nor when it is forgotten"


@pytest.mark.parametrize("forged", ["", "-", "1-2-3", "9999999999-aa-", "9999999999-aa-\u00e4", "\udc80-x-y"])
def test_what_was_not_signed_is_refused(forged: str) -> None:
    assert not tickets([0.0]).take(forged)


def test_another_key_has_other_tickets() -> None:
    assert not tickets([0.0]).take(tickets([0.0], "another").issue())
