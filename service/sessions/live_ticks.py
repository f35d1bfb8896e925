"""The ticks of a live session: what happens when its clock says that one is due.

A tick is decided on the event loop where that is quick, by the live lane where it is dear, and by the process
of its own that a planner of another package has. While a change is under way the session does not tick; a
tick that becomes due meanwhile is run afterwards.
"""

from __future__ import annotations

import asyncio
from collections.abc import Hashable, Mapping
from typing import TYPE_CHECKING

import structlog

from service.sessions.latest_decision import LatestDecision
from service.sessions.part import SessionPart
from service.sessions.scheduler.external_planner import ExternalPlanner
from service.sessions.scheduler.live_decision import LiveDecision, deciding_parts, is_dear_to_decide
from service.sessions.scheduler.playback_speed import is_accelerated, ticks_of_turn
from service.sessions.utterance import Utterance
from sim.actions import SetMode
from sim.explain.summary import long_to_tell
from sim.fast_replace import fast_constructor
from sim.plan import Decision
from sim.plan.safe_planning import is_foreign
from sim.session.timeline import PlannerSilentError
from sim.session.triggers import pauses
from sim.state import SimState, StepResult
from sim.types import Mode

if TYPE_CHECKING:
    from service.sessions.session import Session

_LOG = structlog.get_logger(__name__)

_latest = fast_constructor(LatestDecision, "key", "state", "decision")


class LiveTicks(SessionPart):
    """Ticks of one session. All methods are for the event loop's thread."""

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        self._external_planner = ExternalPlanner(self._on_decision)
        self._live_decision = LiveDecision(
            session.services.work.live, self._on_decision, self._on_no_decision
        )
        self._held = False
        self._due = False
        self._decided_here: Hashable = None
        """the `deciding_parts` for which it is known that every decision is taken on the event loop"""

    @property
    def held(self) -> bool:
        """Whether the session does not tick, since a change is under way."""
        return self._held

    def hold(self) -> None:
        """Run no tick until `let_go`."""
        self._held = True

    def let_go(self) -> None:
        """Tick again, at once where a tick has become due."""
        self._held = False
        if self._due:
            self._due = False
            if not self._session.paused:
                self.run()

    def cancel(self) -> None:
        """Drop the decision that is awaited."""
        self._live_decision.cancel()

    def run(self) -> None:
        """Run one turn of the clock: one tick, or several at high speed."""
        if self._held:
            self._due = True
            return
        session = self._session
        for _ in ticks_of_turn(session.playback_speed, session.run.config.step_seconds):
            # In real time the words of an ending are done by the next tick; in a hurry they are waited for.
            if (
                self._held
                or session.paused
                or (session.feed.narrating and is_accelerated(session.playback_speed))
            ):
                return
            if self._decided_elsewhere(session.run):
                return
            self._tick_once()

    def _decided_elsewhere(self, run: SimState) -> bool:
        """Whether the next decision is taken, or awaited, elsewhere; nobody waits for it here."""
        decided_by = deciding_parts(run)
        if decided_by is not None and decided_by == self._decided_here:
            return False
        self._decided_here = None
        if self._external_planner.busy or self._external_planner.ask(run):
            return True
        if self._live_decision.busy:
            self._say_slowed()
            return True
        if self._live_decision.ask(run):
            return True
        if decided_by is not None and not is_foreign(run.config.planner) and not is_dear_to_decide(run):
            self._decided_here = decided_by
        return False

    def fail(self, error: Exception) -> None:
        """Pause and log a defect of the rules, rather than fail twice a second."""
        session = self._session
        _LOG.error("session paused after a failed tick", session=session.id, error=repr(error))
        session.paused = True
        line = session.feed.log_line(session.timeline.tick, "failed", session.narrator.failed())
        session.feed.publish_change(None, line.text, (), [line])

    def _say_slowed(self) -> None:
        """Say once that time runs slower than it should, since decisions take longer than a tick."""
        decision, session = self._live_decision, self._session
        if not decision.slowed:
            decision.slowed = True
            line = session.feed.log_line(session.timeline.tick, "slowed", session.narrator.slowed())
            session.feed.publish_change(None, line.text, (), [line])

    def _awaits(self, run: SimState) -> bool:
        """Whether a decision about a state is still wanted; it is asked anew when its turn comes."""
        session = self._whole()
        if session is None or session.closed or self._held or session.paused:
            return False
        return session.run is run

    def _on_no_decision(self, run: SimState, fault: str) -> None:
        """Switch to manual driving where the session's own planner did not answer in time."""
        if self._awaits(run):
            self._start_manual_override(PlannerSilentError(run.config.planner, fault))

    def _on_decision(self, run: SimState, decision: Decision | Mapping[str, Decision]) -> None:
        """Tick with the decision of an external planner, or with its fallback."""
        if not self._awaits(run):
            return
        try:
            self._tick_once(decision)
        except Exception as error:
            self._session.services.clock.remove(self._session)
            self.fail(error)

    def _tick_once(self, decided: Decision | Mapping[str, Decision] | None = None) -> None:
        session = self._session
        before = session.run
        try:
            tick = session.timeline.advance(decided)
        except PlannerSilentError as silence:
            self._start_manual_override(silence)
            return
        session.latest = _latest((session.sequence, tick.state.world.tick), before, tick.decision)
        if tick.events and long_to_tell(tick.state):
            session.feed.narrate_in_thread(tick.state, tick)
            session.feed.publish_tick(before, tick, ())
        else:
            session.feed.publish_tick(before, tick, session.feed.log_events(tick.state, tick))
            if tick.events and pauses(tick.events):
                self._pause_by_rule(tick)
        if tick.events and tick.state.world.episode_tick == 0:
            session.reachability.start_road(tick.state)

    def _pause_by_rule(self, tick: StepResult) -> None:
        """Stop the clock since a rule says so; the log has a line of it already."""
        session = self._session
        session.set_paused(True)
        text = " ".join(
            session.narrator.event(event, tick.state) for event in tick.events if pauses((event,))
        )
        session.feed.publish_change(None, text, (), ())

    def _start_manual_override(self, silence: PlannerSilentError) -> None:
        """Switch to manual driving, by a stored change: a replay does not ask that planner again."""
        session = self._session
        self.hold()  # no tick until it is done
        text = session.narrator.planner_timeout(silence.planner, silence.fault)
        task = asyncio.ensure_future(self._switch_to_manual(text))
        session.tasks.add(task)
        task.add_done_callback(session.tasks.discard)

    async def _switch_to_manual(self, text: str) -> None:
        session = self._session
        await session.changes.perform(Utterance(actions=(SetMode(mode=Mode.MANUAL),)), dry_run=False)
        line = session.feed.log_line(session.timeline.tick, "event", text)
        session.feed.publish_change(None, text, (), [line])
