"""How it goes on from a moment if the planner drives and nothing is said: run to the end, with its chance.

Where it is left to chance how others react, the run is one future of many, and the chances come from the same
futures as confidence (`sim.explain.chances`).
"""

from __future__ import annotations

from dataclasses import dataclass

from sim.explain.chances import Chances, chances
from sim.explain.episode_rollout import EpisodeRollout, story, summarize
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Outcome


@dataclass(frozen=True, slots=True)
class Foresight:
    """What comes of a moment."""

    state: SimState
    story: EpisodeRollout
    chances: Chances | None
    """None where nothing is left to chance: the story is what comes"""

    @property
    def arrives(self) -> float:
        """The share of futures in which the ego arrives."""
        return self._share(Outcome.SUCCESS) if self.chances is None else self.chances.arrives

    @property
    def crashes(self) -> float:
        """The share of futures in which it crashes."""
        return self._share(Outcome.CRASH) if self.chances is None else self.chances.crashes

    @property
    def by_chance(self) -> bool:
        """Whether it hangs on chance how or when it ends."""
        return self.chances is not None and not self.chances.settled

    @property
    def told(self) -> bool:
        """Whether the run came to an end, rather than being too long or without an answer of the planner."""
        return self.story.outcome is not Outcome.RUNNING

    def _share(self, outcome: Outcome) -> float:
        return float(self.story.outcome is outcome)


def foresee(state: SimState, ego: str | None = None, *, seen: bool = True) -> Foresight:
    """What comes of a state where an ego (the first by default) drives by itself; an end is told as it is.

    `seen`: whether the ego sees who reacts in the coming tick.
    """
    driven = driving(state, ego)
    if state.world.outcome is not Outcome.RUNNING:
        return Foresight(driven, summarize(driven, [], ego=ego), None)
    told = story(driven, ego=ego)
    return Foresight(driven, told, chances(driven, ego, seen=seen, part=1))


def driving(state: SimState, ego: str | None = None) -> SimState:
    """The state with an ego that drives by itself, whatever a person has asked of it."""
    return state.with_ego(ego, mode=Mode.AUTO, queue=())


def running_state(timeline: Timeline, ego: str | None = None) -> SimState:
    """The present state. Raises `QuestionError`: `nothing_ahead` where the episode has ended."""
    state = timeline.state
    if ego is not None and ego not in state.egos:
        raise QuestionError("no_such_ego", id=ego)
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("nothing_ahead", outcome=state.world.outcome, tick=state.world.tick)
    return state
