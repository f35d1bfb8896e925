"""One utterance read: its lattice → clauses → actions, a question with choices, or a refusal with words.

What reading one sentence needs of its language is the protocol `LanguageReader`, so that the engine imports
this file and not the reverse. No word of any language is here either.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from pydantic import ValidationError

from service.actions import Action, Ask, load
from service.grammar.asking import Asking, once
from service.grammar.clause import Clause, Divided
from service.grammar.composition import asks
from service.grammar.contradictions import contradiction
from service.grammar.distance_of_it import without_distance_again
from service.grammar.fragments import AND, STOP, Fragment
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.noun_phrases import QUANTITY, add_noun_phrases
from service.grammar.order import orders
from service.grammar.parse_types import (
    Correction,
    Parse,
    Understood,
)
from service.grammar.paths import ALLOWS, SEPARATOR
from service.grammar.pointing import add_pointing
from service.grammar.references import add_referents
from service.grammar.refusing import is_impossible
from service.grammar.same_sentence import asked_of_it, beside_what_is_named, named_before
from service.grammar.seconds_in_ticks import count_seconds_in_ticks, steps_in_seconds
from service.grammar.shared_place import place_for_all
from service.grammar.small_talk import same_again, small_talk
from service.grammar.spoken_tick import name_spoken_tick
from service.grammar.subordinate import read_all
from service.grammar.time_clauses import read_in_time
from sim.actions import Add, Scenario, SetCount

SHIFT = "v.shift"
"""Concept of verbs that move things on the road."""


def content_of(lattice: Lattice) -> frozenset[str]:
    """The concepts of a sentence that say what it is about."""
    return frozenset(
        f"{edge.sense.concept}={edge.sense.value}"
        if isinstance(edge.sense.value, str)
        else edge.sense.concept
        for edge in lattice.all()
        if edge.sense.concept not in (GLUE, SEPARATOR, QUANTITY, ALLOWS)
    )


class Reading(Asking):
    """One utterance on its way through the engine."""

    def parse(self, *, asking: bool) -> Parse:
        """The whole utterance; unless `asking`, a refusal suggests nothing."""
        self._suggests = asking
        unknown = self._lattice.uncovered()
        if unknown:
            return self._refuse(self._stretches(unknown), (), unknown=unknown)
        if asking and (manners := small_talk(self._lattice) or same_again(self._lattice)):
            return Understood(self._text, load(manners), self._corrections)
        name_spoken_tick(self._lattice, self._topic.tick)
        if steps_in_seconds(self._lattice):
            count_seconds_in_ticks(self._lattice, self._topic.step_seconds)
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
        if self._tokens[0].text in self._language.data.asks_on and _asks_and_acts(clauses):
            return self._refuse([self._plain.strip()], (), asking=asking)
        if (denied := _denied_beside_question(clauses)) is not None:
            return self._refuse([self._written(denied.start, denied.end)], (), asking=asking)
        if not (found := orders(clauses, self._lattice)):
            return self._refuse([self._plain.strip()], ())
        clauses, *otherwise = found
        if (unsure := next((clause for clause in clauses if clause.instead), None)) is not None:
            return self._together_or_apart(clauses, unsure, asking=asking)
        if (both := contradiction(clauses, self._lattice)) is not None:
            return self._answer_contradiction(both, asking=asking)
        if otherwise:
            return self._which_order((clauses, *otherwise), asking=asking)
        clauses = without_distance_again(clauses, self._lattice, self._tokens)
        values, spans, supposes = once(clauses, self._tokens)
        if not values:
            return self._refusal("negation", self._messages["negation"])
        if self._drives_a_thing(values):
            return self._refuse([self._plain.strip()], (), asking=asking)
        try:
            actions = load(values)
        except ValidationError:
            return self._impossible(clauses)
        if (beside := beside_what_is_named(self._lattice, values)) is not None:
            phrase = self._written(beside.start, beside.end)
            message = self._messages["together_or_apart"].format(phrase=phrase)
            return self._refusal("not_understood", message, (phrase,))
        if self._topic.removed and clauses[0].leans:
            return self._more_of_what(actions) if asking else self._refuse([self._plain], ())
        if (asked := asked_of_it(self._lattice, clauses)) is not None:
            meant = self._put_in_place(*asked)
            if meant is not None and self._explains(meant):
                return meant
        if (readings := place_for_all(clauses)) is not None:
            return self._which_place(readings, asking=asking)
        return Understood(
            self._text, actions, (*self._corrections, *self._stand_ins(actions)), supposes, spans
        )

    def _stand_ins(self, actions: Sequence[Action]) -> Iterator[Correction]:
        """Words for things there are none of, where others are put on the road in their place."""
        put = (each.kind == "vehicle" for each in actions if isinstance(each, Add | SetCount))
        if not (any(put) or any(isinstance(each, Scenario) and each.vehicles for each in actions)):
            return
        known = self._language.data.stand_ins
        for token in self._tokens:
            if token.text in known:
                yield Correction(self._plain[token.start : token.end], known[token.text])

    def _drives_a_thing(self, values: Sequence[dict[str, Any]]) -> bool:
        """Whether the vehicle would turn although something unknown was to be moved: "move it left"."""
        return any(value["do"] == "drive" for value in values) and any(
            edge.concept == SHIFT and edge.end == unclear.start
            for unclear in self._unclear
            for edge in self._lattice.between(max(0, unclear.start - 2), unclear.start)
        )

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
        said = [edge.sense.value for edge in self._lattice.between(part.start, part.end)]
        if impossible := [each for each in said if is_impossible(each)]:
            return self._impossible_number(failed, impossible)
        return self._refuse([failed], understood, asking=asking, failed=part)

    def _said_again(self, divided: Divided) -> Parse | None:
        """The sentence with what "it" stands for in its place, where that was named just before."""
        found = named_before(self._lattice, divided)
        if found is None:
            return None
        return self._put_in_place(*found)

    def _explains(self, meant: Understood) -> bool:
        """Whether a question is about a setting or a word: what "it" stood for was meant."""
        return any(isinstance(each, Ask) and each.about in ("term", "setting") for each in meant.actions)

    def _put_in_place(self, word: Edge, named: Edge) -> Understood | None:
        """The sentence with what a word stands for in its place."""
        start, end = self._tokens[word.start].start, self._tokens[word.end - 1].end
        whole = self._plain[:start] + self._written(named.start, named.end) + self._plain[end:]
        parsed = self._language.read(whole, self._topic, self._work, asking=False)
        if not isinstance(parsed, Understood):
            return None
        return Understood(self._text, parsed.actions, self._corrections, parsed.supposes)


def _asks_and_acts(clauses: Sequence[Clause]) -> bool:
    """Whether a question is followed by a request after "and" alone, which may be a part of it."""
    return any(
        bool(before.actions)
        and all(action["do"] == "ask" for action in before.actions)
        and clause.after == AND
        and any(action["do"] == "drive" for action in clause.actions)
        for before, clause in pairwise(clauses)
    )


def _denied_beside_question(clauses: Sequence[Clause]) -> Clause | None:
    """What is denied beside something else and cannot be left out.

    That is what belongs to the question before it ("and not left"), and a question that is itself denied
    ("and what if you had not braked?"): of a request, what is denied just is not done.
    """
    for before, clause in pairwise(clauses):
        said = [action for action in clause.filled.frame.actions if isinstance(action, Mapping)]
        if clause.negated and not clause.actions and asks(said):
            return clause
        asked = before.actions and all(action["do"] == "ask" for action in before.actions)
        if asked and clause.negated and clause.after != STOP:
            return clause
    return None
