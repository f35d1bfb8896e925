"""Answers about a lane that is not taken: whether a move leads that way now, and what would come of it."""

from __future__ import annotations

from dataclasses import replace

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain, question
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told, share_told
from service.narration.naming import Naming
from service.narration.policies import Policies, lane_told, policy_json
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.driving_policy import Policy, PolicyRun, policy_run
from sim.explain.episode_rollout import decided
from sim.explain.foresight import driving, running_state
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Mode, Outcome


class LanesTaken:
    """Answers to "why don't you take lane 3?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._policies = Policies(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. A drive that has ended is driven again from its start."""
        ask, timeline = asked.ask, asked.timeline
        if timeline.state.world.ended is not None:
            again = replace(ask, about="what_if", what=Policy.TO_LANE.value)
            answer = self._policies.answer(replace(asked, ask=again, supposes=None))
            return answer | {"about": ask.about, "question": question(self._sayings, ask), "what": ask.what}
        try:
            decision = _next(timeline)
            found = policy_run(timeline, Policy.TO_LANE, lane=ask.lane)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told)
        by_hand = timeline.state.mode is Mode.MANUAL
        text = within(
            [
                Part(0, self._sayings.say("ahead", "by_hand") if by_hand else ""),
                Part(0, self._now(found, decision)),
                Part(0, self._then(found)),
                Part(1, lane_told(self._sayings, found) if found.lane_after != 0 else ""),
                Part(1, self._as_it_is(found)),
            ]
        )
        facts = {"what": ask.what, "policy": policy_json(found)}
        return plain(self._sayings, ask, timeline.state, text) | facts

    def _now(self, found: PolicyRun, decision: Decision | None) -> str:
        """Whether it is in that lane, or a move leads that way now, and what is in the way of one."""
        own = found.state.world.road.cell(found.state.world.av)[0] + 1
        if own == found.lane:
            return self._say("there", lane=own)
        if decision is None:
            return ""
        side = 1 if (found.lane or 0) > own else -1
        ways = [each for each in decision.options if each.move.offset[0] == side]
        free = [each for each in ways if not each.reason.blocks and each.cell is not None]
        planner = self._sayings.planner(decision.planner, "id")
        if free:
            moves = self._sayings.joined([self._sayings.move(each.move, "name") for each in free])
            key = "taken" if decision.move in [each.move for each in free] else "free"
            chosen = self._sayings.move(decision.move, "name")
            return self._say("now", key, moves=moves, planner=planner, chosen=chosen)
        aside = next(each for each in ways if not each.move.offset[1])
        reason = self._sayings.met(aside, "now", Naming(self._sayings, found.state))
        return self._say("now", "shut", reason=reason)

    def _then(self, found: PolicyRun) -> str:
        """What comes of keeping to that lane."""
        if found.as_it_is:
            return self._say("same", lane=found.lane)
        if found.by_chance:
            arrive = share_told(self._sayings, found.arrives, found.chances)
            crash = share_told(self._sayings, found.crashes, found.chances)
            return self._say("chance", lane=found.lane, arrive=arrive, crash=crash)
        return self._say(
            "ends",
            found.outcome,
            lane=found.lane,
            a="" if found.cause is None else self._sayings.say("words", "a", found.cause.kind),
            seconds=in_seconds(self._sayings, len(found.path), found.state.config),
        )

    def _as_it_is(self, found: PolicyRun) -> str:
        if found.as_it_is:
            return ""
        real = found.real
        told = self._sayings.say("whatif", "policy", "as_it_is", end=end_told(self._sayings, real))
        if found.by_chance or real.by_chance or (found.outcome, real.story.outcome) != (Outcome.SUCCESS,) * 2:
            return told
        saved = real.story.driven - len(found.path)
        key = "quicker" if saved > 0 else "slower" if saved else "alike"
        return f"{told} {self._say(key)}"

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("lane_taken", *keys, **parts)


def _next(timeline: Timeline) -> Decision | None:
    """The planner's next decision."""
    return decided(step(driving(running_state(timeline, None))), None)
