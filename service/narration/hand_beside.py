"""Answers that set a person's driving beside that of a planner on the same road."""

from __future__ import annotations

from typing import Final

from service.contract.encode.by_hand import hand_beside_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.hand_beside import HandBeside, Stretch, hand_beside
from sim.explain.question_error import QuestionError
from sim.types import Outcome

CONTRARY: Final = ("worse", "riskier", "jerkier")
"""What a question supposes that asks with yes or no whether the planner is ahead."""
WHO: Final = ("who", "who_safer", "who_smoother")
"""What it supposes that asks which of the two it is."""
OF_DISTANCE: Final = ("safer", "riskier", "who_safer")
OF_CALM: Final = ("smoother", "jerkier", "who_smoother")
OF_ALL: Final = ("better", "worse", "who")


class HandsBeside:
    """Answers to "do I drive better than you?", "where would you be now if you had driven?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. What is compared first is what the question supposes."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        try:
            found = hand_beside(timeline, ask.planner)
        except QuestionError as error:
            told = self._not_so(error)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        text = self._text(found, asked.supposes, state.config)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | hand_beside_json(found)

    def _not_so(self, error: QuestionError) -> str:
        if error.code == "not_by_hand":
            return self._sayings.say("stretches", "differed", "not_by_hand")
        if error.code == "no_such_planner":
            name = self._sayings.quoted(str(error.facts["planner"]))
            return self._sayings.say("planners", "missing", names=name)
        return not_so(self._sayings, error.code, error.facts)

    def _text(self, found: HandBeside, supposes: str | None, config: Config) -> str:
        """What was asked about first, then where both are, the figures of both, and how each goes on."""
        place = Part(0, self._place(found, config))
        told = [place]
        if supposes in OF_ALL:
            told.insert(0, Part(0, self._overall(found, supposes)))
        elif supposes in OF_DISTANCE:
            told = [Part(0, self._first(found, found.clearance, supposes)), Part(0, self._distance(found))]
        elif supposes in OF_CALM:
            told = [Part(0, self._first(found, found.calm, supposes)), Part(0, self._calm(found))]
        else:
            told += [Part(1, self._distance(found)), Part(2, self._calm(found))]
        if supposes in OF_ALL:
            told += [Part(1, self._distance(found)), Part(1, self._calm(found))]
        told.append(Part(3, self._ends(found, config)))
        if not config.certain:
            told.append(Part(2, self._say("by_chance")))
        return within(told)

    def _first(self, found: HandBeside, sign: int, supposes: str) -> str:
        """Yes or no, or which of the two; neither where both are alike."""
        if sign == 0:
            return self._say("neither")
        if supposes in WHO:
            return capital(self._say("leader", "you" if sign > 0 else "other", who=self._who(found)))
        yes = (sign > 0) is not (supposes in CONTRARY)
        return self._say("first", word=self._sayings.say("ahead", "answer", "agree" if yes else "disagree"))

    def _overall(self, found: HandBeside, supposes: str) -> str:
        """Yes or no where one of them is behind in nothing; else what each is ahead in."""
        signs = {"place": found.progress, "distance": found.clearance, "calm": found.calm}
        values = set(signs.values()) - {0}
        if len(values) < 2:
            return self._first(found, values.pop() if values else 0, supposes)
        by = [[self._say("points", name) for name, sign in signs.items() if sign == side] for side in (1, -1)]
        yours, others = (self._sayings.joined(each) for each in by)
        return self._say("partly", yours=yours, others=others, who=self._who(found))

    def _place(self, found: HandBeside, config: Config) -> str:
        """Where the planner would be, seen from where the person is."""
        hand, other, who = found.hand, found.other, self._who(found)
        rows = abs(hand.rows_left - other.rows_left)
        apart = self._say(
            "rows", "one" if rows == 1 else "many", count=rows, metres=self._metres(rows, config)
        )
        left = self._metres(hand.rows_left, config)
        ago = in_seconds(self._sayings, found.now - found.other_end[1], config)
        parts = {"who": who, "apart": apart, "metres": left, "seconds": ago}
        if Outcome.CRASH in (hand.outcome, other.outcome):
            key = "both_crash" if hand.outcome is other.outcome else "crash"
            if key == "crash" and hand.outcome is not Outcome.CRASH:
                key = "other_crash"
                parts["metres"] = self._metres(other.rows_left, config)
        elif other.outcome is Outcome.SUCCESS:
            both = hand.outcome is Outcome.SUCCESS
            sooner = found.other_end[1] < found.now
            key = ("both_sooner" if sooner else "both_alike") if both else "other_arrived"
        elif hand.outcome is Outcome.SUCCESS:
            key, parts["metres"] = "arrived", self._metres(other.rows_left, config)
        else:
            key = "level" if rows == 0 else "ahead" if hand.rows_left < other.rows_left else "behind"
        return capital(self._say("place", key, **parts))

    def _distance(self, found: HandBeside) -> str:
        """How near what moves came to each."""
        hand, other = self._gap(found.hand), self._gap(found.other)
        return self._say("distance", hand=hand, other=other, who=self._who(found))

    def _calm(self, found: HandBeside) -> str:
        """Stops and lane changes of each."""
        return self._say(
            "calm",
            tick=found.took,
            hand=self._counted(found.hand),
            other=self._counted(found.other),
            who=self._who(found),
        )

    def _ends(self, found: HandBeside, config: Config) -> str:
        """How it goes on from where each of them is."""
        if found.hand.outcome is not Outcome.RUNNING and found.other.outcome is not Outcome.RUNNING:
            return ""
        hand = self._end(found.hand_end, found.now, config)
        other = self._end(found.other_end, found.now, config)
        who = self._who(found)
        if found.hand.outcome is not Outcome.RUNNING:
            return capital(self._say("ends", "other", end=other, who=who))
        if found.other.outcome is not Outcome.RUNNING:
            return self._say("ends", "hand", end=hand, who=who)
        return self._say("ends", "both", hand=hand, other=other, who=who)

    def _end(self, end: tuple[Outcome, int], now: int, config: Config) -> str:
        outcome, tick = end
        return self._say("end", str(outcome), seconds=in_seconds(self._sayings, tick - now, config))

    def _gap(self, stretch: Stretch) -> str:
        if stretch.outcome is Outcome.CRASH:
            return self._say("gap", "crash")
        if stretch.gap_m is None:
            return self._say("gap", "none")
        gap_m = stretch.gap_m
        return self._say("gap", "of", metres=self._sayings.number(round(gap_m, 1 if gap_m >= 1 else 2)))

    def _counted(self, stretch: Stretch) -> str:
        stops, changes = stretch.stops, stretch.changes
        return self._say(
            "counted",
            stops=self._say("stops", "one" if stops == 1 else "many", count=stops),
            changes=self._say("changes", "one" if changes == 1 else "many", count=changes),
        )

    def _metres(self, rows: int, config: Config) -> str:
        return self._sayings.number(rows * config.cell_m)

    def _who(self, found: HandBeside) -> str:
        return self._say("i") if found.own else self._sayings.planner(found.planner)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("hand_beside", *keys, **parts)
