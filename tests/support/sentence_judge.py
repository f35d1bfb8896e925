"""Whether the sentences of explanations are so: by changing the road and letting it run, and by the twin.

Nothing of `sim.explain` is asked. A change of the road is made by the actions of a person, and the decision
is the one the run takes then. Each judge yields the kind of sentence that it looked at, and what is false
about it, or None where it holds.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from itertools import combinations
from typing import get_args

from service.narration.explanation import Explained
from service.narration.naming import Naming
from service.narration.narrator import Narrator
from service.narration.sayings import Sayings
from sim.actions import Add, Prefer, Remove, Wish, WorldAction
from sim.decide import decide, sense
from sim.explain import Explanation
from sim.explain.crash import Crash
from sim.explain.intervention import wall
from sim.forecast import predict
from sim.plan import Decision, Measure
from sim.plan.rule_based import standing
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.types import Move
from tests.support.intervention_judge import taking
from tests.support.survival import can_avoid, clear_after
from tests.support.twin import STEPS, position

Judged = Iterator[tuple[str, str | None]]
LONGEST = 60
"""Words of an answer that was not asked for in detail."""
CHAINED = re.compile(
    r"not have been in the way|would have (been in the way|kept me from|led into|come between)|Even with"
)
"""What held a thing in the way, or what would have held the move back without it."""
SURVIVED = 40
"""Ticks that a vehicle must keep clear for a crash to count as avoidable."""


class Recording(Sayings):
    """Sayings that remember which things the last sentences named as being in the way."""

    named: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def in_the_way(self, reason, move, ids, tense, naming, **more):  # type: ignore[no-untyped-def]
        told = super().in_the_way(reason, move, ids, tense, naming, **more)
        self.named = (*self.named, (told.lower(), tuple(ids)))
        return told

    def recorded(self, text: str) -> tuple[str, ...]:
        """The ids named since it was last asked, where what names them stands in a text."""
        named, self.named = self.named, ()
        return tuple(name for told, ids in named if told in text.lower() for name in ids)


def decided(state: SimState, change: Iterable[WorldAction] = ()) -> Decision | None:
    """The decision after a person's changes; None where they cannot be made."""
    try:
        for action in change:
            state = apply(state, action).state
    except EditError:
        return None
    return decide(state)


def flips(state: SimState, gone: Collection[str], fact: Move) -> bool:
    """Whether the move is another one once these are gone."""
    after = decided(state, taking(gone, state.config))
    return after is not None and after.move is not fact


def names_of(state: SimState) -> list[str]:
    """Everything on the road, and every wish."""
    return [thing.id for thing in state.world.things()] + [
        f"preference:{wish}" for wish in state.config.preferences
    ]


def judge_crash(crash: Crash, first: SimState, at: Callable[[int], SimState], text: str) -> Judged:
    """`first`: the earliest state of the episode that the answer is about; `at`: the state of a tick."""
    if "could have saved it" in text or "Nor could anything" in text:
        avoidable = can_avoid(position(first.world), crash.end - first.world.tick + SURVIVED)
        yield "1 crash said to be unavoidable", f"it was not: {text}" if avoidable else None
    last = crash.avoidable.last if hasattr(crash, "avoidable") else None
    if last is not None:
        moment = position(at(last.tick).world)
        columns, rows = STEPS[last.instead]
        cell = (moment.av[0] + columns, moment.av[1] + rows)
        kept = clear_after(moment, cell, SURVIVED, stays=last.stays)
        yield "1 crash said to be avoidable", None if kept else f"it was not by {last}: {text}"


def judge_comes_first(explanation: Explanation, text: str) -> Judged:
    """Costs have no order, and what is free is not in the way."""
    weighed = explanation.decision.measure is not Measure.RANK and explanation.decision.asked is None
    ranked = len(re.findall("comes first|I prefer", text))
    if weighed and ranked:
        even = "comes first among equals" in text and ranked == 1
        yield "2 comes first", None if even else text
    if "in the way then" not in text:
        return
    state = explanation.moment
    for cause, flip in _stand_ins(explanation):
        after = decided(state, taking([cause], state.config))
        if after is not None:
            met = set(after.option(flip[1]).causes) & set(flip[0])
            yield "2 in the way then", None if met else f"{flip} for {cause}: {text}"


