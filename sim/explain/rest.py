"""What a decision hangs on beside a minimal sufficient set: what flips it by itself, and what held what.

A set that is enough need not hold everything without which the move would be another one. So each thing that
may have a part is taken away by itself as well. And what stood in the way may have stood there only because of
another thing: then the other one is the cause, and the chain between them is told.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from sim.explain.facts import Link
from sim.explain.intervention import Intervention
from sim.explain.relevance import having_part, tried_singly
from sim.plan import Option, traits_of

MOST_HELD = 3
"""Things in the way of which it is looked for what held them there."""


@dataclass(frozen=True, slots=True)
class Rest:
    """The rest of what a decision hangs on."""

    groups: dict[str, tuple[str, ...]]
    """by name, what must go together for the decision to flip: of names that are not in the sufficient set"""
    chain: tuple[Link, ...]
    untried: int
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
        single = {name for name in parts[:most] if rerun.without([name]) is not fact}
        groups = {name: (name,) for name in parts if name in single and name not in known}
        settled = {*single, *(each for group in known.values() for each in group), *known}
        chain: list[Link] = []
        met = [(name, option) for option in hindered for name in option.causes if name not in settled]
        for name, option in met[:MOST_HELD]:
            by = [other for other in parts if other in single or other in known]
            link = _held_by(rerun, name, option, by)
            if link is not None:
                chain.append(link)
            elif name not in groups and (pair := _paired(rerun, name, parts[:most], single)):
                groups[name] = pair
        return Rest(groups, tuple(chain), max(0, len(parts) - most))


def _held_by(rerun: Intervention, name: str, option: Option, by: Iterable[str]) -> Link | None:
    """Because of which of these a thing stood in the way of a move."""
    for other in by:
        without = rerun.decision_without([other])
        if name not in without.option(option.move).causes:
            return Link(name, other, option.move)
    return None


def _paired(
    rerun: Intervention, name: str, parts: Sequence[str], single: Iterable[str]
) -> tuple[str, ...] | None:
    """A thing and the one that must go with it for the decision to flip."""
    fact = rerun.decision.move
    others = (other for other in parts if other != name and other not in single)
    pair = next((other for other in others if rerun.without([name, other]) is not fact), None)
    return None if pair is None else (name, pair)
