"""A sequence that grows without being copied: many of them share one beginning.

A session's log is tried on copies, kept as it was at named moments, and goes two ways in a fork. As a value
that is never changed it needs no copying for that. Those that go the same way share one list; who goes
another way from a shared beginning gets a list of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from threading import Lock
from typing import TypeVar, overload

Item = TypeVar("Item")

_GROWING = Lock()
"""Two chains of one list may be grown in two threads."""


class PersistentList(Sequence[Item]):
    """A sequence as a value: `plus` and prefixes (`chain[:n]`) answer others, and take no time."""

    __slots__ = ("_length", "_shared")

    def __init__(self, items: Iterable[Item] = ()) -> None:
        self._shared = list(items)
        self._length = len(self._shared)

    def plus(self, items: Sequence[Item]) -> PersistentList[Item]:
        """This and more."""
        if not items:
            return self
        longer: PersistentList[Item] = PersistentList.__new__(PersistentList)
        with _GROWING:
            if len(self._shared) == self._length:
                self._shared.extend(items)
                longer._shared = self._shared
            else:  # another chain has gone on from here
                longer._shared = [*self._shared[: self._length], *items]
        longer._length = self._length + len(items)
        return longer

    def first(self, count: int) -> PersistentList[Item]:
        """The first of it; all where there are no more."""
        if count >= self._length:
            return self
        shorter: PersistentList[Item] = PersistentList.__new__(PersistentList)
        shorter._shared = self._shared
        shorter._length = max(0, count)
        return shorter

    def after(self, count: int) -> list[Item]:
        """What follows the first `count`."""
        return self._shared[count : self._length]

    @property
    def shared(self) -> Sequence[Item]:
        """The list that it is the beginning of, with what others have put after it."""
        return self._shared

    def common_prefix_length(self, other: PersistentList[Item]) -> int:
        """How many items both begin with."""
        shorter = min(self._length, other._length)
        if self._shared is other._shared:
            return shorter
        for place in range(shorter):
            one, two = self._shared[place], other._shared[place]
            if one is not two and one != two:
                return place
        return shorter

    def __len__(self) -> int:
        return self._length

    @overload
    def __getitem__(self, place: int) -> Item: ...
    @overload
    def __getitem__(self, place: slice) -> PersistentList[Item]: ...
    def __getitem__(self, place: int | slice) -> Item | PersistentList[Item]:
        if isinstance(place, slice):
            start, stop, step = place.indices(self._length)
            return (
                self.first(stop) if (start, step) == (0, 1) else PersistentList(self._shared[start:stop:step])
            )
        if not -self._length <= place < self._length:
            raise IndexError(place)
        return self._shared[place if place >= 0 else place + self._length]

    def __iter__(self) -> Iterator[Item]:
        return islice(self._shared, self._length)

    def __add__(self, items: Sequence[Item]) -> PersistentList[Item]:
        return self.plus(items)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence) or len(other) != self._length:
            return False
        if isinstance(other, PersistentList) and other._shared is self._shared:
            return True
        return all(one is two or one == two for one, two in zip(self, other, strict=True))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Chain({list(self)!r})"
