"""Aliases: taught phrases ("when I say rush hour, I mean heavy traffic and ten more cars").

An alias belongs to whoever taught it (`owners`) and works for them in all sessions. Its meaning is fixed when
it is taught: actions, validated like any others. An alias never hides anything that the language says by
itself, or begins to say.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from service import actions as contract
from service.actions import Action, Forget, Pause, Teach
from service.actions.parameters import figure
from service.grammar import Language as Grammar
from service.grammar.follow_up import read_in_conversation
from service.grammar.parse_types import Refused, Understood
from service.grammar.sentences import Unsayable
from service.grammar.topic import Phrases, Topic
from service.interpreter.known_beginnings import is_piece
from service.interpreter.languages import Language, Languages
from service.interpreter.owners import LOCAL, current_owner
from service.problems import FieldProblem, NotAvailable, NotSaved, NotTeachable
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.availability import refusal_of
from service.sessions.facts import AliasChange
from service.store import PhraseRecord, Store, StoredResponse, StoreError
from sim.actions import SetCount, Where
from sim.types import PLACEABLE, Kind

MAX_PHRASES = 200
"""Of one owner, in all languages."""
MAX_ALL_PHRASES = 10_000
"""Of all owners: they are held in memory."""
MAX_WORDS = 8

RICH_TOPIC = Topic(
    things=tuple(f"{kind}-1" for kind in PLACEABLE),
    added=tuple(f"{kind}-{number}" for kind in PLACEABLE for number in range(1, 11)),
    actions=(Pause(),),
    kind=Kind.POTHOLE.value,
    where=Where(lane="left"),
)
"""A conversation in which "again", "two more" and "remove them" mean something, so they cannot be taught."""


class Aliases:
    """The aliases of every owner, in every language; all methods are for whoever asks now (`owners`)."""

    def __init__(self, store: Store, languages: Languages) -> None:
        self._store = store
        self._languages = languages
        self._kept: dict[str, dict[tuple[str, str], PhraseRecord]] = {}
        self._ready: dict[tuple[str, str], Phrases] = {}
        self._changing = asyncio.Lock()
        """held while memory and store are brought in line"""
        self.on_change: Callable[[], None] = lambda: None
        """called after a phrase was taught or forgotten here"""

    async def open(self) -> None:
        """Read the stored aliases, or read them again where another process has changed them.

        Raises `StoreError`.
        """
        async with self._changing:
            found = await self._store.phrases()
            self._kept.clear()
            self._ready.clear()
            for each in found:
                self._own(each.owner)[each.language, each.key] = each

    def phrases(self, code: str = DEFAULT_LANGUAGE) -> Phrases:
        """The aliases of a language, compiled for the parser."""
        owner = current_owner()
        found = (owner if self._kept.get(owner) else LOCAL, code)
        if found not in self._ready:
            self._ready[found] = self._languages[code].phrases(map(taught_of, self.records(code)))
        return self._ready[found]

    def records(self, code: str = DEFAULT_LANGUAGE) -> list[PhraseRecord]:
        """The stored aliases of a language, in alphabetical order: everyone's and the owner's own."""
        both = self._kept.get(LOCAL, {}) | self._kept.get(current_owner(), {})
        return sorted((each for each in both.values() if each.language == code), key=lambda e: e.key)

    def _own(self, owner: str) -> dict[tuple[str, str], PhraseRecord]:
        return self._kept.setdefault(owner, {})

    async def update(
        self,
        action: Teach | Forget,
        code: str,
        *,
        dry_run: bool,
        answer: Callable[[AliasChange], StoredResponse] | None = None,
    ) -> AliasChange:
        """Teach or forget a phrase, and store a response with it.

        Raises `NotTeachable`, `NotAvailable` or `NotSaved`; nothing changes then.
        """
        key = " ".join(self._languages[code].words_of(action.phrase))
        owner = current_owner()
        before = self._kept.get(owner, {}).get((code, key))
        told = None if before is None else self.sentence(taught_of(before), code)
        if isinstance(action, Forget):
            if before is None:
                raise _not_teachable(refusals(code).said("never_taught", phrase=action.phrase))
            lesson = AliasChange(action.phrase, told or "", taught=False, before=told)
            if not dry_run:
                await self._forget(before, None if answer is None else answer(lesson))
            return lesson
        self._check(action, code, key, new=before is None)
        record = PhraseRecord(
            owner=owner, language=code, key=key, phrase=action.phrase, meaning=_kept(action)
        )
        lesson = AliasChange(action.phrase, self.sentence(action, code), taught=True, before=told)
        if not dry_run:
            await self._teach(record, None if answer is None else answer(lesson))
        return lesson

    def describe(self, actions: tuple[Action, ...], code: str) -> str:
        """The actions as a sentence, or their names where the language has no sentence for them."""
        try:
            return self._languages[code].sentence(actions)
        except Unsayable:
            return ", ".join(refusals(code).action(action.do) for action in actions)

    def sentence(self, taught: Teach, code: str) -> str:
        """What a phrase means as a sentence, with its parameters by their names."""
        try:
            return self._languages[code].sentence_of_meaning(taught)
        except Unsayable:
            return self.describe(taught.meaning, code)

    def _check(self, action: Teach, code: str, key: str, *, new: bool) -> None:
        words, said = key.split(), refusals(code).said
        if not any(word.isalpha() for word in words):
            raise _not_teachable(said("no_word"))
        if len(words) > MAX_WORDS:
            raise _not_teachable(said("too_many_words", most=MAX_WORDS))
        if new and len(self._kept.get(current_owner(), ())) >= MAX_PHRASES:
            raise _not_teachable(said("too_many_phrases", most=MAX_PHRASES))
        if new and sum(map(len, self._kept.values())) >= MAX_ALL_PHRASES:
            raise _not_teachable(said("too_many_phrases", most=MAX_ALL_PHRASES))
        others = [taught_of(each) for each in self.records(code) if each.key != key]
        amid = replace(RICH_TOPIC, phrases=self._languages[code].phrases(others))
        language = self._languages[code]
        if self._means_something(language, action, amid) or (
            isinstance(language, Grammar) and is_piece(language, action.phrase)
        ):
            raise _not_teachable(said("means_something", phrase=action.phrase))
        for meant in action.meaning:
            if (sentence := refusal_of(meant, code)) is not None:
                raise NotAvailable(sentence, errors=[FieldProblem("meaning", sentence)])

    @staticmethod
    def _means_something(language: Language, lesson: Teach, amid: Topic) -> bool:
        """Whether a phrase has a meaning of its own; a bare count of things ("wall 5") may be taught over."""
        for said in dict.fromkeys((lesson.phrase, example_of(lesson))):
            alone = language.parse(said, amid)
            if isinstance(language, Grammar):
                alone = read_in_conversation(language, said, amid, alone)
            counts = isinstance(alone, Understood) and all(isinstance(a, SetCount) for a in alone.actions)
            if counts and said != lesson.phrase:
                continue
            if not isinstance(alone, Refused) or alone.reason != "not_understood":
                return True
        return False

    async def _teach(self, record: PhraseRecord, answer: StoredResponse | None) -> None:
        async with self._changing:
            try:
                await self._store.save_phrase(record, answer)
            except StoreError as error:
                raise NotSaved from error
            self._own(record.owner)[record.language, record.key] = record
            self._forget_compiled(record)
        self.on_change()

    async def _forget(self, record: PhraseRecord, answer: StoredResponse | None) -> None:
        async with self._changing:
            try:
                await self._store.delete_phrase(record.owner, record.language, record.key, answer)
            except StoreError as error:
                raise NotSaved from error
            self._own(record.owner).pop((record.language, record.key), None)
            if not self._kept[record.owner]:
                del self._kept[record.owner]
            self._forget_compiled(record)
        self.on_change()

    def _forget_compiled(self, record: PhraseRecord) -> None:
        """The phrases of this machine are in what all others have compiled."""
        if record.owner == LOCAL:
            self._ready.clear()
        self._ready.pop((record.owner, record.language), None)


def taught_of(record: PhraseRecord) -> Teach:
    """What a record holds: a meaning, or a whole lesson where the phrase takes numbers."""
    found = contract.load(record.meaning)
    if len(found) == 1 and isinstance(found[0], Teach):
        return found[0]
    return Teach(phrase=record.phrase, meaning=found)


def _kept(lesson: Teach) -> list[dict[str, Any]]:
    """The meaning to be stored; with it the parameters, if there are any."""
    return contract.dump(lesson.meaning if lesson.parameters is None else (lesson,))


def example_of(lesson: Teach) -> str:
    """A phrase with a number in the place of each parameter, as one would say it."""
    meaning = contract.dump(lesson.meaning)
    numbers = {each.name.casefold(): figure(meaning, each.figures[0]) for each in lesson.parameters or ()}
    return " ".join(str(numbers.get(word.casefold(), word)) for word in lesson.phrase.split())


def _not_teachable(sentence: str) -> NotTeachable:
    return NotTeachable(sentence, errors=[FieldProblem("phrase", sentence)])
