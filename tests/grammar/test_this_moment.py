"""Words for the moment that is looked at: they say nothing more in a question, and none in an order."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.grammar.parse_types import Refused, Understood
from service.grammar.topic import Topic
from service.interpreter.interpreter import _parse as parse
from service.interpreter.languages import Languages
from sim.types import Move

LANGUAGES = Languages.load()


@pytest.mark.parametrize(
    ("code", "text", "meant"),
    [
        ("en", "why didn't you go right here?", Ask(about="why_not", move=Move.RIGHT)),
        ("en", "why did you stop at this point?", Ask(about="why", move=Move.STAY)),
        ("en", "what would you do here?", Ask(about="next")),
        ("en", "what if you had gone left here?", Ask(about="what_if", move=Move.LEFT)),
        ("en", "what were the options at this tick?", Ask(about="history", what="choices")),
        ("de", "warum bist du hier nicht nach rechts gefahren?", Ask(about="why_not", move=Move.RIGHT)),
        ("de", "erkläre diesen Moment", Ask(about="why")),
        ("de", "wie riskant ist es in diesem Moment?", Ask(about="outlook", what="risk")),
    ],
)
def test_a_question_of_this_moment_is_the_question_without_the_words(
    code: str, text: str, meant: Ask
) -> None:
    parsed = parse(LANGUAGES[code], text, Topic(looks_back=True))
    assert isinstance(parsed, Understood)
    assert parsed.actions == (meant,)


@pytest.mark.parametrize("text", ["put a car here", "go left here", "is there a car here in lane here?"])
def test_here_is_no_word_of_an_order_nor_of_a_question_of_things(text: str) -> None:
    assert isinstance(parse(LANGUAGES["en"], text, Topic(looks_back=True)), Refused)


def test_this_moment_is_not_the_one_spoken_of_where_another_is_looked_at() -> None:
    text = "warum bist du in diesem Moment nicht nach rechts gefahren?"
    spoken = parse(LANGUAGES["de"], text, Topic(tick=7))
    viewed = parse(LANGUAGES["de"], text, Topic(tick=7, looks_back=True))
    assert isinstance(spoken, Understood)
    assert isinstance(viewed, Understood)
    assert spoken.actions == (Ask(about="why_not", move=Move.RIGHT, tick=7),)
    assert viewed.actions == (Ask(about="why_not", move=Move.RIGHT),)
