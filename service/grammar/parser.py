"""One utterance read: its lattice → clauses → actions, a question with choices, or a refusal with words.

What reading one sentence needs of its language is the protocol `LanguageReader`, so that the engine imports
this file and not the reverse. No word of any language is here either.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

from pydantic import ValidationError

from service.actions import Action, load
from service.actions.table import verbs_where
from service.grammar.accounting import alignment, restored
from service.grammar.clauses import Clause, Divided, Divider
from service.grammar.contradictions import Contradiction, contradiction
from service.grammar.data import LanguageData
from service.grammar.fragments import Fragment, fragments
from service.grammar.lattice import GLUE, Lattice
from service.grammar.matching import Frames
from service.grammar.noun_phrases import QUANTITY, Amount, add_noun_phrases
from service.grammar.order import orders
from service.grammar.parse_types import (
    Ambiguous,
    Choice,
    Correction,
    Parse,
    Reason,
    Refused,
    Span,
    Understood,
)
from service.grammar.paths import ALLOWS, SEPARATOR
from service.grammar.pointing import add_pointing
from service.grammar.references import add_referents
from service.grammar.referents import Unclear
from service.grammar.same_sentence import named_before
from service.grammar.sentences import Sentences, Unsayable
from service.grammar.small_talk import same_again, small_talk
from service.grammar.spoken_tick import name_spoken_tick
from service.grammar.subordinate import read_all
from service.grammar.suggestions import Suggestions, meanings_of, turned_round
from service.grammar.time_clauses import read_in_time
from service.grammar.tokens import Token
from service.grammar.topic import Topic
from service.grammar.unparsed_span import Gap, GapFinder
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Add, Remove

SHIFT = "v.shift"
"""Concept of verbs that move things on the road."""

CHOICE_STEPS = 10
"""What one action of a choice costs: it is validated, and said back."""

MAX_UNPARSED = 8
"""How many stretches not understood a refusal names."""


class LanguageReader(Protocol):
    """What a reading takes from its language."""

    data: LanguageData
    frames: Frames
    sentences: Sentences

    @property
    def suggestions(self) -> Suggestions:
        """The sayings that a refusal may offer."""

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """Another sentence read: this one with a choice in the place of what was asked about."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def content_of(lattice: Lattice) -> frozenset[str]:
    """The concepts of a sentence that say what it is about."""
    return frozenset(
        f"{edge.sense.concept}={edge.sense.value}"
        if isinstance(edge.sense.value, str)
        else edge.sense.concept
        for edge in lattice.all()
        if edge.sense.concept not in (GLUE, SEPARATOR, QUANTITY, ALLOWS)
    )


def _once(
    clauses: Sequence[Clause], tokens: Sequence[Token]
) -> tuple[list[dict[str, Any]], tuple[tuple[Span, ...], ...]]:
    """All actions and the words of each, without what is only said again: "stop, hold on" pauses once."""
    values: list[dict[str, Any]] = []
    spans: list[tuple[Span, ...]] = []
    for clause in clauses:
        again = bool(values) and clause.after in _EMPHASIS and clause.actions == values[-1:]
        said = alignment(clause.filled, clause.actions, tokens)
        if again and (clause.actions[0]["do"] in _STEADY or _names_again(clause)):
            spans[-1] += said[0]
        else:
            values += clause.actions
            spans += said
    return values, tuple(spans)


def _names_again(clause: Clause) -> bool:
    """Whether it says once more which setting was meant: "turn the noise down, the sensor noise"."""
    handed_on = any(edge.start < clause.start for edge in clause.filled.slots)
    return handed_on and clause.after == "pause" and clause.actions[0]["do"] == "adjust"


_STEADY = verbs_where(lambda traits: traits.idempotent)
"""Actions that make no difference the second time."""

_EMPHASIS = ("pause", "stop", "and")
"""Separators after which they may be said again for emphasis; "pause, then pause" is two."""


