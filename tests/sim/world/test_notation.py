"""Worlds survive being written and read; text that is no world is refused with the line named."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.config import Config
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Outcome
from sim.world import Cause, World, notation
from sim.world.notation import NotationError
from tests.support.roads import worlds

TEXT = """\
road 6x4 tick 12 episode 2 from 5 running
...o..
.>.#.]
..A(..
......
ids pothole 3 7, barrier 1, vehicle 9, pedestrian 2 4
next pothole 8, barrier 2, vehicle 21, pedestrian 5
"""


def test_a_road_is_read_as_it_is_drawn() -> None:
    world = notation.read(TEXT)
    assert (world.road.columns, world.road.rows) == (6, 4)
    assert (world.tick, world.episode, world.episode_start, world.episode_tick) == (12, 2, 5, 7)
    assert (world.outcome, world.ended, world.cause) == (Outcome.RUNNING, None, None)
    assert [(thing.id, thing.cell, thing.heading, thing.disabled) for thing in world.things()] == [
        ("pothole-3", (3, 0), None, False),
        ("pothole-7", (5, 1), None, False),
        ("barrier-1", (3, 1), None, False),
        ("vehicle-9", (1, 1), "right", False),
        ("pedestrian-2", (5, 1), "right", True),
        ("pedestrian-4", (3, 2), "left", False),
    ]
    assert world.numbered == {Kind.POTHOLE: 7, Kind.BARRIER: 1, Kind.VEHICLE: 20, Kind.PEDESTRIAN: 4}
    assert notation.write(world) == TEXT


def test_without_ids_things_are_numbered_in_reading_order() -> None:
    world = notation.read("road 3x3 tick 0 episode 1 from 0 running\n.o.\no.>\n.A.\n")
    assert sorted(world.hazards.items()) == [(1, "pothole-1"), (3, "pothole-2")]
    assert world.numbered == {Kind.POTHOLE: 2, Kind.VEHICLE: 1}


def test_indented_text_is_read_as_well() -> None:
    assert notation.read("\n" + "\n".join("    " + line for line in TEXT.splitlines())) == notation.read(TEXT)


@settings(max_examples=150)
@given(worlds(), st.data())
def test_reading_what_was_written_gives_an_equal_world(world: World, data: st.DataObject) -> None:
    if data.draw(st.booleans()):
        cells = world.road.columns * world.road.rows
        avs = data.draw(st.lists(st.integers(0, cells - 1), min_size=1, max_size=3))
        world = replace(world, avs=tuple(avs))
    if data.draw(st.booleans()):
        outcome = data.draw(st.sampled_from([Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK]))
        world = replace(world, outcome=outcome, ended=data.draw(st.integers(0, world.tick)))
        if outcome is Outcome.CRASH:
            ids = ("av-1", "av-2") if data.draw(st.booleans()) else ("pothole-3",)
            kind = Kind.AV if len(ids) == 2 else Kind.POTHOLE
            cause = Cause(data.draw(st.sampled_from(["hit", "swap"])), kind, ids, (1, 2))
            world = replace(world, cause=cause)
    text = notation.write(world)
    assert notation.read(text) == world
    assert notation.write(notation.read(text)) == text


@pytest.mark.parametrize("seed", range(6))
def test_every_state_of_a_session_round_trips(seed: int) -> None:
    state = SimState.start(Config(seed=seed, columns=5, rows=9, potholes=12, pedestrians=4, barriers=2))
    ends = set()
    for _ in range(160):
        assert notation.read(notation.write(state.world)) == state.world
        ends.add(state.world.outcome)
        state = step(state).state
    assert len(ends) > 1


def changed(number: int, line: str | None) -> str:
    """The text with line `number` (from 1) replaced, or taken out."""
    lines = TEXT.splitlines()
    lines[number - 1 : number] = [] if line is None else [line]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "line 1"),
        ("   \n", "line 1"),
        (changed(1, "road 6by4 tick 12 episode 2 from 5 running"), "line 1"),
        (changed(1, "road 6x4 tick 12 episode 2 from 5 flying"), "line 1"),
        (changed(1, "road 6x4 tick -1 episode 2 from 5 running"), "line 1"),
        (changed(1, "road 0x4 tick 12 episode 2 from 5 running"), "line 1"),
        (changed(1, "road 6x0 tick 12 episode 2 from 5 running"), "line 1"),
        (changed(1, "road 6x4 tick 12 episode 2 from 13 running"), "line 1"),
        (changed(1, "road 6x4 tick 12 episode 2 from 5 crash"), "line 1"),
        (changed(1, "road 6x4 tick 12 episode 2 from 5 running at 9"), "line 1"),
        (changed(2, "...o."), "line 2"),
        (changed(3, ".>.#.]."), "line 3"),
        (changed(4, "..A?.."), "line 4"),
        ("\n".join(TEXT.splitlines()[:4]), "rows"),
        (changed(5, None), "line 5"),
        (changed(6, "dis pothole 3 7"), "line 6"),
        (changed(7, "ids pothole 3 7"), "line 7"),
        (changed(6, "ids pothole 3"), "'ids'"),
        (changed(6, "ids pothole 3 7, vehicle 1 2"), "'ids'"),
        (changed(6, "ids tree 3 7"), "tree"),
        (changed(6, "ids pothole three 7"), "three"),
        (changed(6, "ids pothole 3 3, barrier 1, vehicle 9, pedestrian 2 4"), "pothole"),
        (changed(7, "next pothole"), "pothole"),
        (changed(7, "next pothole 8 9"), "pothole"),
        (changed(7, "next pothole 4, barrier 2, vehicle 21, pedestrian 5"), "pothole"),
        (changed(4, "...(.."), "autonomous vehicle"),
        (TEXT + "av here", "av here"),
        (TEXT + "av 1", "av 1"),
        (TEXT + "av 99,1", "99,1"),
        (TEXT + "av 2,2 99,1", "99,1"),
        (TEXT + "cause bang vehicle-9 at 1,1", "cause bang"),
        (TEXT + "cause hit tree-9 at 1,1", "tree-9"),
        (TEXT + "cause hit vehicle-9 at 77,1", "77,1"),
    ],
)
def test_text_that_is_no_world_is_refused_by_the_line(text: str, named: str) -> None:
    with pytest.raises(NotationError) as refused:
        notation.read(text)
    assert named in str(refused.value)


@settings(max_examples=300)
@given(st.data())
def test_damaged_text_is_a_world_or_a_notation_error(data: st.DataObject) -> None:
    """Whatever one character becomes, nothing but `NotationError` is raised, and nothing is half read."""
    spoilt = data.draw(st.integers(0, len(TEXT) - 1))
    letter = data.draw(st.sampled_from("0123456789 .o#><)(A,x\nat-é"))
    text = TEXT[:spoilt] + letter + TEXT[spoilt + 1 :]
    try:
        world = notation.read(text)
    except NotationError:
        return
    assert notation.read(notation.write(world)) == world
