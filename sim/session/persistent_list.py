"""A persistent (immutable) list: appending returns a new list that shares the old one's storage.

A session's log is tried on copies, kept at named moments, and continued twice after a fork; none of this
copies the log. Lists with a common history share one underlying list. Only a list that branches off from the
middle of a shared one is copied.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from threading import Lock
from typing import TypeVar, overload

Item = TypeVar("Item")

_GROWING = Lock()
"""Two lists that share storage may be extended in two threads."""


class PersistentList(Sequence[Item]):
    """An immutable sequence with fast `plus` and fast prefixes (`log[:n]`)."""

    __slots__ = ("_length", "_shared")

    def __init__(self, items: Iterable[Item] = ()) -> None:
        self._shared = list(items)
        self._length = len(self._shared)

    def plus(self, items: Sequence[Item]) -> PersistentList[Item]:
        """Returns this list followed by `items`."""
        if not items:
            return self
        longer: PersistentList[Item] = PersistentList.__new__(PersistentList)
        with _GROWING:
            if len(self._shared) == self._length:
                self._shared.extend(items)
                longer._shared = self._shared
            else:  # another list has been extended from here
                longer._shared = [*self._shared[: self._length], *items]
        longer._length = self._length + len(items)
        return longer

    def first(self, count: int) -> PersistentList[Item]:
        """Returns the first `count` items, or all if there are fewer."""
        if count >= self._length:
            return self
        shorter: PersistentList[Item] = PersistentList.__new__(PersistentList)
        shorter._shared = self._shared
        shorter._length = max(0, count)
        return shorter

    def after(self, count: int) -> list[Item]:
        """Lists the items after the first `count`."""
        return self._shared[count : self._length]

    @property
    def shared(self) -> Sequence[Item]:
        """The underlying list; this one is a prefix of it. Read only."""
        return self._shared

    def common_prefix_length(self, other: PersistentList[Item]) -> int:
        """The number of items in the common prefix of both lists."""
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
        return f"PersistentList({list(self)!r})"
