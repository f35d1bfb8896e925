"""Aliases: taught phrases ("when I say rush hour, I mean heavy traffic and ten more cars").

An alias belongs to whoever taught it (`owners`) and works for them in all sessions. Its meaning is fixed when
it is taught: actions, validated like any others. An alias never hides anything that the language says by
itself, or begins to say.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from service import actions as contract
from service.actions import Action, Forget, Pause, Teach
from service.grammar import Language as Grammar
from service.grammar.follow_up import read_in_conversation
from service.grammar.parse_types import Refused
from service.grammar.sentences import Unsayable
from service.grammar.topic import Phrases, Topic
from service.interpreter.known_beginnings import is_piece
from service.interpreter.languages import Languages
from service.interpreter.owners import LOCAL, current_owner
from service.problems import FieldProblem, NotAvailable, NotSaved, NotTeachable
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.availability import refusal_of
from service.sessions.facts import AliasChange
from service.store import PhraseRecord, Store, StoredResponse, StoreError
from sim.actions import Where
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

    async def open(self) -> None:
        """Read the stored aliases. Raises `StoreError`."""
        self._kept.clear()
        self._ready.clear()
        for each in await self._store.phrases():
            self._own(each.owner)[each.language, each.key] = each

    def phrases(self, code: str = DEFAULT_LANGUAGE) -> Phrases:
        """The aliases of a language, compiled for the parser."""
        owner = current_owner()
        found = (owner if self._kept.get(owner) else LOCAL, code)
        if found not in self._ready:
            taught = {each.phrase: contract.load(each.meaning) for each in self.records(code)}
            self._ready[found] = self._languages[code].phrases(taught)
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
        told = None if before is None else self.describe(contract.load(before.meaning), code)
        if isinstance(action, Forget):
            if before is None:
                raise _not_teachable(refusals(code).said("never_taught", phrase=action.phrase))
            lesson = AliasChange(action.phrase, told or "", taught=False, before=told)
            if not dry_run:
                await self._forget(before, None if answer is None else answer(lesson))
            return lesson
        self._check(action, code, key, new=before is None)
        record = PhraseRecord(
            owner=owner, language=code, key=key, phrase=action.phrase, meaning=contract.dump(action.meaning)
        )
        lesson = AliasChange(action.phrase, self.describe(action.meaning, code), taught=True, before=told)
        if not dry_run:
            await self._teach(record, None if answer is None else answer(lesson))
        return lesson

    def describe(self, actions: tuple[Action, ...], code: str) -> str:
        """The actions as a sentence, or their names where the language has no sentence for them."""
        try:
            return self._languages[code].sentence(actions)
        except Unsayable:
            return ", ".join(refusals(code).action(action.do) for action in actions)

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
        others = {each.phrase: contract.load(each.meaning) for each in self.records(code) if each.key != key}
        amid = replace(RICH_TOPIC, phrases=self._languages[code].phrases(others))
        language = self._languages[code]
        alone = language.parse(action.phrase, amid)
        if isinstance(language, Grammar):
            alone = read_in_conversation(language, action.phrase, amid, alone)
        means = not isinstance(alone, Refused) or alone.reason != "not_understood"
        if means or (isinstance(language, Grammar) and is_piece(language, action.phrase)):
            raise _not_teachable(said("means_something", phrase=action.phrase))
        for meant in action.meaning:
            if (sentence := refusal_of(meant, code)) is not None:
                raise NotAvailable(sentence, errors=[FieldProblem("meaning", sentence)])

    async def _teach(self, record: PhraseRecord, answer: StoredResponse | None) -> None:
        try:
            await self._store.save_phrase(record, answer)
        except StoreError as error:
            raise NotSaved from error
        self._own(record.owner)[record.language, record.key] = record
        self._forget_compiled(record)

    async def _forget(self, record: PhraseRecord, answer: StoredResponse | None) -> None:
        try:
            await self._store.delete_phrase(record.owner, record.language, record.key, answer)
        except StoreError as error:
            raise NotSaved from error
        self._own(record.owner).pop((record.language, record.key), None)
        if not self._kept[record.owner]:
            del self._kept[record.owner]
        self._forget_compiled(record)

    def _forget_compiled(self, record: PhraseRecord) -> None:
        """The phrases of this machine are in what all others have compiled."""
        if record.owner == LOCAL:
            self._ready.clear()
        self._ready.pop((record.owner, record.language), None)


def _not_teachable(sentence: str) -> NotTeachable:
    return NotTeachable(sentence, errors=[FieldProblem("phrase", sentence)])
