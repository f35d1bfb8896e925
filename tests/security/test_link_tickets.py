"""Tickets of links: for one address, for a while, and made with the key."""

from __future__ import annotations

from pydantic import SecretStr

from service.security.link_tickets import GOOD_FOR_S, LinkTickets


def test_a_ticket_is_good_for_its_address_until_it_ends() -> None:
    now = [1_000.0]
    tickets = LinkTickets(SecretStr("a secret"), lambda: now[0])
    path, _, ticket = tickets.add_to("/one").partition("?ticket=")
    assert path == "/one"
    assert tickets.admits("/one", ticket)
    assert not tickets.admits("/two", ticket)
    assert not LinkTickets(SecretStr("another"), lambda: now[0]).admits("/one", ticket)
    assert LinkTickets(SecretStr("a secret"), lambda: now[0]).admits("/one", ticket), "after a restart"
    now[0] += GOOD_FOR_S
    assert not tickets.admits("/one", ticket)


def test_without_a_key_there_are_none() -> None:
    tickets = LinkTickets(None)
    assert tickets.add_to("/one") == "/one"
    assert not tickets.admits("/one", "9999999999-")
