"""An explanation in words: the move, what was in the way, what re-running has shown, what was at stake."""

from __future__ import annotations

from collections.abc import Sequence

from service.narration.inflection import is_told, lower_first
from service.narration.naming import Naming
from service.narration.planner_reasons import planner_reasons
from service.narration.sayings import Sayings
from sim.actions import Prefer
from sim.explain import Cause, Counterfactual, Explanation, Future
from sim.explain.misperception import misperception
from sim.plan import Measure, Option
from sim.types import Move, Outcome

MOST_TOLD = 3
"""How many causes are told; the facts have all."""


class Explained:
    """Explanations in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, explanation: Explanation) -> str:
        """Why, or why not, in a few sentences."""
        telling = _Telling(self._sayings, explanation)
        told = telling.why() if explanation.about == "why" else telling.why_not()
        return telling.with_imagined(told)


class _Telling:
    """One explanation on its way into words."""

    def __init__(self, sayings: Sayings, explanation: Explanation) -> None:
        self._sayings = sayings
        self._explanation = explanation
        self._decision = explanation.decision
        self._naming = Naming(sayings, explanation.moment, ego=explanation.decision.av)
        self._planner_reasons = planner_reasons(sayings, explanation.decision, explanation.moment)

    def with_imagined(self, told: str) -> str:
        """What was told, and of the causes that were not there that they were not, where it was not told."""
        imagined = self._naming.imagined([cause.id for cause in self._explanation.causes])
        phrases = [self._sayings.imagined(name, where) for name, where in imagined.items()]
        more = [self._say("imagined", told=phrase) for phrase in phrases if not is_told(phrase, told)]
        return self._joined([told, *dict.fromkeys(more)])

    def why(self) -> str:
        """Why the move was made."""
        decision = self._decision
        if decision.fault is not None:
            return self._say(
                "fact_fault",
                tick=decision.tick,
                planner=self._sayings.planner(decision.planner, "id"),
                fault=self._sayings.fault(decision.fault),
            )
        if decision.asked is not None and not decision.held_back:
            return self._say("fact_asked", tick=decision.tick, did=self._did(decision.move))
        if decision.measure is not Measure.RANK and decision.asked is None:
            return self._joined([self._weighed(), *self._proofs()])
        if self._planner_reasons is not None and (reasons := self._planner_reasons.reasons("then")):
            fact = self._fact([decision.option(Move.FORWARD)] if decision.move is not Move.FORWARD else [])
            told = self._say("because", fact=fact, reasons=reasons)
            return self._joined([told, self._planner_reasons.choice_of_side(), *self._proofs()])
        if decision.held_back and decision.asked is not None:
            asked = self._sayings.move(decision.asked, "do")
            fact = self._say("fact_held_back", tick=decision.tick, asked=asked)
            hindered = [decision.option(decision.asked)]
        else:
            hindered = [option for option in decision.preferred if option.cell is not None]
            fact = self._fact(hindered)
        if not hindered:
            told = self._say("clear", fact=fact, reason=self._reason(decision.chosen))
            if self._explanation.causes:
                return self._joined([told, *self._proofs()])
            return self._joined([told, *(self._blocked(flip) for flip in self._explanation.counterfactuals)])
        reasons = self._sayings.all_met(hindered, "then", self._naming)
        return self._joined([self._say("because", fact=fact, reasons=reasons), *self._proofs()])

    def why_not(self) -> str:
        """Why the foil was not made."""
        decision, foil = self._decision, self._explanation.foil
        assert foil is not None
        do = self._sayings.move(foil, "do")
        if decision.asked is not None and not decision.held_back:
            asked = self._sayings.move(decision.asked, "do")
            return self._say("not_preferred_asked", tick=decision.tick, asked=asked, do=do)
        option = decision.option(foil)
        if option.cell is None:
            return self._say("not_off_road", tick=decision.tick, do=do, reason=self._reason(option))
        told = self._not_made(option, do)
        flips = [self._flip(flip, foil) for flip in self._explanation.counterfactuals]
        return self._joined([told, self._would(), *flips])

    def _fact(self, hindered: list[Option]) -> str:
        decision = self._decision
        if not hindered:
            return self._say("fact", tick=decision.tick, did=self._did(decision.move))
        other = self._sayings.move(hindered[0].move, "doing")
        return self._say("rather", tick=decision.tick, did=self._did(decision.move), other=other)

    def _not_made(self, option: Option, do: str) -> str:
        decision = self._decision
        if decision.measure is not Measure.RANK and option.verdict == "free":
            return self._not_worth(option, do)
        if (
            option.verdict == "free"
            and self._planner_reasons is not None
            and (but := self._planner_reasons.not_made(option))
        ):
            return self._say("not_but", tick=decision.tick, but=lower_first(but).rstrip("."))
        if option.verdict == "free":
            return self._say(
                "not_preferred",
                tick=decision.tick,
                do=do,
                reason=self._reason(option),
                preferred=self._sayings.move(decision.move, "name"),
                free=self._reason(decision.chosen),
            )
        return self._say("not_blocked", tick=decision.tick, do=do, reasons=self._reason(option))

    def _weighed(self) -> str:
        """What the move costs in all, and the next best."""
        decision, chosen = self._decision, self._decision.chosen
        fact = self._say("fact", tick=decision.tick, did=self._did(decision.move))
        if decision.measure is Measure.OWN:
            return self._say("own", fact=fact, planner=self._sayings.planner(decision.planner, "id"))
        if chosen.cost is None:
            return self._say("weighed_no_way", fact=fact)
        costs = self._sayings.number(chosen.cost)
        others = [option for option in decision.options if option.cost is not None and option is not chosen]
        if not others or others[0].cost is None:
            return self._say(f"weighed_only_{decision.measure}", fact=fact, costs=costs)
        more = others[0].cost - chosen.cost
        return self._say(
            f"weighed_{decision.measure}" if more else "weighed_even",
            fact=fact,
            costs=costs,
            other=self._sayings.move(others[0].move, "name"),
            more=self._sayings.number(more),
        )

    def _not_worth(self, option: Option, do: str) -> str:
        """Why a free move was not taken by a planner that knows what each costs in all."""
        decision, best = self._decision, self._decision.chosen.cost
        if decision.measure is Measure.OWN:
            return self._say(
                "not_own", tick=decision.tick, planner=self._sayings.planner(decision.planner, "id")
            )
        if option.cost is None or best is None:
            return self._say("not_dead_end", tick=decision.tick, do=do)
        more = option.cost - best
        key = f"not_worth_{decision.measure}" if more else "not_even"
        instead = self._sayings.move(decision.move, "name")
        return self._say(key, tick=decision.tick, do=do, more=self._sayings.number(more), instead=instead)

    def _proofs(self) -> list[str]:
        """What re-running has shown, cause by cause."""
        explanation = self._explanation
        moves = {flip.removed: flip.move for flip in explanation.counterfactuals}
        alone = [cause for cause in explanation.causes if cause.necessary]
        by_move: dict[Move, list[Cause]] = {}
        for cause in alone:
            by_move.setdefault(moves[cause.group], []).append(cause)
        sole = len(explanation.causes) == 1
        flips = [
            self._without(causes, self._sayings.move(move, "do"), sole) for move, causes in by_move.items()
        ]
        proofs = [self._say("run_again", flips=self._sayings.listed(flips))] if flips else []
        others = [cause for cause in explanation.causes if not cause.necessary and cause.group]
        return proofs + [self._stand_in(cause, moves[cause.group]) for cause in others[:MOST_TOLD]]

    def _without(self, causes: list[Cause], do: str, sole: bool) -> str:
        names = [cause.id for cause in causes]
        if sole and causes[0].moves:
            return self._say("without_it", it=self._seeing(names, self._say("it")), do=do)
        if len(names) == 1:
            return self._say("without_one", who=self._seeing(names, self._names(names)), do=do)
        if len(names) > MOST_TOLD:
            return self._say("without_some", who=self._names(names[:1]), count=len(names), do=do)
        key = "without_either" if len(names) == 2 else "without_any"
        return self._say(key, who=self._names(names), do=do)

    def _stand_in(self, cause: Cause, move: Move) -> str:
        who, do = self._seeing(cause.group, self._names(cause.group)), self._sayings.move(move, "do")
        if cause.each_enough:
            return self._say("either" if len(cause.group) == 2 else "any_of", who=who, do=do)
        return self._say(
            "stand_in",
            one=self._names(cause.group[:1]),
            others=self._names(cause.group[1:]),
            who=who,
            do=do,
        )

    def _would(self) -> str:
        """What the foil would have led to."""
        stakes = self._explanation.stakes
        if stakes is None or stakes.would is None:
            return ""
        would, real = stakes.would, stakes.real
        if would.outcome is Outcome.CRASH:
            first = would.ticks == self._explanation.moment.world.episode_tick + 1
            key = "would_crash" if first else "would_crash_later"
            told = self._say(key, who=self._crashed_with(would, first), ticks=would.ticks)
            return self._joined([told, self._missed(would.ids) if first else ""])
        if stakes.dead_end:
            return self._say("would_dead_end")
        if would.outcome is Outcome.STUCK:
            return self._say("would_stuck")
        return self._arrives(would, real)

    def _arrives(self, would: Future, real: Future | None) -> str:
        if real is None or real.outcome is not Outcome.SUCCESS:
            return self._say("would_arrive_but", ticks=would.ticks)
        more = would.ticks - real.ticks
        key = "would_arrive" if more == 0 else "would_arrive_later" if more > 0 else "would_arrive_sooner"
        return self._say(key, ticks=would.ticks, more=abs(more))

    def _crashed_with(self, would: Future, now: bool) -> str:
        """By name where it is here and now; later, by kind."""
        if now:
            return self._names(would.ids)
        kinds = [name.rpartition("-")[0] for name in would.ids]
        return self._sayings.joined([self._sayings.say("words", "a", kind) for kind in kinds])

    def _missed(self, names: tuple[str, ...]) -> str:
        """That what would have been hit was there and was not detected."""
        missed = {thing.id for thing in misperception(self._explanation.moment).missed} & {*names}
        return self._say("missed", "one" if len(missed) == 1 else "many") if missed else ""

    def _seeing(self, names: Sequence[str], who: str) -> str:
        """How to call what the move was run again without: things, or the sight of them."""
        undetected = {name for flip in self._explanation.counterfactuals for name in flip.undetected}
        return self._say("seeing", who=who) if undetected and undetected >= {*names} else who

    def _flip(self, flip: Counterfactual, foil: Move) -> str:
        who = self._seeing(flip.removed, self._names(flip.removed)) if flip.removed else ""
        do = self._sayings.move(flip.move, "do")
        wish = next(
            (action.preference for action in reversed(flip.change) if isinstance(action, Prefer)), None
        )
        if wish is not None and flip.move is foil:
            if wish == "balanced":
                return self._say("not_balanced", do=do)
            wished = self._sayings.say("replies", "preferences", wish)
            return self._say("not_wish_without" if who else "not_wish", who=who, wish=wished, do=do)
        if flip.added:
            key = "not_walls_without" if who else "not_walls"
            return self._say(key, who=who, walls=self._walls(flip), do=do)
        return self._say("not_flips" if flip.move is foil else "not_flips_other", who=who, do=do)

    def _blocked(self, flip: Counterfactual) -> str:
        return self._say("blocked_first", walls=self._walls(flip), do=self._sayings.move(flip.move, "do"))

    def _walls(self, flip: Counterfactual) -> str:
        walls = [
            self._say("wall", thing=self._sayings.things(kind, 1), where=self._naming.place(cell))
            for kind, cell in flip.added
        ]
        return self._sayings.joined(walls)

    def _names(self, names: tuple[str, ...] | list[str]) -> str:
        """Things, wishes and settings as people call them."""
        return self._sayings.joined([self._name(name) for name in names])

    def _name(self, name: str) -> str:
        return called(name, self._sayings, self._naming)

    def _reason(self, option: Option) -> str:
        return self._sayings.met(option, "then", self._naming)

    def _did(self, move: Move) -> str:
        return self._sayings.move(move, "did")

    def _joined(self, parts: list[str]) -> str:
        return " ".join(part for part in parts if part)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("why", *keys, **parts)


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
