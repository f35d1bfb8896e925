"""Sentences that are changed or joined by program never mean what they do not say."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from service.actions import dump
from service.cli.main import cli
from service.grammar import Ambiguous, Language, Refused, Understood
from service.grammar.fuzz.mutations import NEUTRAL, Mutations
from service.grammar.fuzz.pairs import all_pairs, joined, judge
from service.grammar.fuzz.run import PAIRS, Fuzzer
from service.grammar.fuzz.sayings import Sayings
from service.grammar.fuzz.vocabulary import vocabulary_of
from tests.grammar.beside import meaning

CERTAIN = ("negation", "repetition", "order", "past", "unknown", "possible")
"""Kinds in which a short run finds nothing suspicious."""


@pytest.fixture(scope="module")
def sayings(language: Language) -> Sayings:
    return Sayings(language, "en")


def test_a_short_run_finds_no_wrong_act(language: Language, sayings: Sayings) -> None:
    fuzzer = Fuzzer(language, "en", 11, sayings)
    report = fuzzer.run(600, [*CERTAIN, NEUTRAL, *PAIRS])
    assert report.total() > 500
    assert report.total("same") > 100
    assert report.suspicious == []


def test_the_same_seed_makes_the_same_sentences(language: Language, sayings: Sayings) -> None:
    runs = [Fuzzer(language, "en", 3, sayings).run(60, ["duration", "pairs"]).counts for _ in range(2)]
    assert runs[0] == runs[1]


def test_a_mutation_knows_what_it_did(sayings: Sayings) -> None:
    saying = sayings.read("turn left, then add two cars 10 metres ahead, and make it rain")
    assert saying is not None
    mutations = Mutations(vocabulary_of("en"), seed=1)
    made = [mutant for kind in mutations.kinds if (mutant := mutations.of(saying, kind)) is not None]
    assert len(made) > 20
    for mutant in made:
        assert mutant.text != saying.text
        assert mutant.change
    quoted = sayings.read('save this as "two cars"')
    assert quoted is not None
    assert mutations.of(quoted, "number") is None


def test_a_part_that_is_lost_is_seen(language: Language, sayings: Sayings) -> None:
    one, other = sayings.read("add five potholes"), sayings.read("pause")
    assert one is not None
    assert other is not None
    for text, became in (
        ("add five potholes and pause", "same"),
        ("add five potholes", "lost"),
        ("add five potholes and resume", "changed"),
        ("gibberish", "refused"),
    ):
        assert judge(one, other, language.parse(text)) == became


def test_all_pairs_are_each_with_each_in_both_orders(sayings: Sayings) -> None:
    one, other = sayings.read("what do you see"), sayings.read("pause")
    assert one is not None
    assert other is not None
    texts = [pair[2] for pair in all_pairs([one], [other], [" and ", ", "], most=10, seed=1)]
    assert sorted(texts) == sorted(
        joined(a, b, joiner)[2] for a, b in ((one, other), (other, one)) for joiner in (" and ", ", ")
    )


@pytest.mark.parametrize(
    ("text", "actions"),
    [
        (
            "advance one cell. why did you make that move",
            [{"do": "drive", "move": "forward"}, {"do": "ask", "about": "why"}],
        ),
        (
            "four more potholes; drop two of the trucks",
            [{"do": "add", "kind": "pothole", "count": 4}, {"do": "remove", "kind": "vehicle", "count": 2}],
        ),
        (
            "what will you do now; could you explain that decision",
            [{"do": "ask", "about": "next"}, {"do": "ask", "about": "why"}],
        ),
        (
            "run 200 episodes and compare A* with DWA",
            [{"do": "evaluate", "runs": 200, "planners": ["astar", "dwa"]}],
        ),
    ],
)
def test_parts_mean_together_what_they_mean_alone(
    language: Language, text: str, actions: list[dict[str, object]]
) -> None:
    assert meaning(language, text) in (actions, "ask")


@pytest.mark.parametrize(
    "text",
    [
        "why did you stop and turn left",
        "explain your last decision and stop",
        "explain your most recent manoeuvre and stop",
        "why did you swerve and turn left",
        "why did you change lanes and stop",
        "begin again and also exactly 12 cars",
        "save this as monday demo and turn left",
        "are there any potholes. five potholes",
    ],
)
def test_what_may_be_either_is_asked_about(language: Language, text: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Ambiguous)
    for choice in parsed.choices:
        again = language.parse(choice.text)
        assert isinstance(again, Understood)
        assert dump(again.actions) == dump(choice.actions)


@pytest.mark.parametrize(
    "text", ["add five barriers ahead but not in lane 2", "make the potholes disappear but not in lane 2"]
)
def test_a_place_that_is_taken_out_is_not_lost(language: Language, text: str) -> None:
    assert isinstance(language.parse(text), Refused)


def test_the_command_reports_by_kind() -> None:
    told = CliRunner().invoke(cli, ["language-fuzz", "--sentences", "40", "--kind", "past", "--json"])
    assert told.exit_code == 0, told.output
    report = json.loads(told.stdout)
    assert sum(report["counts"]["past"].values()) == 40
    assert report["suspicious"] == []
    assert CliRunner().invoke(cli, ["language-fuzz", "--kind", "none such"]).exit_code == 1
