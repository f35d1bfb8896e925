"""What running a decision again has shown, in words: cause by cause, and change by change."""

from __future__ import annotations

from collections.abc import Sequence

from service.narration.answer_length import MOST_WORDS, Part
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.actions import Prefer
from sim.explain import Cause, Counterfactual, Explanation
from sim.explain.smallest_change import MOST_EDITS
from sim.plan import Measure
from sim.types import Move

MOST_TOLD = 3
"""How many causes are told; the facts have all."""

LEAST = 9
"""Rank of what is left out first."""

MOST_WALLS = 2
"""How many blocked cells are told one by one; of more their number is told."""


class Proofs:
    """The proofs of one explanation on their way into words."""

    def __init__(
        self, sayings: Sayings, explanation: Explanation, naming: Naming, *, detailed: bool = False
    ) -> None:
        """`naming`: of the moment of the decision. `detailed`: nothing is left out for brevity."""
        self._detailed = detailed
        self._sayings = sayings
        self._explanation = explanation
        self._naming = naming

    def least(self) -> int:
        """Words to leave for what held what and the first cause; none where all that is told is a cause."""
        chain = self._chain(0)
        return _words(chain) + _words(self._alone(0)) if chain else 0

    def of_why(self, told: str = "") -> list[Part]:
        """What held what, what flips the move by itself, then what only does so together with others.

        `told`: the sentence before it.
        """
        explanation = self._explanation
        moves = {flip.removed: flip.move for flip in explanation.counterfactuals}
        causes = (*explanation.causes, *explanation.also)
        others = [cause for cause in causes if not cause.necessary and cause.group]
        left, room = MOST_WORDS - _words(told), MOST_WORDS // 2
        chain = self._chain(left - _words(self._alone(0)))
        rank = 2
        if chain and explanation.decision.measure is Measure.RANK:  # `told` names what was in the way
            rank, room = 1, min(room, left - _words(chain))
        parts = [Part(rank, chain), Part(1, self._alone(room))]
        together = dict.fromkeys(self._stand_in(cause, moves[cause.group]) for cause in others)
        most = max(1, MOST_TOLD - sum(cause.necessary for cause in causes))
        parts += [Part(3 + at, text) for at, text in enumerate(list(together)[:most])]
        unfinished = bool(explanation.untried) or explanation.verified.sufficient is None
        hint = Part(LEAST, self._say("go_on") if unfinished and not self._detailed else "")
        return [*parts, Part(1, self._untried()), hint]

    def _alone(self, room: int) -> str:
        """What each flips the move by itself, in so many words: up to three, at least one, how many more."""
        moves = {flip.removed: flip.move for flip in self._explanation.counterfactuals}
        causes = (*self._explanation.causes, *self._explanation.also)
        alone, sole = [cause for cause in causes if cause.necessary], len(causes) == 1
        room -= _words(self._untried())
        for most in range(min(MOST_TOLD, len(alone)), 0, -1):
            by_move: dict[Move, list[Cause]] = {}
            for cause in alone[:most]:
                by_move.setdefault(moves[cause.group], []).append(cause)
            flips = [self._without(each, self._do(move), sole) for move, each in by_move.items()]
            if more := len(alone) - most:
                flips.append(self._say("more_alone", "one" if more == 1 else "many", count=more))
            told = self._say("run_again", flips=capital(self._sayings.listed(flips)))
            if most == 1 or self._detailed or _words(told) <= room:
                return told
        return ""

    def _without(self, causes: list[Cause], do: str, sole: bool) -> str:
        names = [cause.id for cause in causes]
        if sole and causes[0].moves:
            return self._say("without_it", it=self._seeing(names, self._say("it")), do=do)
        if len(names) == 1:
            return self._say("without_one", who=self._seeing(names, self._names(names)), do=do)
        key = "without_either" if len(names) == 2 else "without_any"
        return self._say(key, who=self._names(names), do=do)

    def _stand_in(self, cause: Cause, move: Move) -> str:
        who, do = self._seeing(cause.group, self._names(cause.group)), self._do(move)
        if cause.each_enough:
            return self._say("either" if len(cause.group) == 2 else "any_of", who=who, do=do)
        one, others = self._names(cause.group[:1]), self._names(cause.group[1:])
        if cause.rest_blocks:
            return self._say("stand_in", one=one, others=others, who=who, do=do)
        return self._say("together", one=one, who=who, do=do)

    def _chain(self, room: int) -> str:
        """That what stood in the way did so only because of something else, or what would be there else.

        In so many words, where that can be.
        """
        if not self._explanation.chain:
            return ""
        link = self._explanation.chain[0]
        key = "behind" if link.behind else "held"
        if link.behind and (link.by is None or link.leads):
            key = f"behind_{link.leads or 'free'}"
        parts = {
            "who": self._name(link.blocker),
            "by": "" if link.by is None else self._name(link.by),
            "place": self._sayings.move(link.move, "place"),
        }
        told = self._say(key, **parts)
        if key == "behind" and not self._detailed and _words(told) > room:
            return self._say("behind_short", **parts)
        return told

    def _untried(self) -> str:
        return self._say("untried") if self._explanation.untried else ""

    def of_change(self) -> list[Part]:
        """The smallest change that leads to the foil; or that there is none, as far as was looked."""
        explanation, foil = self._explanation, self._explanation.foil
        assert foil is not None
        found = [flip for flip in explanation.counterfactuals if flip.move is foil]
        if found:
            return [Part(1, self._flip(flip, foil)) for flip in found]
        even = [Part(3, self._even(flip)) for flip in explanation.counterfactuals]
        return [*even, Part(1, self._none(foil))] if explanation.tried else even

    def _none(self, foil: Move) -> str:
        """That no change was found, up to the size of which all were tried."""
        explanation = self._explanation
        if explanation.searched == 0:
            return self._say("no_change", "tried", count=explanation.tried, do=self._do(foil))
        sizes = ("one", "two", "three")
        return self._say("no_change", sizes[min(explanation.searched, MOST_EDITS) - 1], do=self._do(foil))

    def _even(self, flip: Counterfactual) -> str:
        who = self._seeing(flip.removed, self._names(flip.removed))
        weighed = self._explanation.decision.measure is not Measure.RANK
        return self._say(
            "not_flips_weighed" if weighed else "not_flips_other", who=who, do=self._do(flip.move)
        )

    def _flip(self, flip: Counterfactual, foil: Move) -> str:
        who = self._seeing(flip.removed, self._names(flip.removed)) if flip.removed else ""
        do = self._do(foil)
        wish = next(
            (action.preference for action in reversed(flip.change) if isinstance(action, Prefer)), None
        )
        if wish is not None and not any(":" in name for name in flip.removed) and not flip.added:
            if wish == "balanced":
                return self._say("not_balanced_without" if who else "not_balanced", who=who, do=do)
            wished = self._sayings.say("replies", "preferences", wish)
            return self._say("not_wish_without" if who else "not_wish", who=who, wish=wished, do=do)
        if wish is not None and not any(":" in name for name in flip.removed):
            wished = self._say("balanced") if wish == "balanced" else self._wish(wish)
            key = "not_walls_wish_without" if who else "not_walls_wish"
            return self._say(key, who=who, walls=self.walls(flip), wish=wished, do=do)
        if flip.added:
            key = "not_walls_without" if who else "not_walls"
            return self._say(key, who=who, walls=self.walls(flip), do=do)
        return self._say("not_flips", who=who, do=do)

    def _wish(self, wish: str) -> str:
        return self._say("wish", wish=self._sayings.say("replies", "preferences", wish))

    def blocked(self) -> list[Part]:
        """For a move without causes, what is done with its cell blocked."""
        return [
            Part(2, self._say("blocked_first", walls=self.walls(flip), do=self._do(flip.move)))
            for flip in self._explanation.counterfactuals
            if flip.added
        ]

    def walls(self, flip: Counterfactual) -> str:
        """What is put in the way, and where; of many only how many cells they block."""
        if len(flip.added) > MOST_WALLS and not self._detailed:
            return self._say("walls_many", count=len(flip.added))
        walls = [
            self._say("wall", thing=self._sayings.things(kind, 1), where=self._naming.place(cell))
            for kind, cell in flip.added
        ]
        return self._sayings.joined(walls)

    def _seeing(self, names: Sequence[str], who: str) -> str:
        """How to call what the move was run again without: things, or the sight of them."""
        undetected = {name for flip in self._explanation.counterfactuals for name in flip.undetected}
        return self._say("seeing", who=who) if undetected and undetected >= {*names} else who

    def _names(self, names: Sequence[str]) -> str:
        return self._sayings.joined([self._name(name) for name in names])

    def _name(self, name: str) -> str:
        return called(name, self._sayings, self._naming)

    def _do(self, move: Move) -> str:
        return self._sayings.move(move, "do")

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("why", *keys, **parts)


def _words(text: str) -> int:
    return len(text.split())


def called(name: str, sayings: Sayings, naming: Naming) -> str:
    """A thing, a wish or a setting as people call it."""
    kind, _, what = name.partition(":")
    if kind == "preference" and what:
        return sayings.say("why", "wish", wish=sayings.say("replies", "preferences", what))
    if kind == "setting" and what:
        return sayings.say(
            "why",
            "setting",
            setting=what.replace("_", " "),
            name=sayings.value("replies", "parameters", what),
        )
    return naming.thing(name)
