"""When the first ego will next stop or change lanes if its planner drives, by one run to the end."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from sim.explain.episode_rollout import Detour, EpisodeRollout, drive
from sim.explain.foresight import driving, running_state
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import MOVES, Move, Outcome

STOPS = (Move.STAY,)
LANE_CHANGES = tuple(move for move in MOVES if move.offset[0])


@dataclass(frozen=True, slots=True)
class ComingTurn:
    """The next move of a sort."""

    state: SimState
    story: EpisodeRollout
    """the run"""
    after: int | None
    """ticks until it is decided; None where the run has no such move"""
    move: Move | None
    detour: Detour | None
    """whom it is for"""
    count: int
    """how many moves of the sort the run has"""
    chance: bool
    """whether how others react is left to chance, so that the run is one of many"""

    @property
    def known(self) -> bool:
        """Whether that there is none can be said: the run came to an end."""
        return self.after is not None or self.story.outcome is not Outcome.RUNNING


def coming_turn(timeline: Timeline, moves: Collection[Move]) -> ComingTurn:
    """The next move that is one of these. Raises `QuestionError`: `nothing_ahead`, `no_answer`."""
    state = driving(running_state(timeline, None))
    story = drive(state).story
    if story.silent is not None and not story.path:
        raise QuestionError("no_answer", planner=state.config_of(None).planner, fault=story.silent)
    after = next((at for at, move in enumerate(story.path) if move in moves), None)
    move = None if after is None else story.path[after]
    tick = None if after is None else state.world.tick + after
    detour = next((each for each in story.detours if each.tick == tick), None)
    count = sum(each in moves for each in story.path)
    return ComingTurn(state, story, after, move, detour, count, chance=not state.config.certain)
