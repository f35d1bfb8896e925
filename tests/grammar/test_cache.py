"""Sentences that were read are known again where they mean the same, and only there."""

from __future__ import annotations

from dataclasses import replace

import pytest

from service.actions import load
from service.grammar import Language, Understood
from service.grammar.cache import LONGEST, MOST, ParseCache
from service.grammar.evaluation import read_labelled
from service.grammar.parse_types import Parse, Refused
from service.grammar.topic import ALONE, Phrases, Topic
from service.grammar.work_budget import WorkBudget
from sim.actions import Where
from tests.grammar.beside import HERE

PAUSE = load([{"do": "pause"}])
TALKED = Topic(
    things=("pothole-1", "vehicle-3"),
    added=("vehicle-3", "pothole-1"),
    actions=load([{"do": "add", "kind": "pothole", "count": 2}]),
    kind="pothole",
    where=Where(lane="left"),
    names=frozenset({"monday"}),
)
TOPICS = (
    ALONE,
    TALKED,
    replace(TALKED, things=("vehicle-3",), added=("vehicle-3",), kind="vehicle", undone=True),
    replace(TALKED, actions=PAUSE, where=Where(lane="right"), names=frozenset(), removed=True),
)


class Reader:
    """Looks at what a sentence names of its topic, and counts."""

    def __init__(self) -> None:
        self.read = 0

    def __call__(self, text: str, topic: Topic, work: WorkBudget) -> Parse:
        self.read += 1
        work.spend(1)
        if text == "nonsense":
            return Refused(text, "not_understood", "no")
        for name in text.split():
            getattr(topic, name, None)
        return Understood(text, PAUSE)


@pytest.mark.parametrize(
    ("text", "topic", "reads"),
    [
        ("kind", ALONE, 1),
        ("kind", replace(ALONE, things=("pothole-1",)), 1),
        ("kind", replace(ALONE, kind="pothole"), 2),
        ("kind removed", replace(ALONE, removed=True), 2),
        ("things", replace(ALONE, things=("pothole-1",)), 2),
        ("phrases", replace(ALONE, phrases=Phrases()), 1),
        ("phrases", replace(ALONE, phrases=Phrases({"rush": [(("rush",), [{"do": "pause"}])]})), 2),
        ("actions", ALONE, 2),
        ("where", ALONE, 2),
        ("nonsense", ALONE, 2),
        ("kind " * LONGEST, ALONE, 2),
    ],
)
def test_it_is_read_anew_where_what_was_looked_at_is_another(text: str, topic: Topic, reads: int) -> None:
    reader = Reader()
    remembered = ParseCache(reader)
    assert remembered.parse(text, ALONE, WorkBudget()) == remembered.parse(text, topic, WorkBudget())
    assert reader.read == reads


def test_the_longest_unsaid_are_forgotten() -> None:
    reader = Reader()
    remembered = ParseCache(reader)
    for number in range(MOST + 1):
        remembered.parse(f"kind {number}", ALONE, WorkBudget())
    remembered.parse(f"kind {MOST}", ALONE, WorkBudget())
    assert reader.read == MOST + 1
    remembered.parse("kind 0", ALONE, WorkBudget())
    assert reader.read == MOST + 2


def test_whatever_was_said_before_a_sentence_means_what_it_means(language: Language) -> None:
    said = [row.text for row in read_labelled(HERE / "dev.jsonl")]
    said += ["remove it", "again", "two more", "add a car there", "go back to monday", "remove the last car"]
    for text in said:
        for topic in (*TOPICS, *TOPICS):
            parsed, fresh = language.parse(text, topic), language.read(text, topic, WorkBudget(), asking=True)
            if isinstance(fresh, Refused) and isinstance(parsed, Refused):
                assert parsed.reason == fresh.reason  # the message may tell more
            else:
                assert parsed == fresh
