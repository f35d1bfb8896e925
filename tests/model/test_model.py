"""Short walks of fixed seeds; `python -m tools.model_walks` takes as many as one likes, shortened if wrong.

With `--real` it walks on a process that is killed, which takes too long for every day.
"""

from __future__ import annotations

import json

import pytest

from service.actions import Undo
from service.grammar import Language
from sim.actions import Add, Where
from sim.config import Config
from tests.model.compare import DifferenceError
from tests.model.plain import Plain, RefusedError
from tests.model.plan import Op, walk
from tests.model.shrinking import kind, shrunk
from tests.model.walking import walked

STEPS = 40


@pytest.fixture(scope="module")
def language() -> Language:
    return Language.load()


@pytest.mark.parametrize("seed", range(1, 9))
async def test_the_service_is_what_the_model_is(seed: int, language: Language) -> None:
    """Every other one with small limits, so that a short walk comes to what else only a long one does."""
    done = await walked(walk(seed, STEPS), language, small_ones=seed % 2 == 0)
    assert done.done == STEPS + 2
    assert done.judge.ticks > 0


def test_a_walk_is_plain_values_and_the_same_every_time() -> None:
    ops = walk(7, 100)
    assert ops == walk(7, 100)
    assert ops != walk(8, 100)
    assert json.loads(json.dumps(ops)) == [list(op) for op in json.loads(json.dumps(ops))]


def test_walks_come_by_all_rules() -> None:
    """Those of before and of today, and each of them changed alone."""
    made = [op[1] for seed in range(40) for op in walk(seed, 20) if op[0] == "make"]
    told = {
        (name, config.get(name))
        for config in made
        for name in ("rules", "collision", "repetition", "attentive")
    }
    assert {
        ("rules", 1),
        ("rules", None),
        ("collision", "cell"),
        ("repetition", False),
        ("attentive", 0.5),
    } <= told
    assert {config.get("planner") for config in made} >= {None, "rules", "priority", "astar"}
    assert len({config.get("layout") for config in made}) > 4


async def test_a_difference_is_found_and_made_short(
    language: Language, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Were an undo to take back all there is, a walk would show it, in a few steps."""
    whole = Plain.said

    def forgetful(plain: Plain, actions: tuple[object, ...], text: str | None) -> Plain:
        after = whole(plain, actions, text)  # type: ignore[arg-type]
        if any(isinstance(action, Undo) for action in actions):
            after.done = ()
        return after

    monkeypatch.setattr(Plain, "said", forgetful)
    add = [{"do": "add", "kind": "pothole", "count": 1}]
    config = {"seed": 3, "columns": 5, "rows": 8}
    ops: list[Op] = [
        ("make", config, False),
        ("make", config, False),
        ("act", 1, add, "typed"),
        ("act", 0, add, "typed"),
        ("look", 0, 0.5),
        ("act", 0, [*add, {"do": "pause"}], "said"),
        ("act", 0, [{"do": "undo"}], "typed"),
        ("kill",),
    ]

    async def tried(part: list[Op]) -> str | None:
        try:
            await walked(part, language, small_ones=False)
        except DifferenceError as difference:
            return str(difference)
        return None

    found = await tried(ops)
    assert found is not None
    assert kind(found) == "state undo at tick #"
    short = await shrunk(ops, tried)
    assert [op[0] for op in short] == ["make", "act", "act", "act"]


def test_the_model_undoes_and_does_again() -> None:
    """The model by itself, on what anyone can follow."""
    plain = Plain(Config(seed=3, potholes=2))
    add = Add(kind="pothole", count=3)
    said = plain.said((add,), "add three potholes")
    assert (said.run.world.counts()["pothole"], said.sequence, len(said.done)) == (5, 1, 1)
    said.pass_ticks(2)
    undone = said.said((Undo(),), None)
    assert (undone.run.world.counts()["pothole"], undone.tick, len(undone.undone)) == (2, 2, 1)
    assert said.run.world.counts()["pothole"] == 5
    with pytest.raises(RefusedError):
        undone.said((Undo(),), None)


def test_the_model_tells_of_a_road_without_a_way_and_of_its_opening() -> None:
    plain = Plain(Config(seed=4, rows=6, columns=3, vehicles=0, potholes=0))
    plain.look(plain.run)
    assert plain.lines == ()
    wall = tuple(Add(kind="barrier", count=1, where=Where(cell=(column, 2))) for column in range(3))
    closed = plain.said(wall, None)
    assert [line.type for line in closed.lines] == ["changed", "no_way"]
    assert len(closed.lines[-1].ids) == 1
    assert [line.type for line in closed.said((Undo(),), None).lines][2:] == ["changed", "way_open"]
    closed.wake()
    assert [line.type for line in closed.lines] == ["changed", "no_way"]
