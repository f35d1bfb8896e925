"""Rules in words: one said back, the list of those that stand, and what the log says when one is done."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

from service import actions as contract
from service.grammar.sentences import Sentences, Unsayable
from service.narration.answerer import Json, plain
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.refusals import refusals
from service.resources import prompts_folder
from service.sessions.facts import Asked
from service.yaml_files import read_cached_yaml
from sim.actions import Cancel, Condition, Pause, Trigger
from sim.events import Event, EventType
from sim.session.applied import Applied
from sim.session.conditions import SETTINGS
from sim.session.errors import EditError
from sim.triggers import MAX_FAILURES, Triggers

if TYPE_CHECKING:
    from service.narration.replies import Replies


_NOT_NAMED = ("fact", "kind", "side", *SETTINGS)
"""Parts of a condition that the name of its words leaves out."""


class Rules:
    """Words for the rules of a session, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, rule: Trigger) -> str:
        """A rule, said back: when, what, and until when."""
        ends = (
            [] if rule.until is None else [self._say("until", when=self._condition(rule.until, "until_when"))]
        )
        if rule.times is not None:
            ends.append(self._say("times_one" if rule.times == 1 else "times", times=rule.times))
        what = ", ".join([self._done(rule), *ends])
        return self._say("rule", when=self._condition(rule.when, "when"), what=what)

    def listed(self, triggers: Triggers) -> list[Json]:
        """The rules that stand, as the `Rule` of the interface."""
        return [
            {
                "number": rule.number,
                "text": capital(self.text(rule.trigger)),
                "since": rule.since,
                "fired": rule.fired,
                "action": contract.dump((rule.trigger,))[0],
            }
            for rule in triggers.standing
        ]

    def told(self, applied: Applied) -> str:
        """What it is called that a rule was made, or rules were switched off."""
        standing = applied.state.triggers.standing
        if isinstance(applied.action, Cancel):
            gone = next(
                change.before - change.after for change in applied.changes if change.path == "triggers"
            )
            said = self._say("cancelled_one" if gone == 1 else "cancelled", count=gone)
            return f"{said} {self.list(applied.state.triggers)}" if standing else said
        made = standing[-1]
        said = self._say("made", number=made.number, text=self.text(made.trigger))
        return f"{said} {self._say('held')}" if made.held else said

    def list(self, triggers: Triggers) -> str:
        """All rules that stand, in a sentence each."""
        if not triggers:
            return self._say("none")
        told = [
            self._say(
                "one_of", number=rule.number, text=self.text(rule.trigger), fired=self._fired(rule.fired)
            )
            for rule in triggers.standing
        ]
        return " ".join([self._say("count_one" if len(told) == 1 else "count", count=len(told)), *told])

    def event(self, event: Event, replies: Replies) -> str:
        """The line of the log for a rule that was done, could not be done, or ended."""
        number = event.rule
        if event.type is EventType.TRIGGER_FAILED:
            assert isinstance(event.error, EditError)
            why = refusals(self._sayings.language).edit(event.error)
            return self._say("failed", number=number, why=why)
        if event.type is EventType.TRIGGER_ENDED:
            return self._say("ended", event.how or "done", number=number, most=MAX_FAILURES)
        facts = tuple(each for each in event.done if isinstance(each, Applied))
        told = [replies.done(facts)] if facts else []
        if any(isinstance(each, Pause) for each in event.done):
            told.append(self._say("paused"))
        return self._say("fired", number=number, told=" ".join(told))

    def _done(self, rule: Trigger) -> str:
        try:
            return _sentences(self._sayings.language).sentence(rule.then)
        except Unsayable:
            return ", ".join(action.do for action in rule.then)

    def _condition(self, condition: Condition, form: str) -> str:
        """A condition, to stand at the beginning of a rule (`when`) or after "until" (`until_when`)."""
        words = self._sayings.words("rules", form)
        keys = {name: getattr(condition, name) for name in condition.__dataclass_fields__}
        said = [name for name, value in keys.items() if value is not None and name not in _NOT_NAMED]
        if condition.fact == "near" and condition.kind is not None:
            said.append("kind")
        named = "_".join([condition.fact, *sorted(said)])
        one = f"{named}_one"
        single = any(keys[name] == 1 for name in ("ticks", "seconds") if keys[name] is not None)
        kind = condition.kind
        parts = {name: self._number(value) for name, value in keys.items() if name != "kind"}
        parts |= {"lane": self._lane(condition), "side": self._side(condition), "is": self._is(condition)}
        if condition.move is not None:
            parts["move"] = self._sayings.words("rules", "moves")[condition.move]
        if kind is not None:
            parts |= {"a": self._sayings.say("words", "a", kind), "things": self._sayings.things(kind, 2)}
        exactly = condition.at_least is not None and condition.at_least == condition.at_most
        template = words[
            "setting"
            if condition.fact in SETTINGS
            else one
            if single and one in words
            else "count_exactly"
            if exactly
            else named
        ]
        return str(template).format(**parts)

    def _lane(self, condition: Condition) -> str:
        lane, words = condition.lane, self._sayings.words("rules", "lanes")
        return "" if lane is None else str(words.get(lane, words["other"])).format(lane=lane)

    def _side(self, condition: Condition) -> str:
        return "" if condition.side is None else str(self._sayings.words("rules", "sides")[condition.side])

    def _is(self, condition: Condition) -> str:
        """A clause about a setting: "it rains", "it no longer rains"."""
        if condition.fact not in SETTINGS:
            return ""
        form = "no_longer" if condition.no_longer else "is"
        return str(self._sayings.words("rules", form)[getattr(condition, condition.fact)])

    def _number(self, value: Any) -> Any:
        return self._sayings.number(value) if isinstance(value, float) else value

    def _fired(self, fired: int) -> str:
        if not fired:
            return self._say("never_fired")
        return self._say("fired_once" if fired == 1 else "fired_often", count=fired)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("rules", *keys, **parts)


class RulesTold:
    """Answers to "what rules are there?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._rules = Rules(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`; `rules` has those that stand."""
        state = asked.timeline.state
        told = plain(self._sayings, asked.ask, state, self._rules.list(state.triggers))
        return told | {"rules": self._rules.listed(state.triggers)}


@lru_cache(maxsize=16)
def _sentences(language: str) -> Sentences:
    return Sentences(read_cached_yaml([prompts_folder() / "language" / language / "sentences.yaml"])[0])
