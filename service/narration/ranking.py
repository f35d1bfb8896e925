"""Answers about the second best move of a decision, and about what the planner made of each move."""

from __future__ import annotations

from service.contract.encode.soon import ranking_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import seconds_worth
from service.narration.inflection import capital
from service.narration.options import Options
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.ranking import Ranking, ranking
from sim.plan import Measure, Option


class Rankings:
    """Answers to "what was the second best move?" and "give me the scores of all moves"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._options = Options(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = ranking(timeline, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        text = self._second(found) if ask.what == "runner_up" else self._scores(found)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | ranking_json(found)

    def _second(self, found: Ranking) -> str:
        """The runner-up and how much worse it was; what shut the others where there was none."""
        decision, second = found.decision, found.runner_up
        made = self._sayings.move(decision.move, "name")
        if second is None:
            others = [option for option in decision.options if option.move is not decision.move]
            shut = [self._one(found, option) for option in others if option.reason.blocks]
            key = "none_free" if decision.chosen.reason.blocks else "none"
            told = Part(0, self._say("second", key, tick=decision.tick, made=made))
            return within([told, Part(1, self._shut(shut))])
        move = self._sayings.move(second.move, "name")
        key, worse = str(decision.measure), ""
        if found.gap is not None:
            key = key if found.gap > 0 else "even"
            config = found.state.config_of(decision.av)
            worse = seconds_worth(self._sayings, found.gap, decision.measure, config)
        told_second = self._say(
            "second",
            key,
            tick=decision.tick,
            move=move,
            made=made,
            seconds=worse,
            planner=self._sayings.planner(decision.planner, "with"),
        )
        return capital(told_second)

    def _shut(self, shut: list[str]) -> str:
        return self._sayings.say("choices", "shut", moves=self._sayings.listed(shut)) if shut else ""

    def _scores(self, found: Ranking) -> str:
        """Each move with what the planner made of it, in its order."""
        decision = found.decision
        each = [self._one(found, option) for option in decision.options]
        told = [Part(0, self._say("scores", tick=decision.tick, moves=self._sayings.listed(each)))]
        if decision.measure in (Measure.RANK, Measure.OWN):
            planner = self._sayings.planner(decision.planner, "with")
            told.append(Part(1, self._say("no_scores", str(decision.measure), planner=planner)))
        return within(told)

    def _one(self, found: Ranking, option: Option) -> str:
        """A move, and what the planner made of it; a difference of costs as seconds."""
        decision, name = found.decision, self._sayings.move(option.move, "name")
        texts = dict(zip(decision.options, self._options.texts(decision), strict=True))
        best, text = decision.chosen.cost, texts[option]
        weighed = decision.measure in (Measure.COST, Measure.TICKS)
        if weighed and option.cost is not None and best is not None and option.cost > best:
            config = found.state.config_of(decision.av)
            worse = seconds_worth(self._sayings, option.cost - best, decision.measure, config)
            text = self._say("worse", seconds=worse)
        return self._sayings.say("choices", "shut_one", move=name, met=text)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("ranking", *keys, **parts)
