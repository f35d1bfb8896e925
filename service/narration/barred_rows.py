"""Answers about rows of barriers ahead: which lanes are closed, which free, and which of those help."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from service.contract.encode.barred import barred_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, plain
from service.narration.asked_moment import where_stuck
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.barred_rows import BarredRow, BarredRows, barred_rows
from sim.types import Outcome

PREFACE_WORDS: Final = 3
"""Words that say of which tick it is."""
WHOLE: Final = "whole"
"""What a question supposes that asks whether the barriers close the whole road."""
WHICH: Final = "which"
"""The same where it asks which lanes they close, to which neither yes nor no is an answer."""


class BarredRowsTold:
    """Answers to "is there a gap in the barriers?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Of a drive that ended stuck it is told where it got no further."""
        earlier = where_stuck(asked.timeline)
        state = asked.timeline.state if earlier is None else earlier.state
        found = barred_rows(state)
        words = yes_and_no(self._sayings, asked)
        if asked.supposes == WHOLE:
            words = {"yes": words["no"], "no": words["yes"]}
        most = MOST_WORDS if earlier is None else MOST_WORDS - PREFACE_WORDS
        text = self._text(found, {} if asked.supposes == WHICH else words, most)
        if earlier is not None:
            text = self._sayings.say("past", "viewed", "then", tick=earlier.tick, text=text)
        return (
            plain(self._sayings, asked.ask, asked.timeline.state, text)
            | {"what": asked.ask.what}
            | (barred_json(found))
        )

    def _text(self, found: BarredRows, words: dict[str, str], most: int) -> str:
        if not found.rows:
            return self._say("none")
        row = found.rows[0]
        place = {"row": row.row, "metres": self._sayings.number(row.ahead * found.state.config.cell_m)}
        closed = self._closed(row)
        if not row.free:
            told = [Part(0, self._first(words.get("no"), self._say("whole", closed=closed, **place)))]
        else:
            lanes = self._lanes(row.free)
            gap = self._say("gap", lanes=lanes, closed=closed, **place)
            told = [Part(0, self._first(words.get("yes"), gap))]
            told += self._reached(found)
        told += self._next(found.rows[1:])
        return within(told, most)

    def _first(self, word: str | None, text: str) -> str:
        """The text after yes or no, where that is wanted."""
        return capital(text) if word is None else self._say("first", word=word, text=text)

    def _closed(self, row: BarredRow) -> str:
        parts = []
        for key, lanes in (("barrier", row.barriers), ("pothole", row.potholes)):
            if lanes:
                parts.append(self._say("closed", key, lanes=self._lanes(lanes)))
        return self._sayings.joined(parts)

    def _reached(self, found: BarredRows) -> list[Part]:
        """Which of the free lanes the ego can get to, and from which a way leads on."""
        if found.state.world.outcome is not Outcome.RUNNING or not found.gaps:
            return []
        reached = [each for each in found.gaps if each.ticks is not None]
        shut = [each.lane for each in found.gaps if each.ticks is None and each.shut_off]
        unknown = [each.lane for each in found.gaps if each.ticks is None and not each.shut_off]
        told = []
        if reached:
            first = min(reached, key=lambda each: (each.ticks or 0, each.lane))
            seconds = in_seconds(self._sayings, first.ticks or 0, found.state.config)
            lanes = self._lanes([each.lane for each in reached])
            key = "one" if len(reached) == 1 else "many"
            told.append(Part(0, self._say("reach", key, lanes=lanes, lane=first.lane, seconds=seconds)))
        if shut:
            key = "none" if len(shut) == len(found.gaps) else "some"
            told.append(Part(1, self._say("shut_off", key, lanes=self._lanes(shut))))
        if unknown:
            told.append(Part(2, self._say("unknown", lanes=self._lanes(unknown))))
        leads = [each.lane for each in reached if each.leads_on]
        if reached:
            key = "some" if leads else "none"
            told.append(Part(1, self._say("leads_on", key, lanes=self._lanes(leads) if leads else "")))
        return told

    def _next(self, rows: Sequence[BarredRow]) -> list[Part]:
        """The free lanes of the row of barriers after that."""
        if not rows:
            return []
        row = rows[0]
        key = "free" if row.free else "whole"
        lanes = self._lanes(row.free) if row.free else ""
        return [Part(3, self._say("next", key, row=row.row, lanes=lanes))]

    def _lanes(self, lanes: Sequence[int]) -> str:
        form = "one" if len(lanes) == 1 else "many"
        listed = self._sayings.joined([str(lane) for lane in lanes])
        return self._say("lanes", form, lanes=listed)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("barred", *keys, **parts)
