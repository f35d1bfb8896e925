"""Why not another move: the smallest change of the road after which that move is made.

First by taking away what was seen to stand in its way; if it is not made even then, because a move that comes
before it is free, by blocking those moves' cells as well: with a barrier, or where a mover is just
leaving the cell, with a pothole that holds it. A change is only stated if
the decision, run again with it, is the move asked about.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import get_args

from sim.actions import Add, Prefer, Wish, WorldAction
from sim.explain.alternatives import stakes
from sim.explain.facts import Cause, Counterfactual, Explanation, Role, Verified
from sim.explain.intervention import Intervention, wall
from sim.explain.why_causes import by_salience, minimal_subset
from sim.oracle.ddmin import ddmin
from sim.plan import Decision, Measure
from sim.session.errors import EditError
from sim.state import SimState
from sim.types import Move

MAX_ROUNDS = 8
"""How often clearing a cell may let another thing into it before clearing is given up."""


def explain_why_not(
    state: SimState, decision: Decision, foil: Move, announced: Mapping[str, Move] | None = None
) -> Explanation:
    """Why `foil` was not the move of `decision` in a state. `announced`: as for `Intervention`."""
    rerun = Intervention(state, decision, announced)
    cleared = _cleared(rerun, decision, foil)
    freed = rerun.without(cleared) is foil
    if freed:
        cleared = ddmin(cleared, lambda names: rerun.without(names) is foil)
    if not freed and _led_to(decision, foil) and (opened := _opened(rerun, foil)):
        cleared, freed = opened, True
    wished = [] if freed else _wished(rerun, cleared, foil)
    walls = [] if freed or wished else _walls(rerun, cleared, foil)
    counterfactuals = []
    if walls or wished:
        change, phantoms = (*rerun.removal(cleared), *wished, *walls), rerun.phantoms(cleared)
        counterfactuals.append(Counterfactual(change, foil, tuple(cleared), phantoms))
    elif cleared:
        counterfactuals.append(rerun.counterfactual(cleared, rerun.without(cleared)))
    elif freed:
        counterfactuals.append(Counterfactual((), foil))
    causes = _causes(rerun, foil, cleared, freed)
    return Explanation(
        about="why_not",
        moment=state,
        decision=decision,
        foil=foil,
        causes=causes,
        verified=_verified(rerun, foil, cleared, freed),
        counterfactuals=tuple(counterfactuals),
        stakes=stakes(state, decision, foil),
        reruns=rerun.count,
    )


def _cleared(rerun: Intervention, decision: Decision, foil: Move) -> list[str]:
    """The things to take away until the foil's cell will be free."""
    cleared: list[str] = []
    seen = decision
    for _ in range(MAX_ROUNDS):
        blockers = [name for name in seen.option(foil).causes if name not in cleared]
        if not blockers:
            break
        cleared += blockers
        seen = rerun.decision_without(cleared)
    return cleared


def _led_to(decision: Decision, foil: Move) -> bool:
    """Whether it may hang on where the foil leads, and not only on what is in its way."""
    by_rank = decision.measure is Measure.RANK and decision.asked is None
    return by_rank and (foil is Move.FORWARD or decision.option(foil).verdict == "free")


def _opened(rerun: Intervention, foil: Move) -> list[str]:
    """The things to take away, the nearest first, until a foil whose cell is free is the move made."""
    names = by_salience(rerun.percept, rerun.decision)
    return (
        minimal_subset(names, lambda gone: rerun.without(gone) is foil)
        if rerun.without(names) is foil
        else []
    )


def _wished(rerun: Intervention, cleared: Sequence[str], foil: Move) -> list[WorldAction]:
    """The one other wish with which a planner that weighs costs makes the foil, if there is one."""
    if rerun.decision.measure is not Measure.COST:
        return []
    away, phantoms = rerun.removal(cleared), rerun.phantoms(cleared)
    for wish in get_args(Wish):
        change = Prefer(preference=wish)
        if rerun.after((*away, change), phantoms) is foil:
            return [change]
    return []


def _walls(rerun: Intervention, cleared: Sequence[str], foil: Move) -> list[Add]:
    """What blocks the free moves that come before the foil, if with it the foil is the move taken."""
    seen = rerun.decision_without(cleared)
    if seen.option(foil).cell is None or seen.asked is not None:
        return []
    world = rerun.state.world.without(frozenset(cleared))
    away, phantoms = rerun.removal(cleared), rerun.phantoms(cleared)
    before = seen.options[: seen.options.index(seen.option(foil))]
    cells = [option.cell for option in before if option.verdict == "free" and option.cell is not None]
    if world.road.cell(rerun.percept.ego) in cells:
        return []  # nothing can be put where the ego stands, so staying cannot be taken away
    walls = [wall(world, cell) for cell in cells]
    try:
        return walls if walls and rerun.after((*away, *walls), phantoms) is foil else []
    except EditError:  # something is there that was not seen
        return []


def _causes(rerun: Intervention, foil: Move, cleared: Sequence[str], freed: bool) -> tuple[Cause, ...]:
    direct = rerun.decision.option(foil).causes
    causes = []
    for name in cleared:
        found = rerun.seen(name)
        if found is not None:
            thing, real = found
            role = Role.BLOCKS if name in direct else Role.FOLLOWS if direct else Role.DRIVES
            moves = (foil,) if name in direct else ()
            alone = freed and len(cleared) == 1
            group = tuple(cleared)
            causes.append(Cause(name, thing.kind, thing.cell, role, moves, alone, group, real=real))
    return tuple(causes)


def _verified(rerun: Intervention, foil: Move, cleared: Sequence[str], freed: bool) -> Verified:
    if not cleared or not freed:
        return Verified(None, None, None)
    spare = any(rerun.without([other for other in cleared if other != name]) is foil for name in cleared)
    return Verified(necessary=not spare, sufficient=True, minimal=not spare)
