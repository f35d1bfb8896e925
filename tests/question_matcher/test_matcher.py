"""Questions in free words: what is matched is a question, and nothing that was asked for is left out."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from service.actions import Ask
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.question_matcher.kind_scores import KindScores
from service.question_matcher.kinds import NONE_OF_THEM, Canonical, QuestionKind, read_kinds
from service.question_matcher.matcher import QuestionMatcher
from service.question_matcher.situations import Now
from service.question_matcher.slots import SlotWords
from service.question_matcher.weights import FILE, Weights
from service.resources import prompts_folder
from service.yaml_files import read_yaml
from tools.question_examples import sources_of

FOLDER = prompts_folder() / "questions" / "en"
LANGUAGES = ("en", "de")
SLOTS = {
    "tick": "7",
    "until": "9",
    "ticks": "2",
    "n": "5",
    "planner": "Dijkstra",
    "planner_too": "A*",
    "sensor": "Lidar",
    "term": "regret",
    "lane": "3",
}
THINGS = {
    "en": {
        "weather": "foggy",
        "weather_noun": "fog",
        "bad_weather": "foggy",
        "thing": "the car on the left",
        "things": "cars",
        "nearest": "the nearest car",
        "a_thing": "a car",
        "side": "on the left",
    },
    "de": {
        "weather": "Nebel",
        "weather_noun": "Nebel",
        "bad_weather": "Nebel",
        "thing": "das Auto links",
        "things": "Autos",
        "nearest": "das nächste Auto",
        "a_thing": "ein Auto",
        "side": "links",
    },
}


DRIVING, CRASHED = Now(frozenset(("running",))), Now(frozenset(("crash",)))


def folder_of(code: str) -> Path:
    return prompts_folder() / "questions" / code


@pytest.fixture(scope="module")
def language() -> Language:
    return Language.load("en")


@pytest.fixture(scope="module")
def matcher(language: Language) -> QuestionMatcher:
    return QuestionMatcher(language, FOLDER)


@pytest.mark.parametrize("move", ["left", "forward_right", "stay"])
@pytest.mark.parametrize("code", LANGUAGES)
def test_canonical_sentences_are_questions(code, move):
    language, folder = Language.load(code), folder_of(code)
    moves = read_yaml(folder / "words.yaml")["moves"]
    slots = {**SLOTS, **THINGS[code], **moves[move], "instead": moves["right"]["going"]}
    said = 0
    for kind in read_kinds(folder).values():
        for canonical in (*kind.says, *(each for each, _ in kind.with_words)):
            if canonical.slots <= slots.keys():
                sentence = canonical.text.format_map(slots)
                parse = language.parse(sentence)
                assert isinstance(parse, Understood), sentence
                assert all(isinstance(action, Ask) for action in parse.actions), sentence
                said += 1
    assert said > 60


def test_weights_are_of_the_present_examples():
    folder = folder_of("de")
    assert Weights.read(folder / FILE).sources == sources_of(folder), "run tools.train_question_matcher"


def test_weights_survive_a_file(tmp_path: Path):
    weights = Weights.read(folder_of("de") / FILE)
    weights.write(tmp_path / FILE)
    again = Weights.read(tmp_path / FILE)
    words = ("warum", "hast", "du", "angehalten")
    assert np.array_equal(again.scores(words), weights.scores(words))
    assert again.rows == weights.rows
    assert again.words == weights.words


@pytest.mark.parametrize("code", LANGUAGES)
def test_examples_are_of_known_kinds_and_of_one_each(code):
    examples = read_yaml(folder_of(code) / "examples.yaml")
    assert examples.keys() == read_kinds(folder_of(code)).keys()
    said = Counter(re.sub(r"\W+", " ", text.lower()).strip() for texts in examples.values() for text in texts)
    doubled = [text for text, count in said.items() if count > 1]
    assert not doubled


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("on what grounds did you veer off to the left?", "why did you go left?"),
        ("why on earth would you not simply go right?", "why didn't you go right?"),
        ("when do you reckon we get to the finish", "when will we arrive?"),
        ("would dijkstra have picked the same move in this spot?", "what would dijkstra do here?"),
        (
            "suppose that pothole had not been in the road, would you drive differently?",
            "what if that pothole weren't there?",
        ),
        ("what went on from tick 3 to tick 9?", "what happened between 3 and 9?"),
    ],
)
def test_paraphrases(text, sentence, matcher):
    match = matcher.match(text, DRIVING)
    assert match is not None
    assert sentence in match.sentences


@pytest.mark.parametrize(
    "text",
    [
        "stop the simulation, and why on earth did you veer off to the left?",
        "whyever did you veer off like that, and then add five potholes",
        "add three cars. what made you veer off?",
    ],
)
def test_a_request_beside_a_question_is_not_left_out(text, matcher):
    assert matcher.match(text, DRIVING) is None


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("Aus welchem Grund bist du denn gerade nach links ausgewichen?", "warum bist du links gefahren?"),
        ("wann sind wir denn endlich am Ziel, ungefähr", "wann kommen wir an?"),
        ("Wer trägt eigentlich die Schuld an dem Unfall?", "wer war schuld?"),
    ],
)
def test_german_paraphrases(text, sentence):
    match = QuestionMatcher(Language.load("de"), folder_of("de")).match(text, CRASHED)
    assert match is not None
    assert sentence in match.sentences


@pytest.mark.parametrize(
    "text",
    [
        "who will win the next federal election?",
        "what is the capital of Peru?",
        "how do I cook rice without a lid?",
        "can you write me a launch email for our marketing list?",
        "start over before that",
        "the first one",
        "and Dijkstra?",
        "what about the car on the left",
        "and what is behind it?",
        "what would have come of it had you not gone left?",
        "",
        "?!",
        "why " * 200,
    ],
)
def test_other_questions_are_not_matched(text, matcher):
    assert matcher.match(text, DRIVING) is None


def test_a_slot_is_not_left_out(matcher):
    match = matcher.match("for what reason did you veer left at tick 7 of all moments?", DRIVING)
    assert match is not None
    assert all("7" in sentence for sentence in match.sentences)


def test_the_second_of_two_moves_is_not_taken_for_the_only_one(matcher):
    match = matcher.match("what if it goes right now and then forward?", DRIVING)
    assert match is None or not any("forward" in sentence for sentence in match.sentences)


def test_what_is_turned_round_is_not_answered_the_other_way(matcher):
    match = matcher.match("what if there was no snow on the road at all?", DRIVING)
    assert match is None or not any("were snowy" in sentence for sentence in match.sentences)


def test_what_is_asked_of_a_crash_is_only_offered_where_there_was_none(matcher):
    text, of_a_crash = "could that have been prevented somehow?", "could you have avoided it?"
    crashed = matcher.match(text, CRASHED)
    driving = matcher.match(text, DRIVING)
    assert crashed is not None
    assert driving is not None
    assert crashed.sentences[0] == of_a_crash
    assert crashed.sure
    assert not driving.sure


def test_words_that_no_answer_is_for_are_unknown():
    scores = KindScores.read(FOLDER)
    examples = read_yaml(FOLDER / "examples.yaml")
    words = SlotWords(Language.load("en"), FOLDER)
    answered = {
        word
        for kind, texts in examples.items()
        if kind != NONE_OF_THEM
        for text in texts[:3]
        for word in words.question(text).words
    }
    assert answered <= scores.words


def test_a_move_before_straight_on_is_one_of_two(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    two = words.question("At tick 10 I went left, what would have happened if I had gone straight?")
    assert (two.slots["gone"], two.slots["instead"]) == ("gone left", "going forward")
    assert {"move", "instead"} <= two.binding
    one = words.question("what would have happened if I had gone left at tick 10?")
    assert "instead" not in one.binding


@pytest.mark.parametrize(
    "text", ["where did the car halt last", "is our car stuck for good", "why did my vehicle stop there"]
)
def test_the_car_is_the_vehicle_itself(text: str, language: Language) -> None:
    assert "thing" not in SlotWords(language, FOLDER).question(text).binding


@pytest.mark.parametrize(
    "text", ["why did the car we hit stop", "why did the car ahead stop", "why did that car stop"]
)
def test_a_car_of_which_more_is_said_is_another(text: str, language: Language) -> None:
    assert "thing" in SlotWords(language, FOLDER).question(text).binding


def test_the_vehicle_lends_no_words_to_what_else_is_named(language: Language) -> None:
    question = SlotWords(language, FOLDER).question("did the car see the pedestrian at all?")
    assert question.slots["thing"] == "that pedestrian"
    assert question.slots["things"] == "pedestrians"


def test_where_a_car_comes_from_is_no_move(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    question = words.question("if I had gone forward at tick 11, would the car from the left have hit me?")
    assert question.slots["gone"] == "gone forward"
    assert "move" not in question.binding
    assert words.question("could you have gone left instead?").slots["gone"] == "gone left"


def test_a_car_so_many_lanes_away_is_not_the_nearest(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    over = words.question("is the car two lanes over going to come across?")
    assert "elsewhere" in over.binding
    assert "thing" not in over.slots
    in_front = words.question("which direction is the car just in front of you moving in?")
    assert in_front.slots["thing"] == "the car in front"


def test_what_a_sentence_names_itself_is_not_left_out(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    kind = QuestionKind("night", (Canonical.of("does darkness affect the lidar?"),)).naming(words.question)
    assert kind.sentence(words.question("can the lidar see in the dark at all?")) is not None
    assert kind.sentence(words.question("can the radar see in the dark at all?")) is None


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("have you had any false alarms in this drive, ghosts and so on?", "were there any false alarms?"),
        ("has your sensor got anything wrong on the way?", "has the sensor got anything wrong?"),
    ],
)
def test_some_words_choose_the_sentence_of_a_kind(text: str, sentence: str, language: Language) -> None:
    kind = read_kinds(FOLDER)["sensor_errors"]
    assert kind.sentence(SlotWords(language, FOLDER).question(text)) == sentence


def test_a_sentence_that_words_choose_leaves_no_slot_out(language: Language) -> None:
    kind = read_kinds(FOLDER)["sensor_errors"]
    question = SlotWords(language, FOLDER).question("were there any false alarms, ghosts, at tick 7?")
    assert "tick" in question.binding
    assert kind.sentence(question) is None


def test_what_hampers_is_told_from_what_does_not(language: Language) -> None:
    words, kind = SlotWords(language, FOLDER), read_kinds(FOLDER)["what_if_cleared"]
    assert kind.sentence(words.question("would it have gone better without the fog?")) is not None
    dry = kind.sentence(words.question("if it had been clear, would we still have crashed?"))
    assert dry == "what if it were clear?"


def test_where_a_word_turns_the_likeliest_kind_round_others_are_offered(matcher: QuestionMatcher) -> None:
    match = matcher.match("what do the different shades of grey on the occupancy grid stand for", DRIVING)
    assert match is not None
    assert not match.sure
    assert "what does grey mean?" in match.sentences
    assert "what do the colours mean?" not in match.sentences


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("which of the 29 decisions was the riskiest of them?", "what was the riskiest moment?"),
        (
            "has the camera reported anything wrong up to tick 29 at all?",
            "has the sensor got anything wrong?",
        ),
        ("what alternatives did the A* planner reject in all that rain?", "what were your options?"),
    ],
)
def test_what_is_so_anyway_is_left_out(text: str, sentence: str, language: Language) -> None:
    kind = next(
        kind for kind in read_kinds(FOLDER).values() if any(each.text == sentence for each in kind.says)
    )
    question = SlotWords(language, FOLDER).question(text)
    facts = {("planner", "astar"), ("sensor", "camera"), ("weather", "rain"), ("tick", "29"), ("n", "the 29")}
    assert kind.sentence(question) is None
    assert kind.sentence(question.asked(facts)) == sentence
    for each in facts:
        others = facts - {each}
        missing = each[0] in question.binding - kind.ignores
        assert (kind.sentence(question.asked(others)) is None) == missing


def test_a_number_by_itself_is_not_all_there_is(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    assert "n" in words.question("what if we waited 9 ticks longer?").asked({("n", "the 9")}).binding
    assert not words.question("what if we waited 9 ticks longer?").asked({("n", "the 9")}).restated
    assert words.question("how many of the 9 moves were bad ones?").asked({("n", "the 9")}).restated == {"n"}


def test_two_sensors_are_not_both_the_one_there_is(language: Language) -> None:
    question = SlotWords(language, FOLDER).question("is the camera worse than the lidar at seeing that?")
    assert "sensor" not in question.asked({("sensor", "camera")}).restated


@pytest.mark.parametrize(
    "text",
    [
        "what happened to it all between tick 7 and tick 10?",
        "would it have made it with the same road but at night?",
        "with a perfect sensor, is the matrix identical to the ground truth?",
    ],
)
def test_a_circumstance_beside_a_question_is_no_request(text: str, matcher: QuestionMatcher) -> None:
    assert matcher.match(text, DRIVING) is not None


@pytest.mark.parametrize(
    "text",
    [
        "whyever did you veer off like that? at night, please",
        "with five potholes, whyever did you veer off like that?",
        "why on earth did you veer off, and after that start over",
    ],
)
def test_a_request_is_no_circumstance(text: str, matcher: QuestionMatcher) -> None:
    assert matcher.match(text, DRIVING) is None


def test_a_clear_way_is_no_weather(language: Language) -> None:
    words = SlotWords(language, FOLDER)
    assert "weather" not in words.question("did I hesitate although the way ahead was clear?").slots
    assert words.question("would you have seen it in clear weather?").slots["weather"] == "clear"


def test_words_choose_a_sentence_with_slots(language: Language) -> None:
    words, kind = SlotWords(language, FOLDER), read_kinds(FOLDER)["other_why"]
    assert (
        kind.sentence(words.question("why has that car stopped for us, is it nice?"))
        == "why did that car stop?"
    )
    assert kind.sentence(words.question("why has that car gone off like this?")) == "why did that car turn?"
