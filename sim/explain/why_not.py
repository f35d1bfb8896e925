"""Why not another move: the smallest change of the road after which that move is made.

A change takes away what was seen, blocks cells beside the vehicle (with a barrier, or where a mover is just
leaving the cell, with a pothole that holds it), or says another wish. Small changes are tried first
(`smallest_change`). Where they run out, larger ones are built: what stands in the move's way is taken away,
and the free moves that come before it are blocked. A change is only stated if the decision, run again with
it, is the move asked about.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress

from sim.actions import Add
from sim.explain.alternatives import stakes
from sim.explain.edit import Edit, Edits
from sim.explain.effort import FOR_CHANGES, RESERVE, Effort, WorkSpentError
from sim.explain.facts import Cause, Counterfactual, Explanation, Role, Verified
from sim.explain.intervention import Intervention, wall
from sim.explain.smallest_change import ChangeSearch, SmallestChange
from sim.explain.why_causes import by_salience, minimal_subset
from sim.plan import Decision, Measure
from sim.state import SimState
from sim.types import Move

MAX_ROUNDS = 8
"""How often clearing a cell may let another thing into it before clearing is given up."""


def explain_why_not(
    state: SimState,
    decision: Decision,
    foil: Move,
    announced: Mapping[str, Move] | None = None,
    effort: Effort = Effort.USUAL,
) -> Explanation:
    """Why `foil` was not the move of `decision` in a state. `announced`: as for `Intervention`."""
    rerun = Intervention(state, decision, announced, effort.of(FOR_CHANGES))
    cleared: list[str] = []
    flips: list[Counterfactual] = []
    found = SmallestChange(None, 0, 0)
    if decision.option(foil).cell is not None and (decision.asked is None or decision.held_back):
        names = [*rerun.factors, *by_salience(rerun.percept, decision)]
        search = ChangeSearch(rerun, foil, names, effort)
        found = search.smallest(_larger(rerun, search, decision, foil))
        rerun.allow(effort.of(RESERVE))
        if found.edits is None:
            with suppress(WorkSpentError):
                cleared = _cleared(rerun, decision, foil)
                flips = [rerun.counterfactual(cleared, rerun.without(cleared))] if cleared else []
        else:
            cleared = [edit.gone for edit in found.edits if edit.gone]
            change, undetected = search.change(found.edits)
            flips = [Counterfactual(change, foil, tuple(cleared), undetected)]
    freed = found.edits is not None and all(edit.gone for edit in found.edits)
    return Explanation(
        about="why_not",
        moment=state,
        decision=decision,
        foil=foil,
        causes=_causes(rerun, foil, cleared, freed),
        verified=_verified(rerun, foil, cleared, freed),
        counterfactuals=tuple(flips),
        stakes=stakes(state, decision, foil),
        reruns=rerun.count,
        searched=found.searched,
        tried=found.tried,
    )


def _larger(rerun: Intervention, search: ChangeSearch, decision: Decision, foil: Move) -> Iterator[Edits]:
    """Larger changes that may lead to the foil, to be cut down."""
    cleared = _cleared(rerun, decision, foil)
    away = tuple(Edit(gone=name) for name in cleared)
    if away:
        yield away
    if _led_to(decision, foil):
        yield tuple(Edit(gone=name) for name in _opened(rerun, foil))
    walls = tuple(Edit(actions=(each,)) for each in _walls(rerun, cleared, foil))
    if walls:
        yield away + walls
    if cleared or decision.option(foil).verdict == "free":
        yield away + tuple(_walled_in(rerun, search, away, foil))


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


def _walls(rerun: Intervention, cleared: Sequence[str], foil: Move) -> list[Add]:
    """What blocks the free moves that come before the foil."""
    seen = rerun.decision_without(cleared) if cleared else rerun.decision
    if seen.asked is not None:
        return []
    world = rerun.state.world.without(frozenset(cleared))
    before = seen.options[: seen.options.index(seen.option(foil))]
    cells = [option.cell for option in before if option.verdict == "free" and option.cell is not None]
    if world.road.cell(rerun.percept.ego) in cells:
        return []  # nothing can be put where the ego stands, so staying cannot be taken away
    return [wall(world, cell) for cell in cells]


def _walled_in(rerun: Intervention, search: ChangeSearch, away: Edits, foil: Move) -> Edits:
    """What blocks the moves made one after the other, until it is the foil or none can be blocked."""
    walls: Edits = ()
    world = rerun.state.world.without(frozenset(edit.gone for edit in away))
    for _ in Move:
        made = search.made(away + walls)
        cell = None if made is None else rerun.decision.option(made).cell
        if made in (None, foil, Move.STAY) or cell is None:
            break
        walls += (Edit(actions=(wall(world, cell),)),)
    return walls


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
    rerun.allow(len(cleared) * RESERVE)
    spare = any(rerun.without([other for other in cleared if other != name]) is foil for name in cleared)
    return Verified(necessary=not spare, sufficient=True, minimal=not spare)
