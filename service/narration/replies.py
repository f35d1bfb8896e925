"""What an utterance did, as a reply: a sentence for each thing done, with the figures that changed."""

from __future__ import annotations

from service.narration.goals import Goals
from service.narration.rearranged import told_rearranged
from service.narration.sayings import Sayings
from service.sessions.bookmarks import Bookmarked, Jumped
from service.sessions.facts import (
    Advised,
    AliasChange,
    Asked,
    Chatted,
    Dropped,
    Fact,
    PauseSet,
    Resolved,
    Stepped,
    Undone,
    Viewed,
    merge_changes,
)
from service.sessions.scheduler.playback_speed import MAX, PlaybackSpeed, PlaybackSpeedSet
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    MoveThings,
    Prefer,
    Remove,
    Replace,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
)
from sim.events import EventType
from sim.plan import traits_of
from sim.session.edits import Applied, Change
from sim.session.settings import AS_IT_IS, FROM_THE_NEXT_ROAD, NEEDS_A_NEW_ROAD
from sim.state import SimState
from sim.types import Mode


class Replies:
    """Replies in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._goals = Goals(sayings, self._scenario, self.done)

    def done(self, facts: tuple[Fact, ...]) -> str:
        """A sentence for each fact; questions are answered elsewhere."""
        told = [
            self._all_gone(group) if len(group) > 1 and _by_name(group[0]) else self._done(group[-1])
            for group in _grouped(facts)
        ]
        return " ".join(sentence for sentence in told if sentence)

    def lesson(self, lesson: AliasChange) -> str:
        """What was taught or forgotten, as the sentence that says the same."""
        key = "taught" if lesson.taught else "forgotten"
        said = self._say(key, phrase=lesson.phrase, sentence=lesson.sentence)
        if lesson.taught and lesson.before not in (None, lesson.sentence):
            said = f"{said} {self._say('taught_before', sentence=lesson.before)}"
        return said

    def _done(self, fact: Fact) -> str:
        match fact:
            case Applied():
                return self._applied(fact)
            case Resolved():
                return self._goals.said(fact)
            case PauseSet(before=before, paused=paused):
                key = "pause" if paused else "resume"
                return self._say(f"{key}_already" if before is paused else key)
            case PlaybackSpeedSet(before=before, after=after):
                key = "pace_already" if before == after else "pace"
                return self._say(key, before=speed(self._sayings, before), after=speed(self._sayings, after))
            case Stepped(ticks=ticks):
                key = "step_one" if len(ticks) == 1 else "step_many"
                return self._say(key, count=len(ticks), tick=fact.first_tick + len(ticks))
            case Undone():
                return self._undone(fact)
            case Dropped(question=question):
                return self._say("nothing_pending" if question is None else "dropped")
            case Bookmarked(name=name, tick=tick, again=again):
                return self._say("saved_again" if again else "saved", name=name, tick=tick)
            case Jumped(name=name, tick=tick):
                return (
                    self._say("rewound", tick=tick)
                    if name is None
                    else self._say("loaded", name=name, tick=tick)
                )
            case Viewed(view=view, shown=shown):
                name = self._sayings.say("replies", "views", view)
                return self._say("shown" if shown else "hidden", view=name)
            case Chatted(kind=kind):
                return self._sayings.say("chat", kind)
            case Asked() | Advised():
                return ""

    def _undone(self, fact: Undone) -> str:
        """What was undone or redone: the figures that changed, and how the clock runs."""
        key = "redo" if fact.again else "undo"
        if fact.steps > 1:
            key += "_many"
        told = self._diff(fact.changes)
        said = [
            self._say(key, diff=told, count=fact.steps)
            if told
            else self._say(f"{key}_plain", count=fact.steps)
        ]
        for change in fact.changes:
            if change.path == "paused":
                said.append(self._say("pause" if change.after else "resume"))
            if change.path == "playback_speed":
                pace = (speed(self._sayings, each) for each in (change.before, change.after))
                said.append(self._say("pace", **dict(zip(("before", "after"), pace, strict=True))))
        return " ".join(said)

    def _applied(self, applied: Applied) -> str:
        match applied.action:
            case Add():
                said = self._moved("add", applied)
            case Remove(kind=kind) if not applied.removed:
                said = self._say("remove_none", things=self._sayings.things(kind, 2))
            case Remove():
                said = self._moved("remove", applied)
            case SetCount(kind=kind, count=count):
                are = self._sayings.say("replies", "are", "one" if count == 1 else "many")
                changed = bool(applied.changes)
                said = self._say(
                    "set_count" if changed else "set_count_already",
                    are=are,
                    count=count,
                    things=self._sayings.things(kind, count),
                    diff=self._diff(applied.changes),
                )
            case MoveThings() | Swap() | Replace() | Copy() as action:
                said = told_rearranged(self._sayings, applied, action, self._diff(applied.changes))
            case Scenario():
                return self._scenario(applied.state)
            case SetMode(mode=mode):
                changed = any(change.path == "mode" for change in applied.changes)
                return self._say(f"mode_{mode}" if changed else "mode_already")
            case Prefer():
                return self._preferring(applied)
            case Set(parameter=parameter) | Adjust(parameter=parameter):
                return self._setting(parameter, applied)
            case Drive(move=move):
                key = "drive" if applied.state.mode is Mode.MANUAL else "drive_then_auto"
                said = self._say(key, move=self._sayings.move(move, "do"))
            case action:  # actions without parameters
                return self._say(action.do)
        started = any(event.type is EventType.EPISODE_STARTED for event in applied.events)
        return f"{self._say('road_first')} {said}" if started else said

    def _setting(self, parameter: str, applied: Applied) -> str:
        """What was set, from what to what, and when it shows."""
        name = self._sayings.say("replies", "parameters", parameter)
        changed = {change.path: change for change in applied.changes}
        change = changed.get(f"config.{parameter}")
        if change is None:
            value = getattr(applied.state.config, parameter, None) or AS_IT_IS.get(parameter, "")
            return self._say("set_already", name=name, value=self._value(parameter, value))
        before = self._say("unset") if change.before is None else self._value(parameter, change.before)
        said = self._say("set", name=name, before=before, after=self._value(parameter, change.after))
        if parameter in NEEDS_A_NEW_ROAD:
            kept = "episode" not in changed
            return f"{said} {self._say('road_kept') if kept else self._scenario(applied.state)}"
        counted = self._diff(applied.changes)
        told = [said, self._say("on_the_road", diff=counted) if counted else ""]
        if parameter in FROM_THE_NEXT_ROAD:
            told.append(self._say("next_road" if not counted else "next_roads_too"))
        return " ".join(sentence for sentence in told if sentence)

    def _value(self, parameter: str, value: object) -> object:
        """A value as people know it."""
        return value_of(self._sayings, parameter, value)

    def _preferring(self, applied: Applied) -> str:
        config = applied.state.config
        wishes = [self._sayings.say("replies", "preferences", wish) for wish in config.preferences]
        said = self._say("prefer", wishes=self._sayings.joined(wishes)) if wishes else self._say("balanced")
        if not wishes or traits_of(config.planner).weighs_costs:
            return said
        return f"{said} {self._say('weighs_nothing', planner=self._sayings.planner(config.planner, 'id'))}"

    def _moved(self, key: str, applied: Applied) -> str:
        """Things added or removed: one by its id and place, several by their number."""
        things = applied.added or applied.removed
        diff = self._diff(applied.changes)
        if len(things) == 1:
            where = self._sayings.where(things[0].cell)
            return self._say(f"{key}_one", id=things[0].id, where=where, diff=diff)
        kinds = {thing.kind for thing in things}
        noun = next(iter(kinds)) if len(kinds) == 1 else "everything"
        named = self._sayings.things(noun, len(things))
        return self._say(f"{key}_many", count=len(things), things=named, diff=diff)

    def _all_gone(self, group: list[Fact]) -> str:
        """Several things taken away one by one, told at once."""
        things = [thing for fact in group if isinstance(fact, Applied) for thing in fact.removed]
        kinds = {thing.kind for thing in things}
        named = self._sayings.things(next(iter(kinds)) if len(kinds) == 1 else "everything", len(things))
        diff = self._diff(merge_changes(tuple(group)))
        return self._say("remove_many", count=len(things), things=named, diff=diff)

    def _scenario(self, run: SimState) -> str:
        road = self._sayings.say("replies", "roads", run.config.road or "none")
        contents = [
            self._say("contents", count=count, things=self._sayings.things(kind, count))
            for kind, count in run.world.counts().items()
            if count
        ]
        if run.config.layout is not None:
            layout = self._sayings.say("replies", "layouts", run.config.layout)
            key = "scenario_layout" if contents else "scenario_layout_empty"
            return self._say(key, road=road, layout=layout, contents=self._sayings.joined(contents))
        if not contents:
            return self._say("scenario_empty", road=road)
        return self._say("scenario", road=road, contents=self._sayings.joined(contents))

    def _diff(self, changes: tuple[Change, ...]) -> str:
        """The counts that changed."""
        told = [
            self._say("diff", path=self._path(change.path), before=change.before, after=change.after)
            for change in changes
            if type(change.before) is int and not change.path.startswith("config.")
        ]
        return ", ".join(told)

    def _path(self, path: str) -> str:
        """What a figure is called."""
        key = path if path in self._sayings.words("replies", "paths") else "other"
        return self._sayings.say("replies", "paths", key, path=path)

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("replies", key, **parts)


def speed(sayings: Sayings, pace: PlaybackSpeed) -> str:
    """A playback speed: `4×`."""
    if pace == MAX:
        return sayings.say("replies", "speed", "max")
    return sayings.say("replies", "speed", "times", speed=sayings.number(float(pace)))


def value_of(sayings: Sayings, parameter: str, value: object) -> object:
    """The value of a setting as people know it."""
    if parameter == "planner":
        return sayings.planner(str(value))
    known = sayings.words("replies", "values").get(parameter, {}).get(value)
    if known is not None:
        return known
    return sayings.number(value, "") if isinstance(value, float) else value


def _grouped(facts: tuple[Fact, ...]) -> list[list[Fact]]:
    """The facts one by one, but together what is told at once.

    Things that are taken away by name one after another; and wishes, of which the last tells all that hold.
    """
    groups: list[list[Fact]] = []
    for fact in facts:
        if groups and any(alike(fact) and alike(groups[-1][-1]) for alike in (_by_name, _wish)):
            groups[-1].append(fact)
        else:
            groups.append([fact])
    return groups


def _wish(fact: Fact) -> bool:
    return isinstance(fact, Applied) and isinstance(fact.action, Prefer)


def _by_name(fact: Fact) -> bool:
    return (
        isinstance(fact, Applied)
        and isinstance(fact.action, Remove)
        and fact.action.where is not None
        and fact.action.where.id is not None
        and not fact.events
    )
