"""One door to all that is said: decisions, events, replies, answers."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from service.narration.answers import Answers
from service.narration.charges import seconds_worth
from service.narration.episode_end import Ends
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.options import Options
from service.narration.planner_reasons import planner_reasons
from service.narration.replies import Replies
from service.narration.rules import Rules
from service.narration.sayings import Sayings
from service.narration.side_by_side import SidesBySide
from service.narration.values import speed
from service.resources import DEFAULT_LANGUAGE
from service.sessions.facts import AliasChange, Answerable, Fact, SideBySideTexts
from service.sessions.scheduler.playback_speed import PlaybackSpeed
from sim.decide import sense
from sim.events import Event, EventType
from sim.explain.side_by_side import SideBySide
from sim.explain.telling import telling_option
from sim.forecast import Forecast
from sim.perceive import sensor_named
from sim.plan import Decision, Measure, Option
from sim.state import SimState
from sim.types import Move

REMEMBERED = 4_096
"""So many sentences are kept for being said again."""

ENDS = (EventType.ARRIVED, EventType.CRASHED, EventType.STUCK)


class Narrator:
    """Words for facts, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._replies = Replies(sayings)
        self._answers = Answers(sayings, self.decision)
        self._ends = Ends(sayings)
        self._rules = Rules(sayings)
        self._options = Options(sayings)
        self._sides = SidesBySide(sayings)
        self._first_choice = self._say("first_choice")
        self._by_name = False
        self._told: dict[Hashable, str] = {}
        """Sentences said before, by all they are made of: the same few are said again and again."""

    @classmethod
    def load(cls, code: str = DEFAULT_LANGUAGE, folder: Path | None = None) -> Narrator:
        """A narrator of the language `code`."""
        narrator = cls(Sayings.load(code, folder))
        narrator._by_name = folder is None
        return narrator

    def __reduce__(self) -> tuple[Callable[[str], Narrator | None], tuple[str]]:
        """By name, since a worker process has the same files. Raises `TypeError` for sayings of its own."""
        if not self._by_name:
            raise TypeError("sayings that were not loaded by the name of their language")
        return _narrator, (self.language,)

    @property
    def language(self) -> str:
        """The code of the language."""
        return self._sayings.language

    def in_language(self, code: str) -> Narrator:
        """The same in another language; as it is where there are no sayings in that."""
        return self if code == self.language else _narrator(code) or self

    def failed(self) -> str:
        """What is said when the simulation has met a defect of its own."""
        return self._sayings.say("log", "events", "failed")

    def slowed(self) -> str:
        """What is said when decisions take longer than a tick lasts."""
        return self._sayings.say("log", "events", "slowed")

    def decision(self, decision: Decision, run: SimState, forecast: Forecast | None = None) -> str:
        """What the vehicle does at a tick and why, in one line.

        `forecast`: what it was decided by, where that is known already.
        """
        if decision.fault is not None:
            return self._say(
                "fault",
                planner=self._sayings.planner(decision.planner, "id"),
                fault=self._sayings.fault(decision.fault),
            )
        asked, first = decision.asked, decision.options[0]
        ranked = decision.measure is Measure.RANK
        if first.move is decision.move is Move.FORWARD and ranked and asked is None:
            return self._straight_on(first, run)  # said most, by far
        naming = Naming(self._sayings, run)
        if asked is not None:
            return self._asked(decision, asked, naming)
        if decision.measure is Measure.OWN:
            return self._own(decision, naming)
        if not ranked:
            return self._weighed(decision, run, naming, forecast)
        chosen = decision.chosen
        if chosen.reason.blocks:
            return self._say("no_safe_way", reason=self._sayings.met(chosen, "now", naming))
        telling = telling_option(run, decision, forecast)
        if first.reason.blocks and decision.move is not Move.STAY and telling is not None:
            return self._other(decision.move, telling, naming)
        ahead = planner_reasons(self._sayings, decision, run, forecast)
        if ahead is not None:
            return self._say("other", move=self._named(decision.move), reason=ahead.reason("now", telling))
        if decision.move is not Move.STAY:
            if telling is None:
                return self._say("none_open", move=self._named(decision.move))
            return self._other(decision.move, telling, naming)
        return self._say("no_way")

    def _other(self, move: Move, met: Option, naming: Naming) -> str:
        """Another move than the first, for what that would have met."""
        things = naming.kinds_and_places(met.causes)
        key = (move, met.move, met.reason, things)
        told = None if things is None else self._told.get(key)
        if told is None:
            told = self._say("other", move=self._named(move), reason=self._sayings.met(met, "now", naming))
            self._remember(None if things is None else key, told)
        return told

    def _straight_on(self, chosen: Option, run: SimState) -> str:
        """Straight on, in a word; in a few more where something is passed closely, or the goal is near."""
        if chosen.cell is not None and chosen.cell[1] == 0:
            return self._say("into_the_goal")
        world = run.world
        faithful = sensor_named(run.config.sensor).faithful
        movers = world.movers if faithful else sense(run)[0].movers
        passed = [movers[cell] for cell in _beside(world.road.columns, world.avs[0]) if cell in movers]
        if passed:
            return self._passing(passed, Naming(self._sayings, run))
        return self._first_choice

    def _passing(self, passed: list[str], naming: Naming) -> str:
        """Straight on, closely past these."""
        things = naming.kinds_and_places(passed)
        key = ("passing", things)
        told = None if things is None else self._told.get(key)
        if told is None:
            told = self._say("passing", who=naming.things(passed))
            self._remember(None if things is None else key, told)
        return told

    def _remember(self, key: Hashable | None, told: str) -> None:
        """Keep a sentence for being said again, where all is known that it is made of."""
        if key is not None:
            if len(self._told) >= REMEMBERED:
                self._told.clear()
            self._told[key] = told

    def options(self, decision: Decision) -> list[str]:
        """A few words for each option of a decision, in their order."""
        return self._options.texts(decision)

    def side_by_side(self, found: SideBySide) -> SideBySideTexts:
        """A counterfactual beside the real run: what differs, and how each of the two ends."""
        return self._sides.texts(found)

    def alias_change(self, lesson: AliasChange) -> str:
        """The reply to a phrase that was taught or forgotten."""
        return self._replies.lesson(lesson)

    def event(self, event: Event, run: SimState) -> str:
        """One line of the log."""
        if event.type in ENDS:
            return self._ends.text(run)
        if event.type is EventType.NO_WAY:
            return self._no_way(event, run)
        if event.rule is not None:
            return self._rules.event(event, self._replies)
        ticks = run.world.episode_tick
        reason = ""
        if event.type is EventType.HELD_BACK and event.move is not None:
            how = event.how or "free"
            reason = self._sayings.in_the_way(how, event.move, event.ids, "then", Naming(self._sayings, run))
        said = self._sayings.say(
            "log",
            "events",
            event.type,
            episode=event.episode,
            ticks=ticks,
            seconds=self._sayings.number(ticks * run.config.step_seconds),
            who=self._pointed_at(event, run),
            where="" if event.cell is None else self._sayings.where(event.cell),
            move="" if event.move is None else self._sayings.move(event.move, "name"),
            reason=reason,
            planner=self._sayings.planner(run.config.planner, "id"),
            fault=self._sayings.fault(event.how or "") if event.type is EventType.PLANNER_FAILED else "",
        )
        return capital(said)

    def _pointed_at(self, event: Event, run: SimState) -> str:
        """The things of an event, as they are where they stand."""
        if not event.ids:
            return ""
        return Naming(self._sayings, run, as_seen=False).things(event.ids)

    def _no_way(self, event: Event, run: SimState) -> str:
        if not event.ids:
            return self._sayings.say("log", "no_way", event.how or "plain")
        form = "one" if len(event.ids) == 1 else "many"
        return self._sayings.say("log", "no_way", "without", form, who=self._pointed_at(event, run))

    def rules(self, run: SimState) -> list[dict[str, Any]]:
        """The rules that stand, as JSON values."""
        return self._rules.listed(run.triggers)

    def speed(self, pace: PlaybackSpeed) -> str:
        """A playback speed."""
        return speed(self._sayings, pace)

    def planner(self, name: str) -> str:
        """A planner as people know it."""
        return self._sayings.planner(name)

    def planner_timeout(self, planner: str, fault: str) -> str:
        """What is said when a planner did not answer in time and a person is to drive."""
        return self._sayings.say(
            "log",
            "events",
            "planner_silent",
            planner=self._sayings.planner(planner, "id"),
            fault=self._sayings.fault(fault),
        )

    def reply(self, facts: tuple[Fact, ...]) -> str:
        """The reply: what was done, in a sentence for each fact."""
        return self._replies.done(facts)

    def answer(self, asked: Answerable) -> dict[str, Any]:
        """The answer to a question, as JSON values."""
        return self._answers.answer(asked)

    def _weighed(self, decision: Decision, run: SimState, naming: Naming, forecast: Forecast | None) -> str:
        """The move of a planner that knows what each costs in all, against going straight on."""
        name = self._named(decision.move)
        straight, chosen = decision.option(Move.FORWARD), decision.chosen
        if chosen.cost is None:
            if chosen.reason.blocks:
                return self._say("no_safe_way", reason=self._sayings.met(chosen, "now", naming))
            known = "unknown" if run.config.reacting else "proved"
            told = "waits" if decision.move is Move.STAY else "moves"
            return self._sayings.say("log", "decisions", "no_way_on", known, told, move=name)
        if decision.move is Move.FORWARD:
            return self._say("first_choice")
        if straight.cost is None:
            if straight.dead_end:
                return self._say("leads_nowhere", move=name)
            if telling_option(run, decision, forecast) is not straight:
                return self._say("none_open", move=name)
            return self._say("other", move=name, reason=self._sayings.met(straight, "now", naming))
        more = straight.cost - chosen.cost
        worth = seconds_worth(self._sayings, more, decision.measure, run.config_of(decision.av))
        return self._say(f"saves_{decision.measure}", move=name, more=worth)

    def _own(self, decision: Decision, naming: Naming) -> str:
        """The move of another package's planner, with what is so, and without a reason: none is known."""
        name, straight = self._named(decision.move), decision.option(Move.FORWARD)
        if decision.chosen.reason.blocks:
            reason = self._sayings.met(decision.chosen, "now", naming)
            return self._say(
                "own_though", move=name, planner=self._sayings.planner(decision.planner, "id"), reason=reason
            )
        if decision.move is Move.FORWARD:
            return self._say("first_choice")
        if straight.reason.blocks:
            reason = self._sayings.met(straight, "now", naming)
            return self._say(
                "own_past", move=name, planner=self._sayings.planner(decision.planner, "id"), reason=reason
            )
        return self._say("own", move=name, planner=self._sayings.planner(decision.planner, "id"))

    def _asked(self, decision: Decision, asked: Move, naming: Naming) -> str:
        if decision.held_back:
            reason = self._sayings.met(decision.option(asked), "now", naming)
            return self._say("held_back", move=self._sayings.move(asked, "name"), reason=reason)
        return self._say("asked", move=self._named(decision.move))

    def _named(self, move: Move) -> str:
        """A move at the beginning of a sentence."""
        return self._sayings.named_move(move)

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("log", "decisions", key, **parts)


@cache
def _narrator(code: str) -> Narrator | None:
    try:
        return Narrator.load(code)
    except FileNotFoundError:
        return None


@lru_cache(maxsize=4_096)
def _beside(columns: int, av: int) -> tuple[int, ...]:
    """The cells ahead on either side of a vehicle's own lane."""
    ahead, column = av - columns, av % columns
    sides = [ahead - 1] if column else []
    sides += [ahead + 1] if column < columns - 1 else []
    return tuple(cell for cell in sides if cell >= 0)
