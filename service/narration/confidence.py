"""Answers to "how sure are you?": that it arrives, and how clear the last move was."""

from __future__ import annotations

from math import ceil, floor

from service.contract.encode.confidence import confidence_json
from service.narration.answerer import Json, plain
from service.narration.charges import seconds_worth
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.confidence import Clarity, Confidence, Method, confidence
from sim.explain.facts import QuestionError
from sim.perceive import sensor_named
from sim.plan import Measure
from sim.state import SimState
from sim.types import Outcome


class Confidences:
    """Answers to questions about certainty."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        try:
            found = confidence(asked.timeline)
        except QuestionError as error:
            return plain(self._sayings, asked.ask, run, self._not_so(error))
        return plain(self._sayings, asked.ask, run, self.text(found, run)) | confidence_json(found)

    def text(self, found: Confidence, run: SimState) -> str:
        """How sure, in two sentences or three. `run`: the moment it is about."""
        told = self._sure(found, run)
        if run.config.slips and found.method is not Method.ONE_RUN:
            told = f"{told} {self._say('slips')}"
        if found.by_hand:
            return self._say("by_hand", told=told)
        clarity = None if found.clarity is None else self._clarity(found.clarity, run)
        return told if clarity is None else f"{told} {clarity}"

    def _sure(self, found: Confidence, run: SimState) -> str:
        ticks = found.arrival_ticks or found.end_ticks
        sampled = found.method is Method.SAMPLED
        return self._say(
            "sure",
            self._key(found, run),
            when="" if ticks is None else self._when(ticks, run),
            percent=_of_sample(found) if sampled else self._percent(found.stated),
            low=self._percent(found.low),
            high=self._percent(found.high),
            futures=found.futures,
            arrived=round(found.arrives * (found.futures or 0)),
            ends=self._ends(found),
        )

    def _key(self, found: Confidence, run: SimState) -> str:
        """Which sentence it is."""
        if found.method is Method.SAMPLED:
            key = {1.0: "sampled_all", 0.0: "sampled_none"}.get(found.arrives, "sampled")
            return f"{key}_one" if found.futures == 1 else key
        if found.shut_off == 1.0:
            return "shut_off"
        if found.method is Method.ALL_FUTURES:
            return {1.0: "all_arrive", 0.0: "none_arrives"}.get(found.arrives, "exact")
        if found.arrives:
            if found.chance:
                return "one_run_no_matter"
            return "one_run_arrives" if sensor_named(run.config.sensor).faithful else "one_run_errs"
        if found.crashes:
            return "one_run_crashes"
        last = run.world.episode_tick + (found.end_ticks or (0, 0))[1]
        return "one_run_repeats" if last <= run.config.max_ticks else "one_run_stuck"

    def _ends(self, found: Confidence) -> str:
        """How it ends when it does not arrive."""
        shares = {"crashes": found.crashes, "stuck": found.stuck, "shut_off": found.shut_off}
        ends = {self._say("ends", key): share for key, share in shares.items() if share}
        if len(ends) == 1:
            return self._say("rest" if found.arrives else "each", ends=next(iter(ends)))
        return self._sayings.joined(
            [self._say("share", ends=end, percent=self._percent(share)) for end, share in ends.items()]
        )

    def _clarity(self, clarity: Clarity, run: SimState) -> str:
        """The last move against the next best."""
        decision = clarity.decision
        move = self._sayings.move(decision.move, "name")
        other = "" if clarity.next_best is None else self._sayings.move(clarity.next_best, "name")
        gap = clarity.gap or 0.0
        return self._say(
            "clarity",
            _clarity_key(clarity),
            move=move,
            other=other,
            seconds=seconds_worth(self._sayings, gap, decision.measure, run.config_of(decision.av)),
            planner=self._sayings.planner(decision.planner, "id"),
        )

    def _when(self, ticks: tuple[int, int], run: SimState) -> str:
        first, last = (self._sayings.number(each * run.config.step_seconds) for each in ticks)
        key = "one" if first == last else "many"
        return self._say("when", key, seconds=first, first=first, last=last)

    def _percent(self, share: float) -> str:
        """Whole per cent; all or none only where it is exactly so."""
        if 0.0 < share < 0.01:
            return self._say("below")
        if 0.99 < share < 1.0:
            return self._say("above")
        return f"{100 * share:.0f}"

    def _not_so(self, error: QuestionError) -> str:
        parts = dict(error.facts)
        if isinstance(outcome := parts.get("outcome"), Outcome):
            parts["outcome"] = self._sayings.say("answers", "outcomes", outcome)
        if isinstance(fault := parts.get("fault"), str):
            parts["fault"] = self._sayings.fault(fault)
        return self._say(error.code.removeprefix("confidence_"), **parts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("confidence", *keys, **parts)


def _clarity_key(clarity: Clarity) -> str:
    decision = clarity.decision
    if decision.measure is Measure.OWN:
        return "own"
    if decision.measure is not Measure.RANK:
        if decision.chosen.cost is None:
            return "no_way"
        if clarity.gap is None:
            return "only_way"
        return f"gap_{decision.measure}" if clarity.gap else "even"
    if not clarity.free:
        return "none_free"
    if decision.chosen.dead_end:
        return "no_way"
    if decision.move is decision.options[0].move:
        return "first"
    if clarity.next_best is None:
        return "only" if clarity.free == 1 else "only_way"
    return "on_in_order" if any(option.dead_end for option in decision.preferred) else "in_order"


def _of_sample(found: Confidence) -> int:
    """Whole per cent of a sample, which shows neither that all nor that none arrive; bounds outwards."""
    if found.arrives == 1.0:
        return floor(100 * found.low)
    if found.arrives == 0.0:
        return ceil(100 * found.high)
    return min(99, max(1, round(100 * found.stated)))
