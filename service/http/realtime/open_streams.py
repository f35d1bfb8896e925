"""The event streams that are open, to be ended when the service stops."""

from __future__ import annotations

from service.sessions.subscribers import Watcher


class OpenStreams:
    """All who read event streams now."""

    def __init__(self) -> None:
        self.stopping = False
        self._watchers: set[Watcher] = set()

    def add(self, watcher: Watcher) -> None:
        """Adds a reader; while the service stops, its stream ends at once."""
        self._watchers.add(watcher)
        if self.stopping:
            watcher.end()

    def remove(self, watcher: Watcher) -> None:
        """Removes a reader that has gone."""
        self._watchers.discard(watcher)

    def stop(self) -> None:
        """Ends all streams: a server that stops waits for the responses under way."""
        self.stopping = True
        for watcher in self._watchers:
            watcher.end()
