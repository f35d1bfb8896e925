"""The event streams that are open, to be ended when the service stops."""

from __future__ import annotations

from service.sessions.subscribers import Subscriber


class OpenStreams:
    """All who read event streams now."""

    def __init__(self) -> None:
        self.stopping = False
        self._watchers: set[Subscriber] = set()

    def add(self, subscriber: Subscriber) -> None:
        """Adds a reader; while the service stops, its stream ends at once."""
        self._watchers.add(subscriber)
        if self.stopping:
            subscriber.close()

    def remove(self, subscriber: Subscriber) -> None:
        """Removes a reader that has gone."""
        self._watchers.discard(subscriber)

    def stop(self) -> None:
        """Ends all streams: a server that stops waits for the responses under way."""
        self.stopping = True
        for subscriber in self._watchers:
            subscriber.close()
