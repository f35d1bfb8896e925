"""The languages of the service: every folder of `prompts/language`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from service.actions import Action, Teach
from service.grammar import Language as Grammar
from service.grammar.parse_types import Parse
from service.grammar.topic import ALONE, Phrases, Topic
from service.interpreter.guide import Guide
from service.problems import FieldProblem, Invalid
from service.question_matcher.matcher import QuestionMatcher
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE, prompts_folder
from service.sessions.availability import refusal_of


class Language(Protocol):
    """The interface of a language."""

    def parse(self, text: str, topic: Topic = ALONE) -> Parse:
        """The meaning of a sentence; never raises, whatever the text."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """A sentence that means exactly these actions. Raises `Unsayable`."""

    def sentence_of_meaning(self, taught: Teach) -> str:
        """A sentence for what a phrase means, with its parameters by their names. Raises `Unsayable`."""

    def phrases(self, taught: Iterable[Teach]) -> Phrases:
        """Taught phrases, compiled for the parser."""

    def words_of(self, text: str) -> tuple[str, ...]:
        """The words of a text, as they are compared."""


class Languages:
    """Languages by code; each is read once, at the start."""

    def __init__(self, by_code: Mapping[str, Language]) -> None:
        self._by_code = dict(by_code)
        self._guides: dict[str, Guide] = {}
        self._matchers: dict[str, QuestionMatcher] = {}

    def guide(self, code: str) -> Guide | None:
        """The guide to a language; None if it is not made of data. Raises `Invalid` if unknown."""
        language = self[code]
        if code not in self._guides and isinstance(language, Grammar):
            self._guides[code] = Guide(language, code)
        return self._guides.get(code)

    def matcher(self, code: str) -> QuestionMatcher | None:
        """What matches questions in a language, if anything was learnt. Raises `Invalid` if it is unknown."""
        language, folder = self[code], prompts_folder() / "questions" / code
        if code not in self._matchers and isinstance(language, Grammar) and folder.is_dir():
            self._matchers[code] = QuestionMatcher(language, folder)
        return self._matchers.get(code)

    @classmethod
    def load(cls) -> Languages:
        """All languages. Raises `LanguageDataError`, naming every defect."""
        codes = sorted(path.name for path in (prompts_folder() / "language").iterdir() if path.is_dir())
        loaded = {
            code: Grammar.load(code, offered=lambda action: refusal_of(action) is None) for code in codes
        }
        for code in codes:
            refusals(code)  # read at the start as well
        return cls(loaded)

    def prepare(self) -> None:
        """Make what the first refusals and follow-ups need, so that nobody waits. For any thread."""
        for code, language in self._by_code.items():
            if (matcher := self.matcher(code)) is not None:
                matcher.prepare()
            if isinstance(language, Grammar):
                language.suggestions.nearest("", ())
                for table in ("joiners", "typos"):  # made when they are first read
                    getattr(language, table)

    @property
    def codes(self) -> tuple[str, ...]:
        """The codes, the default first."""
        return tuple(sorted(self._by_code, key=lambda code: (code != DEFAULT_LANGUAGE, code)))

    def check(self, code: str) -> None:
        """Raises `Invalid` for a language that is not spoken here; the default always is."""
        if code != DEFAULT_LANGUAGE:
            self[code]

    def __getitem__(self, code: str) -> Language:
        """Raises `Invalid` for a language that is not spoken here."""
        try:
            return self._by_code[code]
        except KeyError:
            sentence = refusals().said("no_language", code=code, codes=self.codes)
            raise Invalid(sentence, errors=[FieldProblem("language", sentence)]) from None
