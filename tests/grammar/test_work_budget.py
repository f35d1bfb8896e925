"""What reading costs, in the engine's steps: no known sentence comes near the bound, no text passes it."""

from __future__ import annotations

import json
import random

import pytest

from service.grammar import Language
from service.grammar.completion import MOST_COMPLETING
from service.grammar.engine import MAX_TOKENS
from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.parse_types import Refused
from service.grammar.span_patterns import MAX_PIECES, SKIPPED, SpanPattern, ends_of_pieces, family, steps_of
from service.grammar.topic import ALONE
from service.grammar.work_budget import MOST_STEPS, READ_STEPS, TOKEN_STEPS, WorkBudget
from tools.slow_sentences import HERE, LONGEST, completing, labelled, reading

LAST = READ_STEPS + TOKEN_STEPS * MAX_TOKENS
"""Steps of the largest single payment: so much may be spent past the bound."""

KNOWN = MOST_STEPS // 4
"""What no labelled sentence comes near."""

THREE_CORRECTED = (
    "please add two cars in the left lane and three potholes in lane 2 five metres ahead and one barrier on "
    "the right and then go on and show the plan and tell me why you stopped, I mean two cars and three cones "
    "in the last lane"
)


@pytest.fixture(scope="module")
def german() -> Language:
    return Language.load("de")


def worst(code: str) -> list[str]:
    lines = (HERE / "worst" / f"{code}.jsonl").read_text("utf-8").splitlines()
    return [str(json.loads(line)["text"]) for line in lines]


def test_no_labelled_sentence_comes_near_the_bound(language: Language, german: Language) -> None:
    for code, each in (("en", language), ("de", german)):
        cost = reading(each)
        found = max(cost(text) for text in labelled(code))
        assert found.steps < KNOWN, found


def test_a_correction_at_the_end_of_much_is_read_within_the_bound(language: Language) -> None:
    work = WorkBudget()
    parsed = language.parse(THREE_CORRECTED, ALONE, work)
    assert work.spent <= MOST_STEPS + LAST  # what is refused is read once more, as a rule
    assert isinstance(parsed, Refused)
    assert parsed.unparsed, "refused for its words, not for its work"


@pytest.mark.parametrize("code", ["en", "de"])
def test_the_worst_that_were_found_stay_within_the_bound(
    code: str, language: Language, german: Language
) -> None:
    each = language if code == "en" else german
    cost, complete = reading(each), completing(each)
    texts = worst(code)
    assert len(texts) >= 10
    for text in texts:
        assert len(text) <= LONGEST
        assert cost(text).steps <= MOST_STEPS + LAST, text
        assert complete(text).steps <= MOST_COMPLETING + LAST, text


def test_a_text_costs_the_same_every_time(language: Language) -> None:
    for text in (THREE_CORRECTED, worst("en")[0], "bake a cake"):
        assert len({reading(language)(text).steps for _ in range(2)}) == 1


def test_what_costs_too_much_is_refused_and_says_what_helps(language: Language, german: Language) -> None:
    for each, said in ((language, "Say it in two parts"), (german, "in zwei Teilen")):
        work = WorkBudget(READ_STEPS)
        parsed = each.parse(
            "add 3417 cones", ALONE, work
        )  # no other test says it: what is known costs nothing
        assert isinstance(parsed, Refused)
        assert (parsed.reason, parsed.unparsed) == ("not_understood", ())
        assert said in parsed.message
        assert work.spent <= READ_STEPS + LAST


def test_completions_that_cost_too_much_are_those_found_by_then(language: Language) -> None:
    text = "add two cars and three cones, I mean four cones, no, five, then "
    assert completing(language)(text).steps <= MOST_COMPLETING + LAST


# Stretches of the same make: against all ways to read them, written out


CONCEPTS = (
    "number",
    "noun.thing.many",
    "v.add",
    "place",
    "place_bare",
    "glue",
    "separator",
    "noun.thing.one",
)


def drawn(chance: random.Random) -> Lattice:
    """A lattice of a few tokens with random edges."""
    size = chance.randrange(2, 14)
    lattice = Lattice(size, [[] for _ in range(size)])
    for at in range(size):
        for _ in range(chance.choice((0, 1, 1, 2, 3))):
            end = min(size, at + chance.choice((1, 1, 1, 2, 3)))
            lattice.edges[at].append(Edge(at, end, Sense(chance.choice(CONCEPTS))))
    return lattice


def makes(lattice: Lattice, at: int, end: int) -> set[tuple[str, ...]]:
    """Every way to read a stretch, piece by piece; after the most pieces nothing follows."""
    known: dict[int, set[tuple[str, ...]]] = {at: {()}}
    for here in range(at, end):
        for made in known.pop(here, set()):
            for edge in lattice.edges[here]:
                if edge.end > end or len(made) == MAX_PIECES:
                    continue
                more = made if edge.concept in SKIPPED else (*made, family(edge.concept))
                known.setdefault(edge.end, set()).add(more)
    return {made for made in known.get(end, set()) if made}


def test_stretches_of_the_same_make_are_those_with_a_reading_in_common() -> None:
    chance = random.Random(4)
    alike = 0
    for _ in range(400):
        lattice = drawn(chance)
        start = chance.randrange(lattice.size)
        end = chance.randrange(start + 1, lattice.size + 1)
        steps, said = steps_of(lattice), makes(lattice, start, end)
        ends = {stop for stop in range(start + 1, lattice.size + 1) if makes(lattice, start, stop)}
        assert ends_of_pieces(steps, start, WorkBudget()) == ends
        make = SpanPattern(steps, start, end, WorkBudget())
        for at in range(lattice.size):
            last = chance.randrange(at, lattice.size + 1)
            stops = (stop for stop in range(at + 1, last + 1) if makes(lattice, at, stop) & said)
            expected = next(stops, None)
            assert make.first_match(at, last) == expected
            alike += expected is not None
    assert alike > 200
