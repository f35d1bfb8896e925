"""Asks about requests that lack something: "add three" (of what?), "turn" (left or right?), "in lane 4".

How a request may be completed is data (`incomplete` of `answers.yaml`): a request is incomplete where it is
understood once something is added to it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from service.actions import Action
from service.grammar.answer_words import INSTEAD, TOO
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.sentences import Unsayable
from service.grammar.tokens import normalise, tokenise
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Add, Drive, MoveThings, Where

MAX_MOVED = 5
"""So many things are asked about at most, whether they are to be moved."""

MAX_WORDS = 6
"""Longer sentences lack more than one thing."""


def ask_what_is_missing(language: Language, text: str, topic: Topic) -> Ambiguous | None:
    """The question about what a sentence lacks, with ways to complete it; None where nothing."""
    said = normalise(text).strip().rstrip(".?! ")
    if not said or len(tokenise(said, language.data.contractions)) > MAX_WORDS:
        return None
    named = language.concepts(said)
    concepts = named | {concept.partition("=")[0] for concept in named}
    work, spoken_of = WorkBudget(), replace(topic, actions=(), kind=None, removed=False)
    for lacking in language.data.answers.incomplete:
        part = _without(said, lacking.get("after"))
        if part is None or not _names(concepts, lacking):
            continue
        try:
            parsed = [
                language.read(each.format(said=part), spoken_of, work, asking=False)
                for each in lacking["with"]
            ]
        except BudgetExceededError:
            return None
        meant = [each.actions for each in parsed if isinstance(each, Understood)]
        if (question := _question(language, text, lacking["ask"], _fitting(meant, lacking))) is not None:
            return question
    return None


def _without(said: str, words: list[str] | None) -> str | None:
    """What is said after one of some words; all of it where none are asked for; None where it has none."""
    if words is None:
        return said
    return next((said[len(word) + 1 :] for word in words if said.startswith(f"{word} ")), None)


def _names(concepts: frozenset[str], lacking: Mapping[str, Any]) -> bool:
    """Whether a sentence has words of each group of concepts that are needed, and of no other."""
    needed = all(not concepts.isdisjoint(group.split("|")) for group in lacking.get("needs", ()))
    return needed and concepts.isdisjoint(lacking.get("lacks", ()))


def _fitting(meant: list[tuple[Action, ...]], lacking: Mapping[str, Any]) -> list[tuple[Action, ...]]:
    """Those completions that set a setting that is named (`of`), or all."""
    settings = lacking.get("of")
    if settings is None:
        return meant
    return [each for each in meant if all(getattr(one, "parameter", None) in settings for one in each)]


def ask_elsewhere(language: Language, text: str, topic: Topic, parsed: Understood | Refused) -> Parse | None:
    """The question what shall be at a place that is said alone after something was added: "in lane 4".

    What was added may move there, or another one be added; the vehicle is not to turn that way for it.
    """
    if len(topic.actions) != 1 or not 0 < len(topic.things) <= MAX_MOVED or topic.undone:
        return None
    (done,) = topic.actions
    drives = isinstance(parsed, Understood) and all(isinstance(each, Drive) for each in parsed.actions)
    if not isinstance(done, Add) or not (drives or isinstance(parsed, Refused)):
        return None
    tokens = tokenise(normalise(text), language.data.contractions)
    if language.data.answers.ending(tokens, INSTEAD) or language.data.answers.ending(tokens, TOO):
        return None
    where = _place(language, text, done)
    if where is None:
        return None
    moved = tuple(
        MoveThings(kind=done.kind, count=1, where=Where(id=thing), to=where) for thing in topic.things
    )
    if len(moved) > 1:
        anew = replace(done, where=where)
        return _question(language, text, language.data.messages["which"], [moved, (anew,)])
    another = Add(kind=done.kind, count=done.count, where=where)
    own = [parsed.actions] if isinstance(parsed, Understood) else []
    return _question(language, text, language.data.messages["which"], [moved, (another,), *own])


def _place(language: Language, text: str, done: Add) -> Where | None:
    """The place that all of a sentence says; None where it says anything else."""
    said = normalise(text).strip().rstrip(".?! ")
    tokens = tokenise(said, language.data.contractions)
    if not tokens or len(tokens) > MAX_WORDS or tokens[0].text not in language.data.answers.places:
        return None
    try:
        base = language.sentence((Add(kind=done.kind, count=1),))
        read = language.read(f"{base} {said}", ALONE, WorkBudget(), asking=False)
    except (Unsayable, BudgetExceededError):
        return None
    if not isinstance(read, Understood) or len(read.actions) != 1:
        return None
    (action,) = read.actions
    if not isinstance(action, Add) or (action.kind, action.count) != (done.kind, 1):
        return None
    return action.where


def _question(
    language: Language, text: str, question: str, meant: Iterable[tuple[Action, ...]]
) -> Ambiguous | None:
    """A question with several choices, each said in full; None where fewer than two can be said."""
    choices: list[Choice] = []
    for actions in dict.fromkeys(meant):
        try:
            choices.append(Choice(language.sentence(actions), actions))
        except Unsayable:
            continue
    return Ambiguous(text, question, tuple(choices)) if len(choices) > 1 else None
