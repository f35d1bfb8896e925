"""The feed of a session: its log, and the messages to those who watch it.

Every event is put into words once, written to the log and published. Words that take long to make are made in
a thread; whatever is written later waits for them, so that the log is in order.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, TypeAlias

from service.sessions.log import EventLog, LogEvent
from service.sessions.messages import changed_message, tick_message
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.part import SessionPart
from service.sessions.scheduler.background_task import BackgroundTask
from service.sessions.scheduler.tick_batch import TickBatch
from service.sessions.subscribers import Subscribers
from service.sessions.utterance import ReachabilityNotice
from sim.events import Event
from sim.session.edits import Applied, Change
from sim.state import SimState, StepResult

if TYPE_CHECKING:
    from service.sessions.session import Session

CHANGED = "changed"
"""Type of the line that says what an utterance did."""

Told: TypeAlias = list[tuple[Event, str]]
"""Events of one tick or action, each in words."""


class EventFeed(SessionPart):
    """Writes a session's events to its log and publishes them. For the event loop's thread only."""

    def __init__(self, session: Session, log_capacity: int) -> None:
        """`log_capacity`: how many lines the log holds."""
        super().__init__(session)
        self.log = EventLog(log_capacity)
        self.subscribers = Subscribers()
        self.tick_batch = TickBatch(self.subscribers)
        self._narration: BackgroundTask[Told] = BackgroundTask(self._publish_late)

    @property
    def narrating(self) -> bool:
        """Whether events are being put into words in a thread."""
        return self._narration.busy

    def wait_for_narration(self) -> None:
        """Write and publish the events that are being put into words; blocks until they are."""
        self._narration.finish()

    def narrate_in_thread(self, run: SimState, part: Applied | StepResult) -> None:
        """Put events into words in a thread, then write and publish them."""
        narrator = self._session.narrator
        self._narration.start(lambda: _narrate(narrator, run, part))

    def log_events(self, run: SimState, part: Applied | StepResult) -> list[LogEvent]:
        """Write the events of a tick or an action to the log; returns the lines."""
        self._narration.finish()
        return self.write(_narrate(self._session.narrator, run, part)) if part.events else []

    def write(self, narrated: Told) -> list[LogEvent]:
        """Write events that are in words already to the log; returns the lines."""
        return [self.log.add(event.tick, event.type, text, event.ids, event.cell) for event, text in narrated]

    def log_reachability(self, notice: ReachabilityNotice) -> LogEvent:
        """Write whether the vehicle can still arrive; the line is transient: it follows from the state."""
        self._narration.finish()
        event = notice.event
        return self.log.add(event.tick, event.type, notice.text, event.ids, transient=True)

    def changes(self) -> tuple[LogEvent, ...]:
        """The lines of what was done that the log still holds, the latest last."""
        self._narration.finish()
        return tuple(line for line in self.log.latest(self.log.capacity) if line.type == CHANGED)

    def log_line(self, tick: int, kind: str, text: str, *, transient: bool = True) -> LogEvent:
        """Write a line; one that is `transient` is not there after a restart."""
        self._narration.finish()
        return self.log.add(tick, kind, text, transient=transient)

    def present(self) -> SimState:
        """The present state of the simulation."""
        return self._session.run

    def announce_reachability(self, event: Event) -> None:
        """Write and publish what was found out about a road that began by itself."""
        session = self._session
        if not session.closed:
            text = session.narrator.event(event, session.run)
            line = self.log_reachability(ReachabilityNotice(event, text, session.run))
            self.publish_change(None, line.text, (), [line])

    def publish_tick(self, before: SimState, tick: StepResult, lines: Sequence[LogEvent]) -> None:
        """Publish a tick; `before` is the state that it began in."""
        session = self._session

        def message() -> bytes:
            decision = tick.decision
            taken, narrator = tick.of(), session.narrator
            narration = None if taken is None else narrator.decision(taken.decision, before, taken.forecast)
            return tick_message(
                session.sequence, lambda: session.status, before, tick.state, decision, narration, lines
            )

        self.tick_batch.publish_tick(tick.state.world.tick, message)

    def publish_change(
        self,
        text: str | None,
        reply: str,
        changes: Sequence[Change],
        lines: Sequence[LogEvent],
        views: Mapping[str, bool] | None = None,
    ) -> None:
        """Publish a change, whoever made it, after all ticks that are not published yet."""
        session = self._session

        def message() -> bytes:
            return changed_message(session.status, session.run, text, reply, changes, lines, views)

        self.tick_batch.publish_now(session.timeline.tick, message)

    def _publish_late(self, narrated: Told) -> None:
        with suppress(ReferenceError):  # nobody has the session any more
            lines = self.write(narrated)
            self.publish_change(None, lines[-1].text, (), lines)


def narrate_parts(
    narrator: NarratorProtocol, parts: Sequence[tuple[SimState, Applied | StepResult]]
) -> list[Told]:
    """The events of each part in words, as `EventFeed.write` takes them; also for other threads."""
    return [_narrate(narrator, run, part) for run, part in parts]


def _narrate(narrator: NarratorProtocol, run: SimState, part: Applied | StepResult) -> Told:
    return [(event, narrator.event(event, run)) for event in part.events]
