"""Tests for `service.interpreter.sentence_cache`: what is kept holds only where nothing tells it apart."""

from __future__ import annotations

from dataclasses import replace

from service.grammar.parse_types import Parse, Refused, Understood
from service.grammar.topic import Phrases, Topic
from service.interpreter.sentence_cache import LONGEST, SentenceCache
from sim.actions import Pause, Set

LANGUAGE = object()


class Reader:
    """Reads the actions of a topic, and counts how often it was asked."""

    def __init__(self, *names: str) -> None:
        self._names = names
        self.asked = 0

    def __call__(self, topic: Topic) -> Parse:
        self.asked += 1
        for name in self._names:
            getattr(topic, name)
        return Understood("again", topic.actions)


def test_a_sentence_is_read_once_while_what_it_looks_at_is_the_same() -> None:
    cache, read = SentenceCache(), Reader("columns")
    topic = Topic(actions=(Pause(),), columns=5, others=1)
    first = cache.parse(LANGUAGE, "again", topic, read)
    assert cache.parse(LANGUAGE, "again", replace(topic, others=7), read) is first
    assert read.asked == 1
    cache.parse(LANGUAGE, "again", replace(topic, columns=6), read)
    assert read.asked == 2


def test_numbers_that_are_equal_and_written_otherwise_are_told_apart() -> None:
    cache, read = SentenceCache(), Reader()
    cache.parse(LANGUAGE, "again", Topic(actions=(Set(parameter="columns", value=2),)), read)
    found = cache.parse(LANGUAGE, "again", Topic(actions=(Set(parameter="columns", value=2.0),)), read)
    assert isinstance(found, Understood)
    (action,) = found.actions
    assert isinstance(action, Set)
    assert repr(action.value) == "2.0"


def test_what_is_read_of_a_topic_made_of_another_counts_as_well() -> None:
    cache, asked = SentenceCache(), []

    def read(topic: Topic) -> Parse:
        asked.append(replace(topic, said="").things)
        return Understood("it", ())

    cache.parse(LANGUAGE, "it", Topic(things=("pothole-1",)), read)
    cache.parse(LANGUAGE, "it", Topic(things=("pothole-2",)), read)
    assert asked == [("pothole-1",), ("pothole-2",)]


def test_phrases_that_somebody_taught_since_are_seen() -> None:
    cache, read = SentenceCache(), Reader("phrases")
    cache.parse(LANGUAGE, "again", Topic(phrases=Phrases()), read)
    cache.parse(LANGUAGE, "again", Topic(phrases=Phrases()), read)
    assert read.asked == 1
    cache.parse(LANGUAGE, "again", Topic(phrases=Phrases({"again": [(("again",), [])]})), read)
    assert read.asked == 2


def test_refusals_other_languages_and_long_texts_are_read_each_time() -> None:
    cache, read, asked = SentenceCache(), Reader(), []

    def refuse(topic: Topic) -> Parse:
        asked.append(topic)
        return Refused("rubbish", "not_understood", "No.")

    for _ in range(2):
        cache.parse(LANGUAGE, "rubbish", Topic(), refuse)
        cache.parse(LANGUAGE, "a" * (LONGEST + 1), Topic(), read)
    assert len(asked) == read.asked == 2
    cache.parse(LANGUAGE, "again", Topic(), read)
    cache.parse(object(), "again", Topic(), read)
    assert read.asked == 4
