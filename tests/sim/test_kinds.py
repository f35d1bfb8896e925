"""Every kind of the table can be written, saved, told apart, checked, foreseen and explained.

The tests know no kind by name: a new row of the table is tested by being there.
"""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import fields, replace
from typing import get_args

import pytest
from hypothesis import given, settings

from sim.actions import Add, PlaceableKind, Remove, Scenario, Where
from sim.config import COUNTS, Config
from sim.explain.why_causes import explain_why
from sim.forecast import Forecast, StepVerdict
from sim.generation import generate
from sim.perceive import perceive
from sim.plan.sandbox import codec
from sim.repetition import Watch, situation
from sim.rules.collision_geometry import clearance
from sim.rules.mover_boards import PERIODS
from sim.session.edits import apply
from sim.session.serialization import Packer, Unpacker
from sim.state import SimState
from sim.transition import step
from sim.types import HAZARDS, KINDS, MARKED, MOVERS, PLACEABLE, Kind
from sim.validation import validate_world
from sim.world import World, notation
from sim.world.boards import Boards
from sim.world.grid import bits
from tests.support import twin
from tests.support.roads import road, run_on, worlds

every_kind = pytest.mark.parametrize("kind", PLACEABLE)


roomy = worlds().filter(lambda world: world.road.between & ~world.occupied)
"""Roads with a free cell between start and goal."""


