"""Scenario files: their form, their flaws by line and field, sentences both ways, and evaluations of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from service.actions import dump, load
from service.cli.main import cli
from service.evaluations.report.document import episode_link
from service.grammar import Language
from service.scenarios import NAMES, ScenarioError, named_scenario, read_scenario
from service.scenarios.begin import recording_of, scenario_link
from service.scenarios.evaluation import evaluation_of_scenario, first_state
from service.scenarios.words import NoScenarioError, scenario_of, sentence_of
from sim.evaluate import Evaluation, EvaluationError
from sim.evaluate.part import drive_one
from sim.evaluate.run import evaluate
from sim.session.rule_values import rule_of, rule_values

HEAD = "format: roadtalk-scenario\nversion: 1\nname: one\nreason: To test.\n"
RULE = "rules:\n  - do: trigger\n    when: {{fact: {}}}\n"
COW = "{do: add, kind: cow, count: 1}"


@pytest.fixture(scope="module")
def english() -> Language:
    return Language.load("en")


@pytest.mark.parametrize("name", NAMES)
def test_every_scenario_of_the_library_begins_and_is_what_its_sentence_makes(
    name: str, english: Language
) -> None:
    found = named_scenario(name)
    assert found.name == name
    assert len(found.reason) > 40
    assert len(first_state(found).triggers.standing) == len(found.rules)
    said = sentence_of(found, english)
    assert said is not None
    again = scenario_of(said, english, found.name, found.reason, found.seed)
    assert recording_of(again) == recording_of(found)
    for text in (json.dumps(found.to_values()),):
        assert read_scenario(text) == found
    assert scenario_link(found).startswith("#/r/")


@pytest.mark.parametrize(
    ("more", "line", "field", "told"),
    [
        ("config: {potholes: 9000}\n", 5, "config.potholes", "too many"),
        ("config: {colour: red}\n", 5, "config.colour", "not a setting"),
        ("config: {seed: 3}\n", 1, "", "given beside config"),
        ("planner: best\n", 5, "planner", ""),
        ("seed: -1\n", 5, "seed", "greater than or equal to 0"),
        ("setup:\n  - {do: add, kind: pothole, count: 1}\n", 1, "", "give its 'seed'"),
        ("seed: 1\nsetup:\n  - {do: add, kind: pothole, count: 0}\n", 7, "setup.0.count", "1"),
        ("seed: 1\nsetup:\n  - {do: fly}\n", 7, "setup.0", "fly"),
        (f"{RULE.format('every')}    then: [{{do: pause}}]\n", 7, "rules.0.when", "ticks"),
        (f"{RULE.format('crash')}    then:\n      - {{do: fly}}\n", 9, "rules.0.then.0.do", "no action"),
        (f"{RULE.format('crash')}    then:\n      - {COW}\n", 9, "rules.0.then.0.kind", "pothole"),
        ("reason: again\n", 5, "reason", "twice"),
        ("speed: 3\n", 5, "speed", "not permitted"),
        ("config: &a {}\nrules: *a\n", 5, "", "aliases"),
        ("config: {\n", 6, "", ""),
    ],
)  # fmt: skip
def test_a_flaw_is_told_with_its_line_and_field(more: str, line: int, field: str, told: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        read_scenario(HEAD + more)
    assert len(refused.value.flaws) == 1, refused.value
    (flaw,) = refused.value.flaws
    assert (flaw.line, flaw.field) == (line, field), flaw
    assert told in flaw.message


@pytest.mark.parametrize(
    "text", ["", "[]", "a", "format: other\n", "\x00", "[" * 5_000, "1: 2\n? [a]\n: b\n"]
)
def test_what_is_no_scenario_is_refused(text: str) -> None:
    with pytest.raises(ScenarioError):
        read_scenario(text)


def test_a_sentence_that_makes_no_scenario_is_refused(english: Language) -> None:
    for text in ("why did you do that?", "pause", "flurb the road"):
        with pytest.raises(NoScenarioError):
            scenario_of(text, english, "one", "To test.")


def test_a_recording_opens_as_the_scenario() -> None:
    found = named_scenario("pothole-appears")
    made = recording_of(found)
    assert load(made["entries"][0]["actions"]) == tuple(found.rules)
    assert made["digest"] == first_state(found).world.digest()


def test_rules_survive_json() -> None:
    for name in NAMES:
        for rule in named_scenario(name).rules:
            values = json.loads(json.dumps(rule_values(rule)))
            assert rule_of(values) == rule
            assert dump((rule,)) == [rule_values(rule)]


def test_rules_are_done_in_every_episode_of_an_evaluation() -> None:
    found = named_scenario("growing-traffic")
    spec = evaluation_of_scenario(found, 6, ("astar", "priority"), 3)
    assert Evaluation.from_json(json.loads(json.dumps(spec.to_json()))) == spec
    plain = Evaluation(planners=spec.planners, episodes=6, seed=3, config=spec.config)
    assert [drive_one(spec.start(index, "priority")) for index in range(6)] != [
        drive_one(plain.start(index, "priority")) for index in range(6)
    ]
    summary = evaluate(spec)
    assert summary is not None
    assert summary == evaluate(Evaluation.from_json(spec.to_json()))
    assert all(episode_link(spec, each) for each in summary["examples"])


def test_a_scenario_with_a_seed_is_evaluated_on_its_own_road() -> None:
    found = named_scenario("gap-in-the-wall")
    spec = evaluation_of_scenario(found, 3)
    assert spec.start(2, "rules").world.digest() == first_state(found).world.digest()


def test_rules_that_begin_other_roads_are_not_evaluated() -> None:
    rule = "rules:\n  - do: trigger\n    when: {fact: crash}\n    then: [{do: reset}]\n"
    with pytest.raises(EvaluationError) as refused:
        evaluation_of_scenario(read_scenario(HEAD + rule), 3)
    assert [each.field for each in refused.value.problems] == ["rules"]


def test_a_scenario_without_a_way_is_refused_before_it_is_run() -> None:
    wall = "".join(
        f"  - {{do: add, kind: barrier, count: 1, where: {{cell: [{x}, 12]}}}}\n" for x in range(8)
    )
    text = HEAD + "seed: 1\nconfig: {potholes: 0, vehicles: 0}\nsetup:\n" + wall
    with pytest.raises(EvaluationError) as refused:
        evaluation_of_scenario(read_scenario(text), 3)
    assert [each.code for each in refused.value.problems] == ["has_no_way"]


def run(*args: str) -> Any:
    return CliRunner().invoke(cli, ["scenario", *args])


def test_the_command_lists_checks_makes_and_runs(tmp_path: Path) -> None:
    assert [line.split()[0] for line in run("list").output.splitlines()] == list(NAMES)
    made = tmp_path / "one.yaml"
    answer = run("make", "new scenario: 0 potholes, 3 cars", "--name", "three-cars", "--to", str(made))
    assert answer.exit_code == 0, answer.output
    checked = run("check", str(made))
    assert (checked.exit_code, "three-cars: a valid scenario" in checked.output) == (0, True)
    assert run("say", str(made)).output == "new scenario: 0 potholes, 3 cars\n"
    made.write_text(made.read_text() + "colour: red\n")
    wrong = run("check", str(made))
    assert wrong.exit_code == 1
    assert "colour" in wrong.stderr
    assert run("show", "no-such").exit_code == 1
    assert "properties" in json.loads(run("schema").output)
