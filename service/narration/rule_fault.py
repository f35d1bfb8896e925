"""Answers about the part of a planner's rules in a crash, and whose a crash would be that came now."""

from __future__ import annotations

from collections.abc import Sequence

from service.contract.encode.blame import blame_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.crash import Crashes
from service.narration.futures_told import yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.blame import Fault
from sim.explain.episode_rollout import decided
from sim.explain.foresight import driving, running_state
from sim.explain.rule_fault import RuleFault, rule_fault
from sim.perceive.registry import sensor_named
from sim.plan import traits_of
from sim.state import SimState
from sim.transition import step
from sim.types import Mode

MOST_PLANNERS = 4
"""Planners that are named."""
_AT_FAULT = (Fault.EGO, Fault.SHARED, Fault.PLANNER)
"""Crashes in which the planner's choice had a part."""


class RuleFaults:
    """Answers to "did your rules contribute to the crash?", "was that a bug?", "whose would one be?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._crashes = Crashes(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where there was no crash, that is the answer."""
        ask, timeline = asked.ask, asked.timeline
        if ask.what == "liable":
            return self._liable(asked)
        try:
            found = rule_fault(timeline, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, self._crashes.not_so(error))
        text = within([*self._part(found, asked), Part(1, self._method(found)), *self._others(found)])
        facts: Json = {"what": ask.what, "since": found.since}
        facts |= {"kept_clear": list(found.kept_clear), "crashed_too": list(found.crashed)}
        return plain(self._sayings, ask, timeline.state, text) | facts | blame_json(found.blame)

    def _part(self, found: RuleFault, asked: Asked) -> list[Part]:
        """Yes or no, and what decided the fatal move."""
        blame, words = found.blame, yes_and_no(self._sayings, asked)
        decision = blame.decision
        if asked.ask.what == "bug":
            broken = blame.fault is Fault.PLANNER
            first = self._say("bug", "broken" if broken else "sound", **words)
        else:
            key = "part" if blame.fault in _AT_FAULT else "none"
            key = "unknown" if blame.fault is Fault.UNKNOWN else key
            first = self._say("rules", key, **words)
        ids = [name for name in blame.crash.cause.ids if name != decision.av]
        parts: dict[str, object] = {
            "who": Naming(self._sayings, blame.state, as_seen=False).things(ids),
            "did": self._sayings.move(decision.move, "did"),
            "planner": self._sayings.planner(decision.planner, "id"),
            "fault": "" if decision.fault is None else self._sayings.fault(decision.fault),
        }
        last = blame.avoidable.last
        key = str(blame.fault)
        if last is not None and blame.fault in (Fault.EGO, Fault.SHARED):
            parts |= {"tick": last.tick, "doing": self._sayings.move(last.instead, "doing")}
            key = "could"
        return [Part(0, first), Part(0, self._say("move", key, **parts))]

    def _method(self, found: RuleFault) -> str:
        """That it looks no further than the coming move, where that is so."""
        decision = found.blame.decision
        if decision.asked is not None or decision.fault is not None:
            return ""
        if traits_of(decision.planner).plans_to_goal:
            return ""
        key = "passages" if traits_of(decision.planner).by_passages else "near"
        return self._say(key, planner=self._sayings.planner(decision.planner, "id"))

    def _others(self, found: RuleFault) -> list[Part]:
        """Which planners keep clear from then on, and which do not."""
        told = []
        for key, names in (("clear", found.kept_clear), ("crash", found.crashed)):
            if names:
                form = "one" if len(names) == 1 else "many"
                listed = self._planners(names)
                told.append(Part(2, self._say("others", key, form, planners=listed, tick=found.since)))
        return told

    def _planners(self, names: Sequence[str]) -> str:
        some = [self._sayings.planner(each) for each in names[:MOST_PLANNERS]]
        more = len(names) - len(some)
        return self._sayings.joined([*some, *([self._say("more", count=more)] if more else [])])

    def _liable(self, asked: Asked) -> Json:
        """Whose a crash would be that came now, by the duty that `fault` goes by."""
        ask, timeline = asked.ask, asked.timeline
        try:
            state = running_state(timeline, None)
            free = self._free(state)
        except QuestionError as error:
            refused = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, refused)
        by_hand = state.ego().mode is Mode.MANUAL
        told = [Part(0, self._say("liable", "by_hand" if by_hand else "mine"))]
        if free:
            told.append(Part(1, self._say("liable", "free", moves=self._sayings.joined(free))))
        told.append(Part(1, self._say("liable", "other")))
        if not sensor_named(state.config.sensor).faithful:
            told.append(Part(1, self._say("liable", "sensor")))
        told.append(Part(2, self._say("liable", "measure")))
        facts = {"what": ask.what, "by_hand": by_hand}
        return plain(self._sayings, ask, timeline.state, within(told)) | facts

    def _free(self, state: SimState) -> list[str]:
        """The moves that are seen to meet nothing now."""
        decision = decided(step(driving(state)), None)
        if decision is None:
            return []
        return [
            self._sayings.move(each.move, "name")
            for each in decision.options
            if each.cell is not None and not each.reason.blocks
        ]

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("rule_fault", *keys, **parts)
