"""Answers about what lies ahead: safe moves, the arrival, a crash, being stuck, and what would help."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any, Final

from service.contract.encode.ahead import (
    arrival_json,
    crash_ahead_json,
    repair_json,
    safe_move_json,
    stuck_json,
)
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.asked_moment import until, where_stuck
from service.narration.assurance import assurance_told
from service.narration.charges import in_seconds
from service.narration.crash_ahead import CrashesAhead
from service.narration.futures_told import counted_told, end_told, share_told, yes_and_no
from service.narration.naming import Naming
from service.narration.repair import Repairs
from service.narration.sayings import Sayings
from service.narration.scene_told import SceneTold
from service.sessions.facts import Asked
from sim.decide import sense
from sim.explain import QuestionError
from sim.explain.ahead import Arrival, StuckAhead, arrival, crash_ahead, stuck_ahead
from sim.explain.planners import planner_of
from sim.explain.repair import repair
from sim.explain.safe_move import SafeMove, safe_move
from sim.explain.scene import describe_percept
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Move, Outcome

_LEADS_ON: Final = ("way", "arrive_how")
"""What is asked of how it could go on."""


START: Final = "start"
"""What a question supposes that is about the first tick of the drive."""


class Outlooks:
    """Answers to "is it safe to go left?", "when will we arrive?", "will you crash?", "are you stuck?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._crashes = CrashesAhead(sayings)
        self._repairs = Repairs(sayings)
        self._ways: dict[str, Callable[[Asked], tuple[str, Json]]] = {
            "safe": self._safe,
            "arrival": self._arrival,
            "crash": self._crash,
            "stuck": self._stuck,
            "way": self._way_through,
            "wait": self._wait,
            "arrive_how": self._arrive_how,
            "avoid_how": self._avoid_how,
        }

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where the episode has ended, that is the answer.

        What would have led on, where it is stuck, is told of the tick at which it got no further; what led on
        at the start, of the first one.
        """
        ask, state = asked.ask, asked.timeline.state
        earlier = None
        if ask.what in _LEADS_ON:
            if asked.supposes == START:
                earlier = until(asked.timeline, state.world.episode_start)
            else:
                earlier = where_stuck(asked.timeline)
        if earlier is not None:
            answer = self.answer(replace(asked, timeline=earlier, supposes=None))
            text = self._sayings.say("past", "viewed", "then", tick=earlier.tick, text=answer["text"])
            return answer | {"text": text}
        try:
            text, facts = self._ways[str(ask.what)](asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        running = state.world.outcome is Outcome.RUNNING
        if running and state.ego().mode is Mode.MANUAL and ask.what != "safe":
            # Whoever steers asks of the way straight on as well.
            straight = self._straight_on(state) if ask.what == "crash" else ""
            text = within([Part(1, straight), Part(0, f"{self._say('by_hand')} {text}")])
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _straight_on(self, state: SimState) -> str:
        """What is met straight on."""
        return SceneTold(self._sayings, state, describe_percept(sense(state)[0], state.config)).way()

    def _safe(self, asked: Asked) -> tuple[str, Json]:
        found = safe_move(asked.timeline, asked.ask.move or Move.STAY)
        text = self._safe_text(found, yes_and_no(self._sayings, asked))
        sure = assurance_told(self._sayings, found.assurance, found.state, safe=found.safe)
        parts = [Part(0, text), Part(1, self._given_away(found)), Part(2, sure)]
        return within(parts), safe_move_json(found)

    def _safe_text(self, found: SafeMove, first: dict[str, str]) -> str:
        """Yes or no, `first` as words, and why."""
        if found.off_road:
            return self._say("safe", "off_road", **first)
        if found.hit is not None or found.then is None:
            ids = () if found.hit is None else found.hit.ids
            naming = Naming(self._sayings, found.state, as_seen=False)
            names = [name for name in ids if name not in found.state.egos or name != found.state.ego().id]
            return self._say("safe", "hit", who=naming.things(names), **first)
        end = end_told(self._sayings, found.then, since=found.state.world.tick)
        if found.safe:
            doing = self._sayings.move(found.move, "doing")
            return self._say("safe", "good" if found.proved else "sampled", end=end, doing=doing, **first)
        if found.then.by_chance:
            share = share_told(self._sayings, found.then.crashes, found.then.chances)
            return self._say("safe", "crash_chance", share=share, **first)
        return self._say("safe", "crash", end=end, **first)

    def _given_away(self, found: SafeMove) -> str:
        return self._say("safe", "gives_away") if found.then is not None and found.open is False else ""

    def _arrival(self, asked: Asked) -> tuple[str, Json]:
        found = arrival(asked.timeline)
        sure, state = found.confidence, found.state
        if sure.arrives == 0.0:
            parts = [Part(0, self._never(found)), *self._ways_there(found)]
            return within(parts), arrival_json(found)
        first, last = sure.arrival_ticks or (0, 0)
        facts = {"metres": self._metres(state)}
        if first == last and sure.arrives == 1.0 and sure.futures is None:
            return self._say("arrival", "sure", seconds=self._seconds(last, state), **facts), arrival_json(
                found
            )
        text = self._say(
            "arrival",
            "chance",
            first=self._seconds(first, state),
            last=self._seconds(last, state),
            share=self._share(found),
            **facts,
        )
        return text, arrival_json(found)

    def _share(self, found: Arrival) -> str:
        return counted_told(self._sayings, found.confidence.arrives, found.confidence.futures)

    def _never(self, found: Arrival) -> str:
        planner = self._sayings.planner(planner_of(found.state), "with")
        if found.confidence.chance and found.confidence.method != "one_run":
            return self._say("arrival", "never_chance", planner=planner)
        return self._say("arrival", "never", planner=planner, end=end_told(self._sayings, found.foresight))

    def _ways_there(self, found: Arrival) -> list[Part]:
        """Another planner that arrives, or a way that does, or that there is none."""
        if found.instead is not None:
            seen = found.instead.foresight
            planner = self._sayings.planner(found.instead.planner, "with")
            if seen.by_chance:
                share = share_told(self._sayings, seen.arrives, seen.chances)
                return [Part(1, self._say("arrival", "instead_chance", planner=planner, share=share))]
            seconds = self._seconds(seen.story.ticks, found.state)
            return [Part(1, self._say("arrival", "instead", planner=planner, seconds=seconds))]
        if found.plan is not None:
            return [Part(1, self._way("arrival", found.plan, found.state))]
        shut = found.outlook is not None and not found.outlook.open
        return [Part(1, self._say("arrival", "shut"))] if shut else []

    def _way(
        self, table: str, plan: tuple[Move, ...], state: SimState, key: str = "way", **parts: object
    ) -> str:
        doing = self._sayings.move(plan[0], "doing")
        return self._say(table, key, seconds=self._seconds(len(plan), state), doing=doing, **parts)

    def _crash(self, asked: Asked) -> tuple[str, Json]:
        found = crash_ahead(asked.timeline)
        return self._crashes.text(found, plainly=asked.supposes == "reason"), crash_ahead_json(found)

    def _stuck(self, asked: Asked) -> tuple[str, Json]:
        if (over := _ended_stuck(asked.timeline)) is not None:
            return within([Part(0, self._say("stuck", "over")), *self._held_up(asked.timeline)]), over
        found = stuck_ahead(asked.timeline)
        return within(self._stuck_parts(found)), stuck_json(found)

    def _held_up(self, timeline: Timeline) -> list[Part]:
        """Since when an ego that ended stuck came no nearer to the goal, and whether a way led there then."""
        earlier = where_stuck(timeline)
        if earlier is None:
            return []
        told = [Part(0, self._say("stuck", "since", tick=earlier.tick))]
        with suppress(QuestionError):
            found = stuck_ahead(earlier)
            shut = found.outlook
            if shut is not None and not shut.open:
                who = Naming(self._sayings, found.state, as_seen=False).things(shut.ids)
                told.append(Part(0, self._say("stuck", "was_late" if shut.late else "was_shut")))
                told.append(Part(1, self._say("stuck", "without", who=who) if shut.ids else ""))
            elif found.plan is not None:
                planner = self._sayings.planner(planner_of(found.state), "with")
                told.append(Part(0, self._way("stuck", found.plan, found.state, "missed", planner=planner)))
        return told

    def _stuck_parts(self, found: StuckAhead) -> list[Part]:
        shut = found.outlook
        if shut is not None and not shut.open:
            naming = Naming(self._sayings, found.state, as_seen=False)
            without = self._say("stuck", "without", who=naming.things(shut.ids)) if shut.ids else ""
            return [Part(0, self._say("stuck", "late" if shut.late else "shut")), Part(1, without)]
        end = end_told(self._sayings, found.foresight)
        if found.stuck:
            planner = self._sayings.planner(planner_of(found.state), "with")
            plan = found.plan
            open_way = "" if plan is None else self._way("stuck", plan, found.state)
            return [Part(0, self._say("stuck", "planner", planner=planner, end=end)), Part(1, open_way)]
        if found.waits and found.waits < found.foresight.story.driven and not found.foresight.by_chance:
            seconds = self._seconds(found.waits, found.state)
            return [Part(0, self._say("stuck", "waiting", seconds=seconds, end=end))]
        return [Part(0, self._say("stuck", "going", end=end))]

    def _way_through(self, asked: Asked) -> tuple[str, Json]:
        """Whether any way leads to the goal, and whether the planner takes one."""
        found = stuck_ahead(asked.timeline)
        if (shut := found.outlook) is not None and not shut.open:
            who = Naming(self._sayings, found.state, as_seen=False).things(shut.ids)
            without = self._say("stuck", "without", who=who) if shut.ids else ""
            parts = [Part(0, self._say("way", "late" if shut.late else "shut")), Part(1, without)]
        elif found.outlook is None and found.foresight.arrives == 0.0:
            parts = [Part(0, self._say("way", "slips" if found.state.config.slips else "unknown"))]
        else:
            end = end_told(self._sayings, found.foresight)
            taken = "taken" if found.foresight.arrives > 0.0 else "missed"
            planner = self._sayings.planner(planner_of(found.state), "with")
            parts = [Part(0, self._say("way", taken, end=end, planner=planner))]
            if found.plan is not None:
                parts.append(Part(1, self._way("way", found.plan, found.state)))
        return within(parts), stuck_json(found)

    def _wait(self, asked: Asked) -> tuple[str, Json]:
        """How long the ego stays where it is."""
        found = stuck_ahead(asked.timeline)
        path = found.foresight.story.path
        if found.waits >= len(path):
            return within(self._stuck_parts(found)), stuck_json(found)
        parts = {
            "do": self._sayings.move(path[found.waits], "do"),
            "doing": self._sayings.move(path[found.waits], "doing"),
            "seconds": self._seconds(found.waits, found.state),
        }
        key = "now" if not found.waits else "one_run" if found.foresight.by_chance else "later"
        return self._say("wait", key, **parts), stuck_json(found)

    def _arrive_how(self, asked: Asked) -> tuple[str, Json]:
        found = repair(asked.timeline, "arrive")
        return self._repairs.text(found), repair_json(found)

    def _avoid_how(self, asked: Asked) -> tuple[str, Json]:
        found = repair(asked.timeline, "avoid")
        facts: dict[str, Any] = repair_json(found)
        if found.reached:
            return self._repairs.text(found), facts
        crash = crash_ahead(asked.timeline)
        ways = self._crashes.avoiding(crash)
        return within([*ways, *self._repairs.parts(found)]), facts | crash_ahead_json(crash)

    def _metres(self, state: SimState) -> str:
        return self._sayings.number(state.world.road.cell(state.world.av)[1] * state.config.cell_m)

    def _seconds(self, ticks: int, state: SimState) -> str:
        return in_seconds(self._sayings, ticks, state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("ahead", *keys, **parts)


def _ended_stuck(timeline: Timeline) -> Json | None:
    """The facts where the episode has ended stuck already; else None."""
    world = timeline.state.world
    return {"stuck": True, "outcome": world.outcome} if world.outcome is Outcome.STUCK else None
