"""Refusals in words: a sentence for each error code of `sim.codes`, and for what the service itself refuses.

The sentences are in `prompts/sayings/<language>/refusals.yaml`. Requests without a language, and languages
without this file, get English.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache
from types import MappingProxyType
from typing import Any, Final, Literal

from service.resources import DEFAULT_LANGUAGE, prompts_folder
from service.yaml_files import read_cached_yaml
from sim.config import Problem
from sim.hazard_advice import NoAdviceError
from sim.rules.versions import NewerRulesError
from sim.session.errors import EditError
from sim.types import KINDS, Kind, kind_of

_NO_FAULTS: Final[Mapping[str, Any]] = MappingProxyType({})


@lru_cache(maxsize=16)
def refusals(language: str = DEFAULT_LANGUAGE) -> Refusals:
    """The refusals of a language, read once."""
    folder = prompts_folder() / "sayings"
    path = folder / language / "refusals.yaml"
    if language not in {each.name for each in folder.iterdir()} or not path.is_file():
        path = folder / DEFAULT_LANGUAGE / "refusals.yaml"
    held, words = read_cached_yaml([path, path.with_name("words.yaml")])
    return Refusals(held, words["faults"])


@lru_cache(maxsize=1)
def _fault_patterns() -> tuple[tuple[str, re.Pattern[str]], ...]:
    """How the simulator words each fault of a planner: patterns that find its code and what it names."""
    path = prompts_folder() / "sayings" / DEFAULT_LANGUAGE / "words.yaml"
    known: dict[str, str] = read_cached_yaml([path])[0]["faults"]
    return tuple(
        (code, re.compile(re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(said))))
        for code, said in known.items()
        if code != "other"
    )


def fault_of(text: str) -> tuple[str, dict[str, str]]:
    """The code of a fault that the simulator has worded, `other` for none that is known, and its parts."""
    for code, pattern in _fault_patterns():
        if found := pattern.fullmatch(text):
            return code, found.groupdict()
    return "other", {"text": text}


class Decimal(float):
    """A number that is written with the marks of a language."""

    marks: Mapping[int, str]

    def __new__(cls, value: float, marks: Mapping[int, str]) -> Decimal:
        """`marks`: what stands for the point and the comma."""
        new = super().__new__(cls, value)
        new.marks = marks
        return new

    def __format__(self, spec: str) -> str:
        """As Python formats it, with these marks."""
        return super().__format__(spec).translate(self.marks)


class Refusals:
    """The sentences of one language."""

    def __init__(self, data: Mapping[str, Any], faults: Mapping[str, Any] = _NO_FAULTS) -> None:
        """`data`: what `refusals.yaml` holds; `faults`: what planners do instead of answering."""
        self._data = data
        self._faults = faults
        numbers = data["numbers"]
        self._marks = str.maketrans({",": numbers["thousands"], ".": numbers["decimal"]})

    def edit(self, error: EditError) -> str:
        """Why a change of the road is impossible, as a sentence."""
        return self._say("edits", error.code, error.facts, spoken=True)

    def instead(self, error: EditError) -> tuple[str, ...]:
        """Sentences that can be said in place of an impossible change."""
        return (self._say("instead", error.code, error.facts),) if error.code in self._data["instead"] else ()

    def problem(self, problem: Problem) -> str:
        """The problem of a field, to follow its name; a whole sentence if it is unavailable."""
        return self._say("problems", problem.code, problem.facts)

    def advice(self, error: NoAdviceError) -> str:
        """Why there is no advice, as a sentence."""
        return self._say("advice", error.code, error.facts)

    def newer_rules(self, error: NewerRulesError, what: Literal["recording", "session"]) -> str:
        """That something was made by a newer version, as a sentence."""
        return self._say("rules", f"newer_{what}", {"rules": error.rules, "known": error.known})

    def older_rules(self, rules: int) -> str:
        """That something was made under older rules."""
        return self._say("rules", "older", {"rules": rules})

    def session(self, code: str, /, **facts: object) -> str:
        """What a session cannot do, as a sentence."""
        return self._say("session", code, facts, spoken=True)

    def said(self, code: str, /, **facts: object) -> str:
        """What is wrong with something that was said or taught."""
        return self._say("said", code, facts)

    def beside(self, code: str, facts: Mapping[str, object]) -> str:
        """Why another run cannot be shown beside the real one, as a sentence."""
        return self._say("beside", code, facts)

    def model(self, reason: str, facts: Mapping[str, object]) -> str:
        """Why a language model was of no use, as a sentence."""
        return self._say("model", reason, facts)

    def action(self, name: str) -> str:
        """What an action is called where no sentence means it."""
        return str(self._data["actions"].get(name, name))

    def playback_speed(self, code: str, facts: Mapping[str, object]) -> str:
        """Why a playback speed is impossible, as a sentence."""
        return self._say("pace", code, facts)

    def _say(self, section: str, code: str, facts: Mapping[str, Any], *, spoken: bool = False) -> str:
        return str(self._data[section][code]).format(**self._slots(facts, spoken=spoken))

    def _slots(self, facts: Mapping[str, Any], *, spoken: bool) -> dict[str, Any]:
        """The facts as they are said, and the forms that depend on them.

        `spoken`: where no field is named, so that nobody has to type the values.
        """
        words = self._data["spoken"] if spoken else _NO_FAULTS
        slots: dict[str, Any] = {
            name: words[value] if isinstance(value, str) and value in words else self._told(name, value)
            for name, value in facts.items()
        }
        if "id" in facts:
            with suppress(ValueError):  # an id as somebody typed it
                slots["thing"] = self._nouns(kind_of(str(facts["id"])))
        if "kind" in facts:
            slots["things"] = slots["kind"]["one" if facts.get("count") == 1 else "many"]
        for name, form in self._data["forms"].items():
            if form["of"] in facts:
                with suppress(KeyError):  # a form that takes other facts too, of another refusal
                    slots[name] = _form(form, facts[form["of"]]).format(**slots)
        return slots

    def _told(self, name: str, value: object) -> object:
        if isinstance(value, Problem):
            return self.problem(value)
        if name == "kind":
            return self._nouns(str(value))
        if isinstance(value, tuple):
            return ", ".join(str(self._worded(each)) for each in value)
        if name == "fault":
            return self._fault(str(value))
        if name in ("low", "high") and isinstance(value, float) and value.is_integer():
            return int(value)
        if isinstance(value, float):
            return Decimal(value, self._marks)
        return self._worded(value)

    def _worded(self, value: object) -> object:
        """A value as it is called, where it is a word."""
        return self._data["values"].get(value, value) if isinstance(value, str) else value

    def _fault(self, text: str) -> str:
        code, parts = fault_of(text)
        said = self._faults.get(code, "{text}" if code == "other" else text)
        return str(next(iter(said.values())) if isinstance(said, dict) else said).format(**parts)

    def _nouns(self, kind: str) -> Mapping[str, str]:
        """The words for a kind, made from its names where the language has none of its own."""
        nouns: Mapping[str, str] | None = self._data["things"].get(kind)
        if nouns is not None:
            return nouns
        other: Mapping[str, str] = self._data["things"]["other"]
        plural = KINDS[Kind(kind)].plural
        return {form: words.format(one=kind, many=plural) for form, words in other.items()}


def _form(form: Mapping[str, str], value: object) -> str:
    """The words for a value: its own, or those for one or many, or those for any other."""
    said = form.get(str(value))
    if said is None and isinstance(value, int):
        said = form.get("one" if value == 1 else "many")
    return form["other"] if said is None else said