def _stand_ins(explanation: Explanation) -> Iterator[tuple[str, tuple[tuple[str, ...], Move]]]:
    moves = {flip.removed: flip.move for flip in explanation.counterfactuals}
    for cause in explanation.causes:
        if len(cause.group) > 1 and not cause.each_enough and cause.group in moves:
            yield cause.group[0], (cause.group[1:], moves[cause.group])


def judge_groups(explanation: Explanation, *, thorough: bool = False) -> Judged:
    """No member of a group is spare, and with `thorough` no smaller one does."""
    state, fact = explanation.moment, explanation.decision.move
    for group in {cause.group for cause in explanation.causes if len(cause.group) > 1}:
        spare = any(
            flips(state, part, fact) for size in range(1, len(group)) for part in combinations(group, size)
        )
        yield "3 spare member of a group", f"{group}" if spare else None
        if thorough and len(group) == 3:
            pairs = combinations(names_of(state), 2)
            smaller = next((pair for pair in pairs if group[0] in pair and flips(state, pair, fact)), None)
            yield "3 group not smallest", f"{smaller} for {group}" if smaller else None


def judge_change(explanation: Explanation, text: str, *, thorough: bool = False) -> Judged:
    """A change that is told reaches the move, nothing of it is spare, and no smaller one does."""
    state, foil = explanation.moment, explanation.foil
    decision = explanation.decision
    if foil is None or decision.option(foil).cell is None or decision.asked is not None:
        return
    found = [flip for flip in explanation.counterfactuals if flip.move is foil]
    said_none = "no change" in text.lower()
    yield "6 no change told, and not said", None if found or said_none else text
    for flip in found:
        after = decided(state, flip.change)
        yield "3 change that is none", None if after and after.move is foil else f"{flip.change}"
        parts = edits_of(flip.change)
        spare = any(
            (after := decided(state, [action for one in part for action in one])) and after.move is foil
            for size in range(len(parts))
            for part in combinations(parts, size)
        )
        yield "3 change with a spare part", f"{flip.change}: {text}" if spare else None
        if thorough and len(parts) > 1:
            smaller = next(changes_reaching(state, foil, len(parts) - 1), None)
            yield "3 change not smallest", f"{smaller} for {flip.change}" if smaller else None
    if thorough and not found:
        size = 3 if "three" in text else 1 if "single" in text else 2
        one = next(changes_reaching(state, foil, min(size, 2)), None)
        yield "6 a small change exists", f"{one}: {text}" if one else None


def edits_of(change: Sequence[WorldAction]) -> list[tuple[WorldAction, ...]]:
    """The single edits of a change: each thing, and all wishes together."""
    wishes = tuple(action for action in change if not isinstance(action, Add | Remove))
    return [(action,) for action in change if isinstance(action, Add | Remove)] + ([wishes] if wishes else [])


def changes_reaching(state: SimState, foil: Move, size: int) -> Iterator[tuple[WorldAction, ...]]:
    """Changes of up to so many edits that lead to a move: things taken away, and cells beside it blocked."""
    edits = [
        (action,) for name in names_of(state) if ":" not in name for action in taking([name], state.config)
    ]
    made = decide(state)
    assert made is not None
    cells = [
        option.cell for option in made.options if option.cell is not None and option.move is not Move.STAY
    ]
    edits += [(wall(state.world, cell),) for cell in cells]
    if made.measure is Measure.COST:
        edits += [(Prefer(preference=wish),) for wish in get_args(Wish)]
    for count in range(1, size + 1):
        for part in combinations(edits, count):
            change = [action for one in part for action in one]
            after = decided(state, change)
            if after is not None and after.move is foil:
                yield tuple(change)


def judge_left_out(explanation: Explanation, text: str, named: Collection[str]) -> Judged:
    """Whatever flips the move by itself is among the causes, and what is said to block is, or was held there.

    `named`: what the sentence says was in the way.
    """
    state, fact = explanation.moment, explanation.decision.move
    if explanation.decision.asked is not None:
        return
    also = {cause.id for cause in getattr(explanation, "also", ())}
    told = {cause.id for cause in explanation.causes} | also
    out = [name for name in names_of(state) if name not in told and flips(state, [name], fact)]
    untried = getattr(explanation, "untried", 0)
    kind = "4 single cause not tried" if untried else "4 single cause left out"
    said = untried and "Not everything" in text
    yield kind, f"{out}: {text}" if out and not said else None
    if named and fact is not Move.FORWARD:
        members = {name for cause in explanation.causes for name in cause.group} | told
        chained = {link.blocker for link in explanation.chain}
        told = {*named} & members or ({*named} & chained and CHAINED.search(text))
        yield "4 blocker is no cause", None if told else f"{named}: {text}"


