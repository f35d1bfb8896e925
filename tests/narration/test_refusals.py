"""Every code of `sim.codes` has a sentence in every language, made of its facts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import pytest
import yaml

from service.grammar.engine import Language
from service.grammar.parse_types import Understood
from service.refusals import Refusals, refusals
from service.resources import prompts_folder
from sim.actions import Add, PlaceableKind, Where
from sim.codes import ADVICE, EDITS, PROBLEMS
from sim.config import Config, ConfigError, Problem
from sim.generation import GenerationError
from sim.hazard_advice import NoAdviceError
from sim.rules.versions import NewerRulesError
from sim.session.errors import EditError
from sim.types import Kind

LANGUAGES = sorted(path.name for path in (prompts_folder() / "language").iterdir())
FACTS: dict[str, tuple[Any, Any]] = {
    "amount": (None, 411),
    "away": (417, 1),
    "choice": ("perfect", "lidar"),
    "choices": (("none", "light"), ("none", "heavy")),
    "column": (403, 1),
    "count": (409, 1),
    "tried": (503, 1),
    "driven": (509, 7),
    "draws": (419, 200),
    "free": (421, 1),
    "free_row": (547, 2),
    "high": (431.0, 1000),
    "id": ("pothole-433", "av-1"),
    "kind": (Kind.POTHOLE, "everything"),
    "lane": (439, 9),
    "lost": (521, 1),
    "lanes": (443, 8),
    "last_column": (449, 7),
    "last_row": (457, 29),
    "layout": ("maze", "walls"),
    "left": (461, 1),
    "low": (0.25, 3),
    "most": (463, 100),
    "percent": (523, 50),
    "near": ("columns", "rows"),
    "now": (0.68, 3),
    "number": (541, 2),
    "place": ("there", "road"),
    "problem": (Problem("rows", "too_many", room=467), Problem("rows", "must_be_a_number")),
    "room": (479, 0),
    "row": (487, 30),
    "setting": ("columns", "rows"),
    "side": ("left", "behind"),
    "value": (491.5, 0.5),
}
"""Two values for each fact, which must be told apart in the sentence."""
MISSING = (
    Problem("avs", "second_vehicle_not_available"),
    Problem("planner", "planner_not_available", value="rl"),
)
CODES = [
    *(("problem", code, facts) for code, facts in PROBLEMS.items()),
    *(("edit", code, facts) for code, (_, facts) in EDITS.items()),
    *(("advice", code, facts) for code, facts in ADVICE.items()),
]


def told(words: Refusals, what: str, code: str, facts: Mapping[str, Any]) -> str:
    """What is said of a code with these facts."""
    if what == "problem":
        return words.problem(Problem("columns", code, **facts))
    if what == "edit":
        return words.edit(EditError(code, "where", **facts))
    return words.advice(NoAdviceError(code, "distance_m", **facts))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("what", "code", "names"), CODES, ids=lambda each: each if type(each) is str else "")
def test_every_code_is_told_with_all_its_facts(
    language: str, what: str, code: str, names: tuple[str, ...]
) -> None:
    words = refusals(language)
    values = FACTS | ({"problem": MISSING} if code == "scenario_not_available" else {})
    facts = {name: values[name][0] for name in names}
    text = told(words, what, code, facts)
    assert text.strip() == text
    assert "  " not in text
    assert "{" not in text
    if what != "problem" or code.endswith("_not_available"):
        assert text.endswith(".")
        assert not text.endswith("..")
    else:
        assert not text.endswith("."), "it follows the name of a field"
    for name in names:
        assert told(words, what, code, facts | {name: values[name][1]}) != text, f"{name} is left out"


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("kind", [*Kind, "everything"])
@pytest.mark.parametrize("code", [code for code, (_, facts) in EDITS.items() if "kind" in facts])
def test_every_kind_can_be_refused(language: str, kind: str, code: str) -> None:
    facts = {name: FACTS[name][0] for name in EDITS[code][1]} | {"kind": kind}
    texts = {told(refusals(language), "edit", code, facts)}
    if "count" in facts:
        texts.add(told(refusals(language), "edit", code, facts | {"count": 1}))
    assert all(text.endswith(".") for text in texts)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("code", [code for code, (_, facts) in EDITS.items() if "kind" in facts])
def test_a_kind_without_words_goes_by_its_name(language: str, code: str) -> None:
    """So that a new kind needs no words before it can be refused."""
    path = prompts_folder() / "sayings" / language / "refusals.yaml"
    data = yaml.safe_load(path.read_text("utf-8"))
    del data["things"]["pedestrian"]
    facts = {name: FACTS[name][0] for name in EDITS[code][1]} | {"kind": Kind.PEDESTRIAN}
    for more in ({}, {"count": 1} if "count" in facts else {}):
        assert "pedestrian" in told(Refusals(data), "edit", code, facts | more)


def keys(data: Mapping[str, Any], path: str = "") -> Iterator[str]:
    """Every key under which a sentence stands."""
    for section in ("edits", "instead", "problems", "advice", "rules", "session", "pace"):
        yield from (f"{path}{section}.{code}" for code in data[section])


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_language_has_the_same_sentences_and_no_stale_ones(language: str) -> None:
    read = yaml.safe_load((prompts_folder() / "sayings" / language / "refusals.yaml").read_text("utf-8"))
    english = yaml.safe_load((prompts_folder() / "sayings" / "en" / "refusals.yaml").read_text("utf-8"))
    assert sorted(keys(read)) == sorted(keys(english))
    assert set(read["edits"]) == set(EDITS)
    assert set(read["problems"]) == set(PROBLEMS)
    assert set(read["advice"]) == set(ADVICE)
    assert not {form["of"] for form in read["forms"].values()} - set(FACTS), "a form of no fact"


@pytest.mark.parametrize(
    ("error", "english", "german"),
    [
        (
            EditError("no_room", "count", count=1, kind=Kind.BARRIER, free=0, place="there"),
            "1 barrier does not fit: 0 cells are free there.",
            "1 Barriere passt nicht: 0 Felder sind dort frei.",
        ),
        (
            EditError("too_few", "count", count=1, kind=Kind.PEDESTRIAN, place="road"),
            "There is only one pedestrian on the road.",
            "Es gibt auf der Straße nur einen Fußgänger.",
        ),
        (
            EditError("too_far", "where", left=1, side="left", away=4),
            "The road ends 1 cell to the left; 4 is too far.",
            "Die Straße endet nach links nach 1 Feld; 4 ist zu weit.",
        ),
        (
            EditError("occupied", "where", column=3, row=4, id="av-1"),
            "Cell (3, 4) is taken by the autonomous vehicle.",
            "Das Feld (3, 4) ist von dem autonomen Fahrzeug belegt.",
        ),
        (
            EditError("at_its_limit", "direction", setting="traffic", now="heavy"),
            "Traffic is at its limit already: heavy.",
            "Der Verkehr ist schon an der Grenze: dicht.",
        ),
    ],
    ids=str,
)
def test_sentences_as_they_are_read(error: EditError, english: str, german: str) -> None:
    assert refusals().edit(error) == english
    assert refusals("de").edit(error) == german


def test_problems_as_they_are_read() -> None:
    with pytest.raises(ConfigError) as refused:
        Config(columns=2, cell_m=200, solvable=1, sensor="sonar", seed=-1)  # type: ignore[arg-type]
    assert {each.field: refusals().problem(each) for each in refused.value.problems} == {
        "columns": "must be between 3 and 64",
        "cell_m": "must be between 0.5 and 100",
        "seed": "must be between 0 and 9007199254740991",
        "sensor": "must be one of perfect, camera, lidar, radar, fusion",
        "solvable": "must be true or false",
    }
    (problem,) = GenerationError().problems
    assert refusals().problem(problem) == "no drivable road was found in 200 draws; ask for fewer hazards"


def test_versions_are_told_of() -> None:
    newer = refusals().newer_rules(NewerRulesError(9), "session")
    assert newer == (
        "This session was made by a newer version of Roadtalk (rules 9). This one knows rules up to 3."
    )
    assert refusals().older_rules(1) == "Made under rules 1: it replays as it did then."


@pytest.mark.parametrize("language", ["xx", "", "..", "../../prompts", "en/../de"])
def test_who_speaks_another_language_gets_english(language: str) -> None:
    road = EditError("no_such_lane", "where", lane=9, lanes=8)
    assert refusals(language).edit(road) == "There is no lane 9: the road has 8 lanes."


def test_an_error_has_a_listed_code_and_its_facts() -> None:
    with pytest.raises(ValueError, match="not listed"):
        EditError("too_green", "where")
    with pytest.raises(ValueError, match="comes with"):
        EditError("no_such_lane", "where", lane=9)
    with pytest.raises(ValueError, match="not listed"):
        Problem("rows", "no_such_lane")
    assert str(EditError("no_such_lane", "where", lane=9, lanes=8)) == "no such lane (lane=9, lanes=8)"
    assert str(ConfigError((Problem("rows", "too_many", room=4),))) == "rows: too many (room=4)"


@pytest.mark.parametrize("kind", ["barrier", "pothole", "vehicle", "pedestrian"])
@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_offered_instead_is_understood(language: str, kind: PlaceableKind) -> None:
    taken = EditError("row_is_taken", "where", lane=3, row=9, id="vehicle-1", kind=Kind(kind), free_row=7)
    (offered,) = refusals(language).instead(taken)
    parsed = Language.load(language).parse(offered)
    assert isinstance(parsed, Understood), offered
    assert parsed.actions == (Add(kind=kind, count=1, where=Where(each="lane", row=7)),)
    assert refusals(language).instead(EditError("no_such_lane", "where", lane=9, lanes=8)) == ()
