"""The whole service inside this process, with a clock moved by hand, that can be stopped, killed and woken.

A killed one leaves behind what its store held at that moment, and nothing else: that is copied, and the next
service is made on the copy.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from copy import deepcopy
from typing import Any

import httpx

from service.app import create_app
from service.sessions.session import Session
from service.settings import Settings
from service.store import MemoryStore
from tests.model.following import Follower
from tests.model.wires import Events, Socket
from tests.support.fakes import HandClock

NEVER = 10**9
TURNS = 20_000


class Inside:
    """One service after the other, on what the one before has left."""

    by_hand = True

    def __init__(self, log_events: int = 400) -> None:
        self.log_events = log_events
        self.settings = Settings(database="memory:", snapshot_work=NEVER, log_events=log_events)
        self.store = MemoryStore()
        self.followers: dict[str, list[Follower]] = {}
        self._away: dict[str, list[Follower]] = {}

    async def __aenter__(self) -> Inside:
        await self._start()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._end()

    async def _start(self) -> None:
        self.clock = HandClock()
        self.app = create_app(self.settings, store=self.store, clock=self.clock)
        self._life = self.app.router.lifespan_context(self.app)
        await self._life.__aenter__()
        self.http = httpx.AsyncClient(transport=httpx.ASGITransport(self.app), base_url="http://localhost")

    async def _end(self) -> None:
        for path in list(self.followers):
            await self.let_go(path)
        await self.http.aclose()
        await self._life.__aexit__(None, None, None)

    async def stop(self) -> None:
        """Gracefully, and begin anew."""
        await self._quiet()
        await self._end()
        await self._start()

    async def kill(self) -> None:
        """Begin anew with what was stored, as if nothing had been done in order."""
        await self._quiet()
        left = deepcopy(self.store)
        await self._end()
        self.store = left
        await self._start()

    @property
    def _manager(self) -> Any:
        return self.app.state.context.manager

    def _live(self, path: str) -> Session | None:
        found: Session | None = self._manager.live_sessions.get(path.rpartition("/")[2])
        return found

    async def _quiet(self) -> None:
        """Whatever is done beside the loop is done."""
        for session in list(self._manager.live_sessions.values()):
            await until(lambda session=session: not session.busy)  # type: ignore[misc]
            await session.reachability.wait_until_idle()
            session.feed.wait_for_narration()

    async def tick(self) -> None:
        """One turn of the clock."""
        await self._quiet()
        self.clock.tick()
        await self._quiet()

    def now(self, path: str) -> int | None:
        """The tick of a session that is live."""
        live = self._live(path)
        return None if live is None else live.timeline.tick

    async def sleep(self, path: str) -> bool:
        """Let go of a session; whether it was live."""
        await self.let_go(path)
        await self._quiet()
        live = self._live(path)
        return live is not None and await self._manager.evict([live], lambda _: True) == 1

    async def snapshot(self, path: str) -> None:
        """Keep one now."""
        live = self._live(path)
        if live is not None:
            await self._quiet()
            self._manager.snapshots.take(live)
            await self._manager.snapshots.flush()

    def drop(self) -> None:
        """All snapshots are lost."""
        self.store._snapshots.clear()

    async def watch(self, path: str) -> None:
        """Follow it by both wires; who does so already goes away, and who was away comes back."""
        if path in self.followers:
            away = self.followers[path]
            await self.let_go(path)
            self._away[path] = away
            return
        live = self._live(path)
        if live is None:
            return
        followers = self._away.pop(path, [])
        if followers:
            for each, wire in zip(followers, (Socket, Events), strict=True):
                each.come_back(wire(self.app, path, f"?after={each.event}"))
        else:
            followers = [Follower(Socket(self.app, path)), Follower(Events(self.app, path))]
        self.followers[path] = followers
        await until(lambda: len(live.subscribers) >= 2)
        await self.heard(path)

    async def heard(self, path: str) -> list[Follower]:
        """Those who follow it, once they have heard all there is."""
        followers = self.followers.get(path, [])
        live = self._live(path)
        if followers and live is not None:
            await self._quiet()
            for each in followers:
                await until(lambda each=each: each.read() == live.subscribers.last_event_id)  # type: ignore[misc]
        return followers

    async def settled(self, path: str, _lines: int) -> None:
        """What is found out about its road has been told."""
        live = self._live(path)
        if live is not None:
            await live.reachability.wait_until_idle()

    async def let_go(self, path: str) -> None:
        """Nobody follows it any more."""
        for each in self.followers.pop(path, []):
            await each.wire.close()

    async def by_socket(self, path: str, message: dict[str, Any]) -> tuple[int, dict[str, Any]]:
        """A message on a socket of its own: the status it would have had, and the answer."""
        socket = Socket(self.app, path)
        socket.say(id="1", **message)
        follower = Follower(socket)
        await until(lambda: follower.read() is not None and "1" in follower.answers)
        answer = follower.answers["1"]
        await socket.close()
        if answer["type"] == "result":
            return 200, answer["result"]
        return answer["problem"]["status"], answer["problem"]


async def until(done: Callable[[], bool]) -> None:
    """Wait for what is sure to come; threads take their time."""
    for turn in range(TURNS):
        if done():
            return
        await asyncio.sleep(0 if turn < 200 else 0.005)
    raise TimeoutError("what had to come has not")
