"""The moves of a decision in a few words each: what a blocked one would meet, what a free one costs more."""

from __future__ import annotations

from service.narration.sayings import Sayings
from sim.plan import Decision, Measure, Option
from sim.types import Kind, kind_of


class Options:
    """Words for the moves of decisions, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        words = sayings.words("options", "met")
        self._met = {
            (reason, kind): sayings.say("options", "met", reason, a=sayings.say("words", "a", kind))
            for reason in words
            for kind in Kind
        }
        self._chosen, self._free, self._even, self._nowhere = (
            sayings.say("options", key) for key in ("chosen", "free", "even", "nowhere")
        )

    def texts(self, decision: Decision) -> list[str]:
        """One text for each of `decision.options`, in their order."""
        return [self._text(option, decision) for option in decision.options]

    def _text(self, option: Option, decision: Decision) -> str:
        if option.reason.blocks:
            kinds = [kind_of(name) for name in option.causes]
            kind = next((kind for kind in kinds if kind.moves), kinds[0] if kinds else Kind.AV)
            return self._met[option.reason.value, kind]
        if option.move is decision.move:
            return self._chosen
        if option.dead_end and decision.measure is not Measure.OWN:
            return self._nowhere
        best = decision.chosen.cost
        if decision.measure not in (Measure.COST, Measure.TICKS) or best is None or option.cost is None:
            return self._free
        more = round(option.cost - best, 1)
        if more <= 0:
            return self._even
        if decision.measure is Measure.COST:
            return self._sayings.say("options", "cost", more=f"{more:g}")
        return self._sayings.say("options", "ticks", "one" if more == 1 else "many", more=f"{more:g}")
