"""The causes of a decision: a minimal sufficient set of things and preferences, each tested by removal.

Causes are looked for among what was *seen*: a thing that was not detected has no part in the decision, and
one that was imagined has. A set is *enough* if, with nothing else seen on the road, the move is the same;
the causes are such a set from which nothing can be spared. A cause is *necessary* if taking it away, and
nothing else, changes the move. If a cause is not necessary, the decision is
overdetermined: the search then tries the necessary things first, and if those are not sufficient, it reports
the cause with its group, the things that must be removed together to change the move.

This is the but-for test and its repair for overdetermination as in Halpern & Pearl, "Causes and
explanations: a structural-model approach" (British Journal for the Philosophy of Science, 2005), with
the deterministic world as the model. Sets are found by deletion in shrinking chunks (Zeller &
Hildebrandt, "Simplifying and isolating failure-inducing input", 2002), so no single member can be
spared; whether any smaller part would do is then tried outright.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations
from typing import Protocol

from sim.explain.effort import FOR_CAUSES, RESERVE, Effort, WorkSpentError
from sim.explain.factors import is_factor
from sim.explain.facts import Cause, Counterfactual, Explanation, Role, Verified
from sim.explain.intervention import Intervention, wall
from sim.explain.rest import Rest
from sim.oracle.ddmin import ddmin
from sim.perceive import Percept
from sim.plan import Decision, Option, traits_of
from sim.session.errors import EditError
from sim.session.locate import nearest_to
from sim.state import SimState
from sim.types import Move
from sim.world import Thing

MAX_TRIED = 6
"""Sets up to this size have every part of them tried; a group that is larger is not told."""

MAX_GROUPS = 6
"""Number of causes, not necessary alone, for which the group is searched."""

MOST_PAIRED = 24
"""Of so many things, the most telling, each is tried as the one stand-in of a cause."""


def explain_why(
    state: SimState,
    decision: Decision,
    announced: Mapping[str, Move] | None = None,
    effort: Effort = Effort.USUAL,
) -> Explanation:
    """Why `decision` was taken in a state, by its ego. `announced`: as for `Intervention`."""
    rerun = Intervention(state, decision, announced, effort.of(FOR_CAUSES))
    fact = decision.move
    names = [*rerun.factors, *by_salience(rerun.percept, decision)]
    if decision.held_back:
        hindered = [option for option in decision.options if option.move is decision.asked]
    else:
        hindered = list(decision.preferred)
    rerun.try_without_each(names)
    groups, verified = _sufficient(rerun, fact, names)
    rerun.allow(effort.of(RESERVE))
    rest = Rest.of(rerun, names, _with_straight_on(decision, hindered), groups)
    rerun.allow(effort.of(RESERVE))
    causes = _with_what_the_rest_blocks(rerun, rank_causes(rerun, fact, rerun.seen, hindered, groups))
    also = rank_causes(rerun, fact, rerun.seen, hindered, rest.groups)
    told = dict.fromkeys(cause.group for cause in (*causes, *also) if cause.group)
    flips = [rerun.counterfactual(group, rerun.without(group)) for group in told]
    foil = next((option.move for option in decision.preferred if option.cell is not None), None)
    return Explanation(
        about="why",
        moment=state,
        decision=decision,
        foil=foil,
        causes=causes,
        verified=verified,
        counterfactuals=tuple(flips or _had_it_been_blocked(rerun, decision)),
        stakes=None,
        reruns=rerun.count,
        also=also,
        chain=rest.chain,
        untried=rest.untried,
    )


def _with_straight_on(decision: Decision, hindered: list[Option]) -> list[Option]:
    """The hindered options and straight on, of a planner that goes by where moves lead.

    What is in the way there is told although such a planner may put a way that leads nowhere last.
    """
    straight = decision.option(Move.FORWARD)
    by_itself = decision.asked is None and decision.fault is None
    if not by_itself or straight in (*hindered, decision.chosen):
        return hindered
    return [straight, *hindered] if traits_of(decision.planner).by_passages else hindered


def _sufficient(
    rerun: Intervention, fact: Move, names: list[str]
) -> tuple[dict[str, tuple[str, ...]], Verified]:
    """The groups of a minimal sufficient set; none, and nothing claimed, where the work did not reach."""
    try:
        enough, groups, minimal = minimal_sufficient_set(rerun, fact, names)
        necessary = all(group == (name,) for name, group in groups.items())
        return groups, Verified(necessary, sufficient=rerun.keeping(enough) is fact, minimal=minimal)
    except WorkSpentError:
        return {}, Verified(None, None, None)


def _with_what_the_rest_blocks(rerun: Intervention, causes: tuple[Cause, ...]) -> tuple[Cause, ...]:
    """The causes, and of those with stand-ins whether these would then be in the way themselves."""
    told = []
    for cause in causes:
        if len(cause.group) > 1 and not cause.each_enough:
            met = rerun.decision_without(cause.group[:1]).option(rerun.without(cause.group)).causes
            cause = replace(cause, rest_blocks=not {*cause.group[1:]}.isdisjoint(met))
        told.append(cause)
    return tuple(told)


class Tried(Protocol):
    """An experiment that is rerun without some things, or with only some, and returns its result."""

    def without(self, names: Iterable[str]) -> object:
        """What it comes to without these."""

    def keeping(self, names: Iterable[str]) -> object:
        """What it comes to with nothing but these."""


def minimal_sufficient_set(
    tried: Tried, fact: object, names: list[str]
) -> tuple[list[str], dict[str, tuple[str, ...]], bool]:
    """A minimal subset of `names` that is sufficient for a fact, and the group of each member.

    Also whether every smaller subset was tried. Precondition: all of `names` together produce the fact,
    and the most salient come first.
    """
    enough = minimal_subset(names, lambda kept: tried.keeping(kept) is fact)
    if any(tried.without([name]) is fact for name in enough):  # some have a stand-in
        enough = _of_necessary(tried, fact, names) or enough
    enough, minimal = _smallest(tried, fact, enough)
    return enough, _groups(tried, fact, names, enough), minimal


def _had_it_been_blocked(rerun: Intervention, decision: Decision) -> list[Counterfactual]:
    """For a move without causes: the move that is made if its cell is blocked."""
    if decision.asked is not None or decision.chosen.cell is None or decision.move is Move.STAY:
        return []
    change = (wall(rerun.state.world, decision.chosen.cell),)
    try:
        move = rerun.behind_barriers((), [rerun.state.world.road.index(decision.chosen.cell)])
        return [Counterfactual(change, rerun.after(change) if move is None else move)]
    except (EditError, WorkSpentError):  # something is there that was not seen
        return []


def by_salience(percept: Percept, decision: Decision) -> list[str]:
    """The id of all that is seen: first what stands in the way, by order of preference; then the nearest."""
    direct = [name for option in decision.options for name in option.causes]
    tables = percept.movers, percept.hazards, {other.cell: other.id for other in percept.egos}
    cells = nearest_to(percept.ego, {cell for table in tables for cell in table}, percept.road)
    near = [table[cell] for cell in cells for table in tables if cell in table]
    return list(dict.fromkeys([*direct, *near]))


def _of_necessary(tried: Tried, fact: object, names: list[str]) -> list[str]:
    """A set that is enough and of necessary things alone, or an empty list if there is none."""
    necessary = [name for name in names if tried.without([name]) is not fact]
    if tried.keeping(necessary) is not fact:
        return []
    return ddmin(necessary, lambda kept: tried.keeping(kept) is fact)


def _groups(tried: Tried, fact: object, names: list[str], enough: list[str]) -> dict[str, tuple[str, ...]]:
    """The group of each cause; of the causes that are not necessary, only the first `MAX_GROUPS` get one.

    Nor do those that the work does not reach: that they are causes holds.
    """
    necessary = {name for name in enough if tried.without([name]) is not fact}
    looked_for = [name for name in enough if name not in necessary][:MAX_GROUPS]
    groups: dict[str, tuple[str, ...]] = {}
    for name in enough:
        if name in necessary:
            groups[name] = (name,)
            continue
        groups[name] = ()
        if name in looked_for:
            with suppress(WorkSpentError):
                groups[name] = _group(tried, fact, name, names, enough)
    return groups


def _group(tried: Tried, fact: object, name: str, names: list[str], enough: list[str]) -> tuple[str, ...]:
    """A cause that is not necessary alone, and the things to remove with it so that the move changes.

    A set that flips the move always exists: without this cause and all non-causes, the other causes are not
    sufficient. It is the group if no member of it can be spared; else there is none to be told.
    """
    stand_ins = [other for other in names if other not in enough]
    alike = (other for other in names[:MOST_PAIRED] if other != name and tried.without([other]) is fact)
    pair = next((other for other in alike if tried.without([name, other]) is not fact), None)
    if pair is not None:
        return name, pair
    found = name, *minimal_subset(stand_ins, lambda gone: tried.without([name, *gone]) is not fact)
    if len(found) > MAX_TRIED:
        return ()  # a part of it may do, though no single member can be spared
    parts = (part for size in range(1, len(found)) for part in combinations(found, size))
    smallest = next((part for part in parts if tried.without(part) is not fact), found)
    return smallest if name in smallest else ()


def minimal_subset(names: list[str], holds: Callable[[Sequence[str]], bool]) -> list[str]:
    """A subset of `names` that satisfies `holds`, with no member to spare; `holds(names)` must be true.

    The search takes prefixes of growing length, so that things far away do not change an explanation.
    """
    size = 0
    while size < len(names) and not holds(names[:size]):
        size = max(size + 1, size * 3 // 2)
    return ddmin(names[:size], holds)


def _smallest(tried: Tried, fact: object, enough: list[str]) -> tuple[list[str], bool]:
    """The smallest sufficient subset, and whether its minimality is proved by trying every smaller one.

    For a set larger than `MAX_TRIED`, it is only known that no single member can be removed.
    """
    if len(enough) > MAX_TRIED:
        return enough, False
    parts = (part for size in range(len(enough)) for part in combinations(enough, size))
    smaller = next((list(part) for part in parts if tried.keeping(part) is fact), None)
    return (enough if smaller is None else smaller), True


def rank_causes(
    tried: Tried,
    fact: object,
    find: Callable[[str], tuple[Thing, bool] | None],
    hindered: Sequence[Option],
    groups: dict[str, tuple[str, ...]],
) -> tuple[Cause, ...]:
    """The causes, by their groups: those that block the first of the hindered moves before the others.

    Causes that block nothing follow, then preferences. `find`: a thing by its id, and whether it is real.
    """
    causes = []
    for name, group in groups.items():
        necessary = group == (name,)
        each = len(group) > 1 and all(tried.keeping([other]) is fact for other in group)
        if is_factor(name):
            kind = name.partition(":")[0]
            causes.append(Cause(name, kind, None, Role.WEIGHS, (), necessary, group, each))  # type: ignore[arg-type]
            continue
        found = find(name)
        if found is not None:
            thing, real = found
            blocked = tuple(option.move for option in hindered if name in option.causes)
            role = Role.BLOCKS if blocked else Role.DRIVES
            causes.append(Cause(name, thing.kind, thing.cell, role, blocked, necessary, group, each, real))
    order = [option.move for option in hindered]

    def rank(cause: Cause) -> tuple[int, bool]:
        return order.index(cause.moves[0]) if cause.moves else len(order), cause.role is Role.WEIGHS

    return tuple(sorted(causes, key=rank))
