"""The interpreter: grammar first, then a match with known questions, then (if configured) a language model,
then a refusal.

A match is a question only, and its answer begins with the sentence that it was read as.

A model is asked only when the grammar refuses. Its result is an interpretation: a question is answered and
marked as read by a model, a change is offered as a sentence to confirm, and nothing is done before that
sentence is sent.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from anyio import CapacityLimiter, to_thread

from service.actions import Action, Ask, Drop, Forget, Teach
from service.actions.table import ModelUse, traits_of
from service.grammar import Language as Grammar
from service.grammar.follow_up import read_in_conversation
from service.grammar.parse_types import Ambiguous as AmbiguousParse
from service.grammar.parse_types import Correction, Parse, Refused, Understood
from service.grammar.references import parse_in_topic
from service.grammar.sentences import Unsayable
from service.grammar.topic import ALONE, Topic
from service.interpreter.aliases import Aliases
from service.interpreter.languages import Language, Languages
from service.interpreter.preview import Preview, preview
from service.interpreter.question import Asked, answered, asked_by, only_doable
from service.interpreter.question_reader import QuestionReader, now_of
from service.interpreter.sentence_cache import SentenceCache
from service.llm.protocol import LanguageModel
from service.problems import FieldProblem, Invalid, NotAQuestion, NotUnderstood, ProblemError
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.server_timing import part
from service.sessions.facts import AliasChange
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.pending import PendingChoice, PendingQuestion
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.session import Session
from service.sessions.utterance import Outcome, Utterance
from service.sessions.work_estimate import question_units
from service.work.long_answers import LONG_UNITS
from service.work.turn import TurnBudget
from sim.actions import Scenario
from sim.config import Config
from sim.session.config_to_actions import UndescribableError, config_to_actions

MAX_SUGGESTIONS = 3

MAX_INLINE_CHARS = 60
"""Longest text, in characters, that is parsed on the event loop: within a few milliseconds. A thread parses
longer ones, which may take 30 ms (`service.grammar.work_budget` limits them)."""

PARSERS = 2
"""Threads that parse at once: each delays the event loop a little."""

Source = Literal["grammar", "matched", "llm", "typed"]


@dataclass(frozen=True, slots=True)
class ParsedCommand:
    """The actions of a text, and who parsed it."""

    text: str
    actions: tuple[Action, ...]
    corrections: tuple[Correction, ...] = ()
    source: Source = "grammar"
    language: str = DEFAULT_LANGUAGE
    supposes: tuple[str | None, ...] = ()
    preface: str = ""
    """what the reply begins with: as what the text was read, where that is not plain"""
    at_tick: int | None = None
    """the past tick that is looked at while it is said"""

    @property
    def utterance(self) -> Utterance:
        """The utterance to perform."""
        return Utterance(
            actions=self.actions,
            text=self.text,
            supposes=self.supposes,
            preface=self.preface,
            language=self.language,
            at_tick=self.at_tick,
        )


class Interpreter:
    """Parses text for sessions and performs it."""

    def __init__(
        self,
        languages: Languages,
        aliases: Aliases,
        words: NarratorProtocol,
        *,
        most_chars: int,
        model: LanguageModel | None = None,
        confirm: bool = True,
        rephrase: bool = False,
    ) -> None:
        """`confirm`: whether changes that a model read have to be confirmed."""
        self.languages = languages
        self.aliases = aliases
        self._narrator = words
        self._most_chars = most_chars
        self._model = model
        self._confirm = confirm
        self._rephrase = rephrase
        self._parsing = CapacityLimiter(PARSERS)
        self._questions = QuestionReader(languages, self._parsing, asks=model is None)
        self._turn = TurnBudget()
        self._sentences = SentenceCache()

    def topic(
        self, session: Session | None, code: str = DEFAULT_LANGUAGE, at_tick: int | None = None
    ) -> Topic:
        """What a sentence may refer to: the session's conversation, the tick looked at, and aliases."""
        phrases = self.aliases.phrases(code)
        if session is None:
            return Topic(phrases=phrases)
        topic = session.conversation.topic(session.run, phrases, session.undo_stack.bookmarks)
        topic = topic if at_tick is None else replace(topic, looks_back=at_tick < session.timeline.tick)
        return topic if session.pending is None else replace(topic, asked_kind=session.pending.kind)

    def sentence_for(self, config: Config, code: str = DEFAULT_LANGUAGE) -> str | None:
        """The sentence that makes such a road; None where nothing that can be said in the language does."""
        try:
            return self.languages[code].sentence(config_to_actions(config) or (Scenario(),))
        except (UndescribableError, Unsayable):
            return None

    async def preview(self, text: str, session: Session, code: str | None = None) -> Preview | None:
        """What a sentence would do now; None for one that is empty, or too long to be read."""
        if not text.strip() or len(text) > self._most_chars:
            return None
        code = code or session.language
        parse = await self._read(text, session, code)
        if isinstance(parse, Refused) and parse.reason in ("not_understood", "negation"):
            try:
                question = await self._question(text, session, code)
            except Asked as problem:
                return Preview("ambiguous", detail=problem.detail)
            if question is not None:
                return Preview("asks", question.actions)
        return preview(parse, session, code)

    async def _read(self, text: str, session: Session | None, code: str, at_tick: int | None = None) -> Parse:
        language, topic = self.languages[code], self.topic(session, code, at_tick)
        if len(text) <= MAX_INLINE_CHARS:
            async with self._turn.piece():
                parsed = self._parse(language, text, topic)
        else:
            parsed = await to_thread.run_sync(self._parse, language, text, topic, limiter=self._parsing)
        pending = None if session is None else session.pending
        return only_doable(answered(language, code, text, parsed, pending), code)

    def _parse(self, language: Language, text: str, topic: Topic) -> Parse:
        return self._sentences.parse(language, text, topic, lambda seen: _parse(language, text, seen))

    async def interpret(
        self,
        text: str,
        session: Session | None = None,
        code: str | None = None,
        field: str = "text",
        *,
        asks: bool = False,
        at_tick: int | None = None,
    ) -> ParsedCommand:
        """What a sentence means, in a language (by default the session's).

        Raises `Invalid`, `NotUnderstood` or `Ambiguous`, naming `field`. `asks`: a question becomes the
        session's pending one, which the next sentence may answer. `at_tick`: the tick that is looked at while
        it is said, which has come.
        """
        try:
            return replace(await self._interpret(text, session, code, field, at_tick), at_tick=at_tick)
        except Asked as problem:
            if not asks or session is None:
                raise
            answered = (
                await self._with_likely_answer(problem, session, at_tick) if problem.likely else problem
            )
            session.pending = answered.question
            answered.becomes_pending()
            raise answered from None

    async def _interpret(
        self, text: str, session: Session | None, code: str | None, field: str, at_tick: int | None
    ) -> ParsedCommand:
        code = code or language_of(session)
        if len(text) > self._most_chars:
            words = refusals(code)
            message = words.said("too_many_characters", length=len(text), most=self._most_chars)
            raise Invalid(words.said("too_long"), errors=[FieldProblem(field, message)])
        with part("parse"):
            parse = await self._read(text, session, code, at_tick)
        match parse:
            case Understood():
                return ParsedCommand(
                    text, parse.actions, parse.corrections, language=code, supposes=parse.supposes
                )
            case AmbiguousParse():
                raise asked_by(parse, code, None if session is None else session.pending)
            case Refused():
                # "Why doesn't it just go around?" says what not to do, and asks.
                if parse.reason in ("not_understood", "negation"):
                    question = await self._question(text, session, code, at_tick)
                    if question is not None:
                        return question
                refusal = await self._refusal(parse, session, field, code)
                elsewhere = session is not None and parse.reason == "not_understood"
                if elsewhere and await self._questions.is_of_something_else(text, code):
                    refusal.detail = f"{refusal.detail} {refusals(code).said('askable')}"
                if self._model is None or parse.reason != "not_understood":
                    raise refusal
                return await self._ask_model(self._model, text, refusal, code)

    async def _question(
        self, text: str, session: Session | None, code: str, at_tick: int | None = None
    ) -> ParsedCommand | None:
        """What a refused text asks of a session if it is a question nevertheless, or None. Raises `Asked`."""
        if session is None:
            return None
        run = session.run if at_tick is None else session.timeline.at(at_tick)
        topic = self.topic(session, code, at_tick)
        question = await self._questions.read(text, topic, code, now_of(run))
        if question is None:
            return None
        return ParsedCommand(
            text,
            question.parse.actions,
            source=question.source,
            language=question.language,
            supposes=question.parse.supposes,
            preface=question.preface,
        )

    async def _with_likely_answer(self, problem: Asked, session: Session, at_tick: int | None) -> Asked:
        """The problem with the answer to its first choice, where that is made soon and can be given."""
        question = problem.question
        likely = question.choices[0]
        asks = [action for action in likely.actions if isinstance(action, Ask)]
        if question_units(session.timeline, asks) >= LONG_UNITS:
            return problem
        utterance = Utterance(actions=likely.actions, language=question.language, at_tick=at_tick)
        try:
            outcome = await session.change(utterance, dry_run=True)
        except ProblemError:
            return problem
        one = "" if len(question.choices) > 1 else "_one"
        said = refusals(question.language).said(f"likely{one}", sentence=likely.text, answer=outcome.reply)
        return Asked(question, said)

    async def interpret_question(
        self, text: str, session: Session | None, code: str | None = None, at_tick: int | None = None
    ) -> ParsedCommand:
        """The same for a question. Raises also `NotAQuestion` for anything else."""
        found = await self.interpret(text, session, code, "question", at_tick=at_tick)
        if not all(traits_of(action).is_question for action in found.actions):
            raise NotAQuestion(refusals(found.language).said("no_question"))
        return found

    async def execute(
        self,
        session: Session,
        utterance: Utterance,
        *,
        dry_run: bool = False,
        preconditions: Preconditions = NO_PRECONDITIONS,
    ) -> Outcome:
        """Perform an utterance, all or nothing; aliases are their owner's. Raises a `ProblemError`.

        What was said drops the pending question, unless it asks for that.
        """
        try:
            outcome = await self._execute(session, utterance, dry_run, preconditions)
        except Invalid:
            if not dry_run and utterance.text is not None:
                session.pending = None
                session.conversation.record_refused(utterance)
            raise
        if not dry_run and _drops_pending(utterance, session.pending):
            session.pending = None
        return outcome

    async def _execute(
        self, session: Session, utterance: Utterance, dry_run: bool, preconditions: Preconditions
    ) -> Outcome:
        if not any(traits_of(action).changes_aliases for action in utterance.actions):
            outcome = await session.change(utterance, dry_run=dry_run, preconditions=preconditions)
            # An answer that is kept is kept as it was made: in our own words.
            return outcome if preconditions.answer else await self._rephrase_answer(outcome, session)
        code = utterance.language or session.language
        if len(utterance.actions) > 1:
            sentence = refusals(code).said("taught_alone")
            raise Invalid(sentence, errors=[FieldProblem("actions", sentence)])
        (action,) = utterance.actions
        assert isinstance(action, Teach | Forget)
        preconditions.check(session.sequence)
        made: list[Outcome] = []

        def outcome_of(lesson: AliasChange) -> Outcome:
            if not made:
                reply = self._narrator.in_language(code).alias_change(lesson)
                made.append(
                    Outcome(
                        utterance=utterance,
                        facts=(),
                        reply=reply,
                        answer=None,
                        sequence=session.sequence,
                        changes=(),
                    )
                )
            return made[0]

        answer = preconditions.answer
        kept = None if answer is None else lambda lesson: answer(outcome_of(lesson))
        lesson = await self.aliases.update(action, code, dry_run=dry_run, answer=kept)
        outcome = outcome_of(lesson)
        if not dry_run:
            session.announce("taught" if lesson.taught else "forgotten", utterance.text, outcome.reply)
        return outcome

    async def _rephrase_answer(self, outcome: Outcome, session: Session) -> Outcome:
        """The answer in a model's words, where one may reword and its words are true to the facts.

        Only where it is English: what a text claims is known for no other language.
        """
        english = (outcome.utterance.language or session.language) == DEFAULT_LANGUAGE
        if self._model is None or not self._rephrase or outcome.answer is None or not english:
            return outcome
        text = outcome.answer["text"]
        other = await self._model.rephrase(text, outcome.answer)
        answer = {**outcome.answer, "text": other}
        return replace(outcome, answer=answer, reply=outcome.reply.replace(text, other))

    async def _refusal(self, parse: Refused, session: Session | None, field: str, code: str) -> NotUnderstood:
        suggestions: list[str] = []
        for say in parse.suggestions:
            async with self._turn.piece():
                if self._would_work(say, session, code):
                    suggestions.append(say)
            if len(suggestions) == MAX_SUGGESTIONS:
                break
        return NotUnderstood(
            parse.message,
            errors=[FieldProblem(field, parse.message)],
            reason=parse.reason,
            unparsed=parse.unparsed,
            understood=parse.understood,
            suggestions=tuple(suggestions),
        )

    def _would_work(self, say: str, session: Session | None, code: str) -> bool:
        if session is None:
            return True
        parse = self.languages[code].parse(say, ALONE)
        return not isinstance(parse, Understood) or session.is_possible(parse.actions)

    async def _ask_model(
        self, model: LanguageModel, text: str, refusal: NotUnderstood, code: str
    ) -> ParsedCommand:
        """What a model makes of a sentence the grammar refused. Raises the refusal, or asks."""
        reading, words = await model.interpret(text), refusals(code)
        if not reading.actions:
            failure, told = reading.failure, reading.explanation
            if failure is not None:
                told = words.model(failure.reason, failure.parts)
            refusal.detail = f"{refusal.detail} {told}".strip()
            raise refusal
        at_once = {ModelUse.ALWAYS} if self._confirm else {ModelUse.ALWAYS, ModelUse.UNCONFIRMED}
        if all(traits_of(action).model in at_once for action in reading.actions):
            return ParsedCommand(text, reading.actions, source="llm", language=code)
        try:
            said = self.languages[code].sentence(reading.actions)
        except Unsayable:
            refusal.detail += f" {words.said('not_confirmable')}"
            raise refusal from None
        offered = (PendingChoice(said, reading.actions),)
        raise Asked(PendingQuestion(text, words.said("confirm"), offered, "llm", code))


def _parse(language: Language, text: str, topic: Topic) -> Parse:
    parsed = parse_in_topic(language.parse, text, topic)
    return read_in_conversation(language, text, topic, parsed) if isinstance(language, Grammar) else parsed


def _drops_pending(utterance: Utterance, pending: PendingQuestion | None) -> bool:
    """Whether nothing is pending after an utterance; of typed actions, only a choice or `drop` answers."""
    actions = utterance.actions
    chosen = pending is not None and any(choice.actions == actions for choice in pending.choices)
    if chosen or any(isinstance(action, Drop) for action in actions):
        return True
    asks = all(isinstance(action, Ask) and action.about in ("pending", "options") for action in actions)
    return utterance.text is not None and not asks


def language_of(session: Session | None) -> str:
    """The language of a sentence that names none: the session's, or the default outside of any."""
    return DEFAULT_LANGUAGE if session is None else session.language
