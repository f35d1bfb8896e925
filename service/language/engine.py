"""The language engine: text → actions, a question, or a refusal, and nothing in between.

Tokens → typos → items → fragments → clauses → actions; each stage is a file of its own. Nothing here knows
a word of any language: words, frames, messages all come from `prompts/language/<code>/`.

Guarantees: every content word is accounted for or the sentence is refused; parsing is a
pure function of the text; no input raises.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from service.actions import Action, dump, load
from service.language.capture import names
from service.language.clauses import Clause, Divided, Divider, Fragment, fragments
from service.language.data import LanguageData, LanguageDataError, read_language
from service.language.lattice import GLUE, Lattice, Name, Scanner
from service.language.linter import defects, flaws
from service.language.matching import Frames
from service.language.noun_phrases import NOUN, QUANTITY, Amount, add_noun_phrases
from service.language.parse_types import Ambiguous, Choice, Correction, Parse, Reason, Refused, Understood
from service.language.paths import ALLOWS, SEPARATOR
from service.language.references import Unclear, add_known, add_referents
from service.language.remembered import Remembered
from service.language.repairs import Repaired
from service.language.sentences import Sentences, Unsayable
from service.language.suggestions import Suggestions
from service.language.tokens import Token, as_said, normalise, renamed, tokenise
from service.language.topic import ALONE, Phrases, Topic
from service.language.typos import Typos
from service.language.wrappers import read_all
from service.resources import prompts_folder
from sim.actions import Add, Remove

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
        self.sentences = Sentences(data.sentences)
        self._remembered = Remembered(lambda text, topic: self.read(text, topic, asking=True))

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

    def parse(self, text: str, topic: Topic = ALONE) -> Parse:
        """What a person said: `Understood`, `Refused` or `Ambiguous`. Never raises.

        `topic` is what it may refer to; without one it is read as a sentence that stands alone.
        """
        return self._remembered.parse(text, topic)

    def read(self, text: str, topic: Topic, *, asking: bool) -> Parse:
        """`parse`; unless `asking`, what would be asked about is refused."""
        messages = self.data.messages
        plain = normalise(text)
        tokens = tokenise(plain, self.data.contractions)
        if not tokens:
            return Refused(text, "empty", messages["empty"])
        if len(tokens) > MAX_TOKENS:
            return Refused(text, "not_understood", messages["too_long"].format(words=MAX_TOKENS))
        kept = names(tokens, self._lexicon, as_said(text, plain), topic)
        tokens, corrections = self._repaired(plain, tokens, kept, topic)
        lattice = self._scanner.scan(tokens, kept)
        lattice.keep_whole(self.data.nouns)
        add_known(lattice, tokens, topic)
        if not kept and (repaired := Repaired.found(plain, tokens, lattice)) is not None:
            readings = repaired.readings(lambda each: self.read(each, topic, asking=False))
            if readings is not None and not lattice.uncovered():
                return self._put_right(text, repaired.phrase, readings, lattice, asking=asking)
        return _Reading(self, text, plain, tokens, lattice, corrections, topic).parse(asking=asking)

    def _put_right(
        self, text: str, phrase: str, readings: list[Choice], lattice: Lattice, *, asking: bool
    ) -> Parse:
        """What a sentence means in which something was taken back."""
        if len(readings) == 1:
            return Understood(text, readings[0].actions)
        if asking and readings:
            return Ambiguous(text, self.data.messages["which"], tuple(readings))
        message = self.data.messages["not_understood"].format(phrases=f'"{phrase}"')
        suggestions = self.suggestions.nearest(text, _content(lattice))
        return Refused(text, "not_understood", message, (phrase,), (), suggestions)

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""
        return self.sentences.sentence(actions)

    def phrases(self, taught: Mapping[str, Sequence[Action]]) -> Phrases:
        """Taught phrases and what they mean, ready to be found in sentences of this language."""
        by_first: dict[str, list[tuple[tuple[str, ...], list[dict[str, Any]]]]] = {}
        for phrase, actions in taught.items():
            if words := self.words_of(phrase):
                by_first.setdefault(words[0], []).append((words, dump(tuple(actions))))
        return Phrases(by_first)

    @cached_property
    def joiners(self) -> frozenset[str]:
        """The words that stand between one request and the next."""
        joining = (w for w, senses in self._lexicon.phrases() if any(s.concept == SEPARATOR for s in senses))
        return frozenset(words[0] for words in joining if len(words) == 1 and words[0].isalpha())

    def ways_to_say(self, concept: str) -> list[str]:
        """The best ways to say each value of a concept."""
        return [" ".join(words) for (name, _), words in self._lexicon.typical.items() if name == concept]

    def means_the_same(self, words: tuple[str, ...]) -> list[tuple[str, ...]]:
        """The best ways to say what these words mean: for "put" it is "add"."""
        senses = self._lexicon.senses_of(words)
        told = (
            self._lexicon.typical.get((sense.concept, repr(sense.value)))
            for sense in senses
            if not sense.form
        )
        return list(dict.fromkeys(typical for typical in told if typical))

    def words_of(self, text: str) -> tuple[str, ...]:
        """The words and marks of a text, as they are compared."""
        return tuple(token.text for token in tokenise(normalise(text), self.data.contractions))

    def check(self) -> list[str]:
        """Every defect of the language's data (see `linter`); empty when it is fit."""
        return defects(self.data, self.parse)

    @cached_property
    def typos(self) -> Typos:
        """The typo repairer, made at the first unknown word."""
        words = self._lexicon.words | self.data.numbers.words()

        def same(a: str, b: str) -> bool:
            if a.startswith(b) or b.startswith(a) or not self._nouns(a).isdisjoint(self._nouns(b)):
                return True
            meant = self._meant(a)
            return bool(meant) and meant == self._meant(b)

        return Typos(self.data.typos, words, self.data.numbers.words(), same)

    def _meant(self, word: str) -> frozenset[tuple[str, str]]:
        """All that a word alone can mean."""
        senses = self._lexicon.senses_of((word,))
        return frozenset((sense.concept, repr(sense.value)) for sense in senses)

    def _nouns(self, word: str) -> frozenset[str]:
        """What a word alone is a noun for, singular and plural taken together."""
        senses = self._lexicon.senses_of((word,))
        return frozenset(str(sense.value) for sense in senses if sense.concept.startswith(NOUN))

    def _repaired(
        self, plain: str, tokens: list[Token], kept: Mapping[int, Name], topic: Topic
    ) -> tuple[list[Token], tuple[Correction, ...]]:
        """The tokens with one-edit typos read as meant, and the list of what was changed."""
        corrections: list[Correction] = []
        in_names = {at for start, name in kept.items() for at in range(start, name.end)}
        if topic.phrases.by_first:
            words = [token.text for token in tokens]
            for start in range(len(tokens)):
                if (taught := topic.phrases.at(words, start)) is not None:
                    in_names.update(range(start, taught[0]))
        for at, token in enumerate(tokens):
            word = token.text
            if token.digits or token.id or at in in_names or self.data.knows(word) or not word.isalpha():
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
        return _content(self._scanner.scan(tokens, {}))


