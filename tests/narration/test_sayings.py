"""Every saying can be said: the data has all that the code asks for, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path

import pytest
import yaml

from service.narration.sayings import Sayings
from service.resources import prompts_folder
from sim.forecast import StepVerdict
from sim.plan import Option
from sim.types import PLACEABLE, Kind, Move, Outcome

SAYINGS = Sayings.load()
FOLDER = prompts_folder() / "sayings" / "en"


@pytest.mark.parametrize("move", Move)
@pytest.mark.parametrize("form", ["did", "do", "name", "place"])
def test_every_move_has_every_form(move: Move, form: str) -> None:
    assert SAYINGS.move(move, form)


@pytest.mark.parametrize("verdict", StepVerdict)
@pytest.mark.parametrize("tense", ["now", "then"])
def test_every_verdict_can_be_told(verdict: StepVerdict, tense: str) -> None:
    assert "X" in SAYINGS.say("words", "reasons", verdict, tense, who="W", a="A", place="X")


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_has_a_singular_and_a_plural(kind: Kind) -> None:
    assert SAYINGS.things(kind, 1) != SAYINGS.things(kind, 2)


@pytest.mark.parametrize("outcome", [outcome for outcome in Outcome if outcome is not Outcome.RUNNING])
def test_every_outcome_has_a_word(outcome: Outcome) -> None:
    assert SAYINGS.say("answers", "outcomes", outcome)


def test_lists_are_joined_as_people_do() -> None:
    assert [SAYINGS.joined("abc"[:n]) for n in range(4)] == ["", "a", "a and b", "a, b and c"]


def test_a_language_without_sayings_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no sayings"):
        Sayings.load("xx", tmp_path)


@pytest.mark.parametrize(
    ("file", "key"),
    [("naming", "the"), ("words", "a"), ("scene", "nouns"), ("ends", "sakes"), ("next", "sakes")],
)
@pytest.mark.parametrize("kind", PLACEABLE)
def test_every_kind_has_the_words_of_each_table(file: str, key: str, kind: Kind) -> None:
    assert SAYINGS.words(file, key, kind)


def test_a_kind_that_is_not_listed_gets_its_words_from_its_nouns() -> None:
    """As a kind that comes later would: here the pedestrian's own words are taken away."""
    files = {path.stem: yaml.safe_load(path.read_text("utf-8")) for path in FOLDER.glob("*.yaml")}
    for file, key in (("words", "things"), ("words", "a"), ("naming", "the"), ("scene", "nouns")):
        del files[file][key][Kind.PEDESTRIAN.value]
    del files["ends"]["sakes"][Kind.PEDESTRIAN.value]
    given = deepcopy(files)
    sayings = Sayings(files)
    assert files == given
    assert [sayings.things("pedestrian", count) for count in (1, 2)] == ["pedestrian", "pedestrians"]
    assert sayings.say("words", "a", "pedestrian") == "a pedestrian"
    assert sayings.say("naming", "the", "pedestrian") == "the pedestrian"
    assert sayings.words("scene", "nouns", "pedestrian") == ["pedestrian", "pedestrians"]
    assert sayings.words("ends", "sakes", "pedestrian") == ["for a pedestrian", "for pedestrians"]


class OneName:
    """Calls everything the same."""

    def things(self, names: Sequence[str]) -> str:
        return " and ".join(names)

    def imagined(self, names: Sequence[str]) -> dict[str, str]:  # noqa: ARG002
        return {}


@pytest.mark.parametrize("code", ["en", "de"])
@pytest.mark.parametrize(
    "reasons",
    [
        (StepVerdict.MOVER_SWAPS, StepVerdict.MOVER_ENTERS),
        (StepVerdict.MOVER_CROSSES, StepVerdict.MOVER_CROSSES),
    ],
)
def test_one_thing_in_the_way_of_two_moves_is_not_told_as_two(
    code: str, reasons: tuple[StepVerdict, StepVerdict]
) -> None:
    sayings = Sayings.load(code)
    moves = (Move.LEFT, Move.FORWARD_LEFT)
    pairs = zip(moves, reasons, strict=True)
    options = [Option(move, (0, 0), reason, None, ("vehicle-7",)) for move, reason in pairs]
    told = str(sayings.all_met(options, "then", OneName()))
    assert told.count("vehicle-7") == 2
    another = [str(sayings.say("words", "a", "vehicle")), sayings.things("vehicle", 2)]
    assert [words for words in another if words in told.replace("vehicle-7", "")] == []
    two = [Option(move, (0, 0), reasons[0], None, (f"vehicle-{move}",)) for move in moves]
    assert str(sayings.all_met(two, "then", OneName())) != told


@pytest.mark.parametrize(
    ("code", "text", "told"),
    [
        ("en", "There are only 1 ticks so far.", "There are only 1 tick so far."),
        (
            "en",
            "Of 1 lane changes 1.1 moves, 21 ticks, 0.1 rows.",
            "Of 1 lane change 1.1 moves, 21 ticks, 0.1 rows.",
        ),
        (
            "en",
            "At tick 1 cars came, in lane 1 things stood.",
            "At tick 1 cars came, in lane 1 things stood.",
        ),
        ("de", "Von 1 Zügen, 11 Zügen und 1 Ticks", "Von 1 Zug, 11 Zügen und 1 Tick"),
    ],
)
def test_one_is_not_told_as_many(code: str, text: str, told: str) -> None:
    assert Sayings.load(code).with_ones(text) == told
