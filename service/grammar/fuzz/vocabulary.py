"""The words of a language that the fuzzer changes sentences with (`fuzz.yaml`)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from service.resources import prompts_folder
from service.yaml_files import read_yaml


@dataclass(frozen=True, slots=True)
class Excuse:
    """Why a change of one kind may leave some requests what they are."""

    because: str
    kinds: frozenset[str]
    changes: frozenset[str]
    """the words that were put in or taken out; any where it is empty"""
    does: frozenset[str]
    """the names of all actions of the sentence; any where it is empty"""
    beside: frozenset[str] = frozenset()
    """words of which one must be in the sentence; none where it is empty"""


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """What `fuzz.yaml` says; every mapping is by the kind of change."""

    joiners: Sequence[str] = ()
    insert: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """what is put in, with marks for the place"""
    replace: Mapping[str, Sequence[Sequence[str]]] = field(default_factory=dict)
    """lists of phrases of which each means something else"""
    numbers: Sequence[str] = ()
    """numbers that are put in"""
    numbered: frozenset[str] = frozenset()
    """words that are replaced as numbers"""
    forms: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """verb → its other forms by name"""
    kept: frozenset[str] = frozenset()
    """kinds of which nothing is left out: what is left may mean the same"""
    loose: frozenset[str] = frozenset()
    """kinds that may mean the same or be refused, and must not mean another request"""
    excuses: Sequence[Excuse] = ()

    def __bool__(self) -> bool:
        return bool(self.insert or self.replace)


def vocabulary_of(code: str) -> Vocabulary:
    """The words for a language; empty where it has no such file."""
    path = prompts_folder() / "language" / code / "fuzz.yaml"
    if not path.is_file():
        return Vocabulary()
    data: Mapping[str, Any] = read_yaml(path)
    names, *verbs = (str(line).split() for line in data.get("forms", [""]))
    return Vocabulary(
        joiners=_texts(data.get("joiners", ())),
        insert={kind: _texts(words) for kind, words in data.get("insert", {}).items()},
        replace={
            kind: [[each.strip() for each in str(line).split(",")] for line in lines]
            for kind, lines in data.get("replace", {}).items()
        },
        numbers=_texts(data.get("numbers", ())),
        numbered=frozenset(_texts(data.get("numbered", ()))),
        forms={verb[0]: dict(zip(names, verb[1:], strict=True)) for verb in verbs},
        kept=frozenset(str(data.get("kept", "")).split()),
        loose=frozenset(str(data.get("loose", "")).split()),
        excuses=[_excuse(each) for each in data.get("same", ())],
    )


def _texts(values: Sequence[object]) -> list[str]:
    return [str(value) for value in values]


def _excuse(data: Mapping[str, Any]) -> Excuse:
    changes, beside = (frozenset(_texts(data.get(key, ()))) for key in ("changes", "beside"))
    return Excuse(
        str(data["because"]),
        frozenset(each.strip() for each in str(data["kinds"]).split(",")),
        changes,
        frozenset(str(data.get("does", "")).split()),
        beside,
    )