def judge_chain(explanation: Explanation) -> Judged:
    """What is said to be in the way only because of another thing, or to hide one, is and does."""
    state, fact = explanation.moment, explanation.decision.move
    for link in explanation.chain:
        if link.by is None or link.leads:
            after = decided(state, taking([link.blocker], state.config))
            kept = after is not None and after.move is fact and not after.option(link.move).causes
            so = kept and (not link.leads or _leads(state, link.blocker, link.move) == (link.leads, link.by))
            yield "4 chain that is none", None if so else f"{link}"
            continue
        gone, met = (link.blocker, link.by) if link.behind else (link.by, link.blocker)
        after = decided(state, taking([gone], state.config))
        there = after is not None and met in after.option(link.move).causes
        yield "4 chain that is none", None if there is link.behind else f"{link}"


def _leads(state: SimState, gone: str, move: Move) -> tuple[str | None, str | None]:
    """Where a move leads once something was taken off the road, and which mover closes the way from there."""
    for action in taking([gone], state.config):
        state = apply(state, action).state
    forecast = predict(sense(state)[0], 1)
    prospect = standing(forecast).of(move)
    if prospect is None:
        return None, None
    closer = None if prospect.closer is None else forecast.slices.movers(0)[prospect.closer]
    return prospect.leads.value, closer


def judge_chance(state: SimState, text: str, *, ends_differ: bool) -> Judged:
    """Where it hangs on chance how it ends, no one future is told as the one. `ends_differ`: as was drawn."""
    text = re.sub(r"It would have been a crash with", "", text)  # at once, by what is seen
    told = re.search(r"\b(arrive|arrived|crashed|crash with|got stuck|get stuck)\b", text)
    if not state.config.certain and told and ends_differ:
        stated = re.search(r"%|in every|in each|of \d+ futures|no way leads", text)
        yield "5 one drawn future told as the future", None if stated else text


def judge_narration(state: SimState, decision: Decision, line: str, named: Collection[str]) -> Judged:
    """What a line names matters to the move: alone, or together with one other that does not do it alone."""
    if not named or decision.asked is not None:
        return
    fact = decision.move
    if decision.measure is Measure.OWN or decision.chosen.reason.blocks:
        return  # no reason is claimed; or it is a danger that is told, and no reason
    if any(flips(state, [name], fact) for name in named):
        yield "7 thing named does not matter", None
        return
    others = [name for name in names_of(state) if name not in named]
    alone = {name for name in others if flips(state, [name], fact)}
    matters = flips(state, named, fact) or any(
        flips(state, [name, other], fact) for name in named for other in others if other not in alone
    )
    yield "7 thing named does not matter", None if matters else f"{named}: {line}"


CLUMSY = {
    "8 1 ticks": re.compile(r"\b1 ticks\b"),
    "8 two clocks": re.compile(r"at tick \d+.*(tick \d+ of the episode|\d+ ticks)"),
    "8 raw costs": re.compile(r"cost(s|)( of)? \d+|\d+ more (in all|on the whole)|best, [\w ]+, \d+ more"),
    "8 ticks instead of seconds": re.compile(r"\d+ ticks?\b"),
}


def judge_wording(text: str) -> Judged:
    """No answer has two clocks, raw costs or more words than it should."""
    for kind, pattern in CLUMSY.items():
        yield kind, text if pattern.search(text) else None
    yield "8 over 60 words", text if len(text.split()) > LONGEST else None


def reading() -> tuple[Recording, Explained, Narrator]:
    """English sayings that are recorded, with what speaks in them."""
    sayings = Recording.load("en")
    return sayings, Explained(sayings), Narrator(sayings)


def naming_at(explanation: Explanation, sayings: Sayings) -> Naming:
    """Names in the moment of an explanation."""
    return Naming(sayings, explanation.moment)
