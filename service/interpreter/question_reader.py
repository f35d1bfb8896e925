"""Questions that the grammar of a session's language refuses: those of another language, and paraphrases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal

from anyio import CapacityLimiter, to_thread

from service.actions import Ask
from service.grammar.parse_types import Understood
from service.grammar.topic import ALONE, Topic
from service.interpreter.languages import Language, Languages
from service.interpreter.question import Asked
from service.question_matcher.matcher import Match, QuestionMatcher
from service.question_matcher.parts import Part
from service.question_matcher.situations import Now, Situation
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

    async def read(self, text: str, topic: Topic, code: str, now: Now) -> Question | None:
        """The question, answered in the language it is in; None where there is none.

        Raises `Asked` where it may be one of several. `now`: what the session is like.
        """
        for other in self._languages.codes:
            if other == code:
                continue
            parse = await to_thread.run_sync(self._languages[other].parse, text, ALONE, limiter=self._parsing)
            if isinstance(parse, Understood) and _only_asks(parse):
                return Question(parse, other, "grammar")
        apart = replace(ALONE, columns=topic.columns)
        for each in sorted(self._languages.codes, key=lambda other: other != code):
            question = await self._matched(
                text, topic if each == code else apart, each, now, asks=self._asks and each == code
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

    async def _matched(self, text: str, topic: Topic, code: str, now: Now, *, asks: bool) -> Question | None:
        """What a text is like in one language. Raises `Asked` where that is several, if it `asks`."""
        language, matcher = self._languages[code], self._languages.matcher(code)
        if matcher is None:
            return None
        likeness = _Likeness(language, matcher, topic, now)
        found = await to_thread.run_sync(likeness.of, text, limiter=self._parsing)
        words = refusals(code)
        match found:
            case None:
                return None
            case _Read(sentence, parse, ""):
                return Question(parse, code, "matched", words.said("read_as", sentence=sentence))
            case _Read(sentence, parse, left):
                preface = words.said("read_as_part", sentence=sentence, left=left)
                return Question(parse, code, "matched", preface)
            case _Unsure(choices, likely) if asks:
                said = (
                    words.said("may_ask")
                    if len(choices) > 1
                    else words.said("may_ask_one", sentence=choices[0].text)
                )
                raise Asked(PendingQuestion(text, said, choices, "matched", code), likely=likely)
            case _:
                return None


@dataclass(frozen=True, slots=True)
class _Read:
    """A sentence that is understood, what it means, and what of the text it may leave unanswered."""

    sentence: str
    parse: Understood
    left: str = ""


@dataclass(frozen=True, slots=True)
class _Unsure:
    """What a text may ask; whether the first is likely (see `Match.likely`)."""

    choices: tuple[PendingChoice, ...]
    likely: bool


@dataclass(frozen=True, slots=True)
class _Likeness:
    """Finds the sentences of one language that a text is like, at a point of a conversation."""

    language: Language
    matcher: QuestionMatcher
    topic: Topic
    now: Now

    def of(self, text: str) -> _Read | _Unsure | None:
        """The question that a text is like, or the several that it may be; None where it is like none."""
        last = self.topic.asked if self.topic.actions == self.topic.asked else ()
        if (match := self.matcher.follow_up(text, last)) is not None:
            return self._chosen(match)
        if (numbered := self.matcher.with_numbered_lanes(text, self.topic.columns)) != text:
            text = numbered
            if (parse := self._understood(text)) is not None:
                return _Read(text, parse)
        if (shorter := self._shortened(text)) is not None:
            return shorter
        parts = self._parts(text)
        read = [found for _, found in parts if found is not None]
        if read and len(read) == len(parts):
            return _joined(read)
        match = self.matcher.match(text, self.now)
        whole = None if match is None else self._chosen(match)
        left = " ".join(part.text for part, found in parts if found is None and not part.is_stump)
        match whole:
            case _Read(sentence, parse) if any(each.parse.actions == parse.actions for each in read):
                return _Read(sentence, parse, left)
            case _Read():
                return whole
            case _ if read:
                return replace(_joined(read), left=left)
            case _:
                return whole

    def _parts(self, text: str) -> list[tuple[Part, _Read | None]]:
        """The questions of a text that asks several, each with what it is like by itself, if that is sure."""
        parts, found = self.matcher.parts(text), list[tuple[Part, _Read | None]]()
        of_a_thing = False
        for part in parts:
            leans = part.leans or (part.leans_on_a_thing and of_a_thing)
            found.append((part, None if leans else self._alone(part.text)))
            of_a_thing = of_a_thing or part.asks_for_a_thing or self.matcher.names_a_thing(part.text)
        return found

    def _alone(self, text: str) -> _Read | None:
        """What a text is surely like that asks one thing."""
        if (parse := self._understood(text)) is not None:
            return _Read(text, parse)
        if (shorter := self._shortened(text)) is not None:
            return shorter
        match = self.matcher.match(text, self.now)
        chosen = None if match is None else self._chosen(match)
        return chosen if isinstance(chosen, _Read) else None

    def _shortened(self, text: str) -> _Read | None:
        """The first question that is understood once words are left out of a text."""
        for each in self.matcher.shortened(text):
            if (parse := self._understood(each)) is not None:
                return _Read(each, parse)
        return None

    def _chosen(self, match: Match) -> _Read | _Unsure | None:
        read = [
            (sentence, parse)
            for sentence in match.sentences
            if (parse := self._understood(sentence)) is not None
        ]
        if not read:
            return None
        if match.sure:
            return _Read(*read[0])
        choices = tuple(PendingChoice(sentence, parse.actions) for sentence, parse in read)
        return _Unsure(choices, match.likely and read[0][0] == match.sentences[0])

    def _understood(self, text: str) -> Understood | None:
        """A text's meaning where it is understood and does nothing but ask."""
        parse = self.language.parse(text, self.topic)
        return parse if isinstance(parse, Understood) and _only_asks(parse) else None


