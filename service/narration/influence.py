"""Answers about others and the ego: who braked or turned for it, and what made its drive most difficult."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.episode_rollout import EpisodeRollout
from sim.explain.influence import Influence, Trouble, Troublemaker, influence, trouble
from sim.state import SimState
from sim.types import Kind, Outcome

MOST_TOLD: Final = 3
"""Times that are told one by one."""
OF_THE_PAST: Final = ("too_long",)
"""Refusals whose words stand among those of the past."""


class Influences:
    """Answers to "did another car have to brake because of us?" and "which car gave us the most trouble?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "trouble":
                kind = None if ask.kind is None else Kind(ask.kind)
                found = trouble(timeline, kind)
                text, facts = self._trouble(found, timeline.state, kind), _trouble_json(found)
            else:
                swayed = influence(timeline)
                text, facts = self._swayed(swayed, asked), _json(swayed)
        except QuestionError as error:
            file = "history" if error.code in OF_THE_PAST else None
            told = (
                not_so(self._sayings, error.code, error.facts)
                if file is None
                else self._sayings.say(file, error.code, **error.facts)
            )
            return plain(self._sayings, ask, timeline.state, told)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _swayed(self, found: Influence, asked: Asked) -> str:
        """Yes or no, how often, and the first times."""
        words = yes_and_no(self._sayings, asked)
        config = asked.timeline.state.config
        seconds = in_seconds(self._sayings, found.ticks, config)
        if not found.found:
            key = "none" if found.heeding else "never"
            told = [Part(0, self._say("swayed", key, seconds=seconds, **words))]
            return within([*told, Part(1, self._say("swayed", "rule") if found.heeding else "")])
        each = []
        for one in found.found[:MOST_TOLD]:
            naming = Naming(self._sayings, one.before, as_seen=False)
            key = "turned" if one.turned else "braked"
            each.append(self._say("swayed", key, who=naming.thing(one.id), tick=one.tick))
        if more := len(found.found) - len(each):
            each.append(self._say("swayed", "more", count=more))
        key = "once" if len(found.found) == 1 else "often"
        parts = self._sayings.joined(each)
        told = [Part(0, self._say("swayed", key, count=len(found.found), parts=parts, **words))]
        return within([*told, Part(1, self._say("swayed", "measure", seconds=seconds))])

    def _trouble(self, found: Trouble, now: SimState, kind: Kind | None) -> str:
        """The first, how many moves were for it, and how the drive goes without it."""
        noun = self._say("trouble", "anything") if kind is None else self._sayings.things(kind, 2)
        if not found.found:
            key = "straight" if not found.moves else "by_hand" if found.by_hand else "none"
            return self._say("trouble", key, count=found.moves, things=noun)
        first = found.found[0]
        there = now if now.world.find(first.id) is not None else found.state
        who = Naming(self._sayings, there, as_seen=False).thing(first.id)
        ticks = self._sayings.joined([str(tick) for tick in first.ticks[:MOST_TOLD]])
        key = "one" if len(first.ticks) == 1 else "many"
        told = self._say("trouble", key, who=who, count=len(first.ticks), moves=found.retaken, ticks=ticks)
        parts = [Part(0, capital(told)), Part(1, self._again(found, first))]
        if len(found.found) > 1 and len(found.found[1].ticks) == len(first.ticks):
            parts.append(Part(2, self._say("trouble", "as_much")))
        return within(parts)

    def _again(self, found: Trouble, first: Troublemaker) -> str:
        if first.without is None:
            return ""
        if first.without.path == found.real.path:
            return self._say("trouble", "same")
        if (first.without.outcome, first.without.driven) == (found.real.outcome, found.real.driven):
            return self._say("trouble", "alike", end=self._end(first.without, found.state))
        ends = {"end": self._end(first.without, found.state), "real": self._end(found.real, found.state)}
        return self._say("trouble", "again", **ends)

    def _end(self, story: EpisodeRollout, state: SimState) -> str:
        seconds = in_seconds(self._sayings, story.driven, state.config)
        return self._sayings.say(
            "whatif",
            "ends",
            "silent" if story.silent is not None else str(story.outcome),
            a="" if story.cause is None else self._sayings.say("words", "a", story.cause.kind),
            ticks=self._sayings.say("whatif", "seconds", seconds=seconds),
            planner=self._sayings.planner(state.config_of(None).planner, "id"),
        )

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("influence", *keys, **parts)


def _json(found: Influence) -> Json:
    return {
        "first": found.first,
        "ticks": found.ticks,
        "heeding": found.heeding,
        "swayed": [
            {"id": each.id, "kind": each.kind, "tick": each.tick, "turned": each.turned}
            for each in found.found
        ],
    }


def _trouble_json(found: Trouble) -> Json:
    return {
        "moves": found.moves,
        "retaken": found.retaken,
        "outcome": found.real.outcome,
        "driven": found.real.driven,
        "trouble": [
            {
                "id": each.id,
                "kind": each.kind,
                "ticks": list(each.ticks),
                "outcome_without": Outcome.RUNNING if each.without is None else each.without.outcome,
                "driven_without": None if each.without is None else each.without.driven,
            }
            for each in found.found
        ],
    }
