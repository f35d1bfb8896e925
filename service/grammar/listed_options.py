"""Reads which of the settings or styles that an answer listed is chosen: "use the second one"."""

from __future__ import annotations

from collections.abc import Sequence

from service.grammar.answer_words import BEFORE, CHOOSES, CORRECTS, LAST
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Choice, Parse, Understood
from service.grammar.said_before import done_anew
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from sim.actions import Set


def choose_listed(language: Language, text: str, topic: Topic) -> Parse | None:
    """The choice of one of them; one that is only named is asked about. None where none is chosen."""
    if not topic.offered:
        return None
    answers, numbers = language.data.answers, language.data.numbers
    tokens = tokenise(normalise(text), language.data.contractions)
    while tokens and not any(char.isalnum() for char in tokens[-1].text):
        tokens = tokens[:-1]
    corrects = answers.beginning(tokens, CORRECTS)
    start = corrects + answers.beginning(tokens[corrects:], CHOOSES)
    rest = tokens[start:]
    found = {at: number for at in range(len(rest)) if (number := numbers.read(rest, at))}
    ordinals = {at: nth for at, token in enumerate(rest) if (nth := numbers.ordinal(token))}
    place = answers.whole(rest, found, ordinals)
    if place == LAST:
        place = len(topic.offered)
    if place is None:
        place = _named(language, text, rest, topic)
    if not isinstance(place, int) or not 1 <= place <= len(topic.offered):
        return None
    actions = (topic.offered[place - 1],)
    if corrects and topic.steps and topic.actions and not topic.undone:
        return Understood(text, done_anew(topic, actions))
    if start or not text.rstrip().endswith("?"):
        return Understood(text, actions)
    try:
        return Ambiguous(text, answers.shall, (Choice(language.sentence(actions), actions),))
    except Unsayable:
        return None


def _named(language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> int | None:
    """The place of the value that some words name: "light"."""
    before = language.data.answers.beginning(tokens, BEFORE)
    rest = tokens[before:] or tokens
    if not rest:
        return None
    said = normalise(text)[rest[0].start : rest[-1].end]
    for place, action in enumerate(topic.offered, start=1):
        if isinstance(action, Set) and isinstance(action.value, str):
            try:
                if said == normalise(language.sentences.value(action.parameter, action.value)):
                    return place
            except Unsayable:
                continue
    return None
