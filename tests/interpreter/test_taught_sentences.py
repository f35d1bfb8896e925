"""What a taught phrase can never change: a sentence that means something without it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from service import actions as contract
from service.grammar.parse_types import Ambiguous, Parse, Refused, Understood
from service.grammar.references import parse_in_topic
from service.grammar.topic import ALONE, Topic
from tests.interpreter.conftest import english

TWO_CARS = [{"do": "add", "kind": "vehicle", "count": 2}]
PAUSE = [{"do": "pause"}]

FIXED = [
    *[say for frame in english().data.frames for say in frame.says][::2][:45],
    *("add five potholes and two cars", "remove it", "again", "two more", "slow down", "add potholes"),
    *("add five potholes and make me a sandwich", "don't add any cars", "could you please pause?", ""),
    *("save this as monday demo", "when I say tidy, I mean pause", "forget tidy", "make it dusk, then go"),
    "add five pothols",
]
TALKED = Topic(things=("barrier-1",), added=("barrier-1",), actions=contract.load(PAUSE), kind="pothole")


def told(parse: Parse) -> object:
    """What comes of a sentence."""
    match parse:
        case Understood():
            return parse.actions, parse.corrections
        case Ambiguous():
            return parse.question, parse.choices
        case Refused():
            return parse.reason, parse.message, parse.unparsed
    return None


BEFORE = {
    (text, topic is TALKED): told(english().parse(text, topic)) for text in FIXED for topic in (ALONE, TALKED)
}


def with_phrase(phrase: str, topic: Topic) -> Topic:
    phrases = english().phrases([contract.Teach(phrase=phrase, meaning=contract.load(TWO_CARS))])
    return replace(topic, phrases=phrases)


LETTERS = st.text("abcdefghijklmnopqrstuvwxyzäßé", min_size=2, max_size=9)


@example(words=["pothols"])
@example(words=["rush", "hour"])
@given(words=st.lists(LETTERS, min_size=1, max_size=4))
def test_a_phrase_of_new_words_changes_no_sentence(words: list[str]) -> None:
    assume(not any(english().data.knows(word) for word in words))
    for text in FIXED:
        for topic in (ALONE, TALKED):
            assert (
                told(parse_in_topic(english().parse, text, with_phrase(" ".join(words), topic)))
                == BEFORE[text, topic is TALKED]
            )


IN_USE = sorted({word for text in FIXED for word in english().words_of(text) if word.isalpha()})


@pytest.mark.parametrize("word", IN_USE)
def test_a_phrase_of_a_known_word_changes_no_sentence_that_means_something(word: str) -> None:
    """So "carry on" stays what it is when "carry" was taught."""
    for text in FIXED:
        if word not in english().words_of(text):
            continue
        before = english().parse(text)
        if isinstance(before, Refused):
            continue
        assert told(parse_in_topic(english().parse, text, with_phrase(word, ALONE))) == BEFORE[text, False]


def part(words: list[str]) -> tuple[contract.Action, ...] | None:
    """What words mean by themselves: nothing where they only make a sentence pleasant, None if unfit."""
    text = " ".join(word for word in words if word != "again")  # "splunge again" is splunge
    parse = english().parse(text)
    if isinstance(parse, Understood):
        return parse.actions
    return () if not english().concepts(text) else None


@given(text=st.sampled_from([text for text in FIXED if '"' not in text]), at=st.integers(0, 12))
def test_a_phrase_put_anywhere_is_done_whole_or_not_at_all(text: str, at: int) -> None:
    words = text.split()
    said = " ".join([*words[:at], "splunge", *words[at:]])
    parse = parse_in_topic(english().parse, said, with_phrase("splunge", ALONE))
    if not isinstance(parse, Understood) or any(
        isinstance(action, contract.Save | contract.Teach | contract.Forget) for action in parse.actions
    ):
        return  # refused, or a name that is kept as it was written
    before, after = part(words[:at]), part(words[at:])
    assert before is not None, said
    assert after is not None, said
    assert parse.actions == (*before, *contract.load(TWO_CARS), *after)
