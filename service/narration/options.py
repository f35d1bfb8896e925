"""The moves of a decision in a few words each: what a blocked one would meet, what a free one costs more."""

from __future__ import annotations

from service.narration.sayings import Sayings
from sim.forecast import StepVerdict
from sim.plan import Decision, Measure, Option
from sim.types import Kind, kind_of

MOST_KEPT = 4_096
"""So many texts are kept for being said again."""


class Options:
    """Words for the moves of decisions, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._chosen, self._free, self._even, self._nowhere = (
            sayings.say("options", key) for key in ("chosen", "free", "even", "nowhere")
        )
        self._more: tuple[dict[float, str], dict[float, str]] = ({}, {})
        """Texts said before of moves that cost more: in ticks, in costs."""
        self._met: dict[tuple[StepVerdict, tuple[str, ...]], str] = {}
        """Texts said before, by what would be met: the same few are said again and again."""

    def texts(self, decision: Decision) -> list[str]:
        """One text for each of `decision.options`, in their order."""
        free, move = StepVerdict.FREE, decision.move
        weighs = decision.measure is Measure.COST or decision.measure is Measure.TICKS
        told = []
        for option in decision.options:
            if option.reason is not free:
                told.append(self._met.get((option.reason, option.causes)) or self._meeting(option))
            elif option.move is move:
                told.append(self._chosen)
            else:
                told.append(self._weighed(option, decision) if weighs else self._unweighed(option, decision))
        return told

    def _meeting(self, option: Option) -> str:
        """What a move would have met."""
        kinds = [kind_of(name) for name in option.causes]
        kind = next((kind for kind in kinds if kind.moves), kinds[0] if kinds else Kind.AV)
        text = self._sayings.say("options", "met", option.reason, a=self._sayings.say("words", "a", kind))
        if len(self._met) >= MOST_KEPT:
            self._met.clear()
        self._met[option.reason, option.causes] = text
        return text

    def _unweighed(self, option: Option, decision: Decision) -> str:
        return self._nowhere if option.cost is None and decision.measure is not Measure.OWN else self._free

    def _weighed(self, option: Option, decision: Decision) -> str:
        """What a free move costs more than the one that was chosen."""
        best = decision.chosen.cost
        if option.cost is None:
            return self._nowhere
        if best is None:
            return self._free
        more = round(option.cost - best, 1)
        if more <= 0:
            return self._even
        known = self._more[decision.measure is Measure.COST]
        return known.get(more) or self._costing(more, decision.measure, known)

    def _costing(self, more: float, measure: Measure, known: dict[float, str]) -> str:
        shown = self._sayings.number(more)
        if measure is Measure.COST:
            text = self._sayings.say("options", "cost", more=shown)
        else:
            text = self._sayings.say("options", "ticks", "one" if more == 1 else "many", more=shown)
        if len(known) < MOST_KEPT:
            known[more] = text
        return text
