"""German, a language that is data alone: its sentences, what is refused, and nothing of English in it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.actions import dump
from service.grammar import Ambiguous, Language, Refused, Understood
from service.grammar.corpus import sentences
from service.grammar.evaluation import evaluate, render, same
from service.grammar.numbers import NumberWords
from service.grammar.tokens import Contractions, normalise, tokenise
from service.grammar.topic import Topic
from service.resources import prompts_folder
from service.yaml_files import read_yaml
from tests.grammar.beside import HERE, meaning
from tests.support.random_actions import failures

FOLDER = prompts_folder() / "language" / "de"
NUMBERS = NumberWords.from_data(read_yaml(FOLDER / "numbers.yaml"))
UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"})

SAME_IN_BOTH = {
    "stop", "halt", "pause", "reset", "undo", "redo", "start", "status", "autopilot",
    "okay", "ok", "okay, stop", "sorry", "hi", "hey, roadtalk",
    "planner: a*", "sensor: lidar", "seed 42", "seed = 42", "tempo 50 km/h",
    "hallo",
}  # fmt: skip
"""Words that both languages have, with the same meaning, or that are a typo of the other's."""


@pytest.fixture(scope="module")
def german() -> Language:
    return Language.load("de")


def beside(key: str, folder: Any = FOLDER) -> list[Any]:
    """All entries under a key, of all test files of the language."""
    return [entry for path in sorted(folder.rglob("*.test.yaml")) for entry in read_yaml(path).get(key, [])]


def sayings() -> Iterator[str]:
    for entry in beside("means"):
        yield from entry["say"]


def test_the_data_have_no_defects(german: Language) -> None:
    assert german.check() == []


@pytest.mark.parametrize(("file", "least_exact"), [("fresh.jsonl", 0.95), ("fresh_j.jsonl", 0.96)])
def test_fresh_sentences_are_never_misread(german: Language, file: str, least_exact: float) -> None:
    report = evaluate(german, HERE / "de" / file)
    assert report.total("wrong") == 0, render(report)
    assert report.total("exact") >= least_exact * report.total(), render(report)


def test_every_intent_has_its_sentences() -> None:
    files = {path.name for path in (FOLDER / "intents").glob("*.yaml")}
    plain = {name for name in files if not name.endswith(".test.yaml")}
    assert plain
    assert {name.replace(".yaml", ".test.yaml") for name in plain} <= files


def test_every_sentence_means_what_is_written(german: Language) -> None:
    entries = beside("means")
    assert sum(len(entry["say"]) for entry in entries) > 450
    wrong = [
        (say, got)
        for entry in entries
        for say in entry["say"]
        if not same(got := meaning(german, say), entry["do"])
    ]
    assert not wrong


def test_every_near_miss_is_refused_in_german(german: Language) -> None:
    sentences = beside("refuse")
    assert len(sentences) > 120
    parsed = {say: german.parse(say) for say in sentences}
    assert [say for say, result in parsed.items() if not isinstance(result, Refused)] == []
    messages = {result.message for result in parsed.values() if isinstance(result, Refused)}
    assert [message for message in messages if "nichts geändert" not in message] == []


def test_every_ambiguity_is_asked_about_and_each_choice_can_be_said(german: Language) -> None:
    sentences = beside("ask")
    assert len(sentences) > 15
    for say in sentences:
        parsed = german.parse(say)
        assert isinstance(parsed, Ambiguous), say
        assert parsed.question.endswith("?")
        for choice in parsed.choices:
            again = german.parse(choice.text)
            assert isinstance(again, Understood), choice.text
            assert again.actions == choice.actions


def test_minimal_pairs(german: Language) -> None:
    pairs = beside("pairs")
    assert len(pairs) > 40
    wrong = [
        (pair[side], got)
        for pair in pairs
        for side in ("a", "b")
        if not same(got := meaning(german, pair[side]), pair[f"{side}_do"])
    ]
    assert not wrong


def test_umlauts_may_be_written_out(german: Language) -> None:
    for say in sayings():
        parsed = german.parse(say)
        if say.translate(UMLAUTS) == say or "Stoßzeit" in say or getattr(parsed, "corrections", ()):
            continue
        assert written_out(meaning(german, say.translate(UMLAUTS))) == written_out(meaning(german, say)), say


def written_out(value: Any) -> Any:
    """The same with its umlauts written out: a given name is kept as it was written."""
    if isinstance(value, dict):
        return {key: written_out(each) for key, each in value.items()}
    if isinstance(value, list):
        return [written_out(each) for each in value]
    return value.translate(UMLAUTS) if isinstance(value, str) else value


