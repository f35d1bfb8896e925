"""Matches a question that the grammar refused to a sentence that it understands.

The kind of the question is found by a classifier (`KindScores`); its slots are found by the lexicon. A match
is a sentence of the grammar, which parses it: nothing but a question about the session can come of it, and
the answer says as what it was read. A match is unsure where two kinds are near each other, or where a word
occurs in no example.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from service.actions import Action, Ask, Chat, Resume, Step, Undo
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.grammar.topic import ALONE
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from service.question_matcher.edge_lanes import EdgeLanes
from service.question_matcher.fillers import Fillers
from service.question_matcher.follow_ups import FollowUps
from service.question_matcher.kind_scores import KindScores
from service.question_matcher.kinds import NONE_OF_THEM, QuestionKind, read_kinds
from service.question_matcher.parts import Part, Parts
from service.question_matcher.situations import UNKNOWN, Now
from service.question_matcher.slots import Question, SlotWords
from sim.actions import Pause, Prefer, Reset, Set

NEAR = 1.5
"""Lead over another kind, in logarithms of odds, below which both are offered."""
LIKELY = 0.3
"""Least lead over what has no answer, for it to be asked about."""
UNKNOWN_COST = 0.3
"""What each unknown word takes from the certainty."""
UNUSUAL = 1.0
"""What a kind loses that is mostly asked in other situations."""
MOST_UNKNOWN = 4
MIN_LETTERS = 4
"""Shorter words are not looked for among the known ones."""
LEAST_LIKELY = -0.5
"""Least certainty of a question whose answer is given beside the question back.

