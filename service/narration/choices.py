"""Answers about the moves that were open, what the coming one hangs on, and what past ones have cost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from service.contract.encode.choices import choices_json, losses_json, matters_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import CONTRARY, yes_and_no
from service.narration.naming import Naming
from service.narration.options import Options
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.coming_move import ComingMove, Flip, coming_decision, coming_move
from sim.explain.losses import Loss, Losses, losses
from sim.explain.query import decision_meant
from sim.forecast import StepVerdict
from sim.plan import Decision

MOST_FLIPS: Final = 3
"""Things the coming move hangs on that are told; the facts have all."""
MOST_LOSSES: Final = 3
"""Decisions told that cost the most."""
JUDGED: Final = "judged"
"""What a question supposes that asks whether anything was lost."""


class Choices:
    """Answers to "which moves were open?", "what matters now?", "which decision cost most?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._options = Options(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            text, facts = self._told(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _told(self, asked: Asked) -> tuple[str, Json]:
        timeline, ask = asked.timeline, asked.ask
        match ask.what:
            case "free":
                decision = coming_decision(timeline)[1]
                return self._open(decision, "now"), choices_json(decision)
            case "choices":
                decision = decision_meant(timeline, ask.tick, None)[1]
                return self._open(decision, "then"), choices_json(decision)
            case "matters":
                coming = coming_move(timeline)
                return self._hangs_on(coming), matters_json(coming)
            case _:
                lost = losses(timeline)
                return self._lost(lost, asked), losses_json(lost)

    def _open(self, decision: Decision, when: str) -> str:
        """The free moves of a decision, then what the others meet."""
        free = [option for option in decision.options if option.reason is StepVerdict.FREE]
        texts = dict(zip(decision.options, self._options.texts(decision), strict=True))
        shut = [
            self._say("shut_one", move=self._sayings.move(option.move, "name"), met=texts[option])
            for option in decision.options
            if option not in free
        ]
        names = self._sayings.joined([self._sayings.move(option.move, "name") for option in free])
        key = "open" if free else "none_open"
        made = self._sayings.move(decision.move, "name")
        told = [Part(0, self._say(key, when, moves=names, tick=decision.tick))]
        if when == "then":
            told.append(Part(0, self._say("made", move=made)))
        if shut:
            told.append(Part(1, self._say("shut", moves=self._sayings.listed(shut))))
        return within(told)

    def _hangs_on(self, found: ComingMove) -> str:
        """The coming move, and what changes it by being gone."""
        do = self._sayings.move(found.decision.move, "do")
        flips = found.flips[:MOST_FLIPS]
        if not flips:
            key = "nothing_tried" if found.explanation.untried else "nothing"
            return self._say("matters", key, do=do, move=self._sayings.move(found.decision.move, "name"))
        naming = Naming(self._sayings, found.state)
        key = "one" if len(flips) == 1 else "many"
        if len(flips[0].ids) > 1:
            key, flips = "together", flips[:1]
        told = self._say(
            "matters",
            key,
            do=do,
            move=self._sayings.move(found.decision.move, "name"),
            who=naming.things(flips[0].ids),
            instead=self._sayings.move(flips[0].move, "name"),
            listed=self._flips(flips, naming),
        )
        more = len(found.flips) - len(flips)
        return within([Part(0, told), Part(1, self._say("matters", "more", count=more) if more else "")])

    def _flips(self, flips: Sequence[Flip], naming: Naming) -> str:
        each = [
            self._say(
                "matters",
                "each",
                who=naming.things(flip.ids),
                instead=self._sayings.move(flip.move, "name"),
            )
            for flip in flips
        ]
        return self._sayings.listed(each)

    def _lost(self, found: Losses, asked: Asked) -> str:
        """What the moves of the episode have cost, the dearest ones first."""
        state = asked.timeline.state
        judged = asked.supposes in (JUDGED, CONTRARY)
        word = yes_and_no(self._sayings, asked)["yes" if found.found else "no"]
        first = self._say("losses", "first", word=word) if judged else ""
        unknown = self._say("losses", "unknown", count=found.unknown) if found.unknown else ""
        if not found.found:
            key = "none" if found.judged else "no_way"
            told = self._say("losses", key, count=found.judged)
            return within([Part(0, first if found.judged else ""), Part(0, told)])
        parts = [Part(0, first)]
        given = [loss for loss in found.found if loss.ticks is None]
        if given:
            parts.append(
                Part(
                    0,
                    self._say(
                        "losses",
                        "gave_away",
                        tick=given[0].tick,
                        move=self._sayings.move(given[0].move, "name"),
                    ),
                )
            )
        dear = [loss for loss in found.found if loss.ticks is not None]
        if dear:
            listed = self._sayings.listed([self._loss(loss, asked) for loss in dear[:MOST_LOSSES]])
            seconds = in_seconds(self._sayings, found.ticks, state.config)
            named = sum(loss.ticks or 0 for loss in dear[:MOST_LOSSES])
            key = "all" if len(dear) <= MOST_LOSSES else "most" if 2 * named > found.ticks else "some"
            parts.append(Part(0, self._say("losses", key, seconds=seconds, count=len(dear), listed=listed)))
        return within([*parts, Part(2, unknown)])

    def _loss(self, loss: Loss, asked: Asked) -> str:
        seconds = in_seconds(self._sayings, loss.ticks or 0, asked.timeline.state.config)
        move = self._sayings.move(loss.move, "name")
        return self._say("losses", "one", seconds=seconds, tick=loss.tick, move=move)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("choices", *keys, **parts)
