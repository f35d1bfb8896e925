"""Reads questions of the moment that is looked at: "why didn't you go right here?", "what do you see now?".

The words for it say nothing that a question does not mean without them. Where things are named they may be a
place as well ("is there a car here?"), and are not passed over.
"""

from __future__ import annotations

from dataclasses import replace

from service.actions import Ask
from service.grammar.answer_words import THIS_MOMENT
from service.grammar.engine import Language
from service.grammar.parse_types import Understood
from service.grammar.references import parse_in_topic
from service.grammar.tokens import normalise, tokenise
from service.grammar.topic import Topic


def read_of_this_moment(language: Language, text: str, topic: Topic) -> Understood | None:
    """The question without its words for this moment; None where there are none, or nothing is asked then."""
    plain = normalise(text)
    tokens = tokenise(plain, language.data.contractions)
    for start in range(len(tokens)):
        end, _ = language.data.answers.longest(tokens, start, THIS_MOMENT)
        if end == start or end - start == len(tokens):
            continue
        rest = plain[: tokens[start].start] + plain[tokens[end - 1].end :]
        parsed = parse_in_topic(language.parse, " ".join(rest.split()), topic)
        if isinstance(parsed, Understood) and all(_is_of_moment(action) for action in parsed.actions):
            return replace(parsed, text=text)
    return None


def _is_of_moment(action: object) -> bool:
    """Whether it is a question that names no things, which could be asked of a place."""
    return isinstance(action, Ask) and action.kind is None and action.which is None and action.change is None
