"""Questions: which of several readings of an utterance is meant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from pydantic import ValidationError

from service.actions import Action, load
from service.actions.table import verbs_where
from service.grammar.accounting import alignment
from service.grammar.clause import Clause
from service.grammar.contradictions import Contradiction
from service.grammar.fragments import Fragment
from service.grammar.noun_phrases import Amount
from service.grammar.parse_types import (
    Ambiguous,
    Choice,
    Parse,
    Span,
    Understood,
)
from service.grammar.referents import Unclear
from service.grammar.refusing import MAX_UNPARSED, Refusing, shorten
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token
from sim.actions import Add, Remove

CHOICE_STEPS = 10
"""What one action of a choice costs: it is validated, and said back."""


class Said(NamedTuple):
    """The actions of an utterance; of each the words that made it, and what it supposes."""

    values: list[dict[str, Any]]
    spans: tuple[tuple[Span, ...], ...]
    supposes: tuple[str | None, ...]


def once(clauses: Sequence[Clause], tokens: Sequence[Token]) -> Said:
    """All that is said, without what is only said again: "stop, hold on" pauses once."""
    values: list[dict[str, Any]] = []
    spans: list[tuple[Span, ...]] = []
    supposes: list[str | None] = []
    for clause in clauses:
        again = bool(values) and clause.after in _EMPHASIS and clause.actions == values[-1:]
        again = again and clause.supposes in (supposes[-1], None)
        said = alignment(clause.filled, clause.actions, tokens)
        if again and (clause.actions[0]["do"] in _STEADY or _names_again(clause)):
            spans[-1] += said[0]
        else:
            values += clause.actions
            spans += said
            supposes += [clause.supposes] * len(clause.actions)
    return Said(values, tuple(spans), tuple(supposes))


def _names_again(clause: Clause) -> bool:
    """Whether it says once more which setting was meant: "turn the noise down, the sensor noise"."""
    handed_on = any(edge.start < clause.start for edge in clause.filled.slots)
    return handed_on and clause.after == "pause" and clause.actions[0]["do"] == "adjust"


_STEADY = verbs_where(lambda traits: traits.idempotent)
"""Actions that make no difference the second time."""

_EMPHASIS = ("pause", "stop", "and")
"""Separators after which they may be said again for emphasis; "pause, then pause" is two."""

_JOINED = frozenset(("place", "thing"))
"""Heads of concepts of which several in one request are named together in its choices."""


class Asking(Refusing):
    """Makes the questions of one utterance."""

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
        quoted = self._messages["both"].join(f'"{shorten(phrase)}"' for phrase in phrases)
        return self._refusal("impossible", self._messages["contradiction"].format(phrases=quoted), phrases)

    def _together_or_apart(self, clauses: Sequence[Clause], unsure: Clause, *, asking: bool) -> Parse:
        """The question whether parts belong together or are each a request of its own."""
        at = clauses.index(unsure)
        together = [replace(clause, instead=()) for clause in clauses]
        apart = [*together[:at], *unsure.instead, *together[at + 1 :]]
        try:
            choices = [self._choice(once(each, self._tokens).values) for each in (together, apart)]
        except (Unsayable, ValidationError):  # nothing to choose from
            choices = []
        if asking and len(choices) > 1:
            return Ambiguous(self._text, self._messages["which"], tuple(choices))
        phrase = self._written(unsure.start, unsure.end)
        message = self._messages["together_or_apart"].format(phrase=shorten(phrase))
        return self._refusal("not_understood", message, (phrase,))

    def _which_order(self, readings: Sequence[Sequence[Clause]], *, asking: bool) -> Parse:
        """The question in which order requests shall be done."""
        try:
            choices = [self._choice(once(each, self._tokens).values) for each in readings]
        except (Unsayable, ValidationError):  # nothing to choose from
            choices = []
        if asking and len(choices) > 1:
            return Ambiguous(self._text, self._messages["which"], tuple(choices))
        return self._refuse([self._plain], (), asking=asking)

    def _which_place(self, readings: Sequence[list[dict[str, Any]]], *, asking: bool) -> Parse:
        """The question whether a place holds for all that a list names."""
        try:
            choices = [self._choice(each) for each in readings]
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
        first: dict[str, int] = {}
        for edge in clause.filled.slots:
            written = self._written(edge.start, edge.end)
            if edge.part:  # only half of it stands here: "divide ... by two"
                typical = self._language.data.lexicon.typical.get((edge.concept, repr(edge.sense.value)))
                written = " ".join(typical or (written,))
            head = edge.sense.concept.partition(".")[0]
            if head in first and head in _JOINED and not edge.part:  # "lanes 2 to 4 at row 12" is one place
                written = self._written(first[head], edge.end)
            first.setdefault(head, edge.start)
            said[head] = written
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

    def _offer(self, readings: Sequence[Sequence[Clause]], question: str) -> Ambiguous | None:
        """A question with these readings to choose from; None where they cannot all be said."""
        try:
            choices = [self._choice(once(each, self._tokens).values) for each in readings]
        except (Unsayable, ValidationError):
            return None
        return Ambiguous(self._text, question, tuple(choices))

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
        quoted = self._messages["and"].join(f'"{shorten(phrase)}"' for phrase in shown)
        message = self._messages["not_understood"].format(phrases=quoted)
        return self._refusal("not_understood", message, tuple(shown), understood, gap)
