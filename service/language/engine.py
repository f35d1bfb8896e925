"""The language engine: text → actions, a question, or a refusal, and nothing in between.

Tokens → typos → items → fragments → clauses → actions; each stage is a file of its own. Nothing here knows
a word of any language: words, frames, messages all come from `prompts/language/<code>/`.

Guarantees: every content word is accounted for or the sentence is refused; parsing is a
pure function of the text; no input raises.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from service.actions import Action, load
from service.language.capture import names
from service.language.clauses import Clause, Divided, Divider, Fragment, fragments
from service.language.data import LanguageData, LanguageDataError, read_language
from service.language.lattice import GLUE, Lattice, Scanner
from service.language.linter import defects, flaws
from service.language.matching import Frames
from service.language.noun_phrases import NOUN, QUANTITY, Amount, add_noun_phrases
from service.language.parse_types import Ambiguous, Choice, Correction, Parse, Reason, Refused, Understood
from service.language.paths import ALLOWS, SEPARATOR
from service.language.suggestions import Suggestions
from service.language.tokens import Token, normalise, renamed, tokenise
from service.language.typos import Typos
from service.language.wrappers import wrapped
from service.resources import prompts_folder

MAX_TOKENS = 300
"""Longer utterances are refused unread: the service caps text at 500 characters anyway."""

MAX_UNPARSED = 8
"""How many stretches not understood a refusal names."""


class Language:
    """One language, loaded. Immutable after loading; safe to share between threads."""

    def __init__(self, data: LanguageData, offered: Callable[[Action], bool] | None = None) -> None:
        self.data = data
        self._offered = offered
        self._lexicon = data.lexicon
        self._scanner = Scanner(data.lexicon, data.numbers)
        self.frames = Frames(data.frames, data.parameters)

    @classmethod
    def load(
        cls,
        code: str = "en",
        folder: Path | None = None,
        offered: Callable[[Action], bool] | None = None,
    ) -> Language:
        """The language with this code, from `folder` (default: the project's prompts).

        Everything in it is understood; only what is `offered` is suggested.
        Raises `LanguageDataError`, naming every defect, when the files are unfit.
        """
        data = read_language((folder or prompts_folder() / "language") / code)
        if found := flaws(data):
            raise LanguageDataError("; ".join(found))
        return cls(data, offered)

    def parse(self, text: str) -> Parse:
        """What a person said: `Understood`, `Refused` or `Ambiguous`. Never raises."""
        return self._parse(text, asking=True)

    def _parse(self, text: str, *, asking: bool) -> Parse:
        messages = self.data.messages
        plain = normalise(text)
        tokens = tokenise(plain, self.data.contractions)
        if not tokens:
            return Refused(text, "empty", messages["empty"])
        if len(tokens) > MAX_TOKENS:
            return Refused(text, "not_understood", messages["too_long"].format(words=MAX_TOKENS))
        kept = names(tokens, self._lexicon)
        tokens, corrections = self._repaired(plain, tokens, kept)
        lattice = self._scanner.scan(tokens, kept, plain)
        lattice.keep_whole(self.data.nouns)
        return _Reading(self, text, plain, tokens, lattice, corrections).parse(asking=asking)

    def check(self) -> list[str]:
        """Every defect of the language's data (see `linter`); empty when it is fit."""
        return defects(self.data, self.parse)

    @cached_property
    def typos(self) -> Typos:
        """The typo repairer, made at the first unknown word."""
        words = self._lexicon.words | self.data.numbers.words()

        def same(a: str, b: str) -> bool:
            return a.startswith(b) or b.startswith(a) or not self._nouns(a).isdisjoint(self._nouns(b))

        return Typos(self.data.typos, words, self.data.numbers.words(), same)

    def _nouns(self, word: str) -> frozenset[str]:
        """What a word alone is a noun for, singular and plural taken together."""
        senses = self._lexicon.senses_of((word,))
        return frozenset(str(sense.value) for sense in senses if sense.concept.startswith(NOUN))

    def _repaired(
        self, plain: str, tokens: list[Token], kept: dict[int, int]
    ) -> tuple[list[Token], tuple[Correction, ...]]:
        """The tokens with one-edit typos read as meant, and the list of what was changed."""
        corrections: list[Correction] = []
        in_names = {at for start, end in kept.items() for at in range(start, end)}
        for at, token in enumerate(tokens):
            word = token.text
            if token.digits or at in in_names or self.data.knows(word) or not word.isalpha():
                continue
            meant = self.typos.repair(word)
            if meant is not None:
                tokens[at] = renamed(token, meant)
                corrections.append(Correction(plain[token.start : token.end], meant))
        return tokens, tuple(corrections)

    @cached_property
    def suggestions(self) -> Suggestions:
        """The example sayings of all frames, ready to be ranked; made at the first refusal."""
        sayings = [say for frame in self.data.frames for say in frame.says if self._suggests(say)]
        return Suggestions((say, self.concepts(say)) for say in sayings)

    def _suggests(self, say: str) -> bool:
        if self._offered is None:
            return True
        parse = self.parse(say)
        return isinstance(parse, Understood) and all(map(self._offered, parse.actions))

    def concepts(self, text: str) -> frozenset[str]:
        """The content concepts that occur in a text."""
        plain = normalise(text)
        tokens = tokenise(plain, self.data.contractions)
        return _content(self._scanner.scan(tokens, {}, plain))


def _content(lattice: Lattice) -> frozenset[str]:
    """The concepts of a sentence that say what it is about."""
    return frozenset(
        f"{edge.concept}={edge.sense.value}" if isinstance(edge.sense.value, str) else edge.concept
        for edge in lattice.all()
        if edge.concept not in (GLUE, SEPARATOR, QUANTITY, ALLOWS)
    )


def _once(values: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Without what is only said again for emphasis: "stop, hold on" pauses once."""
    return [
        value
        for value, before in zip(values, [None, *values], strict=False)
        if value != before or value["do"] not in _STEADY
    ]


_STEADY = ("pause", "resume")
"""Actions that make no difference the second time."""


class _Reading:
    """One utterance on its way through the engine."""

    def __init__(
        self,
        language: Language,
        text: str,
        plain: str,
        tokens: list[Token],
        lattice: Lattice,
        corrections: tuple[Correction, ...],
    ) -> None:
        self._language = language
        self._messages = language.data.messages
        self._text = text
        self._plain = plain
        self._tokens = tokens
        self._lattice = lattice
        self._corrections = corrections

    def parse(self, *, asking: bool) -> Parse:
        """The whole utterance."""
        unknown = self._lattice.uncovered()
        if unknown:
            return self._refused(self._stretches(unknown), ())
        add_noun_phrases(self._lattice, self._language.data.vague)
        result = wrapped(self._lattice, self._divide)
        if isinstance(result, Fragment):
            return self._refused([self._written(result.start, result.end)], ())
        divided = Divided([result]) if result else self._divide(0, self._lattice.size, frozenset())
        clauses = divided.clauses
        if divided.failed is not None or not clauses:
            return self._refused_after(divided)
        question = next(
            (clause for clause in clauses if clause.filled.frame.ask and not clause.negated), None
        )
        if question is not None:
            return self._asked(question) if asking else self._refused([self._plain], ())
        values = _once([value for clause in clauses for value in clause.actions])
        if not values:
            return self._refusal("negation", self._messages["negation"])
        try:
            actions = load(values)
        except ValidationError:
            return self._impossible(clauses)
        return Understood(self._text, actions, self._corrections)

    def _divide(self, start: int, end: int, moods: frozenset[str]) -> Divided:
        """The clauses of tokens `[start, end)`, with these forms in place."""
        divider = Divider(self._language.frames, self._lattice, self._language.data.vague, moods)
        return divider.divide(fragments(self._lattice, start, end))

    def _asked(self, clause: Clause) -> Parse:
        """The question of an ambiguous clause; each choice is the whole utterance with it replaced."""
        ask = clause.filled.frame.ask
        if ask is None:
            return self._refused([self._plain], ())
        said: dict[str, str] = {}
        for edge in clause.filled.slots:
            written = self._written(edge.start, edge.end)
            said[edge.concept.partition(".")[0]] = written
            if isinstance(edge.sense.value, Amount):
                noun = self._tokens[edge.end - 1]
                said["noun"] = self._plain[noun.start : noun.end]
        start, end = self._tokens[clause.start].start, self._tokens[clause.end - 1].end
        choices: list[Choice] = []
        for template in ask.choices:
            try:
                sentence = template.format_map(said)
            except KeyError:
                continue
            whole = self._plain[:start] + sentence + self._plain[end:]
            parsed = self._language._parse(whole, asking=False)
            if isinstance(parsed, Understood) and all(c.actions != parsed.actions for c in choices):
                choices.append(Choice(whole.strip(), parsed.actions))
        if len(choices) < 2:
            return self._refused([self._written(clause.start, clause.end)], ())
        return Ambiguous(self._text, ask.question, tuple(choices))

    def _impossible(self, clauses: Sequence[Clause]) -> Refused:
        """The refusal of actions whose values cannot be."""
        for clause in clauses:
            try:
                load(clause.actions)
            except ValidationError:
                phrase = self._written(clause.start, clause.end)
                return self._refusal(
                    "impossible", self._messages["impossible"].format(phrase=phrase), (phrase,)
                )
        return self._refusal("impossible", self._messages["impossible"].format(phrase=self._text))

    def _refused_after(self, divided: Divided) -> Refused:
        """The refusal of a sentence of known words that make no request."""
        understood = tuple(self._written(clause.start, clause.end) for clause in divided.clauses)
        part = divided.failed
        if part is None:
            return self._refused([self._plain.strip()], understood)
        failed = self._written(part.start, part.end)
        if any(_impossible_number(edge.sense.value) for edge in self._lattice.between(part.start, part.end)):
            return self._refusal("impossible", self._messages["impossible"].format(phrase=failed), (failed,))
        return self._refused([failed], understood)

    def _refused(self, unparsed: list[str], understood: tuple[str, ...]) -> Refused:
        shown = unparsed[:MAX_UNPARSED]
        quoted = self._messages["and"].join(f'"{_shortened(phrase)}"' for phrase in shown)
        message = self._messages["not_understood"].format(phrases=quoted)
        return self._refusal("not_understood", message, tuple(shown), understood)

    def _refusal(
        self,
        reason: Reason,
        message: str,
        unparsed: tuple[str, ...] = (),
        understood: tuple[str, ...] = (),
    ) -> Refused:
        suggestions = self._language.suggestions.nearest(self._plain, _content(self._lattice))
        return Refused(self._text, reason, message, unparsed, understood, suggestions)

    def _stretches(self, unknown: list[int]) -> list[str]:
        """The stretches with unknown words; unknown words with only glue between them are one."""
        stretches: list[tuple[int, int]] = []
        for at in unknown:
            if stretches and self._only_glue(stretches[-1][1], at):
                stretches[-1] = (stretches[-1][0], at + 1)
            else:
                stretches.append((at, at + 1))
        return [self._written(start, end) for start, end in stretches]

    def _only_glue(self, start: int, end: int) -> bool:
        return all(any(edge.concept == GLUE for edge in self._lattice.edges[at]) for at in range(start, end))

    def _written(self, start: int, end: int) -> str:
        """Tokens `[start, end)` as they stand in the text."""
        if not self._tokens:
            return ""
        first = min(start, len(self._tokens) - 1)
        last = max(min(end, len(self._tokens)) - 1, first)
        return self._plain[self._tokens[first].start : self._tokens[last].end]


def _impossible_number(value: object) -> bool:
    """Whether a value is a number that no count or place can be: negative."""
    return isinstance(value, int | float) and value < 0


def _shortened(phrase: str, limit: int = 80) -> str:
    return phrase if len(phrase) <= limit else phrase[: limit - 1] + "…"
