"""What an utterance did, as a reply: a sentence for each thing done, with the figures that changed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from service.evaluations.names import FIND_WORST
from service.narration.evaluation import EvaluationWords
from service.narration.falsification import FalsificationWords
from service.narration.goals import Goals
from service.narration.placing import how_many_now, place_of
from service.narration.rearranged import told_rearranged
from service.narration.rules import Rules
from service.narration.sayings import Sayings
from service.narration.values import conditions_of, speed, value_of
from service.sessions.bookmarks import Bookmarked, Jumped
from service.sessions.facts import (
    Advised,
    AliasChange,
    Asked,
    Chatted,
    Dropped,
    Fact,
    JobAsked,
    JobTold,
    PauseSet,
    Resolved,
    Stepped,
    Undone,
    Viewed,
)
from service.sessions.scheduler.playback_speed import PlaybackSpeedSet
from sim.actions import (
    Add,
    Adjust,
    Cancel,
    Copy,
    Drive,
    MoveThings,
    PlaceableKind,
    Prefer,
    Remove,
    Replace,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
    Trigger,
)
from sim.config import Config
from sim.events import EventType
from sim.falsify import Falsification
from sim.perceive import sensor_named
from sim.plan import traits_of
from sim.session.edits import Applied, Change
from sim.session.settings import AS_IT_IS, FROM_THE_NEXT_ROAD, NEEDS_A_NEW_ROAD
from sim.state import SimState
from sim.types import KINDS, Kind, Mode
from sim.world import Thing

TOLD_SINGLY = 3
"""More things than this, put into cells one after another, are told at once."""


RENEWED: Final = ("planner", "sensor", "weather", "time_of_day")
"""Settings that a scenario sets to their defaults where it does not name them."""

_OF_ERRING_SENSORS: Final = (
    "detection_sensitivity",
    "sensor_range_m",
    "sensor_noise",
    "false_positive_rate",
    "sensor_latency",
)
"""Settings that the perfect sensor does not heed."""


class Replies:
    """Replies in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._evaluations = EvaluationWords(sayings)
        self._falsifications = FalsificationWords(sayings)
        self._goals = Goals(sayings, self._scenario, self.done)
        self._rules = Rules(sayings)

    def done(self, facts: tuple[Fact, ...]) -> str:
        """A sentence for each fact; questions are answered elsewhere."""
        applied = [fact.state.config for fact in facts if isinstance(fact, Applied)]
        end = applied[-1] if applied else None
        told = [self._told_at_once(group, end) for group in _grouped(facts)]
        return " ".join(sentence for sentence in told if sentence)

    def _told_at_once(self, group: list[Fact], end: Config | None) -> str:
        """`end`: the configuration after all that was done."""
        if len(group) > 1 and _by_name(group[0]):
            return self._all_gone(group)
        if _by_cell(group[0]):
            if len(group) > TOLD_SINGLY:
                return self._all_placed(group)
            return " ".join(self._done(fact, end) for fact in group)
        return self._done(group[-1], end)

    def lesson(self, lesson: AliasChange) -> str:
        """What was taught or forgotten, as the sentence that says the same."""
        key = "taught" if lesson.taught else "forgotten"
        said = self._say(key, phrase=lesson.phrase, sentence=lesson.sentence)
        if lesson.taught and lesson.before not in (None, lesson.sentence):
            said = f"{said} {self._say('taught_before', sentence=lesson.before)}"
        return said

    def _done(self, fact: Fact, end: Config | None) -> str:
        match fact:
            case Applied():
                return self._applied(fact, end)
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
            case JobAsked(evaluation=asked):
                if isinstance(asked, Falsification):
                    return self._falsifications.started(asked, fact.job)
                return self._evaluations.started(asked, fact.job)
            case JobTold():
                searched = fact.job is not None and fact.job.kind == FIND_WORST
                return (self._falsifications if searched else self._evaluations).standing(fact)
            case Chatted(kind=kind):
                return self._sayings.say("chat", kind)
            case Asked() | Advised():
                return ""

    def _applied(self, applied: Applied, end: Config | None) -> str:
        match applied.action:
            case Add():
                said = self._moved("add", applied.added, applied.state)
            case Remove(kind=kind) if not applied.removed:
                said = self._say("remove_none", things=self._sayings.things(kind, 2))
            case Remove():
                said = self._moved("remove", applied.removed, applied.state)
            case SetCount(kind=kind, count=count):
                said = self._exactly(kind, count, applied)
            case MoveThings() | Swap() | Replace() | Copy() as action:
                said = told_rearranged(self._sayings, applied, action)
            case Scenario():
                return " ".join((self._scenario(applied.state), *self._renewed(applied)))
            case SetMode(mode=mode):
                changed = any(change.path == "mode" for change in applied.changes)
                return self._say(f"mode_{mode}" if changed else "mode_already")
            case Prefer():
                return self._preferring(applied)
            case Set(parameter=parameter) | Adjust(parameter=parameter):
                return self._setting(parameter, applied, end)
            case Trigger() | Cancel():
                return self._rules.told(applied)
            case Drive(move=move):
                key = "drive" if applied.state.mode is Mode.MANUAL else "drive_then_auto"
                said = self._say(key, move=self._sayings.move(move, "do"))
            case action:  # actions without parameters
                return self._say(action.do)
        started = any(event.type is EventType.EPISODE_STARTED for event in applied.events)
        return f"{self._say('road_first')} {said}" if started else said

    def _setting(self, parameter: str, applied: Applied, end: Config | None) -> str:
        """What was set, from what to what, and when it shows."""
        name = self._sayings.say("replies", "parameters", parameter)
        changed = {change.path: change for change in applied.changes}
        change = changed.get(f"config.{parameter}")
        if change is None:
            now = getattr(applied.state.config, parameter, None)
            value = AS_IT_IS.get(parameter, "") if now is None else now
            return self._say("set_already", name=name, value=self._value(parameter, value))
        after = self._value(parameter, change.after)
        if change.before is None:
            said = self._say("set_first", name=name, after=after)
        else:
            said = self._say("set", name=name, before=self._value(parameter, change.before), after=after)
        if parameter in NEEDS_A_NEW_ROAD:
            kept = "episode" not in changed
            return f"{said} {self._say('road_kept') if kept else self._scenario(applied.state)}"
        counted = self._diff(applied.changes)
        told = [said, self._say("on_the_road", diff=counted) if counted else ""]
        if parameter in FROM_THE_NEXT_ROAD:
            told.append(self._say("next_road" if not counted else "next_roads_too"))
        told.append(self._without_effect(parameter, end or applied.state.config))
        return " ".join(sentence for sentence in told if sentence)

    def _without_effect(self, parameter: str, config: Config) -> str:
        """That the sensor heeds no weather, light or doubt, where such a setting was changed."""
        if not sensor_named(config.sensor).faithful:
            return ""
        if parameter in _OF_ERRING_SENSORS:
            return self._say("sees_all")
        worse = (parameter, getattr(config, parameter)) not in (("weather", "clear"), ("time_of_day", "day"))
        return self._say("sees_through") if parameter in ("weather", "time_of_day") and worse else ""

    def _value(self, parameter: str, value: object) -> str:
        """A value as people know it."""
        return value_of(self._sayings, parameter, value)

    def _preferring(self, applied: Applied) -> str:
        config = applied.state.config
        said = self._wishes(config.preferences)
        if not config.preferences or traits_of(config.planner).weighs_costs:
            return said
        return f"{said} {self._say('weighs_nothing', planner=self._sayings.planner(config.planner, 'id'))}"

    def _moved(self, key: str, things: Sequence[Thing], run: SimState) -> str:
        """Things added or removed: how many, where, and how many there are now."""
        kinds = list(dict.fromkeys(thing.kind for thing in things))
        now = how_many_now(self._sayings, run, kinds, left=key == "remove")
        where = place_of(self._sayings, run, things, key)
        if len(things) == 1:
            return self._say(f"{key}_one", a=self._sayings.say("words", "a", kinds[0]), where=where, now=now)
        named = self._sayings.things(kinds[0] if len(kinds) == 1 else "everything", len(things))
        return self._say(f"{key}_many", count=len(things), things=named, where=where, now=now)

    def _all_gone(self, group: list[Fact]) -> str:
        """Several things taken away one by one, told at once."""
        applied = [fact for fact in group if isinstance(fact, Applied)]
        things = [thing for each in applied for thing in each.removed]
        return self._moved("remove", things, applied[-1].state)

    def _all_placed(self, group: list[Fact]) -> str:
        """Several things put into cells one by one, told at once."""
        applied = [fact for fact in group if isinstance(fact, Applied)]
        things = [thing for each in applied for thing in each.added]
        return self._moved("add", things, applied[-1].state)

    def _exactly(self, kind: PlaceableKind, count: int, applied: Applied) -> str:
        """How many there are of a kind now, and how many there were."""
        are = self._sayings.say("replies", "are", "one" if count == 1 else "many")
        things = self._sayings.things(kind, count or 2)
        before = [change.before for change in applied.changes if change.path == KINDS[Kind(kind)].plural]
        if not before:
            return self._say("set_count_already", are=are, count=count, things=things)
        form = {0: "none", 1: "one"}.get(before[0], "many")
        were = self._sayings.say("replies", "were", form, before=before[0])
        return self._say(
            "set_count" if count else "set_count_none", are=are, count=count, things=things, were=were
        )

    def _undone(self, undone: Undone) -> str:
        """What is as it was before, or as it was made again."""
        key = "redo" if undone.again else "undo"
        if undone.steps > 1:
            key += "_many"
        told = self._diff(undone.changes, settings=True)
        said = [self._say(key if told else f"{key}_plain", diff=told, count=undone.steps)]
        for change in undone.changes:
            match change.path:
                case "paused":
                    said.append(self._say("pause" if change.after else "resume"))
                case "mode":
                    said.append(self._say(f"mode_{change.after}"))
                case "playback_speed":
                    before, after = (speed(self._sayings, pace) for pace in (change.before, change.after))
                    said.append(self._say("pace", before=before, after=after))
                case "config.preferences":
                    said.append(self._wishes(change.after))
        return " ".join(said)

    def _wishes(self, preferences: Sequence[str]) -> str:
        """What is wished for, of all that was said."""
        wishes = [self._sayings.say("replies", "preferences", wish) for wish in preferences]
        return self._say("prefer", wishes=self._sayings.joined(wishes)) if wishes else self._say("balanced")

    def _scenario(self, run: SimState) -> str:
        """What a new road is, and under which conditions, where they are not those of every road."""
        config = run.config
        told = [self._new_road(run)]
        if conditions := conditions_of(self._sayings, config):
            told.append(self._say("conditions", conditions=conditions))
        told += [said for name in ("weather", "time_of_day") if (said := self._without_effect(name, config))][
            :1
        ]
        return " ".join(told)

    def _renewed(self, applied: Applied) -> list[str]:
        """The settings that a new scenario put back without their being named."""
        changed = {change.path: change for change in applied.changes}
        return [
            self._say(
                "set",
                name=self._sayings.say("replies", "parameters", name),
                before=self._value(name, change.before),
                after=self._value(name, change.after),
            )
            for name in RENEWED
            if getattr(applied.action, name) is None and (change := changed.get(f"config.{name}")) is not None
        ]

    def _new_road(self, run: SimState) -> str:
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

    def _diff(self, changes: tuple[Change, ...], *, settings: bool = False) -> str:
        """The counts that changed, and with `settings` those too."""
        told: list[tuple[str, object, object]] = []
        for change in changes:
            field = change.path.removeprefix("config.")
            if field == change.path and type(change.before) is int:
                told.append((self._path(change.path), change.before, change.after))
            elif settings and field in self._sayings.words("whatif", "settings") and _known(change):
                name = self._sayings.say("whatif", "settings", field)
                told.append((name, self._value(field, change.before), self._value(field, change.after)))
        return ", ".join(
            self._say("diff", path=path, before=before, after=after) for path, before, after in told
        )

    def _path(self, path: str) -> str:
        """What a figure is called."""
        key = path if path in self._sayings.words("replies", "paths") else "other"
        return self._sayings.say("replies", "paths", key, path=path)

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("replies", key, **parts)


def _grouped(facts: tuple[Fact, ...]) -> list[list[Fact]]:
    """The facts one by one, but together what is told at once.

    Things that are taken away by name or put into cells, one after another; and wishes, of which the last
    tells all that hold.
    """
    groups: list[list[Fact]] = []
    for fact in facts:
        if groups and any(alike(fact) and alike(groups[-1][-1]) for alike in (_by_name, _by_cell, _wish)):
            groups[-1].append(fact)
        else:
            groups.append([fact])
    return groups


def _known(change: Change) -> bool:
    return change.before is not None and change.after is not None


def _wish(fact: Fact) -> bool:
    return isinstance(fact, Applied) and isinstance(fact.action, Prefer)


def _by_cell(fact: Fact) -> bool:
    return (
        isinstance(fact, Applied)
        and isinstance(fact.action, Add)
        and fact.action.where is not None
        and fact.action.where.cell is not None
        and not fact.events
    )


def _by_name(fact: Fact) -> bool:
    return (
        isinstance(fact, Applied)
        and isinstance(fact.action, Remove)
        and fact.action.where is not None
        and fact.action.where.id is not None
        and not fact.events
    )