def _as_question(read: _Read) -> str:
    """Its sentence with a mark at its end, as it may have been cut out of a longer one."""
    sentence = read.sentence.rstrip()
    return sentence if sentence.endswith(("?", ".", "!")) else f"{sentence}?"


def _joined(read: Sequence[_Read]) -> _Read:
    """Several questions as one text: each is answered, and none twice."""
    told = list({(each.parse.actions, each.parse.supposes): each for each in read}.values())
    sentence = told[0].sentence if len(told) == 1 else " ".join(map(_as_question, told))
    actions = tuple(action for each in told for action in each.parse.actions)
    supposes = tuple(each for one in told for each in one.parse.supposes or (None,) * len(one.parse.actions))
    return _Read(sentence, Understood(sentence, actions, supposes=supposes))


_OF_OUTCOMES: Final[Mapping[Outcome, Situation]] = {
    Outcome.RUNNING: "running",
    Outcome.CRASH: "crash",
    Outcome.STUCK: "stuck",
    Outcome.SUCCESS: "arrived",
}


def now_of(run: SimState) -> Now:
    """What a run is like: what may be asked of it, and what a question about it need not say."""
    found: set[Situation] = {_OF_OUTCOMES[run.world.outcome]}
    if run.mode is Mode.MANUAL:
        found.add("manual")
    config, world = run.config_of(), run.world
    facts = {
        ("planner", config.planner),
        ("sensor", config.sensor),
        ("weather", config.weather),
        ("weather", config.time_of_day),
        ("tick", str(world.tick)),
        ("n", f"the {world.episode_tick}"),
    }
    return Now(frozenset(found), frozenset(facts))


def _only_asks(parse: Understood) -> bool:
    return all(isinstance(action, Ask) for action in parse.actions)
