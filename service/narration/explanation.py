"""An explanation in words: the move, what was in the way, what re-running has shown, what was at stake."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.charges import in_seconds, likely, seconds_worth
from service.narration.inflection import is_told, lower_first
from service.narration.naming import Naming
from service.narration.planner_reasons import planner_reasons
from service.narration.proofs import Proofs, called
from service.narration.sayings import Sayings
from sim.explain import Alternatives, Explanation, Future
from sim.explain.misperception import misperception
from sim.plan import Measure, Option
from sim.types import Move, Outcome, kind_of

MOST_REASONS = 2
"""Moves of which it is told what was in their way, where telling it of all would be too long."""


class Explained:
    """Explanations in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(
        self,
        explanation: Explanation,
        *,
        detailed: bool = False,
        most: int = MOST_WORDS,
        now: int | None = None,
    ) -> str:
        """Why, or why not, in a few sentences of so many words; `detailed` leaves nothing out for brevity.

        `now`: the present tick, to say how long ago the decision was; without it the tick itself is said.
        """
        telling = _Telling(self._sayings, explanation, detailed=detailed, now=now)
        parts = telling.why() if explanation.about == "why" else telling.why_not()
        told = within([*parts, *telling.imagined(parts)], None if detailed else most)
        return told

    def would(self, explanation: Explanation) -> str:
        """What the foil of an explanation would have led to; empty where that is not known."""
        return _Telling(self._sayings, explanation, detailed=False).would()


