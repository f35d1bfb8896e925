"""What other planners would do from a moment on, each of them run to the end of the episode."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from sim.explain.episode_rollout import decided, rollout
from sim.explain.foresight import Foresight, driving, foresee, running_state
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.plan import Decision, planner_named
from sim.planner_names import BUILT_IN, canonical
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome


@dataclass(frozen=True, slots=True)
class PlannerDrive:
    """A planner from a moment on."""

    planner: str
    foresight: Foresight

    @property
    def first(self) -> Move | None:
        """Its first move; None where it did not answer."""
        path = self.foresight.story.path
        return path[0] if path else None


@dataclass(frozen=True, slots=True)
class Parting:
    """The first tick in which two planners decide otherwise, and both decisions about that one situation."""

    tick: int
    own: Decision
    other: Decision


@dataclass(frozen=True, slots=True)
class PlannersHere:
    """Planners from one moment on, beside the one that drives."""

    state: SimState
    own: PlannerDrive
    others: tuple[PlannerDrive, ...]
    missing: tuple[str, ...]
    """those asked about that there are not"""
    ego: str | None = None
    """the one that is driven; None: the first"""

    def parting(self, other: PlannerDrive) -> int | None:
        """Moves that are the same before it is driven differently for the first time; None if never."""
        mine, theirs = self.own.foresight.story.path, other.foresight.story.path
        for ahead, (one, another) in enumerate(zip(mine, theirs, strict=False)):
            if one is not another:
                return ahead
        return None if len(mine) == len(theirs) else min(len(mine), len(theirs))

    def decided(self, other: PlannerDrive) -> Parting | None:
        """What both decide where they part, by driving there again; None where they never do."""
        ahead = self.parting(other)
        if ahead is None:
            return None
        one, another = (_decision_at(each.foresight.state, ahead, self.ego) for each in (self.own, other))
        return None if one is None or another is None else Parting(one.tick, one, another)

    @property
    def ranked(self) -> tuple[PlannerDrive, ...]:
        """All of them, the best first: by the chance to arrive, that of no crash, and the ticks it takes."""
        return tuple(sorted((self.own, *self.others), key=_rank))

    @property
    def best(self) -> tuple[PlannerDrive, ...]:
        """Those that nobody is better than."""
        ranked = self.ranked
        return tuple(each for each in ranked if _rank(each) == _rank(ranked[0]))


def planners_here(
    timeline: Timeline,
    names: Sequence[str] | None = None,
    *,
    tick: int | None = None,
    ego: str | None = None,
) -> PlannersHere:
    """What these planners would do from now or from a tick on; by default all that come with the project.

    Raises `QuestionError`.
    """
    state = running_state(timeline, ego) if tick is None else state_at(timeline, tick)
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("nothing_ahead", outcome=state.world.outcome, tick=state.world.tick)
    state = driving(state, ego)
    own = planner_of(state, ego)
    asked = [canonical(name) for name in names] if names else others_than(state, ego)
    missing = tuple(name for name in asked if name != own and planner_named(name) is None)
    found = [name for name in dict.fromkeys(asked) if name not in (own, *missing)]
    mine = PlannerDrive(own, foresee(state, ego))
    return PlannersHere(state, mine, tuple(drive_each(state, found, ego)), missing, ego)


def planners_beside(timeline: Timeline, names: Sequence[str], *, ego: str | None = None) -> PlannersHere:
    """Two planners from the beginning of this drive on; one alone is beside the one that drives.

    Raises `QuestionError`: `not_two_planners` where they are not two that there are.
    """
    start = driving(timeline.at(timeline.state.world.episode_start), ego)
    asked = list(dict.fromkeys(str(canonical(name)) for name in names))
    if len(asked) == 1:
        asked = [planner_of(start, ego), *(name for name in asked if name != planner_of(start, ego))]
    missing = [name for name in asked if planner_named(name) is None]
    if missing or len(asked) != 2:
        raise QuestionError("not_two_planners")
    one, other = drive_each(start, asked, ego)
    return PlannersHere(one.foresight.state, one, (other,), (), ego)


def planner_of(state: SimState, ego: str | None = None) -> str:
    """The name of the planner that drives an ego."""
    return str(canonical(state.config_of(ego).planner))


def others_than(state: SimState, ego: str | None = None) -> list[str]:
    """The planners of the project beside the one that drives an ego."""
    return [name for name in BUILT_IN if name != planner_of(state, ego)]


def drive_each(state: SimState, names: Iterable[str], ego: str | None = None) -> Iterator[PlannerDrive]:
    """How it goes on from a state with each of these planners."""
    for name in names:
        yield PlannerDrive(name, foresee(driving(state, ego).with_ego(ego, planner=name), ego))


def _decision_at(state: SimState, ahead: int, ego: str | None) -> Decision | None:
    """The decision of an ego after so many others of its own; None where it drives no longer."""
    found = (each for _, tick in rollout(state, ego=ego) if (each := decided(tick, ego)) is not None)
    return next(islice(found, ahead, None), None)


def _rank(drive: PlannerDrive) -> tuple[float, float, int]:
    seen = drive.foresight
    return -seen.arrives, seen.crashes, seen.story.driven
