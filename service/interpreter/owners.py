"""Whose taught phrases hold: those of whoever asks now.

One API key is shared by all who have it, so clients are told apart by their addresses, as for quotas and rate
limits. This machine is one owner, `LOCAL`, whose phrases hold for everyone: whoever runs the service teaches
for all. What others teach holds for them alone.
"""

from __future__ import annotations

from contextvars import ContextVar
from functools import lru_cache
from ipaddress import IPv6Address, ip_address

LOCAL = "everyone"
"""The owner on this machine; also of all phrases from before owners were told apart."""

_IPV6_HOST_BITS = 64
"""A home or a phone has a whole network of these, and changes its address within it every day."""

_CURRENT: ContextVar[str] = ContextVar("owner", default=LOCAL)


def current_owner() -> str:
    """The owner of the request that is being answered; `LOCAL` outside of any."""
    return _CURRENT.get()


def ask_as(client: str) -> None:
    """What follows in this task is asked by a client, given by its address."""
    _CURRENT.set(owner_of(client))


@lru_cache(1_024)
def owner_of(client: str) -> str:
    """The owner that a client is, by its address; "" is a socket of this machine."""
    if client in ("", "localhost"):
        return LOCAL
    try:
        address = ip_address(client.partition("%")[0])
    except ValueError:
        return f"client:{client}"[:64]
    if isinstance(address, IPv6Address):
        if address.ipv4_mapped is not None:
            return owner_of(str(address.ipv4_mapped))
        if not address.is_loopback:
            return f"client:{IPv6Address(int(address) >> _IPV6_HOST_BITS << _IPV6_HOST_BITS)}/64"
    return LOCAL if address.is_loopback else f"client:{address}"
