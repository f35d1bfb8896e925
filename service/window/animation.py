"""What is on screen between two ticks: from where things glide, how far, and what was decided.

The session is at its tick already while the picture glides there; gliding is presentation only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from sim.decide import decide
from sim.plan import Decision
from sim.plan.safe_planning import is_foreign
from sim.state import SimState
from sim.types import Outcome

if TYPE_CHECKING:
    from service.sessions.session import Session

STEP_S: Final = 0.25
"""How long a single step glides while the clock stands still."""


class Showing:
    """The way from the state before to the present one."""

    def __init__(self, session: Session, now_s: float) -> None:
        self._session = session
        self.after: SimState = session.run
        self.before: SimState = session.run
        self.moving: Decision | None = None
        """the decision that leads from `before` to `after`"""
        self._began_s = now_s
        self._lasts_s = 0.0
        self._planned: tuple[SimState, Decision | None] = (self.after, self._decide())

    def follow(self, now_s: float) -> None:
        """See where the session has come to."""
        run, old = self._session.run, self.after
        if run is not old:
            self.after = run
            same_road = run.world.episode_start == old.world.episode_start
            gone = run.world.tick - old.world.tick
            if same_road and gone == 1:
                self._glide(old, now_s)
            elif not same_road or gone:
                self._stand()
        settled = self.phase(now_s) >= 1.0 and self._session.paused
        if settled and self._planned[0] is not self.after and self.after.world.outcome is Outcome.RUNNING:
            self._planned = (self.after, self._decide())

    def phase(self, now_s: float) -> float:
        """The share of the way that is gone, from 0 to 1."""
        if self.before is self.after or self._lasts_s <= 0.0:
            return 1.0
        return min(1.0, max(0.0, (now_s - self._began_s) / self._lasts_s))

    @property
    def planned(self) -> tuple[SimState, Decision | None]:
        """The latest state that was decided in, and the decision; the next one while time stands still."""
        return self._planned

    def _glide(self, old: SimState, now_s: float) -> None:
        pace = self._session.playback_speed
        if self._session.paused:
            self._lasts_s = STEP_S
        else:
            self._lasts_s = 0.0 if pace == "max" else old.config.step_seconds / float(pace)
        self._began_s, self.before = now_s, old
        latest = self._session.latest_decision()
        self.moving = None if latest is None else latest[0]
        if latest is not None:  # while a result stands, what led to it is still to be seen
            self._planned = (latest[1], latest[0])

    def _stand(self) -> None:
        self.before, self.moving = self.after, None
        self._planned = (self.after, self._decide())

    def _decide(self) -> Decision | None:
        if is_foreign(self.after.config.planner) or self.after.world.outcome is not Outcome.RUNNING:
            return None  # a planner of another package is asked only when it is its turn
        return decide(self.after)