class _Telling:
    """One explanation on its way into words."""

    def __init__(
        self, sayings: Sayings, explanation: Explanation, *, detailed: bool, now: int | None = None
    ) -> None:
        self._sayings = sayings
        self._at = _time_of(sayings, explanation, now)
        self._detailed = detailed
        self._explanation = explanation
        self._decision = explanation.decision
        self._naming = Naming(sayings, explanation.moment, ego=explanation.decision.av)
        self._planner_reasons = planner_reasons(sayings, explanation.decision, explanation.moment)
        self._proofs = Proofs(sayings, explanation, self._naming, detailed=detailed)

    def imagined(self, told: list[Part]) -> list[Part]:
        """Of the causes that were not there that they were not, where it was not told."""
        text = " ".join(part.text for part in told)
        imagined = self._naming.imagined([cause.id for cause in self._explanation.causes])
        phrases = [self._sayings.imagined(name, where) for name, where in imagined.items()]
        more = [self._say("imagined", told=phrase) for phrase in phrases if not is_told(phrase, text)]
        return [Part(0, each) for each in dict.fromkeys(more)]

    def why(self) -> list[Part]:
        """Why the move was made."""
        decision = self._decision
        if decision.fault is not None:
            planner, fault = (
                self._sayings.planner(decision.planner, "id"),
                self._sayings.fault(decision.fault),
            )
            return [Part(0, self._say("fact_fault", at=self._at, planner=planner, fault=fault))]
        if decision.asked is not None and not decision.held_back:
            return [Part(0, self._say("fact_asked", at=self._at, did=self._did(decision.move)))]
        if decision.measure is not Measure.RANK and decision.asked is None:
            told = self._weighed()
            return [Part(0, told), *self._proofs.of_why(told)]
        if self._planner_reasons is not None and self._planner_reasons.reasons("then"):
            fact = self._fact([decision.option(Move.FORWARD)] if decision.move is not Move.FORWARD else [])
            met = self._planner_reasons.met()
            told = self._because(fact, met, partial(self._planner_reasons.reasons, "then"))
            side = Part(3, self._planner_reasons.choice_of_side())
            return [Part(0, told), side, *self._proofs.of_why(told)]
        if decision.held_back and decision.asked is not None:
            asked = self._sayings.move(decision.asked, "do")
            fact = self._say("fact_held_back", at=self._at, asked=asked)
            hindered = [decision.option(decision.asked)]
        else:
            hindered = [option for option in decision.preferred if option.cell is not None]
            fact = self._fact(hindered)
        if not hindered:
            told = self._say("clear", fact=fact, reason=self._reason(decision.chosen))
            shown = self._explanation.causes or self._explanation.also
            return [Part(0, told), *(self._proofs.of_why(told) if shown else self._proofs.blocked())]
        told = self._because(fact, hindered, partial(self._met_by_first, hindered))
        return [Part(0, told), *self._proofs.of_why(told)]

    def why_not(self) -> list[Part]:
        """Why the foil was not made."""
        decision, foil = self._decision, self._explanation.foil
        assert foil is not None
        do = self._sayings.move(foil, "do")
        if decision.asked is not None and not decision.held_back:
            asked = self._sayings.move(decision.asked, "do")
            return [Part(0, self._say("not_preferred_asked", at=self._at, asked=asked, do=do))]
        option = decision.option(foil)
        if option.cell is None:
            reason = self._reason(option)
            return [Part(0, self._say("not_off_road", at=self._at, do=do, reason=reason))]
        return [
            Part(0, self._not_made(option, do)),
            Part(2, self.would(named=True)),
            *self._proofs.of_change(),
        ]

    def _met_by_first(self, hindered: list[Option], most: int | None = None) -> str:
        """What was in the way of the first so many moves."""
        return self._sayings.all_met(hindered[:most], "then", self._naming)

    def _because(self, fact: str, met: list[Option], reasons: Callable[[int | None], str]) -> str:
        """The fact and its reasons; where they are very many words, those of the first moves.

        `met`: the moves before the one made that something was in the way of; `reasons`: those of the first
        so many of these moves, or all there are.
        """
        told = self._say("because", fact=fact, reasons=reasons(None))
        if self._detailed:
            return told
        room = MOST_WORDS - self._proofs.least()
        short = len(met) <= MOST_REASONS or len(reasons(None).split()) <= MOST_WORDS // 2
        if short and len(told.split()) <= room:
            return told
        for some in self._fewer(met, reasons):
            told = self._say("because", fact=fact, reasons=some)
            if len(told.split()) <= room:
                break
        return told

    def _fewer(self, met: list[Option], reasons: Callable[[int | None], str]) -> Iterator[str]:
        """The reasons in ever fewer words, as `_because` takes them."""
        for others in (True, False):
            for most in range(min(MOST_REASONS, len(met)), -1, -1):
                some = reasons(most)
                if others and (most if some else 1) < len(met):
                    yield self._say("and_others", reasons=some or self._met_first(met[0]))
                elif some or not others:
                    yield some or self._met_first(met[0])

    def _met_first(self, option: Option) -> str:
        """One thing that was in the way of a move, where several were."""
        movers = [name for name in option.causes if kind_of(name).moves]
        ids = (movers or option.causes)[:1]
        return self._sayings.in_the_way(option.reason, option.move, ids, "then", self._naming)

    def _fact(self, hindered: list[Option]) -> str:
        decision = self._decision
        if not hindered:
            return self._say("fact", at=self._at, did=self._did(decision.move))
        other = self._sayings.move(hindered[0].move, "doing")
        return self._say("rather", at=self._at, did=self._did(decision.move), other=other)

    def _not_made(self, option: Option, do: str) -> str:
        decision = self._decision
        if decision.measure is not Measure.RANK and option.verdict == "free":
            return self._not_worth(option, do)
        if (
            option.verdict == "free"
            and self._planner_reasons is not None
            and (but := self._planner_reasons.not_made(option))
        ):
            return self._say("not_but", at=self._at, but=lower_first(but).rstrip("."))
        if option.verdict == "free":
            return self._say(
                "not_preferred",
                at=self._at,
                do=do,
                reason=self._reason(option),
                preferred=self._sayings.move(decision.move, "name"),
                free=self._reason(decision.chosen),
            )
        told = self._say("not_blocked", at=self._at, do=do, reasons=self._reason(option))
        if self._detailed or len(told.split()) <= MOST_WORDS:
            return told
        return self._say("not_blocked", at=self._at, do=do, reasons=self._met_first(option))

    def _weighed(self) -> str:
        """What the move costs in all, and the next best."""
        decision, chosen = self._decision, self._decision.chosen
        fact = self._say("fact", at=self._at, did=self._did(decision.move))
        if decision.measure is Measure.OWN:
            return self._say("own", fact=fact, planner=self._sayings.planner(decision.planner, "id"))
        if chosen.cost is None:
            return self._say("weighed_no_way", fact=fact)
        costs = self._worth(chosen.cost)
        others = [option for option in decision.options if option.cost is not None and option is not chosen]
        if not others or others[0].cost is None:
            return self._say(f"weighed_only_{decision.measure}", fact=fact, costs=costs)
        more = others[0].cost - chosen.cost
        return self._say(
            f"weighed_{decision.measure}" if more else "weighed_even",
            fact=fact,
            costs=costs,
            other=self._sayings.move(others[0].move, "name"),
            more=self._worth(more),
        )

    def _worth(self, cost: float) -> str:
        config = self._explanation.moment.config_of(self._decision.av)
        return seconds_worth(self._sayings, cost, self._decision.measure, config)

    def _not_worth(self, option: Option, do: str) -> str:
        """Why a free move was not taken by a planner that knows what each costs in all."""
        decision, best = self._decision, self._decision.chosen.cost
        if decision.measure is Measure.OWN:
            return self._say("not_own", at=self._at, planner=self._sayings.planner(decision.planner, "id"))
        if option.cost is None or best is None:
            return self._say("not_dead_end", at=self._at, do=do)
        more = option.cost - best
        key = f"not_worth_{decision.measure}" if more else "not_even"
        instead = self._sayings.move(decision.move, "name")
        return self._say(key, at=self._at, do=do, more=self._worth(more), instead=instead)

    def would(self, *, named: bool = False) -> str:
        """What the foil would have led to. `named`: whether it was said what is in its way."""
        stakes = self._explanation.stakes
        if stakes is None or stakes.would is None:
            return ""
        would, real = stakes.would, stakes.real
        if would.outcome is Outcome.CRASH:
            first = would.ticks == self._explanation.moment.world.episode_tick + 1
            key = "would_crash" if first else "would_crash_later"
            if not first and stakes.by_chance:
                return self._by_chance(stakes)
            if first and named and {*would.ids} == {*self._decision.option(stakes.foil).causes}:
                key = "would_crash_there"
            told = self._say(key, who=self._crashed_with(would, first), seconds=self._from_then(would.ticks))
            return self._joined([told, self._missed(would.ids) if first else ""])
        if stakes.dead_end:
            return self._say("would_dead_end")
        if stakes.by_chance:
            return self._by_chance(stakes)
        if would.outcome is Outcome.STUCK:
            return self._say("would_stuck")
        return self._arrives(would, real)

    def _by_chance(self, stakes: Alternatives) -> str:
        """How likely it is to arrive by either move."""
        would = likely(self._sayings, stakes.would_chances)
        return self._say("would_chance", would=would, real=likely(self._sayings, stakes.real_chances))

    def _arrives(self, would: Future, real: Future | None) -> str:
        seconds = self._from_then(would.ticks)
        if real is None or real.outcome is not Outcome.SUCCESS:
            return self._say("would_arrive_but", seconds=seconds)
        more = would.ticks - real.ticks
        key = "would_arrive" if more == 0 else "would_arrive_later" if more > 0 else "would_arrive_sooner"
        return self._say(key, seconds=seconds, more=self._seconds(abs(more)))

    def _from_then(self, ticks: int) -> str:
        """Seconds from the decision to a tick of the episode."""
        return self._seconds(ticks - self._explanation.moment.world.episode_tick)

    def _seconds(self, ticks: int) -> str:
        return in_seconds(self._sayings, ticks, self._explanation.moment.config)

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

    def _names(self, names: tuple[str, ...]) -> str:
        return self._sayings.joined([called(name, self._sayings, self._naming) for name in names])

    def _reason(self, option: Option) -> str:
        return self._sayings.met(option, "then", self._naming)

    def _did(self, move: Move) -> str:
        return self._sayings.move(move, "did")

    def _joined(self, parts: list[str]) -> str:
        return " ".join(part for part in parts if part)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("why", *keys, **parts)


def _time_of(sayings: Sayings, explanation: Explanation, now: int | None) -> str:
    """When a decision was taken, to begin a sentence: the last one just now, others so long ago."""
    tick = explanation.decision.tick
    if now is None:
        return sayings.say("why", "at", "tick", tick=tick)
    if now == tick + 1:
        return sayings.say("why", "at", "now")
    ago = in_seconds(sayings, now - tick, explanation.moment.config)
    return sayings.say("why", "at", "ago", seconds=ago)
