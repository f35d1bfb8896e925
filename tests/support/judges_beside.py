"""Judges of a drive beside others, of what was late, of the best way and of the safest of the moves."""

from __future__ import annotations

from collections.abc import Iterator

from sim.decide import sense
from sim.explain.crash import is_detected
from sim.session.timeline import Timeline
from sim.types import Outcome
from tests.support.answer_judge import Judge, Told, differ
from tests.support.judges_of_futures import ENDS, MOST
from tests.support.recorded_drives import move_of

NEAR_ROWS, NEAR_LANES = 3, 1
LOOKED = 2
"""Other drives that are driven again for one answer."""


def typical(told: Told) -> Iterator[str]:
    """The first of the other drives are driven again, and those that went better are counted anew."""
    if not told.has("seeds", "rows_then", "here"):
        return
    record, here = told.record, told["here"]
    yield from differ("rows", here["rows"], record.cells[0][1] - record.cells[-1][1])
    for at, seed in enumerate(told["seeds"][:LOOKED]):
        timeline = Timeline(record.config.with_parts(seed=seed))
        while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < MOST:
            timeline.advance()
        if timeline.tick >= MOST:
            continue
        yield from differ(f"seed {seed}", told["outcomes"][at], ENDS[timeline.state.world.outcome])
        yield from differ(f"ticks of {seed}", told["ticks"][at], timeline.tick)
        worlds = [timeline.at(tick).world for tick in (0, min(here["ticks"], timeline.tick))]
        rows = [world.road.cell(world.av)[1] for world in worlds]
        yield from differ(f"rows of {seed}", told["rows_then"][at], rows[0] - rows[1])
    if record.outcome is Outcome.RUNNING:
        better = sum(rows > here["rows"] for rows in told["rows_then"])
    else:
        arrived = [
            ticks
            for ticks, outcome in zip(told["ticks"], told["outcomes"], strict=True)
            if outcome == ENDS[Outcome.SUCCESS]
        ]
        mine = here["ticks"] if record.outcome is Outcome.SUCCESS else float("inf")
        better = sum(ticks < mine for ticks in arrived)
    yield from differ("better", told["better"], better)


def late(told: Told) -> Iterator[str]:
    """What is said to be late was not detected the tick before, though ahead, and was near when it was."""
    if not told.has("late", "never"):
        return
    states = {state.world.tick: state for state in told.record.states}
    for each in told["late"]:
        for tick, detected in ((each["tick"] - 1, False), (each["tick"], True)):
            state = states[tick]
            thing = state.world.find(each["id"])
            if thing is None:
                yield f"{each['id']} is not there at {tick}"
                continue
            if is_detected(sense(state)[0], state.world, each["id"]) is not detected:
                yield f"{each['id']} at {tick}"
            column, row = state.world.road.cell(state.world.av)
            if detected and not (
                1 <= row - thing.cell[1] <= NEAR_ROWS and abs(thing.cell[0] - column) <= NEAR_LANES
            ):
                yield f"{each['id']} is not near at {tick}"
    if told.yes is not None:
        yield from differ("yes", told.yes, bool(told["late"]))


def best_way(told: Told) -> Iterator[str]:
    """The way is driven, and no drive of the record is quicker."""
    if not told.has("plan", "from") or told["plan"] is None:
        return
    record = told.record
    state = next(each for each in record.states if each.world.tick == told["from"])
    if state.config.mover_behaviour.draws(state.config) or state.config.slips:
        return
    rows = state.world.road.cell(state.world.av)[1]
    if len(told["plan"]) < rows:
        yield f"{len(told['plan'])} moves for {rows} rows"
    if record.outcome is Outcome.SUCCESS and not told["changed"] and record.driven < len(told["plan"]):
        yield f"driven in {record.driven}, best {len(told['plan'])}"


def chosen_safest(told: Told) -> Iterator[str]:
    """The move is the recorded one, and yes is said where it is among the safest."""
    if not told.has("at_tick", "made", "safest"):
        return
    yield from differ("yes", told.yes, told["made"] in told["safest"])
    if told["at_tick"] + 1 < len(told.record.states):
        yield from differ("made", told["made"], move_of(told.record, told["at_tick"]))


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(("typical", "hard_road"), typical),
    "late": late,
    **dict.fromkeys(("best_way", "best_lane", "best_way_here"), best_way),
    "chosen_safest": chosen_safest,
}
"""By kind of question."""
