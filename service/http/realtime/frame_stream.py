"""Streams of frames: pictures drawn beside the event loop, encoded once for all who watch the same view.

A *reel* is the task that draws one view of one session for everyone who watches it, as often as the fastest
watcher asks; when nothing moves nothing is drawn or sent. Each watcher has a slot for one picture, the
newest: a slow one sees fewer pictures, never old ones, and nobody waits for it.

A binary message is a header of 16 bytes, big-endian, then the picture's file:

    2 bytes  `RT`
    1 byte   version of this header, 1
    1 byte   1 JPEG, 2 WebP
    4 bytes  float: the phase, the share of the way from the tick before to this tick, 0 to 1
    8 bytes  the tick

Not handled: when exactly a tick was. A reel sees it at its next turn, and animates from there.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from struct import Struct
from typing import Final, Literal

import structlog
from anyio import CapacityLimiter, to_thread

from service.sessions.scheduler.offload import uses_external_planner
from service.sessions.scheduler.playback_speed import MAX
from service.sessions.session import Session
from sim.plan import Decision
from sim.render import Look, encode, render
from sim.render.look import PLAIN
from sim.render.video import DecisionOf, trail_after
from sim.state import SimState
from sim.types import Cell, Mode

_LOG = structlog.get_logger(__name__)

HEADER: Final = Struct(">2sBBfQ")
MAGIC: Final = b"RT"
VERSION: Final = 1
FORMS: Final = {"jpeg": 1, "webp": 2}
RETRY_S: Final = 1.0
"""Wait after a view that could not be drawn."""

Form = Literal["jpeg", "webp"]
View = Literal["road", "schematic"]


@dataclass(frozen=True, slots=True)
class Wanted:
    """A view with its format and size; watchers of the same share a reel."""

    view: View
    form: Form
    side: int
    look: Look = PLAIN


class Slot:
    """The newest picture that one watcher has not been sent."""

    def __init__(self, fps: int) -> None:
        self.fps = fps
        self._newest: bytes | None = None
        self._ready = asyncio.Event()

    def put(self, picture: bytes) -> None:
        """Replaces the picture; never waits."""
        self._newest = picture
        self._ready.set()

    async def next(self) -> bytes:
        """Waits for a picture that was not taken before."""
        while self._newest is None:
            self._ready.clear()
            await self._ready.wait()
        picture, self._newest = self._newest, None
        return picture


class Reel:
    """One view of one session, drawn for all its watchers."""

    def __init__(self, session: Session, wanted: Wanted, drawing: CapacityLimiter) -> None:
        self.drawn = 0
        self._session = session
        self._wanted = wanted
        self._drawing = drawing
        self._slots: set[Slot] = set()
        self._task: asyncio.Task[None] | None = None
        self._newest: bytes | None = None
        self._run: SimState | None = None
        self._phase = 1.0
        self._before: SimState | None = None
        self._moved_at = 0.0
        self._trail: tuple[Cell, ...] = ()
        self._stood = False

    def __len__(self) -> int:
        return len(self._slots)

    def join(self, fps: int) -> Slot:
        """Adds a watcher; it gets the newest picture at once, then every new one."""
        slot = Slot(fps)
        if self._newest is not None:
            slot.put(self._newest)
        self._slots.add(slot)
        if self._task is None:
            self._task = asyncio.create_task(self._roll())
        return slot

    def leave(self, slot: Slot) -> None:
        """Removes a watcher; without watchers nothing is drawn."""
        self._slots.discard(slot)
        if not self._slots and self._task is not None:
            self._task.cancel()
            self._task = None

    async def draw_now(self, now_s: float) -> None:
        """Draws what is to be seen now, unless it was drawn already."""
        run, before, phase = self._session.run, self._before, 1.0
        last = self._run
        if last is not None and last.world.tick != run.world.tick:
            forward = run.world.tick > last.world.tick
            before = self._session.timeline.at(run.world.tick - 1) if forward else None
            follows = before is not None and last.world.tick == before.world.tick
            self._trail = trail_after(self._trail, before, run) if before is not None and follows else ()
            self._moved_at = now_s
        if before is not None and before.world.tick + 1 == run.world.tick:
            lasts_s = self._lasts_s(run)
            phase = min(1.0, (now_s - self._moved_at) / lasts_s) if lasts_s else 1.0
        stands = self._session.paused and phase == 1.0
        if run is last and phase == self._phase and stands == self._stood:
            return
        self._run, self._before, self._phase, self._stood = run, before, phase, stands
        latest = self._session.latest_decision()
        decision = None if latest is None or before is None else latest[0]
        next_of = self._next_of() if stands else None
        picture = await to_thread.run_sync(
            self._draw, run, before, decision, phase, self._trail, next_of, limiter=self._drawing
        )
        self.drawn += 1
        header = HEADER.pack(MAGIC, VERSION, FORMS[self._wanted.form], phase, run.world.tick)
        self._newest = header + picture
        for slot in self._slots:
            slot.put(self._newest)

    async def _roll(self) -> None:
        due_s = time.monotonic()
        while True:
            try:
                await self.draw_now(time.monotonic())
            except Exception:
                _LOG.exception("a view could not be drawn", session=self._session.id, wanted=self._wanted)
                await asyncio.sleep(RETRY_S)
            due_s = await _next_turn(due_s, max((slot.fps for slot in self._slots), default=1))

    def _lasts_s(self, run: SimState) -> float:
        pace = self._session.playback_speed
        return 0.0 if pace == MAX else run.config.step_seconds / float(pace)

    def _next_of(self) -> DecisionOf | None:
        """What finds the next decision of a road that stands; a planner of another package is not asked."""
        timeline = self._session.timeline
        shown = self._wanted.view == "road" and self._wanted.look.path
        by_itself = timeline.state.ego().mode is not Mode.MANUAL
        return timeline.decided if shown and by_itself and not uses_external_planner(timeline) else None

    def _draw(
        self,
        run: SimState,
        before: SimState | None,
        decision: Decision | None,
        phase: float,
        trail: tuple[Cell, ...],
        next_of: DecisionOf | None,
    ) -> bytes:
        """Runs in a thread; `draw_now` waits for it."""
        size = (self._wanted.side, self._wanted.side)
        world = None if before is None else before.world
        picture = render(
            self._wanted.view,
            run,
            before=world,
            decision=decision,
            phase=phase,
            size=size,
            look=self._wanted.look,
            trail=trail,
            coming=None if next_of is None else next_of(run),
        )
        return encode(picture, self._wanted.form)


class Reels:
    """The reels that are watched, by session and view."""

    def __init__(self) -> None:
        self._reels: dict[tuple[str, Wanted], Reel] = {}

    def __len__(self) -> int:
        return len(self._reels)

    async def stream_to(
        self,
        session: Session,
        wanted: Wanted,
        fps: int,
        drawing: CapacityLimiter,
        send: Callable[[bytes], Awaitable[None]],
    ) -> None:
        """Sends one watcher its pictures, at its pace, until cancelled or `send` raises."""
        key = (session.id, wanted)
        reel = self._reels.setdefault(key, Reel(session, wanted, drawing))
        slot = reel.join(fps)
        try:
            due_s = time.monotonic()
            while True:
                await send(await slot.next())
                due_s = await _next_turn(due_s, fps)
        finally:
            reel.leave(slot)
            if not reel and self._reels.get(key) is reel:
                del self._reels[key]


async def _next_turn(due_s: float, fps: int) -> float:
    """Waits for the next of `fps` turns a second; missed turns are not made up for."""
    now_s, period_s = time.monotonic(), 1 / fps
    due_s = max(due_s, now_s - period_s) + period_s
    await asyncio.sleep(max(0.0, due_s - now_s))
    return due_s
