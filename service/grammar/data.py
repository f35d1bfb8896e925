"""Reads a language's folder: lexicon, numbers, frames, messages. The only place that knows its files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from service.grammar.build import Parameters
from service.grammar.frames import Frame, FrameError, read_frames
from service.grammar.lexicon import Lexicon
from service.grammar.numbers import NumberWords
from service.grammar.patterns import PatternError, read_macros
from service.grammar.tokens import Contractions
from service.grammar.typos import TypoRules
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
    )
)
"""What the engine itself says."""

TEST_SUFFIX = ".test.yaml"


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
    vague: int
    number_words: frozenset[str]
    nouns: Mapping[str, str]
    """for each concept that may only stand with a value of its own kind ("weather"), that kind"""

    def knows(self, word: str) -> bool:
        """Whether a word means anything, alone or in a phrase."""
        return self.lexicon.knows(word) or word in self.number_words


def read_language(folder: Path) -> LanguageData:
    """The language in a folder. Raises `LanguageDataError`."""
    if not folder.is_dir():
        raise LanguageDataError(f"there is no language in {folder}")
    try:
        return _read(folder)
    except (PatternError, FrameError, KeyError, YamlError) as error:
        raise LanguageDataError(f"{folder}: {type(error).__name__}: {error}") from error


class YamlError(Exception):
    """A file that is no YAML."""


def read_yaml(path: Path) -> Any:
    """What one YAML file holds. Raises `YamlError`."""
    import yaml  # with the words themselves, and not where only the types are needed

    try:
        return yaml.load(path.read_bytes(), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except yaml.YAMLError as error:
        raise YamlError(f"{path.name}: {error}") from error


def _read(folder: Path) -> LanguageData:
    words = read_yaml(folder / "words.yaml")
    if missing := MESSAGES - words["messages"].keys():
        raise KeyError(f"words.yaml has no message {', '.join(sorted(missing))}")
    lexicon = Lexicon(read_macros(read_yaml(folder / "macros.yaml")))
    for path in sorted((folder / "lexicon").glob("*.yaml")):
        if not path.name.endswith(TEST_SUFFIX):
            lexicon.add_section(read_yaml(path))
    if "planner" in lexicon.concepts:  # one that the language has no words for goes by its name
        unnamed = [name for name in BUILT_IN if ("planner", repr(name)) not in lexicon.typical]
        lexicon.add_section({"planner": {name: f"{name}, {name} planner" for name in unnamed}})
    frames: dict[str, Any] = {"sets": {}, "agree": {}, "frames": {}}
    for path in sorted((folder / "frames").glob("*.yaml")):
        if not path.name.endswith(TEST_SUFFIX):
            data = read_yaml(path)
            frames["sets"].update(data.get("sets", {}))
            frames["agree"].update(data.get("agree", {}))
            for name, content in data.get("frames", {}).items():
                if name in frames["frames"]:
                    raise FrameError(f"frame {name} is there twice")
                frames["frames"][name] = content
    numbers = NumberWords.from_data(read_yaml(folder / "numbers.yaml"))
    return LanguageData(
        lexicon=lexicon,
        numbers=numbers,
        contractions=Contractions.from_data(words["contractions"]),
        typos=TypoRules.from_data(read_yaml(folder / "typos.yaml")),
        parameters=Parameters({name: takes.split() for name, takes in words["parameters"].items()}),
        frames=read_frames(frames),
        messages=words["messages"],
        lanes=tuple(words.get("lanes", ())),
        sentences=read_yaml(folder / "sentences.yaml") if (folder / "sentences.yaml").is_file() else {},
        vague=int(words["vague"]),
        number_words=numbers.words(),
        nouns=frames["agree"],
    )
