"""An explanation in words: the move, what was in the way, and what running it again has shown."""

from __future__ import annotations

from service.narrate.sayings import Sayings
from sim.explain import Cause, Counterfactual, Explanation
from sim.kinds import Move
from sim.plan import Decision, Measure, Option


class Explained:
    """Explanations in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, explanation: Explanation) -> str:
        """Why, or why not, in a few sentences."""
        if explanation.foil is None:
            return self._why(explanation)
        return self._why_not(explanation, explanation.foil)

    def _why(self, explanation: Explanation) -> str:
        decision = explanation.decision
        did = self._sayings.move(decision.move, "did")
        if decision.fault is not None:
            fault = decision.fault
            return self._say("fact_fault", tick=decision.tick, planner=decision.planner, fault=fault)
        if decision.measure is not Measure.RANK and decision.asked is None:
            return " ".join([self._weighed(decision, did), *self._proofs(explanation)])
        if decision.asked is not None and not decision.held_back:
            return self._say("fact_asked", tick=decision.tick, did=did)
        if decision.held_back and decision.asked is not None:
            asked = self._sayings.move(decision.asked, "do")
            fact = self._say("fact_held_back", tick=decision.tick, asked=asked)
            hindered = [decision.option(decision.asked)]
        else:
            fact = self._say("fact", tick=decision.tick, did=did)
            hindered = list(decision.preferred)
        if not hindered:
            reason = self._sayings.reason(decision.chosen, "then")
            told = self._say("clear", fact=fact, reason=reason)
            return " ".join([told, *(self._flip(flip, flip.move) for flip in explanation.counterfactuals)])
        reasons = self._sayings.joined([self._sayings.reason(option, "then") for option in hindered])
        told = self._say("because", fact=fact, reasons=reasons)
        return " ".join([told, *self._proofs(explanation)])

    def _proofs(self, explanation: Explanation) -> list[str]:
        """What re-running has shown, cause by cause."""
        moves = {flip.removed: flip.move for flip in explanation.counterfactuals}
        alone = [cause for cause in explanation.causes if cause.necessary]
        by_move: dict[Move, list[Cause]] = {}
        for cause in alone:
            by_move.setdefault(moves[cause.group], []).append(cause)
        flips = [
            self._say(
                "without_one" if len(causes) == 1 else "without_any",
                who=self._sayings.joined([cause.id for cause in causes]),
                do=self._sayings.move(move, "do"),
            )
            for move, causes in by_move.items()
        ]
        proofs = [self._say("run_again", flips=self._sayings.listed(flips))] if flips else []
        proofs += [
            self._say(
                "stand_in",
                id=cause.id,
                others=self._sayings.joined(cause.group[1:]),
                who=self._sayings.joined(cause.group),
                do=self._sayings.move(moves[cause.group], "do"),
            )
            for cause in explanation.causes
            if not cause.necessary
        ]
        return proofs

    def _why_not(self, explanation: Explanation, foil: Move) -> str:
        decision = explanation.decision
        if decision.asked is not None and not decision.held_back:
            asked, do = self._sayings.move(decision.asked, "do"), self._sayings.move(foil, "do")
            return self._say("not_preferred_asked", tick=decision.tick, asked=asked, do=do)
        option = decision.option(foil)
        reason = self._sayings.reason(option, "then")
        do = self._sayings.move(foil, "do")
        if option.cell is None:
            return self._say("not_off_road", tick=decision.tick, do=do, reason=reason)
        if decision.measure is not Measure.RANK and option.verdict == "free":
            told = self._not_worth(decision, option, do)
        elif option.verdict == "free":
            told = self._say(
                "not_preferred",
                tick=decision.tick,
                do=do,
                reason=reason,
                preferred=self._sayings.move(decision.move, "name"),
                free=self._sayings.reason(decision.chosen, "then"),
            )
        else:
            told = self._say("not_blocked", tick=decision.tick, do=do, reasons=reason)
        return " ".join([told, *(self._flip(flip, foil) for flip in explanation.counterfactuals)])

    def _weighed(self, decision: Decision, did: str) -> str:
        """What the move costs in all, and the next best."""
        chosen = decision.chosen
        if chosen.cost is None:
            return self._say("weighed_no_way", tick=decision.tick, did=did)
        costs = f"{chosen.cost:g}"
        others = [option for option in decision.options if option.cost is not None and option is not chosen]
        if not others:
            return self._say(f"weighed_only_{decision.measure}", tick=decision.tick, did=did, costs=costs)
        next_best = others[0]
        assert next_best.cost is not None
        more = next_best.cost - chosen.cost
        return self._say(
            f"weighed_{decision.measure}" if more else "weighed_even",
            tick=decision.tick,
            did=did,
            costs=costs,
            other=self._sayings.move(next_best.move, "name"),
            more=f"{more:g}",
        )

    def _not_worth(self, decision: Decision, option: Option, do: str) -> str:
        """Why a free move was not taken by a planner that knows what each costs in all."""
        best = decision.chosen.cost
        if option.cost is None or best is None:
            return self._say("not_dead_end", tick=decision.tick, do=do)
        more = option.cost - best
        key = f"not_worth_{decision.measure}" if more else "not_even"
        instead = self._sayings.move(decision.move, "name")
        return self._say(key, tick=decision.tick, do=do, more=f"{more:g}", instead=instead)

    def _flip(self, flip: Counterfactual, foil: Move) -> str:
        who = self._sayings.joined(flip.removed)
        walls = self._sayings.joined(
            [
                self._say("wall", thing=self._sayings.things(kind, 1), where=self._sayings.where(cell))
                for kind, cell in flip.added
            ]
        )
        do = self._sayings.move(flip.move, "do")
        if flip.added:
            return self._say("not_walls_without" if who else "not_walls", who=who, walls=walls, do=do)
        return self._say("not_flips" if flip.move is foil else "not_flips_other", who=who, do=do)

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("answers", key, **parts)