class Reading:
    """One utterance on its way through the engine."""

    def __init__(
        self,
        language: LanguageReader,
        text: str,
        plain: str,
        tokens: list[Token],
        lattice: Lattice,
        corrections: tuple[Correction, ...],
        topic: Topic,
        work: WorkBudget,
    ) -> None:
        self._language = language
        self._topic = topic
        self._work = work
        self._suggests = False
        self._unclear: list[Unclear] = []
        self._messages = language.data.messages
        self._text = text
        self._plain = plain
        self._tokens = tokens
        self._lattice = lattice
        self._corrections = corrections

    def parse(self, *, asking: bool) -> Parse:
        """The whole utterance; unless `asking`, a refusal suggests nothing."""
        self._suggests = asking
        unknown = self._lattice.uncovered()
        if unknown:
            return self._refuse(self._stretches(unknown), (), unknown=unknown)
        if asking and (manners := small_talk(self._lattice) or same_again(self._lattice)):
            return Understood(self._text, load(manners), self._corrections)
        name_spoken_tick(self._lattice, self._topic.tick)
        add_noun_phrases(self._lattice, self._language.data.vague)
        self._unclear = add_referents(self._lattice, self._topic)
        add_pointing(self._lattice)
        divided = read_all(self._lattice, 0, self._lattice.size, self._divide)
        if isinstance(divided, Fragment):
            return self._refuse([self._written(divided.start, divided.end)], (), asking=asking)
        clauses = divided.clauses
        if divided.failed is not None or not clauses:
            return self._refuse_after(divided, asking=asking)
        question = next(
            (clause for clause in clauses if clause.filled.frame.ask and not clause.negated), None
        )
        if question is not None:
            return self._ask(question) if asking else self._refuse([self._plain], ())
        if not (found := orders(clauses, self._lattice)):
            return self._refuse([self._plain.strip()], ())
        clauses, *otherwise = found
        if (unsure := next((clause for clause in clauses if clause.instead), None)) is not None:
            return self._together_or_apart(clauses, unsure, asking=asking)
        if (both := contradiction(clauses, self._lattice)) is not None:
            return self._answer_contradiction(both, asking=asking)
        if otherwise:
            return self._which_order((clauses, *otherwise), asking=asking)
        values, spans = _once(clauses, self._tokens)
        if not values:
            return self._refusal("negation", self._messages["negation"])
        if self._drives_a_thing(values):
            return self._refuse([self._plain.strip()], (), asking=asking)
        try:
            actions = load(values)
        except ValidationError:
            return self._impossible(clauses)
        if self._topic.removed and clauses[0].leans:
            return self._more_of_what(actions) if asking else self._refuse([self._plain], ())
        supposes = next((each.supposes for each in clauses if each.actions and each.supposes), None)
        return Understood(self._text, actions, self._corrections, supposes, spans)

    def _drives_a_thing(self, values: Sequence[dict[str, Any]]) -> bool:
        """Whether the vehicle would turn although something unknown was to be moved: "move it left"."""
        return any(value["do"] == "drive" for value in values) and any(
            edge.concept == SHIFT and edge.end == unclear.start
            for unclear in self._unclear
            for edge in self._lattice.between(max(0, unclear.start - 2), unclear.start)
        )

    def _divide(self, start: int, end: int, moods: frozenset[str]) -> Divided:
        """The clauses of tokens `[start, end)`, with these forms in place."""
        divider = Divider(self._language.frames, self._lattice, self._language.data.vague, moods, self._work)
        return divider.divide(fragments(self._lattice, start, end), None if start else self._topic.kind)

    def _more_of_what(self, actions: tuple[Action, ...]) -> Parse:
        """The question after "two more" when the last amount was taken away."""
        first = actions[0]
        if not isinstance(first, Add):
            return self._refuse([self._plain], ())
        away = Remove(kind=first.kind, count=first.count, where=first.where)
        try:
            choices = tuple(
                Choice(self._language.sentence(each), each) for each in ((away, *actions[1:]), actions)
            )
        except Unsayable:  # a language that says nothing back has no sentences to choose from
            return self._refuse([self._plain], ())
        return Ambiguous(self._text, self._messages["more_of_what"], choices)

    def _answer_contradiction(self, both: Contradiction, *, asking: bool) -> Parse:
        """The question which of two values is meant, or the refusal of parts that cannot both hold."""
        try:
            choices = [self._choice(alternative) for alternative in both.alternatives]
        except (Unsayable, ValidationError):  # nothing to choose from
            choices = []
        if asking and len(choices) > 1:
            return Ambiguous(self._text, self._messages["which"], tuple(choices))
        phrases = tuple(dict.fromkeys(self._written(each.start, each.end) for each in both.clauses))
        quoted = self._messages["both"].join(f'"{_shorten(phrase)}"' for phrase in phrases)
        return self._refusal("impossible", self._messages["contradiction"].format(phrases=quoted), phrases)

    def _together_or_apart(self, clauses: Sequence[Clause], unsure: Clause, *, asking: bool) -> Parse:
        """The question whether parts belong together or are each a request of its own."""
        at = clauses.index(unsure)
        together = [replace(clause, instead=()) for clause in clauses]
        apart = [*together[:at], *unsure.instead, *together[at + 1 :]]
        try:
            choices = [self._choice(_once(each, self._tokens)[0]) for each in (together, apart)]
        except (Unsayable, ValidationError):  # nothing to choose from
            choices = []
        if asking and len(choices) > 1:
            return Ambiguous(self._text, self._messages["which"], tuple(choices))
        phrase = self._written(unsure.start, unsure.end)
        message = self._messages["together_or_apart"].format(phrase=_shorten(phrase))
        return self._refusal("not_understood", message, (phrase,))

    def _which_order(self, readings: Sequence[Sequence[Clause]], *, asking: bool) -> Parse:
        """The question in which order requests shall be done."""
        try:
            choices = [self._choice(_once(each, self._tokens)[0]) for each in readings]
        except (Unsayable, ValidationError):  # nothing to choose from
            choices = []
        if asking and len(choices) > 1:
            return Ambiguous(self._text, self._messages["which"], tuple(choices))
        return self._refuse([self._plain], (), asking=asking)

    def _choice(self, values: list[dict[str, Any]]) -> Choice:
        """Actions to choose, with a sentence that means them."""
        self._work.spend(CHOICE_STEPS * len(values))
        actions = load(values)
        return Choice(self._language.sentence(actions), actions)

    def _which(self) -> Parse | None:
        """The question about a reference to one of several things, or the refusal of one to nothing."""
        for unclear in self._unclear:
            lanes = self._language.data.lanes
            tried = unclear.candidates or (lanes if unclear.lane else ("vehicle-1",))
            choices: list[Choice] = []
            for candidate in tried:
                parsed = self._language.read(
                    self._instead(unclear, candidate), self._topic, self._work, asking=False
                )
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

    def _ask(self, clause: Clause) -> Parse:
        """The question of an ambiguous clause; each choice is the whole utterance with it replaced."""
        ask = clause.filled.frame.ask
        if ask is None:
            return self._refuse([self._plain], ())
        said: dict[str, str] = {}
        for edge in clause.filled.slots:
            written = self._written(edge.start, edge.end)
            if edge.part:  # only half of it stands here: "divide ... by two"
                typical = self._language.data.lexicon.typical.get((edge.concept, repr(edge.sense.value)))
                written = " ".join(typical or (written,))
            said[edge.sense.concept.partition(".")[0]] = written
            if isinstance(edge.sense.value, Amount):
                noun = self._tokens[edge.end - 1]
                said["noun"] = self._plain[noun.start : noun.end]
                said |= self._language.sentences.names(edge.sense.value.of)
        start, end = self._tokens[clause.start].start, self._tokens[clause.end - 1].end
        choices: list[Choice] = []
        for template in ask.choices:
            try:
                sentence = template.format_map(said)
            except KeyError:
                continue
            whole = self._plain[:start] + sentence + self._plain[end:]
            parsed = self._language.read(whole, self._topic, self._work, asking=False)
            if isinstance(parsed, Understood) and all(c.actions != parsed.actions for c in choices):
                choices.append(Choice(whole.strip(), parsed.actions))
        if len(choices) < 2:
            return self._refuse([self._written(clause.start, clause.end)], ())
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

    def _refuse_after(self, divided: Divided, *, asking: bool) -> Parse:
        """The refusal of a sentence of known words that make no request; or a question about one of them."""
        understood = tuple(self._written(clause.start, clause.end) for clause in divided.clauses)
        part = divided.failed
        if part is None:
            return self._refuse([self._plain.strip()], understood)
        if asking and (meant := self._said_again(divided)) is not None:
            return meant
        if asking and (in_time := read_in_time(self._lattice, self._divide)):
            question = self._offer(in_time, self._messages["in_order"])
            if question is not None:
                return question
        if lost := self._lost(part):
            return self._refuse(lost, understood)
        failed = self._written(part.start, part.end)
        if any(_impossible_number(edge.sense.value) for edge in self._lattice.between(part.start, part.end)):
            return self._refusal("impossible", self._messages["impossible"].format(phrase=failed), (failed,))
        return self._refuse([failed], understood, asking=asking, failed=part)

    def _said_again(self, divided: Divided) -> Parse | None:
        """The sentence with what "it" stands for in its place, where that was named just before."""
        found = named_before(self._lattice, divided)
        if found is None:
            return None
        word, named = found
        start, end = self._tokens[word.start].start, self._tokens[word.end - 1].end
        whole = self._plain[:start] + self._written(named.start, named.end) + self._plain[end:]
        parsed = self._language.read(whole, self._topic, self._work, asking=False)
        if not isinstance(parsed, Understood):
            return None
        return Understood(self._text, parsed.actions, self._corrections, parsed.supposes)

    def _offer(self, readings: Sequence[Sequence[Clause]], question: str) -> Ambiguous | None:
        """A question with these readings to choose from; None where they cannot all be said."""
        try:
            choices = [self._choice(_once(each, self._tokens)[0]) for each in readings]
        except (Unsayable, ValidationError):
            return None
        return Ambiguous(self._text, question, tuple(choices))

    def _gap(self, unknown: Sequence[int], failed: Fragment | None) -> Gap | None:
        """The smallest stretches that hold what is unknown, or make a part fail, and what is left without."""
        if not self._suggests:
            return None
        finder = GapFinder(
            self._plain,
            self._tokens,
            self._lattice,
            lambda text, work: self._language.read(text, self._topic, work, asking=False),
            self._language.data.lexicon.leads_on,
        )
        return finder.find(unknown, failed)

    def _lost(self, part: Fragment) -> list[str]:
        """The markers of a part with what they stand with, where the part would be read without them."""
        inside = [each for each in self._lattice.withheld if part.start <= each.start < part.end]
        for tried in [*((each,) for each in inside[:MAX_UNPARSED]), inside]:
            with restored(self._lattice, tried, part.end):
                try:
                    read = read_all(self._lattice, 0, self._lattice.size, self._divide)
                except BudgetExceededError:
                    return []
            if not isinstance(read, Fragment) and (read.failed is None or read.failed.start > part.start):
                return [self._written(each.start, min(each.end, part.end)) for each in tried]
        return []

    def _refuse(
        self,
        unparsed: list[str],
        understood: tuple[str, ...],
        *,
        asking: bool = False,
        unknown: Sequence[int] = (),
        failed: Fragment | None = None,
    ) -> Parse:
        if asking and (which := self._which()) is not None:
            return which
        gap = self._gap(unknown, failed) if unknown or failed else None
        if gap is not None:
            unparsed = [self._written(*span) for span in gap.spans]
        shown = unparsed[:MAX_UNPARSED]
        quoted = self._messages["and"].join(f'"{_shorten(phrase)}"' for phrase in shown)
        message = self._messages["not_understood"].format(phrases=quoted)
        return self._refusal("not_understood", message, tuple(shown), understood, gap)

    def _refusal(
        self,
        reason: Reason,
        message: str,
        unparsed: tuple[str, ...] = (),
        understood: tuple[str, ...] = (),
        gap: Gap | None = None,
    ) -> Refused:
        suggestions: tuple[str, ...] = ()
        if self._suggests and reason != "negation":
            meanings, turned = meanings_of(self._lattice), turned_round(self._lattice)
            suggestions = self._language.suggestions.nearest(self._plain, meanings, harmless=turned, gap=gap)
        return Refused(self._text, reason, message, unparsed, understood, suggestions)

    def _stretches(self, unknown: list[int]) -> list[str]:
        """The stretches with unknown words; unknown words with only glue between them are one."""
        stretches: list[tuple[int, int]] = []
        marked = {each.start: each.end for each in self._lattice.withheld}
        for at in unknown:
            if at in marked:
                stretches.append((at, marked[at]))
                continue
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


def _shorten(phrase: str, limit: int = 80) -> str:
    return phrase if len(phrase) <= limit else phrase[: limit - 1] + "…"
