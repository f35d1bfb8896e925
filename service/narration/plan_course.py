"""Answers about the ways that were planned: what one was at a tick, and how often the plan changed."""

from __future__ import annotations

from collections import Counter
from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.move_list import way_told
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.plan_course import PlanChange, PlanCourse, WayThen, plan_course, way_then

WHETHER: Final = "whether"
"""What a question supposes that wants yes or no first (`Asked.supposes`)."""


class PlansTold:
    """Answers to "what was the plan at tick 5?", "how often did the plan change?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            text, facts = self._changes(asked) if ask.what == "plan_changes" else self._plan(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _changes(self, asked: Asked) -> tuple[str, Json]:
        """How often what was left of the way was given up, why, and where the two differed most."""
        found = plan_course(asked.timeline)
        facts: Json = {
            "planner": found.planner,
            "plans_ways": found.searching,
            "decisions": found.decisions,
            "changes": [
                {
                    "tick": each.tick,
                    "why": each.why,
                    "by": each.by,
                    "other_cells": each.cells,
                    "lanes_apart": each.lanes,
                    "ticks_later": each.later,
                }
                for each in found.changes
            ],
        }
        planner = self._sayings.planner(found.planner)
        if not found.searching:
            told = [self._say("moves", planner=planner), self._turns(found)]
            return " ".join(told), facts
        count = len(found.changes)
        parts = [Part(0, self._say(*self._count_key(count), count=count, ticks=found.decisions))]
        if asked.supposes == WHETHER:
            parts.insert(0, Part(0, self._yes(count)))
        biggest = found.biggest
        if biggest is None:
            parts.append(Part(1, self._say("held")))
        else:
            parts += [Part(2, self._reasons(found)), Part(1, self._biggest(biggest, alone=count == 1))]
        return within(parts), facts

    @staticmethod
    def _count_key(count: int) -> tuple[str, str]:
        return "count", "none" if not count else "one" if count == 1 else "many"

    def _turns(self, found: PlanCourse) -> str:
        key = "one" if found.turns == 1 else "many"
        return self._say("turns", key, turns=found.turns, decisions=found.decisions)

    def _reasons(self, found: PlanCourse) -> str:
        """How often for which reason; empty for a single change, whose reason is told with it."""
        if len(found.changes) < 2:
            return ""
        listed = [
            self._say("reason", count=count, why=self._say("short", why))
            for why, count in Counter(each.why for each in found.changes).most_common()
        ]
        return self._say("reasons", listed=self._sayings.joined(listed))

    def _biggest(self, change: PlanChange, *, alone: bool) -> str:
        if change.why == "blocked" and change.by is not None:
            who = Naming(self._sayings, change.state).thing(change.by)
            why = self._say("blocked_by", who=who)
        else:
            why = self._say("whys", change.why)
        apart = self._say("apart", lanes=change.lanes) if change.lanes > 1 else ""
        key = ("only" if alone else "biggest") if change.cells else "no_cells"
        return self._say(key, tick=change.tick, cells=change.cells, apart=apart, why=why)

    def _plan(self, asked: Asked) -> tuple[str, Json]:
        """The moves that were planned at a tick, and how many of them were made so."""
        found = way_then(asked.timeline, asked.ask.tick)
        tick, planner = found.state.world.tick, self._sayings.planner(found.planner)
        way = found.way
        facts: Json = {
            "at": tick,
            "planner": found.planner,
            "plans_ways": found.searching,
            "moves": None if way is None else list(way.moves),
            "cells": None if way is None else [list(each) for each in way.cells],
            "kept": found.kept,
            "left": found.left,
        }
        if way is None:
            return self._say("no_way", tick=tick, planner=planner), facts
        if not found.searching:
            move = self._sayings.move(way.moves[0], "name")
            return self._say("one_move", tick=tick, planner=planner, move=move), facts
        seconds = self._sayings.number(len(way.moves) * found.state.config.step_seconds)
        told = self._say(
            "way",
            "one" if len(way.moves) == 1 else "many",
            tick=tick,
            planner=planner,
            count=len(way.moves),
            seconds=seconds,
            moves=way_told(self._sayings, way.moves),
        )
        return within([Part(0, told), Part(1, self._kept(found, asked.timeline.tick))]), facts

    def _kept(self, found: WayThen, now: int) -> str:
        assert found.way is not None
        planned = len(found.way.moves)
        if found.kept == planned:
            return self._say("kept", "all")
        if found.ended:
            return self._say("kept", "ended", kept=found.kept)
        if not found.left:
            return self._say(
                "kept", "not_yet" if now == found.state.world.tick else "so_far", kept=found.kept
            )
        key = "none" if not found.kept else "one" if found.kept == 1 else "some"
        return self._say("kept", key, kept=found.kept)

    def _yes(self, so: object) -> str:
        return self._say(
            "first_word", answer=self._sayings.say("ahead", "answer", "agree" if so else "disagree")
        )

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("plan_course", *keys, **parts)
