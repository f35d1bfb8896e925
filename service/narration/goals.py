"""What a search for a goal found, and what a driving style is, as replies: with the figures measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from service.actions import Goal
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked, Fact, Resolved
from service.styles import styles
from sim.actions import Prefer, Set
from sim.goals import Drive, Finding
from sim.state import SimState
from sim.types import PLACEABLE

FILE = "goals"


class Goals:
    """Replies to goals and styles in one language."""

    def __init__(
        self,
        sayings: Sayings,
        scenario: Callable[[SimState], str],
        done: Callable[[tuple[Fact, ...]], str],
    ) -> None:
        """`scenario`: tells a new road; `done`: tells what was done."""
        self._sayings = sayings
        self._scenario = scenario
        self._done = done

    def said(self, fact: Resolved) -> str:
        """What was done for a goal or a style."""
        if isinstance(fact.action, Goal):
            assert fact.finding is not None
            return self._found(fact, fact.finding)
        return f"{self._style(fact.action.style)} {self._done(fact.done)}"

    def _style(self, name: str) -> str:
        known = self._sayings.words(FILE, "styles")
        if name not in known:
            return self._say("style", name=name)
        return self._sayings.say(FILE, "styles", name, "now")

    def _found(self, fact: Resolved, found: Finding) -> str:
        told = [self._change(fact, found), self._ticks(found), self._room(found)]
        told += self._drives(found)
        told.append(self._say("tried", count=found.tried))
        return " ".join(sentence for sentence in told if sentence)

    def _change(self, fact: Resolved, found: Finding) -> str:
        if found.goal in ("surprise", "hard_but_solvable", "separates"):
            said = self._scenario(found.state)
            settings = [action for action in found.actions if isinstance(action, Set)]
            seeds = [action.value for action in settings if action.parameter == "seed"]
            return f"{said} {self._say('seed', seed=seeds[-1])}" if seeds else said
        moved = [thing.kind for each in fact.done for thing in (*each.added, *each.removed)]
        counts = Counter(moved)
        things = self._sayings.joined(
            [
                self._say("counted", count=counts[kind], things=self._sayings.things(kind, counts[kind]))
                for kind in PLACEABLE
                if counts[kind]
            ]
        )
        return self._say(found.goal, things=things, lane=found.lane, row=found.row)

    def _ticks(self, found: Finding) -> str:
        after = self._seconds(found.after.ticks, found)
        if found.before is None:
            opened = found.goal == "easier"
            return self._say("ticks_opened" if opened else "ticks", after=after)
        key = "ticks_alike" if found.after.ticks == found.before.ticks else "ticks_other"
        return self._say(key, after=after, before=self._seconds(found.before.ticks, found))

    def _seconds(self, ticks: int, found: Finding) -> str:
        return in_seconds(self._sayings, ticks, found.state.config)

    def _room(self, found: Finding) -> str:
        if found.before is None or not found.before.room:
            return ""
        percent = round(100 * (found.after.room / found.before.room - 1))
        if not percent:
            return ""
        return self._say("room_less" if percent < 0 else "room_more", percent=abs(percent))

    def _drives(self, found: Finding) -> list[str]:
        """How the planners drive it, and how they drove the road as it was."""
        before = {each.planner: each for each in found.drives_before}
        return [self._drive(each, before.get(each.planner), found) for each in found.drives]

    def _drive(self, drive: Drive, before: Drive | None, found: Finding) -> str:
        planner = self._sayings.planner(drive.planner, "with")
        seconds = self._seconds(drive.ticks, found)
        said = self._sayings.say(FILE, "drives", drive.outcome, planner=planner, seconds=seconds)
        if before is None:
            return self._say("drive", said=said)
        same = (before.outcome, before.ticks) == (drive.outcome, drive.ticks)
        key = "as_before" if same else before.outcome.value
        was = self._sayings.say(FILE, "before", key, seconds=self._seconds(before.ticks, found))
        return self._say("drive_before", said=said, before=was)

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say(FILE, key, **parts)


class Styles:
    """Answers to "which driving styles are there?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        told = [self._line(name, actions) for name, actions in styles().items()]
        text = self._sayings.say(FILE, "styles_are", styles=self._sayings.listed(told))
        return plain(self._sayings, asked.ask, asked.timeline.state, text)

    def _line(self, name: str, actions: tuple[Prefer | Set, ...]) -> str:
        """A style as it is asked for, and what it sets."""
        words = self._sayings.words(FILE, "styles")
        said = self._sayings.say(FILE, "styles", name, "say") if name in words else name
        wishes = [action for action in actions if isinstance(action, Prefer)]
        cleared = len(wishes) > 1  # before others, to weigh evenly is where they start from
        parts = [
            self._part(action)
            for action in actions
            if not (cleared and isinstance(action, Prefer) and action.preference == "balanced")
        ]
        return self._sayings.say(FILE, "style_is", say=said, parts=self._sayings.joined(parts))

    def _part(self, action: Prefer | Set) -> str:
        if isinstance(action, Prefer):
            return self._sayings.say(FILE, "wishes", action.preference)
        named = self._sayings.words(FILE, "settings")
        key = action.parameter if action.parameter in named else "other"
        name = self._sayings.say("replies", "parameters", action.parameter)
        return self._sayings.say(FILE, "settings", key, name=name, value=action.value)
