"""Evaluations under several conditions: each is what it would be alone, whatever the parts."""

from __future__ import annotations

import json

import numpy as np
import pytest

from sim.config import Config
from sim.evaluate import Evaluation, EvaluationError
from sim.evaluate.cases import MAX_CASES, cases_of, problems_of
from sim.evaluate.run import evaluate, pack_part, summarize_parts
from sim.evaluate.spec import MAX_EPISODES
from sim.world.notation import write


def weathers(episodes: int = 24, **config: object) -> Evaluation:
    return Evaluation(
        planners=("rules", "priority"),
        episodes=episodes,
        seed=4,
        config=Config(sensor="camera", **config),  # type: ignore[arg-type]
        cases=cases_of({"weather": ("clear", "fog")}),
    )


def test_each_condition_is_what_it_is_alone_and_together_they_are_added_up() -> None:
    spec = weathers()
    found = evaluate(spec)
    assert found is not None
    assert found["episodes"] == 48
    for number, (weather, case) in enumerate(zip(("clear", "fog"), found["cases"], strict=True)):
        alone = Evaluation(
            planners=spec.planners, episodes=24, seed=4, config=Config(sensor="camera", weather=weather)
        )
        expected = evaluate(alone)
        assert expected is not None
        examples = [each for each in found["examples"] if each["case"] == number]
        assert [{**each, "case": number} for each in expected.pop("examples")] == examples
        assert case == {"said": {"weather": weather}, **expected}
    for planner in spec.planners:
        counts = [case["planners"][planner]["arrived"]["count"] for case in found["cases"]]
        assert found["planners"][planner]["arrived"]["count"] == sum(counts)
        near = [case["planners"][planner]["close"]["near_misses"]["count"] for case in found["cases"]]
        assert found["planners"][planner]["close"]["near_misses"]["count"] == sum(near)
        effect = next(each for each in found["effects"] if each["planner"] == planner)
        assert effect["difference"]["share"] == pytest.approx((counts[1] - counts[0]) / 24)


def test_parts_in_any_order_and_by_json_give_the_same() -> None:
    spec = weathers()
    parts = {part: pack_part(spec.to_json(), part, lambda: False) for part in reversed(spec.parts())}
    assert sum(part.count for part in parts) == spec.total
    found = summarize_parts(spec, parts, lambda: False)
    assert json.loads(json.dumps(found)) == json.loads(json.dumps(evaluate(spec)))
    assert Evaluation.from_json(json.loads(json.dumps(spec.to_json()))) == spec


def test_an_evaluation_stored_before_there_were_conditions_is_read() -> None:
    spec = Evaluation(planners=("rules",), episodes=5)
    old = spec.to_json()
    del old["cases"]
    assert Evaluation.from_json(old) == spec


def test_combinations_and_traffic() -> None:
    cases = cases_of({"traffic": ("light", "heavy"), "weather": ("clear", "rain", "clear")})
    assert [dict(case.said) for case in cases] == [
        {"weather": weather, "traffic": traffic}
        for weather in ("clear", "rain")
        for traffic in ("light", "heavy")
    ]
    spec = Evaluation(planners=("rules",), episodes=2, cases=cases)
    assert [spec.under(number).config.spawn_probability for number in (0, 1)] == [0.34, 0.9]
    assert spec.under(3).config.weather == "rain"


def test_what_cannot_be_is_refused() -> None:
    assert problems_of({"colour": ("red", "blue")})
    assert problems_of({"potholes": tuple(range(MAX_CASES + 1))})
    for cases, world, episodes, field in (
        ({"weather": ("clear", "hail")}, None, 2, "weather"),
        ({"weather": ("clear", "fog")}, None, MAX_EPISODES // 2 + 1, "episodes"),
        ({"potholes": (1, 2)}, write(Evaluation(planners=("rules",), episodes=1).start(0, "rules").world), 2,
         "conditions"),
    ):  # fmt: skip
        with pytest.raises(EvaluationError) as refused:
            Evaluation(planners=("rules",), episodes=episodes, cases=cases_of(cases), world=world)
        assert [each.field for each in refused.value.problems] == [field]


def test_every_figure_has_an_episode_behind_it() -> None:
    found = evaluate(Evaluation(planners=("astar", "rules"), episodes=30, seed=30))
    assert found is not None
    for planner, figures in found["planners"].items():
        own = [each for each in found["examples"] if each["planner"] == planner]
        shown = {name for each in own for name in each["shows"]}
        assert {"arrived", "slowest", "ttc", "gap"} <= shown
        assert len({each["index"] for each in own}) == len(own)
        slowest = next(each for each in own if "slowest" in each["shows"])
        assert slowest["ticks"] == max(tick for tick, _ in figures["ticks"])
        middle = next(each for each in own if "arrived" in each["shows"])
        ticks = np.repeat([tick for tick, _ in figures["ticks"]], [count for _, count in figures["ticks"]])
        assert middle["ticks"] == ticks[(len(ticks) - 1) // 2]
        assert all(0 <= each["tick"] <= each["ticks"] for each in own)
