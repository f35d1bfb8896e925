"""One list of planners: a name that is good somewhere is good everywhere, older names too."""

from __future__ import annotations

from typing import Any, get_args

import pytest
import yaml
from typer.testing import CliRunner

from service import actions as contract
from service.cli.main import cli
from service.grammar import Language, Understood
from service.llm.schema import WORDS
from service.narration.sayings import Sayings
from service.resources import prompts_folder
from sim.actions import Scenario, Set
from sim.batch import Batch
from sim.config import Config
from sim.plan import planner_named, traits_of
from sim.planner_names import ALIASES, BUILT_IN, PROMISED, PlannerName, canonical, names
from sim.session.config_to_actions import config_to_actions
from sim.session.edits import apply
from sim.session.saved_config import saved_config
from sim.session.timeline import Timeline
from sim.state import SimState
from tests.support.service import Service

GOOD = (*BUILT_IN, *ALIASES)
OLD = tuple(ALIASES)


@pytest.fixture(scope="module")
def language() -> Language:
    return Language.load()


def test_the_lists_are_one() -> None:
    assert set(get_args(PlannerName)) == {*GOOD, *PROMISED}
    assert set(names()) >= set(BUILT_IN)
    assert not set(names()) & set(ALIASES)
    assert set(ALIASES.values()) <= set(BUILT_IN)
    assert WORDS["planner"] == (*BUILT_IN, *PROMISED)
    assert set(Sayings.load().words("words", "planners")) <= set(BUILT_IN)
    for code in ("en", "de"):
        words = yaml.safe_load((prompts_folder() / f"language/{code}/lexicon/values.yaml").read_text())
        assert set(words["planner"]) <= {*BUILT_IN, *PROMISED}


@pytest.mark.parametrize("name", GOOD)
def test_a_planner_can_be_set_and_asked_for_with_a_scenario(name: Any) -> None:
    state = SimState.start(Config(planner="priority" if name == "rules" else "rules"))
    for action in (Set(parameter="planner", value=name), Scenario(planner=name)):
        assert apply(state, action).state.config.planner == canonical(name)
    actions = [
        {"do": "set", "parameter": "planner", "value": name},
        {"do": "scenario", "planner": name},
        {"do": "evaluate", "planners": [name], "scenario": {"potholes": 3}},
        {"do": "find_worst", "planner": name},
    ]
    assert contract.dump(contract.load(actions)) == actions


@pytest.mark.parametrize("name", OLD)
def test_an_older_name_is_the_present_one(name: Any) -> None:
    new = canonical(name)
    assert Config(planner=name) == Config(planner=new)
    assert saved_config({"planner": name, "seed": 3}).planner == new
    assert planner_named(name) is planner_named(new)
    assert traits_of(name) == traits_of(new)
    assert config_to_actions(Config(planner=name)) == config_to_actions(Config(planner=new))
    batch = Batch([Config(seed=4, rows=8)], after="stop")
    assert batch.least(name)[0] == batch.least(new)[0]
    batch.run_to_end(name)
    timeline = Timeline(Config())
    timeline.apply(1, [Set(parameter="planner", value=name)])
    assert timeline.entries[0].action == Set(parameter="planner", value=name)  # as it was said
    assert timeline.state.config.planner == new
    assert Sayings.load().planner(name) == Sayings.load().planner(new)


@pytest.mark.parametrize("name", OLD)
async def test_an_older_name_is_good_in_every_request(service: Service, name: str) -> None:
    new = canonical(name)
    for body in ({"planner": name}, {"config": {"planner": name}}):
        path = await service.session(paused=True, **body)
        assert (await service.state(path))["planner"] == new
    patched = await service.client.patch(f"{path}/config", json={"planner": name})
    assert patched.json()["changes"] == []  # it is so already
    await service.act(path, {"do": "set", "parameter": "planner", "value": "rules"})
    patched = await service.client.patch(f"{path}/config", json={"planner": name})
    assert {each["after"] for each in patched.json()["changes"]} == {new}
    done = await service.act(path, {"do": "scenario", "planner": name, "potholes": 2})
    assert done.status_code == 200
    assert (await service.state(path))["planner"] == new
    await service.act(path, {"do": "step", "ticks": 3})
    recording = (await service.client.get(f"{path}/recording")).json()
    assert name in str(recording["entries"])
    again = await service.session(recording=recording, seed=None)
    assert (await service.state(again))["digest"] == (await service.state(path))["digest"]


@pytest.mark.parametrize(
    "text", ["use the exact planner", "use the quickest planner", "use bfs", "switch to breadth first search"]
)
def test_it_is_understood_by_either_name(language: Language, text: str) -> None:
    parse = language.parse(text)
    assert isinstance(parse, Understood)
    assert contract.dump(parse.actions) == [{"do": "set", "parameter": "planner", "value": "bfs"}]


@pytest.mark.parametrize("name", OLD)
def test_what_was_done_by_an_older_name_can_be_said(language: Language, name: str) -> None:
    told = language.sentence(contract.load([{"do": "set", "parameter": "planner", "value": name}]))
    parse = language.parse(told)
    assert isinstance(parse, Understood)
    assert contract.dump(parse.actions)[0]["value"] == canonical(name)


def test_a_planner_is_checked_by_an_older_name() -> None:
    done = CliRunner().invoke(cli, ["check-planner", "exact", "--seconds", "1"])
    assert "There is no planner" not in done.output
    assert "bfs: " in done.output
