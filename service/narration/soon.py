"""Answers about the near future: how safe it is now, and what happens in the next ticks."""

from __future__ import annotations

from collections.abc import Sequence

from service.contract.encode.ahead import safe_move_json
from service.contract.encode.soon import coming_json, risk_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.assurance import assurance_told
from service.narration.charges import in_seconds
from service.narration.futures_told import counted_told, end_told
from service.narration.move_list import moves_told
from service.narration.naming import Naming
from service.narration.nearest import nearest_seen
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.safe_move import SafeMove
from sim.explain.safest_moves import safest_moves, safety
from sim.explain.soon import ComingTicks, RiskNow, coming_ticks, risk_now
from sim.types import Mode


class Soon:
    """Answers to "how safe are we?" and "what will happen in the next three ticks?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        try:
            text, facts = self._told(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        if state.mode is Mode.MANUAL:
            text = f"{self._sayings.say('ahead', 'by_hand')} {text}"
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _told(self, asked: Asked) -> tuple[str, Json]:
        timeline = asked.timeline
        if asked.ask.what == "risk":
            found = risk_now(timeline)
            nearest = nearest_seen(timeline.state)
            return self._risk(found, nearest), risk_json(found, nearest)
        if asked.ask.what == "safest":
            moves = safest_moves(timeline)
            return self._safest(moves), {"safest": [safe_move_json(each) for each in moves]}
        coming = coming_ticks(timeline, asked.ask.ticks or 1)
        return self._coming(coming, crash_first=asked.supposes == "crash"), coming_json(coming)

    def _safest(self, found: Sequence[SafeMove]) -> str:
        """The safest moves, with how sure that is; then those that would crash."""
        best = [each for each in found if safety(each) == safety(found[0])]
        first = best[0]
        listed = self._moves(best)
        if not first.safe:
            told = [Part(0, self._say("safest", "none", moves=listed))]
        else:
            told = [Part(0, self._say("safest", "one" if len(best) == 1 else "many", moves=listed))]
            told.append(Part(1, assurance_told(self._sayings, first.assurance, first.state, safe=True)))
        bad = [each for each in found if each.then is None and not each.off_road]
        if bad:
            told.append(Part(1, self._say("safest", "crash", moves=self._moves(bad))))
        return within(told)

    def _moves(self, found: Sequence[SafeMove]) -> str:
        return self._sayings.joined([self._sayings.move(each.move, "doing") for each in found])

    def _risk(self, found: RiskNow, nearest: str | None) -> str:
        """The chance of a crash, how sure that is, whether standing is safe, and the nearest thing."""
        sure = found.confidence
        key = "none" if not sure.crashes else "sure" if sure.crashes == 1.0 else "some"
        if sure.futures is not None:
            key = {"none": "none_drawn", "sure": "sure_drawn", "some": "some"}[key]
        elif key == "none" and found.foresight.by_chance:
            key = "none_chance"
        told = self._say(
            "risk",
            key,
            end=end_told(self._sayings, found.foresight),
            share=counted_told(self._sayings, sure.crashes, sure.futures),
        )
        assured = assurance_told(self._sayings, found.assurance, found.state, safe=not sure.crashes)
        parts = [Part(0, told), Part(1, assured)]
        if found.stay is not None:
            parts.append(Part(1, self._say("stay", "safe" if found.stay.safe else "unsafe")))
        if nearest is not None:
            who = Naming(self._sayings, found.state).thing(nearest)
            parts.append(Part(2, self._sayings.say("world", "nearest", who=who)))
        return within(parts)

    def _coming(self, found: ComingTicks, *, crash_first: bool = False) -> str:
        """The moves of the next ticks, then whether anything is hit, with its chance; or that first."""
        story, config = found.story, found.state.config
        seconds = in_seconds(self._sayings, found.ticks, config)
        key = "one_run" if found.branched else "moves"
        told = [Part(0, self._say(key, seconds=seconds, moves=moves_told(self._sayings, story.path)))]
        if found.branched:
            share = counted_told(self._sayings, found.crashes, found.futures)
            told.append(Part(0, self._say("crash", "chance" if found.crashes else "no_chance", share=share)))
        else:
            told.append(Part(0, self._ended(found)))
        return within(reversed(told) if crash_first else told)

    def _ended(self, found: ComingTicks) -> str:
        """How it ends within these ticks, or that nothing is hit."""
        story = found.story
        if story.silent is not None:
            planner = self._sayings.planner(found.state.config_of(None).planner, "id")
            return self._say("end", "silent", planner=planner)
        return self._say(
            "end",
            str(story.outcome),
            a="" if story.cause is None else self._sayings.say("words", "a", story.cause.kind),
            seconds=in_seconds(self._sayings, story.driven, found.state.config),
        )

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("soon", *keys, **parts)
