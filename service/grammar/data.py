"""Reads a language's folder: lexicon, numbers, frames, messages. The only place that knows its files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from service.grammar.answer_words import Answers
from service.grammar.build import Parameters
from service.grammar.frame_use import idle
from service.grammar.frames import Frame, FrameError, read_frames
from service.grammar.lexicon import Lexicon
from service.grammar.numbers import NumberWords
from service.grammar.other_words import OtherWords
from service.grammar.patterns import PatternError, read_macros
from service.grammar.rule_words import RuleWords
from service.grammar.tokens import Contractions, normalise, tokenise
from service.grammar.typos import TypoRules
from service.yaml_files import YamlError, read_yaml
from sim.planner_names import BUILT_IN

MESSAGES = frozenset(
    (
        "empty",
        "too_long",
        "too_involved",
        "not_understood",
        "and",
        "impossible",
        "negation",
        "contradiction",
        "both",
        "earlier",
        "instead",
        "no_referent",
        "which",
        "more_of_what",
        "together_or_apart",
        "too_often",
        "several_times",
    )
)
"""What the engine itself says."""

TEST_SUFFIX = ".test.yaml"
FACTS = "facts.yaml"
"""The sentences that ask for what is always so, by fact; the first of each is said back."""


class LanguageDataError(ValueError):
    """The files of a language are unfit; the message names every defect found."""


@dataclass(frozen=True, slots=True)
class LanguageData:
    """Everything a language's files say."""

    lexicon: Lexicon
    numbers: NumberWords
    contractions: Contractions
    typos: TypoRules
    parameters: Parameters
    frames: list[Frame]
    messages: Mapping[str, str]
    lanes: tuple[str, ...]
    """what may be meant by a lane that is not clear"""
    sentences: Mapping[str, Any]
    """how actions are said back; empty in a language that cannot"""
    stand_ins: Mapping[str, str]
    """words for things there are none of, and the word for what stands for each"""
    asks_on: frozenset[str]
    """words that begin a question to which a verb after "and" belongs"""
    vague: int
    number_words: frozenset[str]
    answers: Answers
    """how questions are answered, and what begins a sentence that leans on the one before"""
    rules: RuleWords
    """how rules are said"""
    others: OtherWords
    """sentences that are read as others, or refused for a known reason"""
    nouns: Mapping[str, str]
    """for each concept that may only stand with a value of its own kind ("weather"), that kind"""
    free: frozenset[str]
    """concepts that frames may take and have no use for, because they say nothing more"""
    idle: frozenset[str]
    """these, and all others that no frame has a use for"""

    def knows(self, word: str) -> bool:
        """Whether a word means anything, alone or in a phrase."""
        return self.lexicon.knows(word) or word in self.number_words


@dataclass(frozen=True, slots=True)
class Documents:
    """The parsed files of a language, the lexicon's aside."""

    words: Mapping[str, Any]
    numbers: Mapping[str, Any]
    typos: Mapping[str, Any]
    sentences: Mapping[str, Any]
    answers: Mapping[str, Any]
    rules: Mapping[str, Any]
    others: Mapping[str, Any]
    frames: Mapping[str, Any]
    """`sets`, `agree`, and the `frames` of all intents together"""


def read_language(folder: Path) -> LanguageData:
    """The language in a folder. Raises `LanguageDataError`."""
    return language_data(*read_parts(folder))


def read_parts(folder: Path) -> tuple[Documents, Lexicon]:
    """What the files of a language hold, and its lexicon. Raises `LanguageDataError`."""
    if not folder.is_dir():
        raise LanguageDataError(f"there is no language in {folder}")
    try:
        documents, lexicon = _documents(folder), _lexicon(folder)
        language_data(documents, lexicon)  # what they hold must also make sense
    except (PatternError, FrameError, KeyError, YamlError) as error:
        raise LanguageDataError(f"{folder}: {type(error).__name__}: {error}") from error
    return documents, lexicon


def data_files(folder: Path) -> list[Path]:
    """The files a language is made of, without its tests; in order of their paths."""
    return sorted(path for path in folder.rglob("*.yaml") if not path.name.endswith(TEST_SUFFIX))


