"""Judges of how near others came: each works the gaps and times out anew from the recorded states."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby, pairwise
from math import hypot

from sim.state import SimState
from sim.transition import next_world
from sim.types import KINDS, Kind, Move, Outcome, kind_of
from sim.world import World
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.recorded_drives import Record, move_of

NEAR_M = 0.5
FAR_CELLS = 3
"""Only what begins a tick within so many cells of the ego is looked at for how near it comes."""


def gap_cells(before: World, after: World, id: str) -> float | None:
    """How near a mover came to the ego in a tick, body to body, by looking at many moments; 0 on contact."""
    was, now = before.find(id), after.find(id)
    if was is None or now is None or was.heading is None:
        return None
    start, end = before.road.cell(before.av), after.road.cell(after.av)
    if max(abs(was.cell[0] - start[0]), abs(was.cell[1] - start[1])) > FAR_CELLS:
        return None
    own, other = KINDS[Kind.AV].size, KINDS[was.kind].size
    wide, long = float(own.across + other.across) / 2, float(own.along + other.along) / 2

    def gap(time: float) -> float:
        apart = [
            abs(was.cell[axis] - start[axis]
                + time * (now.cell[axis] - was.cell[axis] - end[axis] + start[axis]))
            for axis in (0, 1)
        ]  # fmt: skip
        return hypot(max(0.0, apart[0] - wide), max(0.0, apart[1] - long))

    low, high = 0.0, 1.0
    for _ in range(60):  # the gap between two boxes in straight motion has one valley
        one, two = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, two) if gap(one) <= gap(two) else (one, high)
    return min(gap(0.0), gap(1.0), gap((low + high) / 2))


@lru_cache(maxsize=16)
def gaps(record: Record, kind: Kind | None = None) -> list[tuple[int, str, float]]:
    """Tick, id and metres of each passing in the present episode, without contacts."""
    found = []
    for before, after in pairwise(record.episode):
        for thing in before.world.things():
            if kind not in (None, thing.kind):
                continue
            apart = gap_cells(before.world, after.world, thing.id)
            if apart is not None and apart > 1e-9:
                found.append((before.world.tick, thing.id, apart * record.config.cell_m))
    return found


def misses(record: Record, kind: Kind | None = None) -> list[list[tuple[int, str, float]]]:
    """Near misses; each is the passings of one thing in ticks one after the other."""
    close: dict[str, list[tuple[int, str, float]]] = {}
    for each in gaps(record, kind):
        if each[2] < NEAR_M - 1e-9:
            close.setdefault(each[1], []).append(each)
    found = []
    for passings in close.values():
        for _, run in groupby(enumerate(passings), key=lambda each: each[1][0] - each[0]):
            found.append([one for _, one in run])
    return sorted(found, key=lambda run: run[0][0])


def near_misses(told: Told) -> Iterator[str]:
    kind = told.thing_kind
    if not told.has("near_misses") or not told.record.driven or not (kind is None or kind.moves):
        return
    found = misses(told.record, told.thing_kind)
    yield from differ("near misses", len(told["near_misses"]), len(found))
    count = told.between(r"^(?:Yes: )?(\d+|One|No) near miss")
    least = sorted(round(min(each[2] for each in run), 2) for run in found)
    said = sorted(round(each["gap_m"], 2) for each in told["near_misses"])
    if len(said) == len(least) and any(abs(a - b) > 0.011 for a, b in zip(said, least, strict=True)):
        yield f"gaps: {said}, not {least}"
    if count is None and len(found) > 1 and not told.text.startswith(str(len(found))):
        yield f"said otherwise than {len(found)}"
    if not found and not told.text.startswith("No near miss"):
        yield "said of none"


def closest_call(told: Told) -> Iterator[str]:
    if not told.has("closest_call") or not told.record.driven or told.kind == "second_call":
        return
    call, found = told["closest_call"], gaps(told.record, told.thing_kind)
    if call is None or not found:
        if (call is None) != (not found):
            yield f"call {call}, not {found[:3]}"
        return
    least = min(each[2] for each in found)
    yield from near("gap", call["gap_m"], least, 1e-4)
    if not any(
        each[0] == call["tick"] and each[1] == call["id"] and each[2] < least + 1e-4 for each in found
    ):
        yield "another thing or tick"
    said = told.between(r"near as (\d+(?:\.\d+)?) m")
    if said is not None:
        yield from near("gap said", said[0], least, 0.051 if least >= 1 else 0.0051)


def move_risk(told: Told) -> Iterator[str]:
    if not told.has("at_tick"):
        return
    record, tick = told.record, told["at_tick"]
    before, after = record.states[tick], record.states[tick + 1]
    if before.config.slip_probability and before.config.weather == "snow":
        return
    yield from differ("move", told["made"], str(move_of(record, tick)))
    free = []
    for move in Move:
        column, row = before.world.road.cell(before.world.av)
        to = column + move.offset[0], row + move.offset[1]
        if 0 <= to[0] < before.world.road.columns and to[1] >= 0:
            then = next_world(before.world, (move,), before.config)
            if then.outcome is not Outcome.CRASH:
                free.append(str(move))
    yield from listed("free moves", sorted(told["free"]), sorted(free))
    yield from differ(
        "crashed", told["crashed"], after.world.ended is not None and after.world.outcome is Outcome.CRASH
    )
    said = told.between(r"(\d+) of (\d+) moves")
    if said is not None:
        yield from listed("moves said", said, [len(free), len(told["tried"])])
    found = [
        (gap * before.config.cell_m, thing.id)
        for thing in before.world.things()
        if (gap := gap_cells(before.world, after.world, thing.id)) is not None and gap > 1e-9
    ]
    if told["nearest"] is not None and found and not told["crashed"]:
        yield from near("nearest", told["nearest"]["gap_m"], min(found)[0], 1e-4)
    if not told["crashed"]:
        close = bool(found) and min(found)[0] < NEAR_M - 1e-9
        if close is not told.text.startswith("A near miss"):
            yield f"near miss said otherwise: {min(found)}"


def least_ttc(told: Told) -> Iterator[str]:
    """By small steps of time: how long the motion of a tick leads to contact with what is ahead."""
    if not told.has("ttc_s"):
        return
    states = told.record.episode
    if told.record.outcome is Outcome.CRASH:
        states = states[:-1]
    least, ticks = None, 0
    for before, after in pairwise(states):
        times = [
            time for thing in before.world.things() if (time := _contact(before, after, thing.id)) is not None
        ]
        ticks += bool(times)
        if times and (least is None or min(times) < least - 1e-9):
            least = min(times)
    if least is None or told["ttc_s"] is None:
        yield from differ("ttc", told["ttc_s"], least)
    else:
        yield from near("ttc", told["ttc_s"], least, 0.02)
        said = told.between(r"(\d+(?:\.\d+)?) s, at tick (\d+)")
        if said is None or abs(said[0] - least) > 0.03:
            yield f"said {said}, not {least}"
    yield from differ("ticks", told["ticks"], ticks)


def _contact(before: SimState, after: SimState, id: str) -> float | None:
    """Seconds until the motion of a tick leads to contact with a thing ahead in the lane, if it does."""
    was, now = before.world.find(id), after.world.find(id)
    start, end = before.world.road.cell(before.world.av), after.world.road.cell(after.world.av)
    if was is None or was.cell[0] != start[0] or was.cell[1] >= start[1]:
        return None
    to = was.cell if now is None else now.cell
    own, other = KINDS[Kind.AV].size, KINDS[kind_of(id)].size
    reach = float(own.across + other.across) / 2, float(own.along + other.along) / 2
    for step in range(1, 12_800):
        time = step / 400
        apart = [
            was.cell[axis] - start[axis] + time * (to[axis] - was.cell[axis] - end[axis] + start[axis])
            for axis in (0, 1)
        ]
        if all(abs(apart[axis]) < reach[axis] for axis in (0, 1)):
            return time * before.config.step_seconds
        if (end, to) == (start, was.cell):
            return None
    return None


JUDGES: dict[str, Judge] = {
    "near_misses": near_misses,
    **dict.fromkeys(("closest_call", "closest_kind"), closest_call),
    "move_risk": move_risk,
    "least_ttc": least_ttc,
}
"""By kind of question."""