def _content(lattice: Lattice) -> frozenset[str]:
    """The concepts of a sentence that say what it is about."""
    return frozenset(
        f"{edge.sense.concept}={edge.sense.value}"
        if isinstance(edge.sense.value, str)
        else edge.sense.concept
        for edge in lattice.all()
        if edge.sense.concept not in (GLUE, SEPARATOR, QUANTITY, ALLOWS)
    )


def _once(clauses: Sequence[Clause]) -> list[dict[str, Any]]:
    """All actions, without what is only said again for emphasis: "stop, hold on" pauses once."""
    values: list[dict[str, Any]] = []
    for clause in clauses:
        again = bool(values) and clause.after in _EMPHASIS and clause.actions == values[-1:]
        if not (again and clause.actions[0]["do"] in _STEADY):
            values += clause.actions
    return values


_STEADY = ("pause", "resume")
"""Actions that make no difference the second time."""

_EMPHASIS = ("pause", "stop", "and")
"""Separators after which they may be said again for emphasis; "pause, then pause" is two."""


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
        topic: Topic,
    ) -> None:
        self._language = language
        self._topic = topic
        self._unclear: list[Unclear] = []
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
        self._unclear = add_referents(self._lattice, self._topic)
        divided = read_all(self._lattice, 0, self._lattice.size, self._divide)
        if isinstance(divided, Fragment):
            return self._refused([self._written(divided.start, divided.end)], (), asking=asking)
        clauses = divided.clauses
        if divided.failed is not None or not clauses:
            return self._refused_after(divided, asking=asking)
        question = next(
            (clause for clause in clauses if clause.filled.frame.ask and not clause.negated), None
        )
        if question is not None:
            return self._asked(question) if asking else self._refused([self._plain], ())
        values = _once(clauses)
        if not values:
            return self._refusal("negation", self._messages["negation"])
        try:
            actions = load(values)
        except ValidationError:
            return self._impossible(clauses)
        if self._topic.removed and clauses[0].leans:
            return self._more_of_what(actions) if asking else self._refused([self._plain], ())
        supposes = next((each.supposes for each in clauses if each.actions and each.supposes), None)
        return Understood(self._text, actions, self._corrections, supposes)

    def _divide(self, start: int, end: int, moods: frozenset[str]) -> Divided:
        """The clauses of tokens `[start, end)`, with these forms in place."""
        divider = Divider(self._language.frames, self._lattice, self._language.data.vague, moods)
        return divider.divide(fragments(self._lattice, start, end), None if start else self._topic.kind)

    def _more_of_what(self, actions: tuple[Action, ...]) -> Parse:
        """The question after "two more" when the last amount was taken away."""
        first = actions[0]
        if not isinstance(first, Add):
            return self._refused([self._plain], ())
        away = Remove(kind=first.kind, count=first.count, where=first.where)
        try:
            choices = tuple(
                Choice(self._language.sentence(each), each) for each in ((away, *actions[1:]), actions)
            )
        except Unsayable:  # a language that says nothing back has no sentences to choose from
            return self._refused([self._plain], ())
        return Ambiguous(self._text, self._messages["more_of_what"], choices)

    def _which(self) -> Parse | None:
        """The question about a reference to one of several things, or the refusal of one to nothing."""
        for unclear in self._unclear:
            lanes = self._language.data.lanes
            tried = unclear.candidates or (lanes if unclear.lane else ("vehicle-1",))
            choices: list[Choice] = []
            for candidate in tried:
                parsed = self._language.read(self._instead(unclear, candidate), self._topic, asking=False)
                if isinstance(parsed, Understood) and all(c.actions != parsed.actions for c in choices):
                    choices.append(Choice(parsed.text.strip(), parsed.actions))
            if len(choices) > 1:
                return Ambiguous(self._text, self._messages["which"], tuple(choices))
            if choices:
                phrase = self._written(unclear.start, unclear.end)
                return self._refusal(
                    "not_understood", self._messages["no_referent"].format(phrase=phrase), (phrase,)
                )
        return None

    def _instead(self, unclear: Unclear, phrase: str) -> str:
        """The whole text with a reference replaced by what it may mean."""
        start, end = self._tokens[unclear.start].start, self._tokens[unclear.end - 1].end
        return self._plain[:start] + phrase + self._plain[end:]

    def _asked(self, clause: Clause) -> Parse:
        """The question of an ambiguous clause; each choice is the whole utterance with it replaced."""
        ask = clause.filled.frame.ask
        if ask is None:
            return self._refused([self._plain], ())
        said: dict[str, str] = {}
        for edge in clause.filled.slots:
            written = self._written(edge.start, edge.end)
            said[edge.sense.concept.partition(".")[0]] = written
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
            parsed = self._language.read(whole, self._topic, asking=False)
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

    def _refused_after(self, divided: Divided, *, asking: bool) -> Parse:
        """The refusal of a sentence of known words that make no request; or a question about one of them."""
        understood = tuple(self._written(clause.start, clause.end) for clause in divided.clauses)
        part = divided.failed
        if part is None:
            return self._refused([self._plain.strip()], understood)
        failed = self._written(part.start, part.end)
        if any(_impossible_number(edge.sense.value) for edge in self._lattice.between(part.start, part.end)):
            return self._refusal("impossible", self._messages["impossible"].format(phrase=failed), (failed,))
        return self._refused([failed], understood, asking=asking)

    def _refused(self, unparsed: list[str], understood: tuple[str, ...], *, asking: bool = False) -> Parse:
        if asking and (which := self._which()) is not None:
            return which
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
        return all(
            any(edge.sense.concept == GLUE for edge in self._lattice.edges[at]) for at in range(start, end)
        )

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
