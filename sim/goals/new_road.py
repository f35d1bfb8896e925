"""Looks for a new road: one that surprises, one that is hard, one that tells two planners apart.

Candidates are scenarios of a family, with a seed where many roads of one family are drawn. Every one that is
kept can be driven, which is proved; what is said of planners was driven.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeVar, get_args

from sim.actions import GoalName, Layout, RoadType, Scenario, Set, Traffic, WorldAction
from sim.config import Problem
from sim.goals.budget import Budget
from sim.goals.finding import Finding
from sim.goals.measure import Difficulty, Drive, drive, measure
from sim.goals.more_or_less import present_drives
from sim.plan import traits_of
from sim.planner_names import BUILT_IN, PROMISED, PlannerName
from sim.randomness import Stream
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.world.layouts import has_barriers

SURPRISES: Final = 6
"""Roads that are drawn for a surprise."""

HARD_ROADS: Final = 24
"""Roads that are drawn for a hard one."""

SEPARATING_ROADS: Final = 300
"""Roads that are drawn at most to tell two planners apart."""

LARGEST_SEED: Final = 99_999
"""Seeds are drawn from 1 up to this, so that they can be said."""

_LAYOUTS: Final[tuple[Layout, ...]] = get_args(Layout)
_ROADS: Final[tuple[RoadType, ...]] = get_args(RoadType)
_TRAFFIC: Final[tuple[Traffic, ...]] = ("light", "normal", "heavy")
_DIVIDING: Final[tuple[Layout | None, ...]] = (None, *_LAYOUTS, "crossing", "crossing", "crossing")
"""Families that roads which divide planners are drawn from: crossing traffic does so most often."""
_MOST_EXTRA: Final = 6
"""Largest number of potholes or pedestrians that a surprise names."""

Item = TypeVar("Item")


def find_surprise(state: SimState, budget: Budget) -> Finding | None:
    """A new road of another kind; of those drawn, the one that leads the present planner furthest round."""
    stream = _stream(state, "surprise")
    best: tuple[tuple[bool, int], Finding] | None = None
    for number in range(SURPRISES):
        begun = _begin(state, _surprise(state, stream.narrow(number)))
        level = None if begun is None else measure(begun[1], budget)
        if begun is None or level is None:
            continue
        drives = present_drives(begun[1], budget)
        rank = all(each.arrives for each in drives), max((each.ticks for each in drives), default=0)
        if best is None or rank > best[0]:
            best = rank, Finding("surprise", *begun, level, drives=drives)
    return None if best is None else best[1]


def find_hard_road(state: SimState, budget: Budget) -> Finding | None:
    """A new road with a way to the goal on which a planner of ours fails, and the way is no straight one.

    Of those drawn, the one on which most of the quick planners fail, then the one of most ticks.
    """
    stream = _stream(state, "hard_but_solvable")
    quick = [name for name in BUILT_IN if traits_of(name).quick]
    best: tuple[tuple[int, int], tuple[WorldAction, ...], SimState, Difficulty] | None = None
    for number in range(HARD_ROADS):
        begun = _begin(state, _seeded(state, _LAYOUTS, "heavy", stream.narrow(number)))
        level = None if begun is None else measure(begun[1], budget)
        if begun is None or level is None or level.ticks < begun[1].world.road.rows:
            continue
        failed = sum(not drive(begun[1], name, budget).arrives for name in quick)
        if failed and (best is None or (failed, level.ticks) > best[0]):
            best = (failed, level.ticks), *begun, level
    if best is None:
        return None
    _, actions, after, level = best
    drives = tuple(drive(after, name, budget) for name in BUILT_IN)
    return Finding("hard_but_solvable", actions, after, level, drives=drives)


def find_separating_road(state: SimState, can: str, cannot: str, budget: Budget) -> Finding | None:
    """A new road that one planner drives to the goal, and another does not. Raises `EditError`."""
    if can == cannot:
        raise EditError("goal_same_planner", "planners")
    for name in (can, cannot):
        if name in PROMISED:
            problem = Problem("planner", "planner_not_available", value=name)
            raise EditError("scenario_not_available", "planners", problem=problem)
    stream = _stream(state, "separates")
    # The quicker of the two first: it rules out most roads.
    order = sorted((can, cannot), key=lambda name: (traits_of(name).work, name != cannot))
    for number in range(SEPARATING_ROADS):
        draws = stream.narrow(number)
        begun = _begin(state, _seeded(state, _DIVIDING, _pick(_TRAFFIC[1:], draws, 4), draws))
        level = None if begun is None else measure(begun[1], budget)
        if begun is None or level is None:
            continue
        drives: dict[str, Drive] = {}
        for name in order:
            drives[name] = drive(begun[1], name, budget)
            if drives[name].arrives is not (name == can) or drives[name].outcome == "running":
                break
        else:
            return Finding("separates", *begun, level, drives=(drives[can], drives[cannot]))
    return None


def _stream(state: SimState, goal: GoalName) -> Stream:
    world = state.world
    return Stream.of(state.config.seed, f"goal {goal}", world.episode, world.tick, state.edits)


def _pick(choices: Sequence[Item], stream: Stream, index: int) -> Item:
    return choices[stream.below(len(choices), index)]


def _surprise(state: SimState, stream: Stream) -> tuple[WorldAction, ...]:
    """A scenario of another layout than the present one, furnished by chance."""
    others = [layout for layout in (None, *_LAYOUTS) if layout != state.config.layout]
    layout = _pick(others, stream, 0)
    scenario = Scenario(
        road=_pick(_ROADS, stream, 1),
        layout=layout,
        traffic=_pick(_TRAFFIC, stream, 2),
        potholes=stream.below(_MOST_EXTRA + 1, 3),
        pedestrians=stream.below(_MOST_EXTRA + 1, 4),
        barriers=None if has_barriers(layout) else stream.below(_MOST_EXTRA + 1, 5),
        planner=_nameable(state),
    )
    return scenario, *_own_planner(state)


def _seeded(
    state: SimState, layouts: Sequence[Layout | None], traffic: Traffic, stream: Stream
) -> tuple[WorldAction, ...]:
    """A scenario of a layout and a seed by chance."""
    scenario = Scenario(layout=_pick(layouts, stream, 0), traffic=traffic, planner=_nameable(state))
    seed = Set(parameter="seed", value=1 + stream.below(LARGEST_SEED, 1))
    return scenario, *_own_planner(state), seed


def _nameable(state: SimState) -> PlannerName | None:
    """The present planner, where a scenario can name it."""
    planner = state.config.planner
    return planner if planner in BUILT_IN and planner not in PROMISED else None  # type: ignore[return-value]


def _own_planner(state: SimState) -> tuple[Set, ...]:
    """The present planner, where a scenario cannot name it."""
    if _nameable(state) is not None:
        return ()
    return (Set(parameter="planner", value=state.config.planner),)


def _begin(
    state: SimState, actions: tuple[WorldAction, ...]
) -> tuple[tuple[WorldAction, ...], SimState] | None:
    """The actions and what they lead to; None where no such road can be drawn."""
    try:
        for action in actions:
            state = apply(state, action).state
    except EditError:
        return None
    return actions, state
