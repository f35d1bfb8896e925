"""The language engine: text → actions, a question, or a refusal, and nothing in between.

Tokens → typos → items → fragments → clauses → actions; each stage is a file of its own. Nothing here knows
a word of any language: words, frames, messages all come from `prompts/language/<code>/`.

Guarantees: every content word is accounted for or the sentence is refused; parsing is a
pure function of the text; no input raises.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path

from service.actions import Action, Teach, dump
from service.grammar.accounting import withhold
from service.grammar.cache import ParseCache
from service.grammar.compiled import check_fit, load_language
from service.grammar.correction import answer_correction, opening_words
from service.grammar.data import LanguageData, read_language
from service.grammar.free_text import TEACH, find_names
from service.grammar.lanes_from_right import resolve_lanes_from_right
from service.grammar.lattice import Lattice, Name, Scanner
from service.grammar.likely_words import read_likely
from service.grammar.linter import defects
from service.grammar.matching import Frames
from service.grammar.name_ends import shorter_names
from service.grammar.noun_phrases import NOUN
from service.grammar.old_values import add_old_values
from service.grammar.parse_types import Ambiguous, Choice, Correction, Parse, Refused, Understood
from service.grammar.parser import Reading, content_of
from service.grammar.paths import SEPARATOR
from service.grammar.references import add_known
from service.grammar.repairs import ALWAYS, DROPPED, Repair
from service.grammar.rules import RuleReader
from service.grammar.scenario_names import find_scenario_name
from service.grammar.sentences import Sentences
from service.grammar.small_talk import small_talk
from service.grammar.span_patterns import REPAIR
from service.grammar.suggestions import Meanings, Saying, Suggestions, meanings_of
from service.grammar.teaching import read_teaching
from service.grammar.tokens import Token, normalise, restore_marks, tokenise, with_text
from service.grammar.topic import ALONE, Phrases, TaughtWords, Topic
from service.grammar.typos import Typos
from service.grammar.work_budget import READ_STEPS, TOKEN_STEPS, BudgetExceededError, WorkBudget
from service.resources import prompts_folder

MAX_TOKENS = 300
"""Longer utterances are refused unread: the service caps text at 500 characters anyway."""


class Language:
    """One language, loaded. Immutable after loading; safe to share between threads."""

    def __init__(self, data: LanguageData, offered: Callable[[Action], bool] | None = None) -> None:
        self.data = data
        self._offered = offered
        self._lexicon = data.lexicon
        self._scanner = Scanner(data.lexicon, data.numbers)
        self.frames = Frames(data.frames, data.parameters)
        self.sentences = Sentences(data.sentences)
        self._rules = RuleReader(self, data.rules)
        self._cache = ParseCache(self._parse_uncached)

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
        if folder is not None:
            return cls(check_fit(read_language(folder / code)), offered)
        return cls(load_language(prompts_folder() / "language" / code), offered)

    def parse(self, text: str, topic: Topic = ALONE, work: WorkBudget | None = None) -> Parse:
        """What a person said: `Understood`, `Refused` or `Ambiguous`. Never raises.

        `topic` is what it may refer to; without one it is read as a sentence that stands alone. `work` is
        what it may cost, where several texts share that.
        """
        return self._cache.parse(text, topic, work or WorkBudget())

    def _parse_uncached(self, text: str, topic: Topic, work: WorkBudget) -> Parse:
        work.known.clear()
        try:
            parsed = self.read(text, topic, work, asking=True)
        except BudgetExceededError:
            return Refused(text, "not_understood", self.data.messages["too_involved"])
        if not isinstance(parsed, Refused):
            return parsed
        ruled = self._rules.read(text, topic, work) or read_teaching(self, text, topic, work)
        return ruled or self.data.others.read(self, text, parsed, topic, work)

    def meaning(self, text: str, topic: Topic, work: WorkBudget) -> tuple[Action, ...] | None:
        """What a text means that is a part of another; None where that is not certain."""
        try:
            parsed = self.read(text, topic, work, asking=False)
            if isinstance(parsed, Refused):
                parsed = self._rules.read(text, topic, work) or parsed
        except BudgetExceededError:
            return None
        return parsed.actions if isinstance(parsed, Understood) else None

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """`parse`; unless `asking`, what would be asked about is refused, and nothing is suggested.

        Raises `BudgetExceededError` where the work does not suffice.
        """
        if asking:
            return self._read(text, topic, work, asking=True)
        key = text, id(topic)
        known = work.known.get(key)
        if known is None:
            known = work.known[key] = self._read(text, topic, work, asking=False)
        return known

    def _read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        messages = self.data.messages
        plain = normalise(text)
        tokens = tokenise(plain, self.data.contractions)
        if not tokens:
            return Refused(text, "empty", messages["empty"])
        if len(tokens) > MAX_TOKENS:
            return Refused(text, "not_understood", messages["too_long"].format(words=MAX_TOKENS))
        work.spend(READ_STEPS + TOKEN_STEPS * len(tokens))
        said = restore_marks(text, plain)
        kept = find_names(tokens, self._lexicon, said, topic)
        kept = kept or find_scenario_name(tokens, self._lexicon, said, topic)
        if kept and small_talk(self._scanner.scan(tokens, {})):
            kept = {}
        tokens, corrections = self._fix_typos(plain, tokens, kept, topic)
        lattice = self._scanner.scan(tokens, kept)
        resolve_lanes_from_right(lattice, topic)
        add_old_values(lattice)
        withhold(lattice, self.data.free, self.data.idle)
        lattice.keep_whole(self.data.nouns)
        add_known(lattice, tokens, topic)
        uncovered = bool(lattice.uncovered())
        if not (kept or uncovered) and (repair := Repair.find(plain, tokens, lattice, work)) is not None:
            readings = repair.readings(lambda each: self.read(each, topic, work, asking=False))
            if readings is not None:
                return self._answer_repair(text, repair.phrase, readings, lattice, asking=asking)
        if kept and TEACH not in lattice.concepts and not uncovered:
            names = [at for start, name in kept.items() for at in range(start, name.end)]
            repair = Repair.find(plain, tokens, lattice, work)
            if repair is not None and repair.start not in names and repair.is_sure:
                return self._answer_repair(text, repair.phrase, [], lattice, asking=asking)
        reading = Reading(self, text, plain, tokens, lattice, corrections, topic, work)
        parsed = reading.parse(asking=asking)
        if uncovered and asking and not kept:
            unknown = [each for each in tokens if self._may_be_a_typo(each, plain)]
            likely = lambda each: self.read(each, topic, work, asking=False)  # noqa: E731
            parsed = read_likely(text, plain, unknown, self.typos, likely) or parsed
        if kept and isinstance(parsed, Understood):
            parsed = self._ask_name(
                parsed, restore_marks(text, plain), tokens, kept, topic, work, asking=asking
            )
        if not asking or uncovered or tokens[0].text not in self._correction_openings:
            return parsed
        sure = self._corrects(tokens)
        return (
            parsed if sure is None else answer_correction(self, text, plain, topic, parsed, work, sure=sure)
        )

    def _may_be_a_typo(self, token: Token, plain: str) -> bool:
        """Whether a token is an unknown word and no name."""
        if not token.text.isalpha() or self.data.knows(token.text):
            return False
        return not self.typos.is_name(plain[token.start : token.end], plain[: token.start])

    def _ask_name(
        self,
        parsed: Understood,
        said: str,
        tokens: Sequence[Token],
        kept: Mapping[int, Name],
        topic: Topic,
        work: WorkBudget,
        *,
        asking: bool,
    ) -> Parse:
        """The question where a name ends, if a request may follow it; else what was read."""
        read = lambda each: self.read(each, topic, work, asking=False)  # noqa: E731
        choices = shorter_names(said, tokens, kept, self._lexicon, parsed, read)
        if not choices:
            return parsed
        if asking:
            return Ambiguous(parsed.text, self.data.messages["which"], tuple(choices))
        message = self.data.messages["together_or_apart"].format(phrase=parsed.text.strip())
        return Refused(parsed.text, "not_understood", message)

    @cached_property
    def _correction_openings(self) -> frozenset[str]:
        return opening_words(self.data)

    def _corrects(self, tokens: Sequence[Token]) -> bool | None:
        """Whether a sentence begins by taking something back for sure; None where it does not at all."""
        after = [self._comma, *tokens]
        matches = self._lexicon.matches(after, 0, {}, {})
        senses = [sense for end, found, _ in matches if 1 < end < len(after) for sense in found]
        kinds = {sense.value for sense in senses if sense.concept == REPAIR} - {DROPPED}
        return ALWAYS in kinds if kinds else None

    @cached_property
    def _comma(self) -> Token:
        return tokenise(",", self.data.contractions)[0]

    def _answer_repair(
        self, text: str, phrase: str, readings: list[Choice], lattice: Lattice, *, asking: bool
    ) -> Parse:
        """What a sentence means in which something was taken back."""
        if len(readings) == 1:
            return Understood(text, readings[0].actions)
        if asking and readings:
            return Ambiguous(text, self.data.messages["which"], tuple(readings))
        message = self.data.messages["not_understood"].format(phrases=f'"{phrase}"')
        suggestions = self.suggestions.nearest(text, meanings_of(lattice)) if asking else ()
        return Refused(text, "not_understood", message, (phrase,), (), suggestions)

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""
        return self.sentences.sentence(actions)

    def sentence_of_meaning(self, taught: Teach) -> str:
        """A sentence for what a phrase means, with its parameters by their names. Raises `Unsayable`."""
        return self.sentences.meaning_of(taught)

    def phrases(self, taught: Iterable[Teach]) -> Phrases:
        """Taught phrases, ready to be found in sentences of this language."""
        by_first: dict[str, list[TaughtWords]] = {}
        for each in taught:
            if words := self.words_of(each.phrase):
                found = TaughtWords(words, dump(each.meaning), each.parameters or ())
                by_first.setdefault(words[0], []).append(found)
        tokens = lambda text: tokenise(normalise(text), self.data.contractions)  # noqa: E731
        return Phrases(by_first, self.data.numbers.read, tokens)

    @cached_property
    def joiners(self) -> frozenset[str]:
        """The words that stand between one request and the next."""
        joining = (words for words, _ in self._lexicon.phrases_of(SEPARATOR))
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
        """All that a word alone can mean, that the glossary explains it aside."""
        senses = self._lexicon.senses_of((word,))
        return frozenset((sense.concept, repr(sense.value)) for sense in senses if sense.concept != "term")

    def _nouns(self, word: str) -> frozenset[str]:
        """What a word alone is a noun for, singular and plural taken together."""
        senses = self._lexicon.senses_of((word,))
        return frozenset(str(sense.value) for sense in senses if sense.concept.startswith(NOUN))

    def _fix_typos(
        self, plain: str, tokens: list[Token], kept: Mapping[int, Name], topic: Topic
    ) -> tuple[list[Token], tuple[Correction, ...]]:
        """The tokens with one-edit typos read as meant, and the list of what was changed."""
        corrections: list[Correction] = []
        in_names = {at for start, name in kept.items() for at in range(start, name.end)}
        if topic.phrases.by_first:
            for start in range(len(tokens)):
                if (taught := topic.phrases.at(tokens, start)) is not None:
                    in_names.update(range(start, taught[0]))
        for at, token in enumerate(tokens):
            word = token.text
            if token.digits or token.id or at in in_names or self.data.knows(word) or not word.isalpha():
                continue
            written = plain[token.start : token.end]
            meant = None if self.typos.is_name(written, plain[: token.start]) else self.typos.repair(word)
            if meant is not None:
                tokens[at] = with_text(token, meant)
                corrections.append(Correction(written, meant))
        return tokens, tuple(corrections)

    @cached_property
    def suggestions(self) -> Suggestions:
        """The example sayings of all frames, ready to be ranked; made at the first refusal."""
        said = ((say, frame) for frame in self.data.frames for say in frame.says)
        sayings = (
            Saying(say, frame, actions, self.meanings(say))
            for say, frame in said
            if (actions := self._offered_actions(say))
        )
        return Suggestions(sayings, self.data.nouns, self._offered)

    def _offered_actions(self, say: str) -> tuple[Action, ...]:
        """What a saying does; nothing where it cannot be offered."""
        try:
            # Not `parse`: a refusal there names suggestions, which are what is being made here.
            parse = self.read(say, ALONE, WorkBudget(), asking=False)
        except BudgetExceededError:
            return ()
        if not isinstance(parse, Understood):
            return ()
        return parse.actions if self._offered is None or all(map(self._offered, parse.actions)) else ()

    def scan(self, tokens: Sequence[Token]) -> Lattice:
        """All that any stretch of some tokens can mean."""
        return self._scanner.scan(tokens, {})

    def concepts(self, text: str) -> frozenset[str]:
        """The content concepts that occur in a text."""
        plain = normalise(text)
        tokens = tokenise(plain, self.data.contractions)
        return content_of(self._scanner.scan(tokens, {}))

    def meanings(self, text: str) -> tuple[Meanings, ...]:
        """What each stretch of a text may mean."""
        tokens = tokenise(normalise(text), self.data.contractions)
        return meanings_of(self._scanner.scan(tokens, {}))