def test_no_phrase_holds_a_word_that_is_always_written_out(german: Language) -> None:
    shortened = read_yaml(FOLDER / "words.yaml")["contractions"]["words"]
    assert sorted(german.data.lexicon.words & shortened.keys()) == []


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("groesser", "größer"),
        ("schlagloecher", "schlaglöcher"),
        ("strasse", "straße"),
        ("fussgänger", "fußgänger"),
    ],
)
def test_letters_that_a_keyboard_lacks_may_be_written_out(german: Language, written: str, meant: str) -> None:
    assert german.data.contractions.expand(written) == (meant,)


def test_no_word_stands_for_another_that_is_written_alike(german: Language) -> None:
    words = german.data.lexicon.words
    assert not [
        word for word in words if "'" not in word and german.data.contractions.expand(word) != (word,)
    ]


@pytest.mark.parametrize("polite", ["{}!", "  {}  ", "Bitte {}", "Äh, {}", "{}, bitte"])
def test_politeness_and_marks_change_nothing(german: Language, polite: str) -> None:
    for say in list(sayings())[::9]:
        if say.startswith(("Speichere", "speichere", "lade")) or say.endswith(("?", "!", ".")):
            continue
        # After a comma these take back what was said.
        if say.startswith(("Moment", "Mach daraus", "warte", "Warte")):
            continue
        if say.startswith("Auto,"):  # who is spoken to stands first
            continue
        if "chat" in str(meaning(german, say)):  # "hallo, bitte" says less than a greeting
            continue
        assert meaning(german, polite.format(say)) == meaning(german, say), say


@pytest.mark.parametrize(
    ("text", "wrote", "read"),
    [
        ("füge fünf Schlaglöhcer hinzu", "Schlaglöhcer", "schlaglöcher"),
        ("enferne alle Autos", "enferne", "entferne"),
        ("Pausire", "Pausire", "pausiere"),
        ("zeige das Protokol", "Protokol", "protokoll"),
        ("füge zwei Fusgänger hinzu", "Fusgänger", "fußgänger"),
    ],
)
def test_typos_are_repaired_and_reported(german: Language, text: str, wrote: str, read: str) -> None:
    parsed = german.parse(text)
    assert isinstance(parsed, Understood)
    assert [(c.wrote, c.read) for c in parsed.corrections] == [(wrote, read)]


@pytest.mark.parametrize(
    "text", ["füge zwie Kegel hinzu", "füge einundzwanzg Kegel hinzu", "er entfernte alle Autos"]
)
def test_numbers_and_other_tenses_are_never_guessed(german: Language, text: str) -> None:
    assert isinstance(german.parse(text), Refused)


def test_a_negation_after_a_list_holds_for_all_of_it(german: Language) -> None:
    for text in (
        "füge 5 Schlaglöcher, 2 Autos und 3 Kegel nicht hinzu",
        "nimm die Autos und die Kegel nicht weg",
        "zeige das Protokoll und den Plan nicht an",
        "simuliere nicht eine Autobahn mit 10 Schlaglöchern und 2 Autos",
    ):
        parsed = german.parse(text)
        assert isinstance(parsed, Refused), text
        assert parsed.reason == "negation"


def test_no_word_less_turns_an_order_into_a_greater_one(german: Language) -> None:
    """A word lost on the way never makes "some" into "everything"."""
    for entry in beside("means"):
        if len(entry["do"]) > 1 or entry["do"][0]["do"] != "add":
            continue
        for say in (say for say in entry["say"] if "entferne" not in say):
            words = say.split()
            for at in range(len(words)):
                parsed = german.parse(" ".join(words[:at] + words[at + 1 :]))
                if isinstance(parsed, Understood):
                    assert all(action["do"] != "remove" for action in dump(parsed.actions)), say


def test_neither_language_does_what_the_other_says(german: Language, language: Language) -> None:
    english = [say for entry in beside("means", FOLDER.parent / "en") for say in entry["say"]]
    assert len(english) > 1000
    heard = {say.lower().strip("!?. ") for say in english if not isinstance(german.parse(say), Refused)}
    assert heard <= SAME_IN_BOTH | {"stop, stop", "random seed 42"}
    back = {say.lower().strip("!?. ") for say in sayings() if not isinstance(language.parse(say), Refused)}
    assert back <= SAME_IN_BOTH | {"halt an", "autopilot an", "automatik"}


