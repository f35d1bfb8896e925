"""What is not detected, and what would not be there, come to the same with perfect sight."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from sim.perceive import NO_BELIEF, perceive, perceive_truth
from sim.types import Kind, kind_of, phantom_id
from sim.world import World
from tests.support.roads import run_on, worlds
from tests.support.sensors import with_pothole


@given(worlds(), st.data(), st.sampled_from([0.0, 0.5, 1.0]), st.sampled_from([0.0, 0.5, 1.0]))
def test_what_is_not_detected_is_as_if_it_were_not_there(
    world: World, data: st.DataObject, courtesy: float, attentive: float
) -> None:
    config = run_on(world, courtesy=courtesy, attentive=attentive).config
    names = [thing.id for thing in world.things()]
    gone = data.draw(st.sets(st.sampled_from(names))) if names else set()
    percept = perceive_truth(world, config)
    assert percept.without(gone) == perceive_truth(world.without(gone), config)
    assert percept.keeping(gone) == perceive_truth(world.keeping(gone), config)
    assert perceive(world, config) == (percept, NO_BELIEF)


@given(worlds())
def test_things_are_found_in_a_percept_as_in_the_world(world: World) -> None:
    percept = perceive_truth(world, run_on(world).config)
    assert {thing.id: thing for thing in percept.things()} == {thing.id: thing for thing in world.things()}
    for name in ("pothole-999", "pothole-p1", "elephant", "av-1"):
        assert percept.find(name) is None
    for thing in world.things():
        assert percept.find(thing.id) == thing


@given(worlds(), st.data())
def test_a_phantom_is_seen_and_never_in_the_world(world: World, data: st.DataObject) -> None:
    percept = perceive_truth(world, run_on(world).config)
    index = data.draw(st.integers(0, world.road.columns * world.road.rows - 1))
    imagined = with_pothole(percept, index, 7)
    name = phantom_id(Kind.POTHOLE, 7)
    assert kind_of(name) is Kind.POTHOLE
    assert world.find(name) is None
    if imagined is percept:
        assert world.occupied >> index & 1
        return
    found = imagined.find(name)
    assert found is not None
    assert (found.kind, found.cell) == (Kind.POTHOLE, world.road.cell(index))
    assert imagined.without([name]) == percept
