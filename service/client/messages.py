"""The stream's messages, under the names that watchers use.

A kind of message that is not known here is a plain `Message`, so that a newer service can be watched.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from service.client.call import Json
from service.client.reading import read
from service.contract.stream import ChangedMessage as Changed
from service.contract.stream import GoneMessage as Gone
from service.contract.stream import HelloMessage, Message
from service.contract.stream import StateMessage as Standing
from service.contract.stream import TickMessage as Tick

__all__ = ["Changed", "Gone", "Hello", "Message", "Standing", "Tick", "read_message"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Hello(HelloMessage):
    """The first message of a connection: everything to begin with; `resumed` after a lost connection."""

    resumed: bool = False


_KINDS: dict[str, type[Message]] = {
    "hello": Hello,
    "tick": Tick,
    "changed": Changed,
    "state": Standing,
    "gone": Gone,
}


def read_message(values: Json, *, resumed: bool) -> Message:
    """A message of the stream. Raises `UnexpectedAnswer`."""
    message = read(_KINDS.get(values["type"], Message), values, "the message")
    if isinstance(message, Hello) and resumed:
        message = replace(message, resumed=True)
        message.read_from(values)
    return message
