"""Explains in words why a planner that ranks moves like `rules` chose as it did.

Its reasons are where moves lead, what closes a way, and which side is nearer.
"""

from __future__ import annotations

from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.decide import announced_before, sense
from sim.forecast import Forecast, predict
from sim.plan import Decision, Option, traits_of
from sim.plan.rule_based import Leads, Prospect, standing
from sim.state import SimState
from sim.types import Move, kind_of

_OTHER_SIDE = {Move.LEFT: Move.RIGHT, Move.RIGHT: Move.LEFT}


def planner_reasons(
    sayings: Sayings, decision: Decision, run: SimState, forecast: Forecast | None = None
) -> PlannerReasons | None:
    """The reasons of a decision taken in `run`.

    None if another kind of planner, or a person, took the decision. `forecast` is the one that the decision
    was taken by, where that is known already.
    """
    by_planner = decision.asked is None and decision.fault is None
    if not by_planner or not traits_of(decision.planner).by_passages:
        return None
    return PlannerReasons(sayings, decision, run, forecast)


class PlannerReasons:
    """The reasons of one decision of such a planner, in words."""

    def __init__(
        self, sayings: Sayings, decision: Decision, run: SimState, forecast: Forecast | None = None
    ) -> None:
        """`run`: the moment in which the decision was taken."""
        if forecast is None:
            ego = decision.av
            forecast = predict(sense(run, announced_before(run, ego), ego)[0], 1)
        self._sayings = sayings
        self._decision = decision
        self._forecast = forecast
        self._standing = standing(self._forecast)
        self._naming = Naming(sayings, run, ego=decision.av)
        self._straight = decision.option(Move.FORWARD)

    def reasons(self, tense: str, most: int | None = None) -> str:
        """What spoke against every move that would have come first; nothing for what is the first choice.

        `most`: of so many moves it is told what was in their way, and what closes other ways is left out.
        """
        decision = self._decision
        if decision.move is Move.STAY and self._standing.columns is None:
            return self._say("walled_in", tense)
        met = self.met()
        against = self._against(self._straight, tense) if decision.move is not Move.FORWARD else ""
        told = [against] if against else []
        told += [self._sayings.all_met(met[:most], tense, self._naming)] if met[:most] else []
        if decision.move is Move.STAY and (most is None or not (told or met)):
            told += self._closed_aside(tense, met)[: None if most is None else 1]
        return self._sayings.joined(told)

    def met(self) -> list[Option]:
        """Straight on and the moves that would have come first, of those that something was in the way of."""
        preferred = [option for option in self._decision.preferred if option.cell is not None]
        if self._decision.move is not Move.FORWARD and self._straight not in preferred:
            preferred.insert(0, self._straight)
        return [option for option in preferred if option.reason.blocks]

    def reason(self, tense: str, telling: Option | None) -> str:
        """The one of them that says most: what is in the way straight on, or what is waited for.

        `telling`: a move whose blockers matter, if there is one; no others are named.
        """
        straight, decision = self._straight, self._decision
        if decision.move is Move.STAY and self._standing.columns is None:
            return self._say("walled_in", tense)
        against = self._against(straight, tense)
        moving = self._standing.columns == 0 or any(kind_of(name).moves for name in straight.causes)
        if decision.move is not Move.STAY or moving:
            return against or self._met(telling, tense)
        blocked = [option for option in decision.preferred if option is not straight and option.causes]
        if blocked and telling is not None:
            return self._met(telling, tense)
        told = self._closed_aside(tense, [])
        return told[0] if told else against or self._met(telling, tense)

    def _met(self, telling: Option | None, tense: str) -> str:
        if telling is None:
            return self._say("none_open", tense)
        return self._sayings.met(telling, tense, self._naming)

    def choice_of_side(self) -> str:
        """Why it was this side and not the other, for a step aside; nothing where the other was no choice."""
        decision = self._decision
        other = _OTHER_SIDE.get(decision.move)
        mine = self._standing.of(decision.move)
        if other is None or mine is None or mine.leads is not Leads.ON or not self._standing.columns:
            return ""
        theirs = self._standing.of(other)
        if theirs is None or theirs.columns is None:
            return self._say("only_side", side=self._side(decision.move))
        if theirs.leads is Leads.CLOSED:
            return self._say("closed_side", side=self._side(other), who=self._who(theirs))
        if decision.option(other) in decision.preferred:
            return ""  # it is told what was in the way there
        return self._nearer(decision.move, mine, theirs)

    def not_made(self, option: Option) -> str:
        """What spoke against a move whose cell was free; nothing where the one made just comes first."""
        prospect, standing = self._standing.of(option.move), self._standing
        if prospect is None or option.move is Move.STAY:
            return ""
        if (reason := self._against(option, "then")) or prospect.leads is Leads.BACK:
            return reason or self._say("leads_back")
        made = standing.of(self._decision.move)
        if option.move not in _OTHER_SIDE or made is None:
            return ""
        if standing.columns == 0:
            return self._say("straight_on") if self._decision.move is Move.STAY else ""
        if self._decision.move is _OTHER_SIDE[option.move] and made.leads is Leads.ON:
            return self._nearer(self._decision.move, made, prospect)
        return ""

    def _against(self, option: Option, tense: str) -> str:
        """Why a move is not made although nothing is met: a dead end, or a way on that a mover closes."""
        prospect = self._standing.of(option.move)
        if prospect is None or option.reason.blocks or option.move is Move.STAY:
            return ""
        place = self._sayings.move(option.move, "place")
        if prospect.leads is Leads.NOWHERE:
            return self._say("dead_end", tense, place=place)
        if prospect.leads is Leads.CLOSED:
            return self._say("closed", tense, who=self._who(prospect), place=place)
        return ""

    def _closed_aside(self, tense: str, met: list[Option]) -> list[str]:
        """Who closes the ways on that are not straight ahead."""
        told: dict[int, str] = {}
        for option in self._decision.options if self._standing.columns else ():
            closer = prospect.closer if (prospect := self._standing.of(option.move)) is not None else None
            if closer is None or closer in told or option in met:
                continue
            blocked = option.reason.blocks
            told[closer] = (
                self._sayings.met(option, tense, self._naming) if blocked else self._against(option, tense)
            )
        return list(told.values())

    def _nearer(self, side: Move, mine: Prospect, theirs: Prospect) -> str:
        """The way on by both sides, in columns from the vehicle."""
        near, far = (1 + (each.columns or 0) for each in (mine, theirs))
        key = "as_near" if near == far else "nearer"
        form = "one" if near == 1 else "many"
        return self._say(key, form, side=self._side(side), near=near, far=far)

    def _side(self, move: Move) -> str:
        return self._say("sides", move)

    def _who(self, prospect: Prospect) -> str:
        """The mover that closes a way, from the driver's seat."""
        assert prospect.closer is not None
        return self._naming.thing(self._forecast.slices.movers(0)[prospect.closer])

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("outlook", *keys, **parts)
