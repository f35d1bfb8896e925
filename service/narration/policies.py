"""Answers about driving by a simple rule: "if I keep pressing forward, do I crash?"."""

from __future__ import annotations

from service.contract.encode.ahead import foresight_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told, share_told, yes_and_no
from service.narration.sayings import Sayings
from service.narration.supposed_ends import ARRIVES, FAILS
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.driving_policy import Policy, PolicyRun, policy_run
from sim.types import Mode, Outcome


class Policies:
    """Answers to "what if you never changed lanes?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """What comes of the rule from now or from a tick on, and what comes as it is."""
        ask, timeline = asked.ask, asked.timeline
        try:
            tick = ask.tick
            if ask.lane is not None and tick is None:  # "what if you had driven in lane 3": from the start
                tick = timeline.state.world.episode_start
            found = policy_run(timeline, Policy(str(ask.what)), tick, lane=ask.lane)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        parts = [
            Part(0, self._agreed(found, asked)),
            Part(1, self._moment(found, asked)),
            Part(0, self._told(found)),
            Part(1, self._lane(found)),
            Part(0, self._by_hand(found)),
            Part(1, self._as_it_is(found)),
            Part(2, "" if ask.tick is None else self._since(found, ask.tick)),
        ]
        return plain(self._sayings, ask, found.state, within(parts)) | {"policy": policy_json(found)}

    def _agreed(self, found: PolicyRun, asked: Asked) -> str:
        """Yes or no, where that was asked, does not hang on chance, and is so by hand as well."""
        share = {ARRIVES: found.arrives, FAILS: found.crashes}.get(str(asked.supposes))
        untold = found.outcome is Outcome.RUNNING
        if share not in (0.0, 1.0) or found.by_hand is not None or (untold and found.chances is None):
            return ""
        word = yes_and_no(self._sayings, asked)["yes" if share else "no"]
        return self._sayings.say("whatif", "yes_no", word=word)

    def _moment(self, found: PolicyRun, asked: Asked) -> str:
        """From when on it is driven so, where that is not now."""
        tick = found.state.world.tick
        if asked.ask.tick is not None:
            return self._sayings.say("whatif", "from_tick", tick=tick)
        if asked.timeline.state.world.ended is not None or asked.ask.lane is not None:
            return self._sayings.say("whatif", "driven_again", "start", tick=tick)
        return ""

    def _lane(self, found: PolicyRun) -> str:
        """When it comes to the lane that it is driven to, and for how long it is in it."""
        if found.lane is None:
            return ""
        return lane_told(self._sayings, found)

    def _told(self, found: PolicyRun) -> str:
        """How it ends, with its chance where that is left to chance."""
        supposed = self._say("supposed", found.policy, lane=found.lane)
        if found.as_it_is:
            key = "anyway_by_planner" if self._went_otherwise(found) else "anyway"
            return self._say(key, supposed=supposed, end=end_told(self._sayings, found.real))
        if found.chances is not None and found.by_chance:
            crash = share_told(self._sayings, found.crashes, found.chances)
            arrive = share_told(self._sayings, found.arrives, found.chances)
            return self._say("chance", supposed=supposed, crash=crash, arrive=arrive)
        config = found.state.config
        return self._say(
            "ends",
            found.outcome,
            supposed=supposed,
            a="" if found.cause is None else self._sayings.say("words", "a", found.cause.kind),
            seconds=in_seconds(self._sayings, len(found.path), config),
            metres=self._sayings.number(found.cells * config.cell_m),
        )

    def _by_hand(self, found: PolicyRun) -> str:
        """How it ends where a person asks for the same, so that the step into something is held back."""
        if found.by_hand is None:
            return ""
        if found.by_hand.outcome is Outcome.CRASH:
            return self._say("by_hand", "crash")
        return self._say("by_hand", "clear" if found.by_hand.outcome is Outcome.SUCCESS else "stuck")

    def _as_it_is(self, found: PolicyRun) -> str:
        if found.as_it_is:
            return ""
        key = "by_planner" if self._went_otherwise(found) else "as_it_is"
        return self._say(key, end=end_told(self._sayings, found.real))

    def _went_otherwise(self, found: PolicyRun) -> bool:
        """Whether it does not go as the planner alone would have it: a person has, or had, a hand in it."""
        return bool(found.said_since) or found.state.mode is Mode.MANUAL

    def _since(self, found: PolicyRun, tick: int) -> str:
        return self._sayings.say("whatif", "said_since", tick=tick) if found.said_since else ""

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "policy", *keys, **parts)


def lane_told(sayings: Sayings, found: PolicyRun) -> str:
    """When a run to a lane comes to it, and for how long it is in it."""
    config = found.state.config
    if found.lane_after is None:
        return sayings.say("whatif", "policy", "lane", "never", lane=found.lane)
    after = in_seconds(sayings, found.lane_after, config)
    seconds = in_seconds(sayings, found.ticks_in_lane, config)
    key = "reached" if found.lane_after else "there"
    return sayings.say("whatif", "policy", "lane", key, lane=found.lane, after=after, seconds=seconds)


def policy_json(found: PolicyRun) -> Json:
    """The run as JSON values."""
    return {
        "name": found.policy,
        "from_tick": found.state.world.tick,
        "outcome": found.outcome,
        "ticks": len(found.path),
        "path": list(found.path),
        "hit": [] if found.cause is None else list(found.cause.ids),
        "crashes": found.crashes,
        "arrives": found.arrives,
        "futures": None if found.chances is None else found.chances.futures,
        "by_hand": None if found.by_hand is None else found.by_hand.outcome,
        "as_it_is": foresight_json(found.real),
        "lane": found.lane,
        "lane_after": found.lane_after,
        "ticks_in_lane": found.ticks_in_lane,
    }
