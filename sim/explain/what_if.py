"""What if: a fork in which something is otherwise, and the real run, both driven to the end.

Both are told as if nothing more were said. Where a tick in the past is asked about, what has been said
since then is left out of both, so that they differ in the change and in nothing else.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass

from sim.actions import Add, Adjust, Prefer, Remove, Scenario, Set, SetCount, SetMode, WorldAction
from sim.decide import announced_before, decide_on, sense
from sim.explain.chances import Chances, chances
from sim.explain.episode_rollout import Drive, EpisodeRollout, drive
from sim.explain.facts import check_ego
from sim.explain.moments import state_at
from sim.oracle.lower_bounds import PATIENCE
from sim.oracle.regret import Regret, regret
from sim.search.reactive import ImpatientError
from sim.session.edits import ON_THE_NEXT_ROAD, Applied, apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome


@dataclass(frozen=True, slots=True)
class Difference:
    """The first moment at which the two are driven differently, and how."""

    tick: int
    """of the real run"""
    ahead: int
    """moves that are the same before it"""
    real: Move
    changed: Move


@dataclass(frozen=True, slots=True)
class WhatIf:
    """The answer to what if, in facts."""

    state: SimState
    """the moment at which it is changed"""
    done: tuple[Applied, ...]
    """what the change has done, an entry for each action"""
    real: EpisodeRollout
    changed: EpisodeRollout
    same_road: bool
    """whether both go on along the same road, so that moves can be compared"""
    first_difference: Difference | None
    regret: Regret | None
    """what the real move costs at that moment on the real road, against the best that could be done there;
    None also where that is not known within `sim.oracle.lower_bounds.PATIENCE`"""
    certain: bool
    """whether the regret is exact: nothing is left to who gives way"""
    said_since: int
    """how many actions said after the moment are left out"""
    over: bool
    """whether the drive has ended since the moment"""
    real_chances: Chances | None = None
    """the chances as it is, where how others react is left to chance: `real` is then one future of many"""
    changed_chances: Chances | None = None
    """the same after the change"""

    @property
    def by_chance(self) -> bool:
        """Whether it hangs on chance how one of the two ends."""
        both = self.real_chances, self.changed_chances
        return None not in both and any(each is not None and not each.settled for each in both)

    @property
    def no_effect(self) -> bool:
        """Whether the change changes nothing at all."""
        return all(
            not (each.changes or each.added or each.removed or each.moved or each.events)
            for each in self.done
        )


def moment_of(timeline: Timeline, change: Sequence[WorldAction]) -> int | None:
    """The tick from which a change is looked at that no tick was named for; None for now.

    A drive that has ended is looked at again: how it is set and what is on its road from its beginning, or
    from where something was last said; things at a place, and moves, where the last decision was made.
    """
    world = timeline.state.world
    if world.ended is None or world.ended <= world.episode_start:
        return None
    last = world.ended - 1
    if any(_hangs_on_the_place(action) for action in change):
        return last
    said = [entry.tick for entry in timeline.entries if entry.tick <= last]
    return max([world.episode_start, *said])


def _hangs_on_the_place(action: WorldAction) -> bool:
    """Whether what an action does depends on where the ego is."""
    match action:
        case Remove(count=count, where=where, except_=but):
            return count != "all" or where is not None or but is not None
        case Add(where=where):
            return where is not None
        case Set() | Adjust() | SetCount() | Scenario() | SetMode() | Prefer():
            return False
    return True


def what_if(
    timeline: Timeline,
    change: Sequence[WorldAction],
    tick: int | None = None,
    undetected: Collection[str] = (),
    *,
    ego: str | None = None,
) -> WhatIf:
    """What would come of the session were this done now, or had it been done at a tick.

    It is told of an ego, the first by default. `undetected`: ids that are taken out of what it sees at that
    tick, and stay on the road.
    Raises `QuestionError` for a tick that never was, and `EditError` for what cannot be done.
    The timeline is left as it is.
    """
    check_ego(timeline.state, ego)
    state = state_at(timeline, tick)
    done, changed = [], state
    for action in change:
        applied = apply(changed, action)
        changed = applied.state
        done.append(applied)
    first = None
    if undetected and changed.world.outcome is Outcome.RUNNING:
        percept = sense(changed, announced_before(changed, ego), ego)[0]
        first = decide_on(changed, percept.without(undetected), ego)
    real, other = drive(state, ego=ego), drive(changed, first, ego=ego)
    same_road = not _new_road(done)
    difference = _first_difference(real, other) if same_road else None
    lost, certain = None, state.config.certain
    if difference is not None:
        with suppress(ImpatientError):
            lost = regret(real.at(difference.tick), difference.real, PATIENCE, ego=ego)
    since = state.world.tick
    said_since = 0 if tick is None else sum(entry.tick > since for entry in timeline.entries)
    likely: tuple[Chances | None, Chances | None] = (None, None)
    if state.world.outcome is changed.world.outcome is Outcome.RUNNING and first is None:
        known = state.config.certain and changed.config.certain
        likely = (
            chances(state, ego, seen=True, even_certain=not known),
            chances(changed, ego, seen=True, even_certain=not known),
        )
    over = tick is not None and timeline.state.world.ended is not None
    return WhatIf(
        state,
        tuple(done),
        real.story,
        other.story,
        same_road,
        difference,
        lost,
        certain,
        said_since,
        over,
        *likely,
    )


def _new_road(done: Sequence[Applied]) -> bool:
    """Whether the change itself begins a road, rather than touching the one there is or is next."""
    return any(each.events and not isinstance(each.action, ON_THE_NEXT_ROAD) for each in done)


def _first_difference(real: Drive, changed: Drive) -> Difference | None:
    """The first of the decisions, one by one from the moment on, in which the moves are not the same."""
    for ahead, ((tick, one), (_, other)) in enumerate(zip(real.moves(), changed.moves(), strict=False)):
        if one is not other:
            return Difference(tick, ahead, one, other)
    return None
