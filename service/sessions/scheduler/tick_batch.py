"""What a session tells, made and sent at once; or, in a turn of the clock, stage by stage.

Sessions that are due together are ticked one after the other, then all their messages are made, then all are
sent. A processor that goes on doing one kind of thing does it in four fifths of the time: what it needs for
that stays at hand. Nothing else happens in between, and each session tells all in its order. Leaves out
when the stages are: the clock knows that.
"""

from __future__ import annotations

from collections.abc import Callable

from service.sessions.subscribers import Notice, Watchers


class Stages:
    """What one session has not told yet. Empty whenever no turn of the clock is under way."""

    __slots__ = ("_holding", "_made", "_untold", "_watchers")

    def __init__(self, watchers: Watchers) -> None:
        self._watchers = watchers
        self._holding = False
        self._untold: list[tuple[int, Callable[[], bytes]]] = []
        self._made: list[Notice] = []

    def hold(self) -> None:
        """Ticks are not told until `make` and `send` are called."""
        self._holding = True

    def tick(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell of a tick, now or when its stage comes."""
        if self._holding:
            self._untold.append((tick, encode))
        else:
            self._watchers.publish(tick, encode)

    def now(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell of something else at once, after all that is not told yet."""
        self.make()
        self.send()
        self._watchers.publish(tick, encode)

    def make(self) -> None:
        """Make the messages of what was held. Raises what making one raises; those before it are made."""
        self._holding = False
        if self._untold:
            untold, self._untold = self._untold, []
            for tick, encode in untold:
                notice = self._watchers.made(tick, encode)
                if notice is not None:
                    self._made.append(notice)

    def send(self) -> None:
        """Hand out what was made."""
        if self._made:
            made, self._made = self._made, []
            for notice in made:
                self._watchers.hand_out(notice)
