"""Where two planners first decide otherwise on this road, both run from its beginning."""

from __future__ import annotations

from service.contract.encode.planners import planners_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.options import Options
from service.narration.planners import Planners
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.planners import planners_beside


class PlannerPartings:
    """Answers to "at which tick do A* and Dijkstra first differ?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._options = Options(sayings)
        self._planners = Planners(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Of one planner, it is beside the one that drives."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = planners_beside(timeline, ask.planners or ())
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        parting = found.decided(found.others[0])
        if parting is None:
            names = [self._sayings.planner(each.planner) for each in (found.own, *found.others)]
            first = self._sayings.say("planners", "never_part", planners=self._sayings.joined(names))
        else:
            first = self._planners.parting(parting, found.state, past=True)
        ends = (self._planners.end_line(each) for each in (found.own, *found.others))
        text = within([Part(0, first), *(Part(1, end) for end in ends)])
        facts = planners_json(found)
        if parting is not None:
            texts = self._options.texts(parting.own), self._options.texts(parting.other)
            facts = planners_json(found, parting, texts)
        return plain(self._sayings, ask, found.state, text) | {"what": ask.what} | facts
