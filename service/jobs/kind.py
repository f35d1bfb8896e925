"""What a kind of job does; the runner knows no more of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

Spec: TypeAlias = Mapping[str, Any]
"""What is to be done, as JSON values."""
Parts: TypeAlias = Mapping[str, bytes]
"""What the finished pieces came to, by key."""


class Piece(NamedTuple):
    """A piece of a job's work; it can be sent to another process."""

    key: str
    """the same whenever the job is resumed"""
    weight: int
    """how much of the job's total it is"""
    what: Any


class JobKind(Protocol):
    """A kind of job. Its functions are pure, and those that `work` and `finish` return are of a module."""

    name: str

    def total(self, spec: Spec) -> int:
        """The weights of all pieces together."""

    def size(self, spec: Spec) -> int:
        """Bytes that the finished pieces take at most, about."""

    def pieces(self, spec: Spec, parts: Parts) -> Sequence[Piece]:
        """The pieces that can be done next, given what is done; none when the job is finished."""

    def work(self, spec: Spec) -> Callable[[Piece, Callable[[], bool]], bytes]:
        """What runs a piece in another process; the second argument tells whether it is cancelled."""

    def finish(self, spec: Spec) -> Callable[[Parts, Callable[[], bool]], dict[str, Any]]:
        """What makes the result of all parts in another process."""