Of 1,254 questions that were not learnt from, 430 lie between this and what is sure; of these 68 % are read
rightly.
"""
MAX_CHOICES = 3
MAX_WORDS = 60
MOST_FOLLOWING = 60
"""Letters of a follow-up."""
MOST_SHORTENED = 300
"""Letters of a question that words are left out of."""
MOST_IN_PARTS = 300
"""Letters of a text that is read in parts."""
_THINGS = frozenset(("<thing>", "<things>"))


def _is_a_request(action: Action) -> bool:
    return not isinstance(action, Ask | Chat)


def _is_of_the_clock(action: Action) -> bool:
    """What counts in a name alone: "fog" may be a topic, "stop" is a request."""
    return isinstance(action, Pause | Resume | Reset | Undo)


def _is_no_circumstance(action: Action) -> bool:
    """What counts in words of a time, a place or a manner: "at night" belongs to the question beside it."""
    return not isinstance(action, Ask | Chat | Set | Prefer | Step)


@dataclass(frozen=True, slots=True)
class Match:
    """The sentences a question may stand for, the likeliest first: choices, unless the first is `sure`."""

    sentences: tuple[str, ...]
    sure: bool
    likely: bool = False
    """whether the first is likelier than all else, and says all that the question does"""


class QuestionMatcher:
    """The matcher of one language."""

    def __init__(self, language: Language, folder: Path) -> None:
        """`folder`: of `prompts/questions`; its files are read at the first question."""
        self._language = language
        self._folder = folder

    def prepare(self) -> None:
        """Read all files, so that no question waits for that."""
        for table in (
            "_words",
            "_kinds",
            "_scores",
            "_follow_ups",
            "_fillers",
            "_parts",
            "_edge_lanes",
        ):  # made when they are first read
            getattr(self, table)

    @cached_property
    def _words(self) -> SlotWords:
        return SlotWords(self._language, self._folder)

    @cached_property
    def _kinds(self) -> dict[str, QuestionKind]:
        return {name: kind.naming(self._words.question) for name, kind in read_kinds(self._folder).items()}

    @cached_property
    def _scores(self) -> KindScores:
        return KindScores.read(self._folder)

    @cached_property
    def _follow_ups(self) -> FollowUps:
        return FollowUps(self._language, self._folder)

    @cached_property
    def _fillers(self) -> Fillers:
        return Fillers(self._folder)

    @cached_property
    def _parts(self) -> Parts:
        return Parts(self._folder)

    @cached_property
    def _edge_lanes(self) -> EdgeLanes:
        return EdgeLanes(self._folder)

    def follow_up(self, text: str, asked: Sequence[Action]) -> Match | None:
        """What a few words ask after the last question; None where they are no follow-up."""
        if len(text) > MOST_FOLLOWING or (found := self._follow_ups.match(text, asked)) is None:
            return None
        sentences, sure = found
        return Match(sentences, sure)

    def with_numbered_lanes(self, text: str, columns: int) -> str:
        """The same question of a road of so many columns, with "lane 8" for its rightmost lane."""
        return self._edge_lanes.numbered(text, columns)

    def shortened(self, text: str) -> tuple[str, ...]:
        """A question without what does not change it (see `Fillers`); empty where it holds a request."""
        if len(text) > MOST_SHORTENED or self._holds_a_request(text):
            return ()
        return self._fillers.without(text)

    def parts(self, text: str) -> tuple[Part, ...]:
        """The questions of a text that asks two or three; empty where it asks one, or holds a request."""
        if len(text) > MOST_IN_PARTS or self._holds_a_request(text):
            return ()
        return self._parts.of(text)

    def names_a_thing(self, text: str) -> bool:
        """Whether a text names a thing on the road other than the vehicle."""
        return not _THINGS.isdisjoint(self._words.question(text).words)

    def match(self, text: str, now: Now = UNKNOWN) -> Match | None:
        """What a question may stand for; None where it is like none that has an answer."""
        question, situations = self._words.question(text).asked(now.facts), now.situations
        if len(question.words) > MAX_WORDS or not self._words.says_something(question):
            return None
        if not self._words.asks(text, question) or self._holds_a_request(text):
            return None
        unknown = self._unknown(question.words)
        if len(unknown) > MOST_UNKNOWN:
            return None
        unusual = {name for name, kind in self._kinds.items() if kind.when and kind.when not in situations}
        scores = self._scores.of(text, question.words, situations)
        order = sorted(
            ((score - UNUSUAL * (kind in unusual), kind) for kind, score in scores.items()),
            key=lambda each: (-each[0], each[1]),
        )
        match = self._decided(question, order, UNKNOWN_COST * len(unknown))
        if match is not None and match.sure and order[0][1] in unusual:
            # What is asked of a crash is hardly meant where there was none: it is offered, not answered.
            return Match(match.sentences, sure=False)
        return match

    def is_of_something_else(self, text: str) -> bool:
        """Whether a text is a question, and likest to those that no answer is for."""
        question = self._words.question(text)
        if not 0 < len(question.words) <= MAX_WORDS or not self._words.asks(text, question):
            return False
        scores = self._scores.of(text, question.words)
        likeliest = max(scores, key=scores.__getitem__) == NONE_OF_THEM
        return likeliest and not self._holds_a_request(text)

    def _decided(self, question: Question, order: Sequence[tuple[float, str]], cost: float) -> Match | None:
        """What the order of the kinds says, the likeliest first; `cost` is taken from their certainty.

        A kind that no sentence fits, since it leaves a slot out, is no rival of one that is likelier; it is
        asked about where it is much the likeliest. In place of one that a word turns round others are
        offered.
        """
        turned = self._kinds[order[0][1]].is_turned(question) and not self._words.denies(question)
        if turned:
            order = [each for each in order if not self._kinds[each[1]].is_turned(question)]
        said = {name: self._kinds[name].sentence(question) for _, name in order}
        rivals = [(score, name) for score, name in order if said[name] or not self._kinds[name].says]
        (best, name), likeliest, likely = rivals[0], order[0][0], False
        floor = next(score for score, each in order if each == NONE_OF_THEM) + LIKELY + cost
        if said[name] is None or likeliest - best >= NEAR:
            if likeliest < floor:
                return None
            said = {each: said[each] or self._kinds[each].offered(question) for each in said}
            rivals, best = list(order), likeliest
        elif not turned and best == likeliest and (sentence := said[name]):
            certainty = self._scores.certainties({each: score for score, each in order})[name] - cost
            if certainty >= self._scores.least_sure:
                return Match((sentence,), sure=True)
            likely = certainty >= LEAST_LIKELY
        offered = (said[each] for score, each in rivals if score >= max(floor, best - NEAR))
        near = tuple(dict.fromkeys(filter(None, offered)))[:MAX_CHOICES]
        return Match(near, sure=False, likely=likely) if near else None

    def _holds_a_request(self, text: str) -> bool:
        """Whether a part of a text asks for something to be done: nothing of that may be left out."""
        joined = "|".join(map(re.escape, sorted(self._language.joiners)))
        first = True
        for sentence in re.split(r"[.;!?]", text):
            parts = [each.strip() for each in re.split(rf",|\b(?:{joined})\b", sentence) if each.strip()]
            asks = [self._words.asks(each, self._words.question(each)) for each in parts]
            for number, part in enumerate(parts):
                counts = _is_a_request
                if not first and self._words.is_a_name(part):
                    counts = _is_of_the_clock
                elif any(asks[:number] + asks[number + 1 :]) and self._words.is_a_circumstance(part):
                    counts = _is_no_circumstance
                if self._does(part, counts):
                    return True
                first = False
        return False

    def _does(self, part: str, counts: Callable[[Action], bool]) -> bool:
        """Whether a part does something that counts as a request."""
        try:
            # Not `parse`: what would be asked about or suggested is of no use here.
            parse = self._language.read(part, ALONE, WorkBudget(), asking=False)
        except BudgetExceededError:
            return True
        return isinstance(parse, Understood) and any(map(counts, parse.actions))

    def _unknown(self, words: Sequence[str]) -> list[str]:
        """The words that occur in no example that has an answer, a slip of the pen aside."""
        known = self._scores.words
        return [
            word
            for word in words
            if len(word) >= MIN_LETTERS
            and word not in known
            and self._language.typos.repair(word) not in known
        ]