SMALL = [
    *(
        "null",
        "eins",
        "zwei",
        "drei",
        "vier",
        "fünf",
        "sechs",
        "sieben",
        "acht",
        "neun",
        "zehn",
        "elf",
        "zwölf",
    ),
    *("dreizehn", "vierzehn", "fünfzehn", "sechzehn", "siebzehn", "achtzehn", "neunzehn"),
]
TENS = ["zwanzig", "dreißig", "vierzig", "fünfzig", "sechzig", "siebzig", "achtzig", "neunzig"]


def spell(number: int, *, last: bool = True) -> str:
    """A German number in one word, written for this test; `last` says whether anything follows."""
    if number < 20:
        return "ein" if number == 1 and not last else SMALL[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return (spell(ones, last=False) + "und" if ones else "") + TENS[tens - 2]
    for power, name in ((1000, "tausend"), (100, "hundert")):
        if number >= power:
            head, rest = divmod(number, power)
            return spell(head, last=False) + name + (spell(rest) if rest else "")
    raise AssertionError(number)


def read(text: str) -> tuple[float, bool] | None:
    """The number a text starts with, and whether it is all of the text."""
    tokens = tokenise(normalise(text), Contractions({}, ()))
    found = NUMBERS.read(tokens, 0)
    return (found.value, found.end == len(tokens)) if found else None


@given(st.integers(0, 999_999), st.booleans())
def test_numbers_in_one_word_are_read_back(number: int, plain: bool) -> None:
    text = spell(number)
    assert read(text.translate(UMLAUTS) if plain else text) == (number, True)


@given(st.integers(0, 10**9))
def test_digits_with_points_between_thousands_are_read(number: int) -> None:
    assert read(str(number)) == (number, True)
    assert read(f"{number:,}".replace(",", ".")) == (number, True)


@given(st.integers(0, 999), st.integers(1, 99))
def test_a_comma_is_the_decimal_mark(whole: int, decimals: int) -> None:
    text = f"{whole},{decimals:02d}"
    assert read(text) == (pytest.approx(float(text.replace(",", "."))), True)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("hundert", 100),
        ("hunderteins", 101),
        ("hundertundeins", 101),
        ("hundert und fünf", 105),
        ("ein Dutzend", 12),
        ("ein halbes Dutzend", 6),
        ("neunzehnhundert", 1900),
        ("null Komma vier", 0.4),
        ("anderthalb", 1.5),
        ("dreiviertel", 0.75),
        ("drei Viertel", 0.75),
        ("zwei Millionen", 2_000_000),
        ("1.000,5", 1000.5),
        ("0.4", 0.4),
        ("-3", -3),
    ],
)
def test_other_shapes_of_numbers(text: str, value: float) -> None:
    found = read(text)
    assert found is not None
    assert found[0] == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        "ein",
        "und",
        "einundeins",
        "zwanzigeins",
        "hundertzwanzigtausendtausend",
        "zehnundzwanzig",
        "nullhundert",
    ],
)
def test_what_is_no_number_in_one_word(text: str) -> None:
    assert read(text) is None


@pytest.mark.parametrize("text", ["1,000", "12,345", "1.00.000", "1,2,3"])
def test_digits_whose_marks_are_doubtful_are_no_number(text: str) -> None:
    assert read(text) is None


def test_a_pair_in_brackets_is_no_decimal(german: Language) -> None:
    assert meaning(german, "ein Kegel bei (3,7)") == [
        {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [3, 7]}}
    ]


def test_what_is_said_back_means_what_was_done(german: Language) -> None:
    said = list(sentences(german.sentences))
    assert len(said) > 380
    assert [text for text in said if not isinstance(german.parse(text), Understood)] == []


def test_random_actions_come_back_or_cannot_be_said(german: Language) -> None:
    told = [failure for failure in failures(german, range(300)) if "cannot be said" not in failure]
    assert told == []


def test_more_of_what_was_taken_away_is_asked_about(german: Language) -> None:
    parsed = german.parse("noch zwei", Topic(kind="pothole", removed=True))
    assert isinstance(parsed, Ambiguous)
    assert [choice.text for choice in parsed.choices] == [
        "entferne 2 Schlaglöcher",
        "füge 2 Schlaglöcher hinzu",
    ]


@given(st.text(max_size=300))
def test_any_text_gets_one_of_three_answers(text: str) -> None:
    assert isinstance(GERMAN.parse(text), Understood | Refused | Ambiguous)


GERMAN = Language.load("de")
WORDS = sorted({word for say in sayings() for word in say.split()})


@given(st.lists(st.sampled_from(WORDS), max_size=20))
def test_known_words_in_any_order_get_one_of_three_answers(words: list[str]) -> None:
    parsed = GERMAN.parse(" ".join(words))
    assert isinstance(parsed, Understood | Refused | Ambiguous)
