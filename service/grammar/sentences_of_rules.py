"""Sentences that mean rules, and that switch them off."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from service.grammar.sentences_of_things import ThingSentences, Unsayable, number
from sim.actions import Cancel, Condition, Trigger
from sim.session.conditions import SETTINGS

_NOT_NAMED = ("fact", "side")
"""Parts of a condition that the name of its words leaves out."""


class RuleSentences(ThingSentences):
    """Sentences about rules in one language."""

    def _rule(self, rule: Trigger, request: str) -> str:
        """A rule that does a request, which is told already."""
        when = self._condition("rule_when", rule.when)
        if rule.until is not None:
            when = self._say("rule_until", when=when, until=self._condition("rule_until_when", rule.until))
        if rule.times is not None:
            key = "rule_once" if rule.times == 1 else "rule_times"
            when = self._say(key, when=when, times=rule.times)
        return self._say("rule", when=when, request=request)

    def _condition(self, form: str, condition: Condition) -> str:
        """A condition in a form of its own, since some stand after "when" and others do not."""
        said = {each.name: getattr(condition, each.name) for each in fields(condition)}
        named = sorted(name for name, value in said.items() if value is not None and name not in _NOT_NAMED)
        key = "_".join([condition.fact, *named])
        if condition.at_least is not None and condition.at_least == condition.at_most:
            key = "count_exactly"
        words: dict[str, Any] = {
            name: number(value) if isinstance(value, float) else value for name, value in said.items()
        }
        if condition.kind is not None:
            words["thing"], words["things"] = self._entry("things", condition.kind)[:2]
            words["one"] = self._words.get("rule_one", {}).get(condition.kind, words["thing"])
        if condition.lane is not None:
            lanes = self._words.get("rule_lanes", {})
            words["lane"] = lanes.get(condition.lane) or self._say("rule_lane", lane=condition.lane)
        if condition.move is not None:
            words["move"] = self._word("rule_moves", condition.move)
        words["side"] = "" if condition.side is None else self._word("rule_sides", condition.side)
        if condition.fact in SETTINGS:
            form_of_setting = "rule_no_longer" if condition.no_longer else "rule_is"
            key, words["is"] = "setting", self._word(form_of_setting, said[condition.fact])
        return self._word(form, key).format(**words)

    def _cancel(self, action: Cancel) -> str:
        if action.place is not None:
            places = self._words.get("cancel_places", ())
            if action.place > len(places):
                raise Unsayable("a far place")
            return self._say("cancel_place", place=places[action.place - 1])
        if action.doing is None:
            key = "number" if isinstance(action.which, int) else str(action.which)
            return self._word("cancel", key).format(number=action.which)
        key = action.doing if action.kind is None else f"{action.doing}_kind"
        things = "" if action.kind is None else self._entry("things", action.kind)[1]
        return self._word("cancel", key).format(things=things)
