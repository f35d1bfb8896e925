"""Scores, scales, and the files of a quiz; at the terminal and as an answer."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from service.cli.main import cli
from service.narration.quiz.result import (
    SATISFACTION,
    TRUST,
    Given,
    Result,
    as_csv,
    as_json,
    scale_mean,
    score,
)
from service.narration.quiz.situations import NOTHING, situations
from service.narration.sayings import Sayings
from sim.types import MOVES, Move
from tests.support.service import Service

QUIZ = situations(1, "priority", 2, Sayings.load())
ASKED = [each for each in QUIZ if each.phase != "explained"]


def test_who_always_knows_scores_all_and_who_never_does_nothing() -> None:
    right = [Given(each, each.move, each.reason) for each in ASKED]
    other = {move: next(each for each in MOVES if each is not move) for move in MOVES}
    wrong = [Given(each, other[each.move], "no such reason") for each in ASKED]
    assert score(right, "before") == score(right, "after")
    assert (score(right, "after").moves, score(right, "after").both) == (1.0, 1.0)
    assert (score(wrong, "after").moves, score(wrong, "after").reasons) == (0.0, 0.0)


def test_who_agrees_to_be_wary_trusts_less() -> None:
    assert scale_mean({"reliable": 5, "wary": 5}) == 3.0
    assert scale_mean({"reliable": 5, "wary": 1}) == 5.0
    assert scale_mean({}) is None


def test_both_files_say_the_same() -> None:
    given = tuple(Given(each, Move.FORWARD, NOTHING) for each in ASKED)
    result = Result("priority", 1, "en", given, dict.fromkeys(SATISFACTION, 4), dict.fromkeys(TRUST, 3))
    told = json.loads(as_json(result))
    rows = list(csv.DictReader(io.StringIO(as_csv(result))))
    by_move = [row for row in rows if row["item"] == "move"]
    assert [row["right"] == "1" for row in by_move] == [each["move_right"] for each in told["answers"]]
    assert told["scales"]["satisfaction"]["mean"] == 4
    assert told["scores"]["gain"]["moves"] == pytest.approx(
        told["scores"]["after"]["moves"] - told["scores"]["before"]["moves"]
    )
    assert sum(row["phase"] == "trust" for row in rows) == len(TRUST)


@pytest.mark.parametrize("ending", [".json", ".csv"])
def test_the_terminal_asks_and_writes(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"result{ending}"
    typed = [
        "9",
        "1",
        "1",
        *[""],
        *["1", "1"],
        *["4"] * 16,
    ]  # a number that is none of the choices is asked again
    told = CliRunner().invoke(cli, ["quiz", "--count", "1", "--to", str(file)], input="\n".join(typed) + "\n")
    assert told.exit_code == 0, told.output
    assert "Moves predicted" in told.output
    assert file.read_text(encoding="utf-8").count("satisfaction") >= 1


def test_a_file_of_another_kind_is_refused(tmp_path: Path) -> None:
    told = CliRunner().invoke(cli, ["quiz", "--to", str(tmp_path / "result.txt")])
    assert told.exit_code == 1
    assert ".json or .csv" in told.output


async def test_quiz_me_answers_with_situations_and_changes_nothing(service: Service) -> None:
    path = await service.session(paused=True)
    before = await service.state(path)
    asked = {"actions": [{"do": "ask", "about": "quiz"}]}
    answer = (await service.client.post(f"{path}/actions", json=asked)).json()["answer"]
    quiz = answer["quiz"]
    assert (answer["about"], quiz["planner"]) == ("quiz", "rules")
    assert [each["phase"] for each in quiz["situations"]] == ["before"] * 4 + ["explained"] * 4 + [
        "after"
    ] * 4
    assert {each["id"] for each in quiz["scales"]["trust"] if each["reversed"]} == {"wary"}
    assert await service.state(path) == before