def with_one(world: World, kind: Kind) -> World:
    """The world with one thing of a kind more."""
    free = list(bits(world.road.between & ~world.occupied))
    cell = world.road.cell(free[len(free) // 2])
    added = apply(run_on(world), Add(kind=kind.value, count=1, where=Where(cell=cell)))  # type: ignore[arg-type]
    return added.state.world


def saved(state: SimState) -> SimState:
    """The state written to JSON and read back."""
    packer = Packer()
    number = packer.run(state)
    found: SimState = Unpacker(json.loads(json.dumps(packer.packed()))).runs[number]
    return found


def test_the_table_is_whole() -> None:
    assert set(KINDS) == set(Kind)
    assert set(get_args(PlaceableKind)) == {*PLACEABLE, Kind.AV}
    assert {*COUNTS.values()} <= {field.name for field in fields(Scenario)}
    signs = Counter(sign for spec in KINDS.values() for sign in spec.signs)
    assert set(signs.values()) == {1}
    assert all(len(sign) == 1 and sign not in ". " for sign in signs)
    assert len({spec.plural for spec in KINDS.values()}) == len(KINDS)
    assert PERIODS[Kind.VEHICLE] == 1, "a mover on no board moves every tick"


@every_kind
def test_its_row_fits_what_it_does(kind: Kind) -> None:
    spec = KINDS[kind]
    assert kind.moves is not kind.fixed
    assert len(spec.signs) == (4 if kind.moves else 1)
    assert spec.period is None or spec.period >= 1
    assert not (kind.moves and spec.holds_movers)
    assert clearance(Kind.AV, kind) >= 0
    assert spec.probability is None or hasattr(Config(), spec.probability)


@pytest.mark.parametrize("kind", COUNTS)
def test_an_exact_number_of_them_is_on_a_new_road(kind: Kind) -> None:
    config = Config(seed=5).with_parts(**{COUNTS[kind]: 3})
    world = generate(config, 1)
    assert world.count(kind) == 3
    assert validate_world(world) == ()


@every_kind
@settings(max_examples=25, deadline=None)
@given(world=roomy)
def test_it_is_written_and_read(kind: Kind, world: World) -> None:
    world = with_one(world, kind)
    assert notation.read(notation.write(world)) == world
    state = run_on(world).with_ego(watch=Watch(situation(world), 1, 2))
    assert saved(state) == state
    percept, _ = perceive(world, state.config)
    assert codec.parse_question(codec.question(percept, state.config)) == (percept, state.config)


@every_kind
@settings(max_examples=25, deadline=None)
@given(world=roomy)
def test_the_digest_sees_it(kind: Kind, world: World) -> None:
    one = with_one(world, kind)
    digests = {world.digest(), one.digest()}
    assert len(digests) == 2
    name = next(thing.id for thing in one.things() if world.find(thing.id) is None)
    assert one.without([name]).digest() == world.digest()
    place = one.index_of(name)
    assert place is not None
    if kind.moves:
        turned = replace(one, right=one.right ^ 1 << place[0], left=one.left ^ 1 << place[0])
        assert turned.digest() not in digests
    for other in HAZARDS if kind.fixed else MARKED:
        if other is not kind:
            boards = {each: one.boards[each] & ~(1 << place[0]) for each in (*HAZARDS, *MARKED)}
            boards[other] |= 1 << place[0]
            assert replace(one, boards=Boards.of(boards)).digest() not in digests


@every_kind
@settings(max_examples=25, deadline=None)
@given(world=roomy)
def test_it_is_found_where_it_cannot_be(kind: Kind, world: World) -> None:
    one = with_one(world, kind)
    assert validate_world(one) == ()
    name = next(thing.id for thing in one.things() if world.find(thing.id) is None)
    place = one.index_of(name)
    assert place is not None
    cell, off = place[0], one.road.columns * one.road.rows + 3

    def codes(**parts: object) -> set[str]:
        return {defect.code for defect in validate_world(replace(one, **parts))}  # type: ignore[arg-type]

    assert "vehicle_in_something" in codes(avs=(cell,))
    table = "movers" if kind.moves else "hazards"
    stranger = next(other for other in (MOVERS if kind.moves else HAZARDS) if other is not kind)
    renamed = {**getattr(one, table), cell: f"{stranger}-1"}
    assert "wrong_kind" in codes(**{table: renamed})
    assert f"{table[:-1]}_without_id" in codes(**{table: {}})
    if kind is not Kind.VEHICLE:
        stray = one.boards.with_kind(kind, one.boards[kind] | 1 << off)
        assert f"{KINDS[kind].plural}_off_road" in codes(boards=stray)
    if kind in MARKED:
        assert f"{kind}_without_heading" in codes(right=0, left=0)
    if kind.fixed and not KINDS[kind].holds_movers:
        assert f"mover_in_{kind}" in codes(right=one.right | 1 << cell)


@pytest.mark.parametrize("kind", MOVERS)
@settings(max_examples=25, deadline=None)
@given(world=roomy)
def test_it_is_foreseen_where_the_twin_moves_it(kind: Kind, world: World) -> None:
    one = with_one(world, kind)
    horizon = 7
    forecast = Forecast.of_truth(one, run_on(one).config, horizon)
    now = twin.position(one)
    for ahead in range(horizon):
        now = replace(now, bodies=twin.moved_bodies(now), episode_tick=now.episode_tick + 1)
        cells = {one.road.index(body.cell): body.id for body in now.bodies}
        assert forecast.slices.movers(ahead) == cells
        marked = {
            other: {one.road.index(body.cell) for body in now.bodies if body.kind is other}
            for other in MARKED
        }
        boards = forecast.slices.boards(ahead)
        assert {other: set(bits(boards[other])) for other in MARKED} == marked


@every_kind
def test_it_is_in_the_way_and_named_as_the_cause(kind: Kind) -> None:
    """Walled in, it stays; the way past it is to the side."""
    signs = KINDS[kind].signs
    world = road("........", f"..#{signs[0]}#...", "...A....", "........")
    state = run_on(world, visible_rows=4)
    ahead = world.av - world.road.columns
    name = world.id_at(ahead, kind)
    verdict, ids = Forecast.of_truth(world, state.config, 1).check_step(world.av, ahead)
    assert ids == (name,)
    assert verdict is (StepVerdict.MOVER_STAYS if kind.moves else StepVerdict(kind.value))
    decision = step(state).decision
    assert decision is not None
    assert name in {cause.id for cause in explain_why(state, decision).causes}


@every_kind
def test_a_named_one_is_removed_again(kind: Kind) -> None:
    state = run_on(with_one(road("........", "........", "...A....", "........"), kind))
    gone = apply(state, Remove(kind=kind.value, count=1, where=Where(id=f"{kind}-1")))  # type: ignore[arg-type]
    assert gone.state.world.counts() == dict.fromkeys(PLACEABLE, 0)
    assert [(change.path, change.before, change.after) for change in gone.changes] == [
        (KINDS[kind].plural, 1, 0)
    ]
