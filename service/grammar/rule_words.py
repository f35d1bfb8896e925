"""The words of `rules.yaml`: conditions ("when it crashes", "every 10 ticks") and what is said about rules.

They are kept apart from the lexicon, since they mean nothing in a request that stands for itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

from service.grammar.clause_patterns import Choice, Patterns, Sentence, Slots
from service.grammar.patterns import PatternError

WHEN, ONCE, UNTIL, TIMES = "when", "once", "until", "times"
PARTS = (WHEN, ONCE, UNTIL, TIMES)
"""Parts of a rule beside what it does: what it waits for (`once`: only the next time), its end, how often."""
KEEP = "keep"
"""What begins a request that is repeated: "keep adding"."""
COMMAND = "command"
"""Whole sentences about rules."""
JOINT = "joint"
"""What may stand between a condition and the rest."""
REPEAT = "repeat"
"""How often a request is done at once: "three times"."""
ECHO = "echo"
"""A whole sentence that asks for the one before it several times: "do that three times"."""
SAME = "same"
"""A request that stands for the last one: "do that every 10 ticks"."""

_SENTENCES = (KEEP, COMMAND, ECHO)
_SLOT = "$"
_QUESTION_MARK = "?"


@dataclass(frozen=True, slots=True)
class Phrase:
    """A pattern with what it means, and the words that it may begin with."""

    pattern: Choice
    value: Any
    openings: frozenset[str]


@dataclass(frozen=True, slots=True)
class _Asks:
    """How a question begins, and what follows where it is a polite request."""

    opening: Choice
    unless: Choice

    @staticmethod
    def of(patterns: Patterns, data: Mapping[str, str]) -> _Asks:
        return _Asks(patterns.read(data["with"]), patterns.read(data["unless"]))


@dataclass(frozen=True, slots=True)
class RuleWords:
    """The words around rules in one language; none in a language without that file."""

    patterns: Patterns
    phrases: Mapping[str, tuple[Phrase, ...]]
    """by part, or `keep`, `command`, `joint`"""
    openers: Mapping[str, Choice]
    """by part, the words before a clause"""
    clauses: tuple[Phrase, ...]
    """conditions without the word before them: "it crashes" """
    asks_as: str = ""
    """how a request is begun whose verb is in the form after `keep`: "would you mind" """
    begins: frozenset[str] = frozenset()
    """words without one of which a sentence has nothing to do with rules"""
    vague: Choice | None = None
    """how long and how often in no figures: "for a while" """
    asks: _Asks | None = None
    """how questions begin that ask what would be done"""
    lasting: Choice | None = None
    """how long something is, where it follows what is so: "for 10 ticks" """
    waiting: Choice | None = None
    """what asks to wait for a condition, and so may be joined to the next request by "and" """
    apart: Choice | None = None
    """conditions that may be taken for a part of a request where they stand in its midst"""

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> RuleWords:
        """The words of `rules.yaml`. Raises `PatternError`."""
        patterns = Patterns(data.get("macros", {}), data.get("units", {}), data.get("kinds", {}))
        phrases = {
            part: tuple(_phrases(patterns, entries)) for part, entries in data.get("phrases", {}).items()
        }
        if odd := set(phrases) - {*PARTS, *_SENTENCES, JOINT, REPEAT, SAME}:
            raise PatternError(f"rules.yaml has no use for {', '.join(sorted(odd))}")
        openers = {part: patterns.read(text) for part, text in data.get("openers", {}).items()}
        spoken = (
            phrase.openings for part in (*PARTS, *_SENTENCES, REPEAT) for phrase in phrases.get(part, ())
        )
        opened = (patterns.openings(opener) for opener in openers.values())
        return cls(
            patterns,
            phrases,
            openers,
            tuple(_phrases(patterns, data.get("clauses", ()))),
            data.get("asks_as", ""),
            frozenset(chain.from_iterable((*spoken, *opened, data.get("counted", "").split()))) - {"{}"},
            patterns.read(data["vague"]) if "vague" in data else None,
            _Asks.of(patterns, data["asks"]) if "asks" in data else None,
            patterns.read(data["lasting"]) if "lasting" in data else None,
            patterns.read(data["waiting"]) if "waiting" in data else None,
            patterns.read(data["apart"]) if "apart" in data else None,
        )

    @property
    def words(self) -> frozenset[str]:
        """All words that the patterns have."""
        return frozenset(self.patterns.words)

    def stands_apart(self, said: Sentence, at: int) -> bool:
        """Whether a condition at a token may not stand amid a request: "remove every second cone"."""
        return self.apart is not None and any(self.patterns.matches(self.apart, said, at))

    def lasts(self, said: Sentence, at: int, stop: int) -> bool:
        """Whether the tokens `[at, stop)` may say how long something is so: "for 10 ticks"."""
        return self.lasting is not None and any(
            end == stop for end, _ in self.patterns.matches(self.lasting, said, at)
        )

    def waits(self, said: Sentence, at: int) -> bool:
        """Whether a request to wait for something begins at a token."""
        return self.waiting is not None and any(self.patterns.matches(self.waiting, said, at))

    def is_vague(self, said: Sentence) -> bool:
        """Whether something is said that no rule can do as it is said: "for a while"."""
        if self.vague is None:
            return False
        return any(any(self.patterns.matches(self.vague, said, at)) for at in range(len(said.tokens)))

    def asks_about_driving(self, said: Sentence) -> bool:
        """Whether a sentence asks what would be done, as "would you brake if it rains?" does."""
        asked = self.asks is not None and any(token.text == _QUESTION_MARK for token in said.tokens)
        if not asked or self.asks is None:
            return False
        ends = {end for end, _ in self.patterns.matches(self.asks.opening, said, 0)}
        polite = (any(self.patterns.matches(self.asks.unless, said, end)) for end in ends)
        return bool(ends) and not any(polite)

    def at(self, part: str, said: Sentence, at: int) -> Iterator[tuple[int, Any]]:
        """The ends of all phrases of a part that begin at a token, with what each means."""
        yield from self._among(self.phrases.get(part, ()), said, at)
        if part in self.openers:
            for end, _ in self.patterns.matches(self.openers[part], said, at):
                yield from self._among(self.clauses, said, end)

    def _among(self, phrases: tuple[Phrase, ...], said: Sentence, at: int) -> Iterator[tuple[int, Any]]:
        if at >= len(said.tokens):
            return
        word = said.tokens[at].text
        number = at in said.numbers or at in said.ordinals
        for phrase in phrases:
            if word in phrase.openings or (number and "{}" in phrase.openings):
                for end, slots in self.patterns.matches(phrase.pattern, said, at):
                    yield end, _filled(phrase.value, slots)


def _phrases(patterns: Patterns, entries: Any) -> Iterator[Phrase]:
    for entry in entries:
        value, says = (entry["is"], entry["say"]) if isinstance(entry, dict) else (None, entry)
        for text in (says,) if isinstance(says, str) else says:
            pattern = patterns.read(text)
            yield Phrase(pattern, value, patterns.openings(pattern))


def _filled(value: Any, slots: Slots) -> Any:
    """A value with `$name` replaced by what was said; one more or less where that follows: `$n+1`."""
    if isinstance(value, str) and value.startswith(_SLOT):
        name, more, less = value[1:], value.endswith("+1"), value.endswith("-1")
        return slots[name[:-2]] + (1 if more else -1) if more or less else slots[name]
    if isinstance(value, Mapping):
        return {key: _filled(part, slots) for key, part in value.items()}
    return value
