"""Questions that the grammar of a session's language refuses: those of another language, and paraphrases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

from anyio import CapacityLimiter, to_thread

from service.actions import Ask
from service.grammar.parse_types import Understood
from service.grammar.topic import ALONE, Topic
from service.interpreter.languages import Language, Languages
from service.interpreter.question import Asked
from service.question_matcher.matcher import QuestionMatcher
from service.question_matcher.situations import Situation
from service.refusals import refusals
from service.sessions.pending import PendingChoice, PendingQuestion
from sim.state import SimState
from sim.types import Mode, Outcome


@dataclass(frozen=True, slots=True)
class Question:
    """A question that was found in a text, and what its answer begins with."""

    parse: Understood
    language: str
    source: Literal["grammar", "matched"]
    preface: str = ""


class QuestionReader:
    """Finds the question in a text that was refused."""

    def __init__(self, languages: Languages, parsing: CapacityLimiter, *, asks: bool) -> None:
        """`parsing` limits the threads that parse; `asks`: whether what may be several is asked about.

        It is not where a language model reads what is left.
        """
        self._languages = languages
        self._parsing = parsing
        self._asks = asks

    async def read(self, text: str, topic: Topic, code: str, now: frozenset[Situation]) -> Question | None:
        """The question, answered in the language it is in; None where there is none.

        Raises `Asked` where it may be one of several. `now`: the situations of the session.
        """
        for other in self._languages.codes:
            if other == code:
                continue
            parse = await to_thread.run_sync(self._languages[other].parse, text, ALONE, limiter=self._parsing)
            if isinstance(parse, Understood) and _only_asks(parse):
                return Question(parse, other, "grammar")
        for each in sorted(self._languages.codes, key=lambda other: other != code):
            question = await self._matched(
                text, topic if each == code else ALONE, each, now, asks=self._asks and each == code
            )
            if question is not None:
                return question
        return None

    async def is_of_something_else(self, text: str, code: str) -> bool:
        """Whether a text is a question, and of something that no answer is for."""
        matcher = self._languages.matcher(code)
        if matcher is None:
            return False
        return await to_thread.run_sync(matcher.is_of_something_else, text, limiter=self._parsing)

    async def _matched(
        self, text: str, topic: Topic, code: str, now: frozenset[Situation], *, asks: bool
    ) -> Question | None:
        """What a text is like in one language. Raises `Asked` where that is several, if it `asks`."""
        language, matcher = self._languages[code], self._languages.matcher(code)
        if matcher is None:
            return None
        last = topic.asked if topic.actions == topic.asked else ()
        match = matcher.follow_up(text, last)
        words = refusals(code)
        if match is None:
            shorter = await to_thread.run_sync(
                self._shortened, language, matcher, text, topic, limiter=self._parsing
            )
            if shorter is not None:
                sentence, parse = shorter
                return Question(parse, code, "matched", words.said("read_as", sentence=sentence))
            match = await to_thread.run_sync(matcher.match, text, now, limiter=self._parsing)
        if match is None:
            return None
        read = [(sentence, language.parse(sentence, topic)) for sentence in match.sentences]
        questions = [
            (sentence, parse)
            for sentence, parse in read
            if isinstance(parse, Understood) and _only_asks(parse)
        ]
        if not questions:
            return None
        if match.sure:
            sentence, parse = questions[0]
            return Question(parse, code, "matched", words.said("read_as", sentence=sentence))
        if not asks:
            return None
        choices = tuple(PendingChoice(sentence, parse.actions) for sentence, parse in questions)
        said = (
            words.said("may_ask") if len(choices) > 1 else words.said("may_ask_one", sentence=choices[0].text)
        )
        raise Asked(PendingQuestion(text, said, choices, "matched", code))

    def _shortened(
        self, language: Language, matcher: QuestionMatcher, text: str, topic: Topic
    ) -> tuple[str, Understood] | None:
        """The first question that is understood once words are left out of a text."""
        for each in matcher.shortened(text):
            parse = language.parse(each, topic)
            if isinstance(parse, Understood) and _only_asks(parse):
                return each, parse
        return None


_OF_OUTCOMES: Final[Mapping[Outcome, Situation]] = {
    Outcome.RUNNING: "running",
    Outcome.CRASH: "crash",
    Outcome.STUCK: "stuck",
    Outcome.SUCCESS: "arrived",
}


def situations(run: SimState) -> frozenset[Situation]:
    """The situations of a run that say what may be asked."""
    found: set[Situation] = {_OF_OUTCOMES[run.world.outcome]}
    if run.mode is Mode.MANUAL:
        found.add("manual")
    return frozenset(found)


def _only_asks(parse: Understood) -> bool:
    return all(isinstance(action, Ask) for action in parse.actions)
