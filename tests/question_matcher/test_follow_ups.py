"""Follow-ups of a few words: what was asked last decides, else it is asked back."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.question_matcher.follow_ups import FILE
from service.question_matcher.matcher import QuestionMatcher
from service.resources import prompts_folder
from service.yaml_files import read_yaml

LANGUAGES = ("en", "de")


def matcher_of(code: str) -> QuestionMatcher:
    return QuestionMatcher(Language.load(code), prompts_folder() / "questions" / code)


@pytest.fixture(scope="module")
def matcher() -> QuestionMatcher:
    return matcher_of("en")


@pytest.mark.parametrize("code", LANGUAGES)
def test_what_follow_ups_stand_for_are_questions(code):
    language = Language.load(code)
    folder = prompts_folder() / "questions" / code
    things = read_yaml(folder / "words.yaml")["things"]["vehicle"]
    asked = 0
    for entry in read_yaml(folder / FILE)["follow_ups"]:
        for sentence in [*entry["choices"], *(text for texts in entry["after"].values() for text in texts)]:
            parse = language.parse(sentence.format_map(things))
            assert isinstance(parse, Understood), sentence
            assert all(isinstance(action, Ask) for action in parse.actions), sentence
            asked += 1
    assert asked > 40


@pytest.mark.parametrize("code", LANGUAGES)
def test_the_words_of_follow_ups_are_said_once(code):
    entries = read_yaml(prompts_folder() / "questions" / code / FILE)["follow_ups"]
    said = [text for entry in entries for text in entry["said"]]
    assert len(said) == len(set(said))


@pytest.mark.parametrize(
    ("text", "asked", "sentence"),
    [
        ("How?", Ask(about="blame", what="avoidable"), "in more detail"),
        ("and since when?", Ask(about="outlook", what="stuck"), "how long have we been waiting?"),
        ("How far?", Ask(about="scene", kind="pedestrian", count=1), "where is the nearest pedestrian?"),
        ("how far", Ask(about="status"), "how far to the goal?"),
        ("is it moving?", Ask(about="scene", kind="vehicle"), "where is the nearest car going?"),
        ("so what about the others?", Ask(about="planners", what="here"), "compare the planners"),
        ("when was that?", Ask(about="history", what="closest_call"), "what was the closest call?"),
        ("why that one", Ask(about="planners", what="compare"), "why is that?"),
    ],
)
def test_the_last_question_decides(text, asked, sentence, matcher):
    match = matcher.follow_up(text, (asked,))
    assert match is not None
    assert match.sure
    assert match.sentences[0] == sentence


@pytest.mark.parametrize(
    "text", ["how?", "is it moving", "how far?", "isn't that a lot?", "what about the others"]
)
def test_without_a_question_before_it_is_asked_back(text, matcher):
    match = matcher.follow_up(text, ())
    assert match is not None
    assert not match.sure
    assert match.sentences


def test_a_thing_of_no_kind_leaves_no_place_empty(matcher):
    match = matcher.follow_up("how far?", (Ask(about="scene"),))
    assert match is not None
    assert match.sentences == ("what do you see?",)


@pytest.mark.parametrize("text", ["how far is the moon", "how do you decide?", "and", "", "how " * 40])
def test_other_words_are_no_follow_up(text, matcher):
    assert matcher.follow_up(text, (Ask(about="status"),)) is None


def test_german_follow_ups():
    match = matcher_of("de").follow_up("Und seit wann?", (Ask(about="why"),))
    assert match is not None
    assert match.sentences == ("wie lange warten wir schon?",)
