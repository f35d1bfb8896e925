"""What is done at the next thing of a kind: a run up to its row beside the same run without it.

Both are driven by the planner, with the same draws. The first move that differs is made because of the thing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sim.explain.episode_rollout import EpisodeRollout, drive
from sim.explain.foresight import driving, running_state
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Move


@dataclass(frozen=True, slots=True)
class NextOfKind:
    """The next thing ahead of a kind, in facts."""

    state: SimState
    kind: Kind
    id: str | None
    """the nearest of them in the rows ahead; None where there is none"""
    story: EpisodeRollout
    """the run"""
    after: int | None
    """ticks until the ego is in its row; None where the run ends before"""
    differs: int | None
    """ticks until the first move that is another one without the thing; None where all up to its row are the
    same"""
    otherwise: Move | None
    """that other move"""
    chance: bool
    """whether how others react is left to chance, so that the run is one of many"""

    @property
    def move(self) -> Move | None:
        """The first move that is made for the thing."""
        return None if self.differs is None else self.story.path[self.differs]

    @property
    def hit(self) -> bool:
        """Whether the run ends in it."""
        return self.story.cause is not None and self.id in self.story.cause.ids


def next_of_kind(timeline: Timeline, kind: Kind) -> NextOfKind:
    """What the first ego does at the next thing of a kind. Raises `QuestionError`."""
    state = driving(running_state(timeline, None))
    world, story = state.world, drive(state).story
    if story.silent is not None and not story.path:
        raise QuestionError("no_answer", planner=state.config_of(None).planner, fault=story.silent)
    column, row = world.road.cell(world.av)
    ahead = [each for each in world.things() if each.kind is kind and each.cell[1] < row]
    chance = not state.config.certain
    if not ahead:
        return NextOfKind(state, kind, None, story, None, None, None, chance)
    thing = max(ahead, key=lambda each: (each.cell[1], -abs(each.cell[0] - column), each.id))
    after = _reached(story.path, row - thing.cell[1])
    other = drive(replace(state, world=world.without(frozenset((thing.id,))))).story.path
    differs = next(
        (at for at, both in enumerate(zip(story.path, other, strict=False)) if len({*both}) > 1), None
    )
    if differs is None or (after is not None and differs >= after):
        return NextOfKind(state, kind, thing.id, story, after, None, None, chance)
    return NextOfKind(state, kind, thing.id, story, after, differs, other[differs], chance)


def _reached(path: tuple[Move, ...], rows: int) -> int | None:
    """The ticks after which so many rows are left behind."""
    for ticks, move in enumerate(path, 1):
        rows += move.offset[1]
        if rows <= 0:
            return ticks
    return None
