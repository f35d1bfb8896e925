"""Answers about how much the search of a planner looks at for one decision."""

from __future__ import annotations

from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.moments import state_at
from sim.explain.planners import planner_of
from sim.explain.search_effort import search_effort
from sim.planner_names import canonical
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Outcome

SEARCHES = "astar"
"""The only planner that expands nodes one at a time."""


class SearchEfforts:
    """Answers to "how many nodes does A* expand?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Without a planner's name the one that drives is meant."""
        ask, state = asked.ask, asked.timeline.state
        name = canonical(ask.planner or planner_of(state))
        planner = self._sayings.planner(name)
        if name != SEARCHES:
            text = self._say("none", planner=planner)
            facts: dict[str, object] = {"expanded": None}
        else:
            at = _last_decided(asked.timeline)
            found = search_effort(at)
            key = "one" if found.searches == 1 else "many" if found.searches else "no_way"
            text = self._say(
                key, planner=planner, tick=at.world.tick, count=found.expanded, searches=found.searches
            )
            text = f"{text} {self._say('uncounted')}"
            facts = {"expanded": found.expanded, "of_tick": at.world.tick}
        return plain(self._sayings, ask, state, text) | {"what": ask.what, "planner": name} | facts

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("search_effort", *keys, **parts)


def _last_decided(timeline: Timeline) -> SimState:
    """The present state, or the last one of the drive in which a move was decided."""
    state = timeline.state
    if state.world.outcome is Outcome.RUNNING or state.world.ended is None:
        return state
    return state_at(timeline, max(state.world.episode_start, state.world.ended - 1))
