"""What a decision hangs on beside a minimal sufficient set: what flips it by itself, and what held what.

A set that is enough need not hold everything without which the move would be another one. So each thing
that may have a part is taken away by itself as well. And what stood in the way may have stood there only
because of another thing: then the other one is the cause, and the chain between them is told.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations

from sim.explain.effort import WorkSpentError
from sim.explain.facts import Link
from sim.explain.intervention import Intervention
from sim.explain.relevance import having_part, tried_singly
from sim.forecast import predict
from sim.perceive import Percept
from sim.plan import Decision, Measure, Option, traits_of
from sim.plan.rule_based import Leads, standing
from sim.types import MOVES, Move

MOST_BEHIND = 3
"""So many times what comes to stand in the way once others are gone is taken away too."""
MOST_TRIED = 5
"""Things of which every part is tried."""
MOST_RUNS = 6
"""Runs in which further things are tried in groups."""
MOST_HELD = 3
"""Things in the way of which it is looked for what held them there."""


@dataclass(frozen=True, slots=True)
class Rest:
    """The rest of what a decision hangs on."""

    groups: dict[str, tuple[str, ...]]
    """by name, what must go together for the decision to flip: of names that are not in the sufficient set"""
    chain: tuple[Link, ...]
    untried: tuple[str, ...]
    """things that may have a part and were not tried by themselves"""

    @staticmethod
    def of(
        rerun: Intervention,
        names: Sequence[str],
        hindered: Sequence[Option],
        known: Mapping[str, tuple[str, ...]],
    ) -> Rest:
        """`known`: the sufficient set with its groups; `hindered`: the options before the one taken."""
        fact = rerun.decision.move
        traits = traits_of(rerun.decision.planner)
        parts = having_part(rerun.percept, traits, list(names))
        most = tried_singly(traits)
        further = Flipping(rerun)
        each = len(parts) if rerun.try_without_each(parts) else most
        single = {name for name in parts[:each] if further.flips(name)}
        single.update(further.among([name for name in parts[each:] if rerun.tried_without(name) is None]))
        single.update(name for name in parts if rerun.tried_without(name) not in (None, fact))
        groups: dict[str, tuple[str, ...]] = {
            name: (name,) for name in parts if name in single and name not in known
        }
        settled = {*single, *(each for group in known.values() for each in group), *known}
        chain: list[Link] = []
        met = [(name, option) for option in hindered for name in option.causes if name not in settled]
        with suppress(WorkSpentError):
            for name, option in met[:MOST_HELD]:
                by = [other for other in parts if other in single or other in known]
                link = _held_by(rerun, name, option, by)
                if link is not None:
                    chain.append(link)
                elif name not in groups and (pair := _grouped(rerun, name, option, parts[:most], single)):
                    groups[name] = pair
                elif name not in groups and (link := _behind(rerun, name, option, by)) is not None:
                    chain.append(link)
        return Rest(groups, tuple(chain), tuple(further.untried))


class Flipping:
    """What flips a decision by itself, among many things and in few runs.

    Of a planner that weighs costs, things are taken away in groups. With less in the way no way gets dearer,
    so where even without the whole group no other move is as good as the one taken, none of it flips it
    alone. Only what shares a row with a mover may make that one go otherwise, and so shut a way: that counts
    as not tried.
    """

    def __init__(self, rerun: Intervention) -> None:
        """`rerun`: the decision."""
        self._rerun = rerun
        self._runs = MOST_RUNS
        self._beside_movers = _beside_movers(rerun.percept)
        self.untried: list[str] = []
        """things that were not looked at, for want of runs"""

    def flips(self, name: str) -> bool:
        """Whether this one flips the decision by itself; what there is no work left for is not tried."""
        try:
            return self._rerun.without([name]) is not self._rerun.decision.move
        except WorkSpentError:
            self.untried.append(name)
            return False

    def among(self, names: Sequence[str]) -> list[str]:
        """Those of the names that flip the decision by themselves."""
        if not names:
            return []
        if self._runs <= 0 or self._rerun.decision.measure is Measure.RANK:
            self.untried += names
            return []
        self._runs -= 1
        try:
            without = self._rerun.decision_without(names)
        except WorkSpentError:
            self.untried += names
            return []
        if not self._another_is_as_good(without):
            self.untried += [name for name in names if name in self._beside_movers]
            return []
        if len(names) == 1:
            return [names[0]] if without.move is not self._rerun.decision.move else []
        half = len(names) // 2
        return self.among(names[:half]) + self.among(names[half:])

    def _another_is_as_good(self, without: Decision) -> bool:
        made, best = self._rerun.decision.move, self._rerun.decision.chosen.cost
        if best is None or without.move is not made:
            return True
        before = MOVES[: MOVES.index(made)]
        return any(
            option.cost is not None
            and (option.cost < best or (option.cost == best and option.move in before))
            for option in without.options
            if option.move is not made
        )


def _beside_movers(percept: Percept) -> frozenset[str]:
    """Whatever is in a row with a mover other than itself."""
    columns = percept.road.columns
    movers = Counter(cell // columns for cell in percept.movers)
    found = {name for cell, name in percept.hazards.items() if movers[cell // columns]}
    return frozenset(found | {name for cell, name in percept.movers.items() if movers[cell // columns] > 1})


def _held_by(rerun: Intervention, name: str, option: Option, by: Iterable[str]) -> Link | None:
    """Because of which of these a thing stood in the way of a move."""
    for other in by:
        without = rerun.decision_without([other])
        if name not in without.option(option.move).causes:
            return Link(name, other, option.move)
    return None


def _behind(rerun: Intervention, name: str, option: Option, by: Iterable[str]) -> Link | None:
    """What would hold a move back, were the thing that is in its way gone: one of these if it is one of them.

    Of a planner that weighs costs only these count: its moves are held back by what they cost.
    """
    after = rerun.decision_without([name])
    met = after.option(option.move).causes
    other = next((other for other in by if other != name and other in met), None)
    if other is not None:
        return Link(name, other, option.move, behind=True)
    if rerun.decision.measure is not Measure.RANK or after.move is not rerun.decision.move:
        return None
    if met:
        return Link(name, met[0], option.move, behind=True)
    return _led(rerun, name, option.move)


def _led(rerun: Intervention, name: str, move: Move) -> Link:
    """Where a move would lead that is not made, though its cell is free without a thing."""
    if not traits_of(rerun.decision.planner).by_passages:
        return Link(name, None, move, behind=True)
    forecast = predict(rerun.percept.without(frozenset((name,))), 1)
    prospect = standing(forecast).of(move)
    if prospect is None or prospect.leads not in (Leads.CLOSED, Leads.NOWHERE):
        return Link(name, None, move, behind=True)
    closer = None if prospect.closer is None else forecast.slices.movers(0)[prospect.closer]
    return Link(name, closer, move, behind=True, leads=prospect.leads)


def _grouped(
    rerun: Intervention, name: str, option: Option, parts: Sequence[str], single: Iterable[str]
) -> tuple[str, ...] | None:
    """A thing in the way of a move, and the fewest that must go with it for the decision to flip."""
    fact = rerun.decision.move
    others = (other for other in parts if other != name and other not in single)
    pair = next((other for other in others if rerun.without([name, other]) is not fact), None)
    if pair is not None:
        return name, pair
    gone = list(option.causes)
    for _ in range(MOST_BEHIND):
        gone += [each for each in rerun.decision_without(gone).option(option.move).causes if each not in gone]
    if rerun.without(gone) is fact or len(gone) > MOST_TRIED:
        return None
    sizes = range(1, len(gone) + 1)
    found = (part for size in sizes for part in combinations(gone, size) if rerun.without(part) is not fact)
    smallest = next(found)
    return smallest if name in smallest else None
