"""Actions → one sentence that means exactly these actions: the way back through the grammar.

Used wherever what was done is told in the form it could have been said: replies to typed actions, logs,
links, the confirmation of an interpretation. Which words is data (`sentences.yaml`). That the
sentence parses to the same actions is a property the tests hold on thousands of random lists;
what the language cannot say raises `Unsayable` rather than becoming something near it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import asdict

from pydantic import ValidationError

from service.actions import (
    Action,
    Advise,
    Ask,
    Chat,
    Evaluate,
    EvaluationTalk,
    FindWorst,
    Forget,
    Goal,
    Hide,
    Load,
    Record,
    Redo,
    Rewind,
    Save,
    ScenarioParts,
    Show,
    Step,
    Style,
    Teach,
    Undo,
    Varied,
    dump,
    load,
)
from service.actions.parameters import filled, paths
from service.grammar.sentences_of_counts import counted_sentence, is_counted
from service.grammar.sentences_of_rules import RuleSentences
from service.grammar.sentences_of_things import Unsayable, number
from sim.actions import (
    Add,
    Adjust,
    Cancel,
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
    Trigger,
    Where,
)
from sim.planner_names import BUILT_IN, canonical
from sim.types import Move

__all__ = ["Sentences", "Unsayable", "number", "quoted"]

_FULL_SPEED = ("playback_speed", "max")
"""The one number that may also be a word."""

_NUMBERS_FOR_NAMES = (41, 60)
"""Numbers of which those that a meaning does not have stand for parameters until their names do."""

_KEPT_APART = (Teach, Forget)


class Sentences(RuleSentences):
    """Sentences in one language."""

    def names(self, kind: str) -> dict[str, str]:
        """What one thing of a kind is called (`one`), and what many are (`many`); empty for other words."""
        named = self._words.get("things", {}).get(kind)
        return {} if named is None else {"one": named[0], "many": named[1]}

    def parameter(self, name: str) -> str:
        """What a setting is called. Raises `Unsayable`."""
        return self._word("parameters", name)

    def value(self, parameter: str, name: str) -> str:
        """What a value of a setting is called. Raises `Unsayable`."""
        return self._value(parameter, name)

    def view(self, name: str) -> str:
        """What a view is called. Raises `Unsayable`."""
        return self._word("views", name)

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence for all of them, in order. Raises `Unsayable`."""
        if not actions or not self._words:
            raise Unsayable("nothing is said by no sentence, and a language may have none")
        if len(actions) > 1 and any(isinstance(each, Ask) and each.about == "detail" for each in actions):
            raise Unsayable("what wants the last answer again says nothing else")
        if len({isinstance(action, Chat) for action in actions}) > 1:
            raise Unsayable("small talk beside a request says nothing")
        whole = ""
        before: Action | None = None
        for action in actions:
            if before is not None:
                # A what-if and a rule take in all that follows them, so they have sentences of their own.
                apart = any(isinstance(each, Ask | Trigger) for each in (before, action))
                whole += self._words["stop"] if apart else self._words["then"]
            whole += self._request(action)
            before = action
        return whole

    def meaning_of(self, taught: Teach) -> str:
        """What a phrase means, with its parameters by their names. Raises `Unsayable`."""
        if taught.parameters is None:
            return self.sentence(taught.meaning)
        meaning = dump(taught.meaning)
        used = {value for value in paths(meaning).values() if isinstance(value, int)}
        free = [each for each in range(*_NUMBERS_FOR_NAMES) if each not in used]
        names = {each.name: stands_in for each, stands_in in zip(taught.parameters, free, strict=False)}
        try:
            said = self.sentence(load(filled(meaning, taught.parameters, names)))
        except ValidationError:
            raise Unsayable("no number that the sentence does not have") from None
        for name, stands_in in names.items():
            said, put = re.subn(rf"\b{stands_in}\b", name, said)
            if not put:
                raise Unsayable("a parameter that the sentence does not name")
        return said

    def _request(self, action: Action) -> str:
        match action:
            case Add():
                return self._say(
                    "add", **self._counted(action.kind, action.count), where=self._where(action.where)
                )
            case Remove():
                return self._remove(action)
            case SetCount():
                return self._say("set_count", **self._counted(action.kind, action.count))
            case MoveThings():
                return self._move(action)
            case Swap(first=first, second=second):
                return self._say("swap", first=self._one(first), second=self._one(second))
            case Replace(by=by):
                things = self._meant(action.kind, action.count, action.where)
                others = self._entry("things", by)
                one = action.count == 1
                return self._say("replace", things=things, others=f"1 {others[0]}" if one else others[1])
            case Copy(to=to):
                things = self._meant(action.kind, action.count, action.where)
                return self._say("copy_to" if to else "copy", things=things, to=self._destination(to))
            case Scenario():
                parts = self._parts(action)
                return self._say("scenario", parts=parts) if parts else self._say("scenario_empty")
            case Set():
                return self._set(action)
            case Adjust():
                return self._adjust(action)
            case Prefer():
                return self._word("prefer", action.preference)
            case Goal():
                return self._goal(action)
            case Style():
                return self._word("style", action.style)
            case SetMode():
                mode = self._word("mode", action.mode)
                return mode if action.ego is None else self._say("mode_ego", mode=mode, ego=action.ego)
            case Drive():
                key = "drive" if action.ego is None else "drive_ego"
                return self._say(key, move=self._word("moves", action.move), ego=action.ego)
            case Rewind(to=str(moment)):
                return self._word("rewind_to", moment)
            case Rewind(to=int(tick)):
                return self._say("rewind_to_tick", tick=tick)
            case Chat():
                return self._word("chat", action.kind)
            case Step() | Rewind():
                key = action.do if action.ticks != 1 else f"{action.do}_one"
                return self._say(key, count=action.ticks)
            case Show() | Hide():
                return self._say(action.do, view=self._word("views", action.view))
            case Ask():
                return self._question(action)
            case Evaluate():
                return self._evaluate(action)
            case EvaluationTalk():
                return self._evaluation_talk(action)
            case FindWorst():
                planner = action.planner and self._say(
                    "find_worst_planner", planner=self._value("planner", action.planner)
                )
                runs = action.runs and self._say("find_worst_runs", runs=action.runs)
                return self._say("find_worst", planner=planner or "", runs=runs or "")
            case Trigger():
                return self._rule(action, self.sentence(action.then))
            case Cancel():
                return self._cancel(action)
            case Advise():
                thing = self._entry("things", action.hazard)[0]
                return self._say(
                    "advise", thing=thing, metres=number(action.distance_m), speed=number(action.speed_kmh)
                )
            case Save() | Load():
                return self._say(action.do, name=quoted(action.name))
            case Undo() | Redo():
                key = action.do if action.steps is None else f"{action.do}_steps"
                return self._say(f"{action.do}_all" if action.steps == "all" else key, count=action.steps)
            case Record():
                return self._word("record", action.on)
            case Teach():
                return self._say("teach", phrase=quoted(action.phrase), meaning=self.meaning_of(action))
            case Forget():
                return self._say("forget", phrase=quoted(action.phrase))
            case _:
                return self._say(action.do)

    def _goal(self, goal: Goal) -> str:
        if goal.planners is not None:
            can, cannot = (self._value("planner", planner) for planner in goal.planners)
            return self._say("separates", can=can, cannot=cannot)
        return self._word("goal", goal.goal if goal.degree is None else f"{goal.goal}_{goal.degree}")

    def _set(self, action: Set) -> str:
        value, parameter = action.value, action.parameter
        named = parameter in self._words["values"]
        if named is not isinstance(value, str) and (parameter, value) != _FULL_SPEED:
            raise Unsayable(f"{value!r} is no value of {parameter}")
        if not isinstance(value, str):
            told = number(value)
        elif parameter == "traffic":
            self._value(parameter, value)
            told = self._words.get("traffic_levels", {}).get(value, value)
        else:
            told = self._value(parameter, value)
        return self._say("set", parameter=self._word("parameters", parameter), value=told)

    def _adjust(self, action: Adjust) -> str:
        if action.parameter in self._words["values"]:
            raise Unsayable(f"{action.parameter} has no more or less")
        parameter = self._word("parameters", action.parameter)
        if action.factor is not None:
            return self._say("adjust_factor", parameter=parameter, value=number(action.factor))
        if action.by is not None:
            key = "adjust_down_by" if action.by < 0 else "adjust_up_by"
            return self._say(key, parameter=parameter, value=number(abs(action.by)))
        return self._say(f"adjust_{action.direction}", parameter=parameter)

    def _question(self, ask: Ask) -> str:
        match ask.about:
            case "why" | "why_not" | "what_if" if ask.what is not None:
                form = "had_moved" if ask.about == "what_if" else "asked"
                move = "" if ask.move is None else self._word(form, ask.move)
                if ask.tick is not None:
                    raise Unsayable("a way of driving from a tick on")
                if ask.what == "so_far":
                    match ask.change:
                        case (Set(parameter="courtesy" | "sensor_noise" as without),):
                            return self._word("what_if_without", without)
                    return self._say("what_if_so_far", settings=self._settings(ask.change or ()))
                things = "" if ask.kind is None else self._entry("things", ask.kind)[1]
                return self._say(f"{ask.about}_{ask.what}", move=move, things=things, lane=ask.lane)
            case "why" | "why_not":
                key: str = ask.about
                if ask.move is not None and ask.about == "why":
                    key += "_move"
                if ask.instead is not None:
                    key += "_instead"
                move = "" if ask.move is None else self._word("asked", ask.move)
                other = "" if ask.instead is None else self._word("foil", ask.instead)
                return self._at_tick(ask, key, move=move, other=other)
            case "what_if" if ask.move is not None:
                return self._at_tick(ask, "what_if_moved", move=self._word("had_moved", ask.move))
            case "detail":
                return self._word("detail", ask.how)
            case "other":
                return self._other(ask)
            case "pattern":
                if (ask.tick, ask.until) != (None, None):
                    raise Unsayable("a pattern is one of the whole episode")
                return self._say("pattern") if ask.move is None else self._word("patterns", ask.move)
            case "what_if" if ask.count is not None:
                if ask.change != (Drive(move=Move.STAY),):
                    raise Unsayable("what is done several times running is standing still")
                return self._say("what_if_times", count=ask.count)
            case "what_if":
                return self._say("what_if", change=self.sentence(ask.change or ()))
            case "next" if ask.kind is not None:
                return self._say("next_at", thing=self._entry("things", ask.kind)[0])
            case "scene" if ask.kind is not None and ask.count is not None:
                return self._say("scene_nearest", thing=self._entry("things", ask.kind)[0])
            case "scene" if ask.kind is not None:
                return self._say("scene_kind", things=self._entry("things", ask.kind)[1])
            case "metrics" if ask.metric is not None:
                return self._word("metric", ask.metric)
            case "setting":
                return self._setting_asked(ask)
            case "options" if ask.parameter is not None:
                return self._word("options_of", ask.parameter)
            case "fact":
                return self._word("facts", ask.fact)
            case "term":
                return self._say("term", term=self._word("terms", ask.term))
            case "history":
                return self._history(ask)
            case "outlook" | "blame" | "planners" | "sight" | "world":
                return self._of_what(ask)
            case "changes" if ask.count is not None or ask.tick is not None:
                if ask.count is not None and ask.tick is not None:
                    raise Unsayable("changes are counted, or those since a tick")
                key = "changes_count" if ask.count is not None else "changes_tick"
                return self._say(key, count=ask.count, tick=ask.tick)
            case about:
                return self._say(about)

    def _settings(self, change: Sequence[Action]) -> str:
        """Settings as they are supposed to be: "Dijkstra", "lidar and clear weather"."""
        said = [
            self._word("supposed", each.parameter).format(value=self._value(each.parameter, str(each.value)))
            for each in change
            if isinstance(each, Set)
        ]
        return str(self._words["and"]).join(said)

    def _at_tick(self, ask: Ask, key: str, **parts: str) -> str:
        """A question about a tick, one so many ticks or seconds ago, or none."""
        when = ""
        if ask.tick is not None:
            when = self._say("at_tick", tick=ask.tick)
        elif ask.ticks is not None:
            when = self._say("ticks_ago" if ask.ticks != 1 else "tick_ago", ticks=ask.ticks)
        elif ask.seconds is not None:
            when = self._say("seconds_ago", seconds=number(ask.seconds))
        return self._say(key, when=when, **parts)

    def _other(self, ask: Ask) -> str:
        which = ask.which
        if which is None:
            raise Unsayable("nobody is asked about")
        if which.id is not None:
            who = which.id
        else:
            parts = {name: getattr(which, name) for name in Where.__dataclass_fields__}
            where = Where(**parts)
            if which.nearest and where != Where(nearest=True):
                raise Unsayable("the nearest of a place")
            if where == Where():
                raise Unsayable("no one in particular")
            noun = self._entry("things", which.kind)
            words = "the_nearest" if which.nearest else "the_one"
            who = self._say(words, thing=noun[0], where="" if which.nearest else self._where(where))
        if ask.what == "going" and ask.count is not None:
            return self._say("other_then", who=who, count=ask.count)
        if ask.what == "going":
            return self._say("other_going", who=who)
        move = self._word("others_did", ask.move or "any")
        return self._at_tick(ask, "other_why", who=who, move=move)

    def _setting_asked(self, ask: Ask) -> str:
        name = str(ask.parameter)
        if ask.value is None:
            return self._word("setting_asked", name)
        named = name in self._words["values"]
        if named is not isinstance(ask.value, str):
            raise Unsayable(f"{ask.value!r} is no value of {name}")
        if isinstance(ask.value, str):
            value = self._value(name, ask.value)
            return self._word("setting_is", name).format(value=value)
        return self._say(
            "setting_is_number", parameter=self._word("parameters", name), value=number(ask.value)
        )

    def _history(self, ask: Ask) -> str:
        key = str(ask.what)
        if ask.which is not None:
            raise Unsayable("which")
        if is_counted(ask):
            return counted_sentence(
                self._words, ask, "" if ask.kind is None else self._entry("things", ask.kind)[1]
            )
        if ask.what == "riskiest" and ask.tick is not None:
            key += "_between"
        if ask.what == "similar":
            key += "_to" if ask.tick is not None else ""
            key += "" if ask.count is None else "_one" if ask.count == 1 else "_count"
        key += "" if ask.move is None else "_move"
        of_tick = ("choices", "runner_up", "scores", "needed", "noticed", "move_risk", "chosen_safest")
        if ask.what in of_tick and ask.tick is not None:
            key += "_at"
        if ask.ticks is not None:
            key += "_ticks" if ask.ticks != 1 else "_tick"
        key += "" if ask.seconds is None else "_seconds"
        key += "" if ask.kind is None else "_kind"
        key += "" if ask.want is None else f"_{ask.want}"
        key += "_count" if ask.what == "closest_call" and ask.count is not None else ""
        seconds = "" if ask.seconds is None else number(ask.seconds)
        things = "" if ask.kind is None else self._entry("things", ask.kind)[1]
        move = "" if ask.move is None else self._word("asked", ask.move)
        return self._word("history", key).format(
            tick=ask.tick,
            until=ask.until,
            ticks=ask.ticks,
            count=ask.count,
            seconds=seconds,
            things=things,
            move=move,
        )

    def _of_what(self, ask: Ask) -> str:
        """A question of one of several about the same: ahead, blame, planners, sensing, this world."""
        named = ask.planners or (() if ask.planner is None else (ask.planner,))
        planners = self._words["and"].join([self._value("planner", planner) for planner in named])
        key = str(ask.what) + ("_of" if named else "") + ("" if ask.tick is None else "_tick")
        key += "" if ask.ticks is None else "_ticks"
        key += "" if ask.seconds is None else "_seconds"
        key += "" if ask.kind is None else "_kind"
        key += "" if ask.value is None else "_sensor"
        sensor = "" if ask.value is None else self._value("sensor", str(ask.value))
        seconds = "" if ask.seconds is None else number(ask.seconds)
        thing, things = ("", "") if ask.kind is None else self._entry("things", ask.kind)[:2]
        move = "" if ask.move is None else self._word("asked", ask.move)
        return self._word(ask.about, key).format(
            planners=planners,
            tick=ask.tick,
            ticks=ask.ticks,
            seconds=seconds,
            move=move,
            thing=thing,
            things=things,
            sensor=sensor,
            lane=ask.lane,
        )

    def _evaluation_talk(self, action: EvaluationTalk) -> str:
        names = [self._value("planner", planner) for planner in action.planners or ()]
        named = self._say("evaluation_of", planners=self._words["and"].join(names)) if names else ""
        return self._say(f"evaluation_{action.want}", planners=named)

    def _evaluate(self, action: Evaluate) -> str:
        planners = [self._value("planner", planner) for planner in action.planners or ()]
        named = self._say("evaluate_with", planners=self._words["and"].join(planners)) if planners else ""
        given = [each for each in (action.scenario, *_each_varied(action.vary)) if each is not None]
        parts = self._words["listed"].join([self._parts(each) for each in given])
        if action.map is not None:
            if action.road is not None or action.scenario_name is not None or parts:
                raise Unsayable("a success map of one road or scenario, or under conditions")
            return self._success_map(action.map, planners, action.runs)
        scenario = self._say("evaluate_on", parts=parts) if parts else ""
        if action.scenario_name is not None:
            if action.road is not None:
                raise Unsayable("an evaluation of a scenario and of this road")
            key = "evaluate_named" if action.runs is None else "evaluate_named_times"
            name = quoted(action.scenario_name)
            return self._say(key, name=name, runs=action.runs, planners=named, scenario=scenario)
        if action.road is not None:
            if action.runs is None or parts:
                raise Unsayable("an evaluation of this road without a number of runs, or with a scenario")
            return self._say("evaluate_this", runs=action.runs, planners=named)
        if action.runs is not None:
            return self._say("evaluate", runs=action.runs, planners=named, scenario=scenario)
        key = "evaluate_planners" if planners else "evaluate_scenario"
        return self._say(key, planners=named, scenario=scenario)

    def _success_map(self, axes: Sequence[str], planners: Sequence[str], runs: int | None) -> str:
        joint = self._words["and"]
        return self._say(
            "evaluate_map",
            axes=joint.join(self._word("map_axes", name) for name in axes),
            planners=self._say("evaluate_map_for", planners=joint.join(planners)) if planners else "",
            runs="" if runs is None else self._say("evaluate_map_runs", runs=runs),
        )

    def _parts(self, parts: Scenario | ScenarioParts) -> str:
        words = self._words["part"]
        said = []
        for key in ("weather", "time_of_day", "road", "layout", "traffic", "planner", "sensor"):
            value = getattr(parts, key)
            if value is not None:
                said.append(words[key].format(value=self._value(key, value)))
        for kind in self._words["things"]:
            count = getattr(parts, f"{kind}s")
            if count is not None:
                said.append(words["things"].format(**self._counted(kind, count)))
        return str(self._words["listed"].join(said))

    def _value(self, key: str, value: str) -> str:
        words = self._words["values"].get(key)
        if words is None:
            return value
        if key == "planner":
            value = canonical(value)
            if value in BUILT_IN:  # by its name where there are no other words for it
                return str(words.get(value, value))
        if value not in words:
            raise Unsayable(f"{value!r} is no value of {key}")
        return str(words[value])


def _each_varied(vary: Varied | None) -> list[ScenarioParts]:
    """A condition for each value that is compared, in their order."""
    values = {} if vary is None else asdict(vary)
    return [ScenarioParts(**{name: value}) for name, several in values.items() for value in several or ()]


def quoted(name: str) -> str:
    """A name in quotation marks, those within it escaped."""
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