def _documents(folder: Path) -> Documents:
    words = read_yaml(folder / "words.yaml")
    if missing := MESSAGES - words["messages"].keys():
        raise KeyError(f"words.yaml has no message {', '.join(sorted(missing))}")
    frames: dict[str, Any] = {**read_yaml(folder / "sets.yaml"), "frames": {}}
    for path in data_files(folder / "intents"):
        for name, content in read_yaml(path)["frames"].items():
            if name in frames["frames"]:
                raise FrameError(f"frame {name} is there twice")
            frames["frames"][name] = content
    named = ("sentences", "answers", "rules", "other_words")
    said_back, answers, rules, others = (folder / f"{name}.yaml" for name in named)
    sentences = read_yaml(said_back) if said_back.is_file() else {}
    return Documents(
        words=words,
        numbers=read_yaml(folder / "numbers.yaml"),
        typos=read_yaml(folder / "typos.yaml"),
        sentences=sentences | {"facts": {name: said[0] for name, said in _facts(folder).items()}}
        if sentences
        else {},
        answers=read_yaml(answers) if answers.is_file() else {},
        rules=read_yaml(rules) if rules.is_file() else {},
        others=read_yaml(others) if others.is_file() else {},
        frames=frames,
    )


def _facts(folder: Path) -> Mapping[str, Sequence[str]]:
    """The sentences that ask for each fact; a language may do without."""
    facts: Mapping[str, Sequence[str]] = read_yaml(folder / FACTS) if (folder / FACTS).is_file() else {}
    return facts


def _lexicon(folder: Path) -> Lexicon:
    lexicon = Lexicon(read_macros(read_yaml(folder / "macros.yaml")))
    for path in data_files(folder / "intents"):  # first: what a word means to one intent is tried first
        lexicon.add_section(read_yaml(path).get("phrases", {}))
    for path in data_files(folder / "lexicon"):
        lexicon.add_section(read_yaml(path))
    short = Contractions.from_data(read_yaml(folder / "words.yaml")["contractions"])
    for name, said in _facts(folder).items():  # sentences as they are written, and no patterns
        lexicon.add_section({"fact": {name: [_as_pattern(text, short) for text in said]}})
    if "planner" in lexicon.concepts:  # one that the language has no words for goes by its name
        unnamed = [name for name in BUILT_IN if ("planner", repr(name)) not in lexicon.typical]
        lexicon.add_section({"planner": {name: f"{name}, {name} planner" for name in unnamed}})
    return lexicon


def _as_pattern(sentence: str, contractions: Contractions) -> str:
    """A sentence as a phrase of the lexicon: its words as they are read, its marks in brackets."""
    tokens = tokenise(normalise(sentence), contractions)
    return " ".join(each.text if each.text.isalnum() else f"<{each.text}>" for each in tokens)


def language_data(documents: Documents, lexicon: Lexicon) -> LanguageData:
    """A language of its parts."""
    words = documents.words
    numbers = NumberWords.from_data(documents.numbers)
    frames = read_frames(documents.frames)
    free = frozenset(str(documents.frames.get("free", "")).split())
    answers = Answers.from_data(documents.answers)
    rules = RuleWords.from_data(documents.rules)
    written = lexicon.words | numbers.words() | rules.words
    contractions = Contractions.from_data(words["contractions"]).with_spellings(
        written, words["contractions"].get("spellings", ())
    )
    return LanguageData(
        lexicon=lexicon,
        numbers=numbers,
        contractions=contractions,
        asks_on=frozenset(words.get("asks_on", ())),
        typos=TypoRules.from_data(documents.typos),
        parameters=Parameters(
            {name: takes.split() for name, takes in words["parameters"].items()}, int(words["vague"])
        ),
        frames=frames,
        messages=words["messages"],
        lanes=tuple(words.get("lanes", ())),
        sentences=documents.sentences,
        stand_ins={said: stands for stands, each in words.get("stand_ins", {}).items() for said in each},
        vague=int(words["vague"]),
        number_words=numbers.words(),
        answers=answers,
        rules=rules,
        others=OtherWords.from_data(documents.others),
        nouns=documents.frames["agree"],
        free=free,
        idle=idle(frames, free),
    )
