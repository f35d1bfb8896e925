"""Judges of what was seen, believed and really there, by the percepts of the recorded states."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from functools import lru_cache

from sim.decide import sense
from sim.perceive import Percept
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.recorded_drives import Record


@lru_cache(maxsize=2_000)
def _seen(record: Record, tick: int) -> Percept:
    return sense(record.states[tick])[0]


def things_of(state: SimState) -> list[Thing]:
    """Everything on the road but the ego."""
    return [each for each in state.world.things() if each.kind is not Kind.AV]


def believed(record: Record, tick: int) -> dict[str, tuple[Kind, tuple[int, int]]]:
    """What is seen at a tick: kind and cell by id."""
    percept = _seen(record, tick)
    columns = percept.road.columns
    found = {}
    for table in (percept.hazards, percept.movers):
        for cell, id in table.items():
            found[id] = Kind(id.rpartition("-")[0]), (cell % columns, cell // columns)
    return {id: each for id, each in found.items() if each[0] is not Kind.AV}


def detected(record: Record, tick: int) -> dict[str, Thing]:
    """What is seen in the very cell it is in."""
    seen = believed(record, tick)
    return {
        each.id: each
        for each in things_of(record.states[tick])
        if seen.get(each.id) == (each.kind, each.cell)
    }


def _row(record: Record, tick: int) -> int:
    world = record.states[tick].world
    return world.road.cell(world.av)[1]


@lru_cache(maxsize=16)
def _first_seen(record: Record) -> dict[str, tuple[int, int]]:
    """By id: the tick at which it was first detected in this drive, and rows ahead then."""
    found: dict[str, tuple[int, int]] = {}
    for tick in range(record.first, record.last + 1):
        for id, thing in detected(record, tick).items():
            found.setdefault(id, (tick, _row(record, tick) - thing.cell[1]))
    return found


def sightings(told: Told) -> Iterator[str]:
    if not told.has("sightings"):
        return
    record, first = told.record, _first_seen(told.record)
    said = {
        each["id"]: (each["first_seen"], each["rows_ahead"])
        for each in told["sightings"]
        if each["first_seen"] is not None
    }
    yield from differ(
        "first seen",
        {k: said[k] for k in sorted(said)},
        {k: first[k] for k in sorted(first) if k in said or k in {e["id"] for e in told["sightings"]}},
    )
    every = {
        each.id: each.kind
        for tick in range(record.first, record.last + 1)
        for each in things_of(record.states[tick])
    }
    kind = told.thing_kind if told.kind == "sighted_kind" else None
    named = [id for id, each in every.items() if kind in (None, each)]
    rate = told.between(r"Of (\d+) .*? in this drive I have detected (\d+)")
    if rate is not None:
        yield from listed("rate", rate, [len(named), sum(id in first for id in named)])
    mean = told.between(r"it was (-?\d+(?:\.\d+)?) m ahead on average")
    if mean is not None and not kind:
        every_row = [first[id][1] for id in named if id in first]
        rows = [each for each in every_row if each > 0]
        yield from near("mean", mean[0], sum(rows) / len(rows) * record.config.cell_m, 0.51)
        counted = told.between(r"counting the (\d+) of (\d+)")
        if len(rows) < len(every_row) and counted != [len(rows), len(every_row)]:
            yield f"mean of {len(rows)} of {len(every_row)}"
    begun = told.between(r"^The first was .*? at tick (\d+)")
    if begun is not None:
        yield from differ("first tick", begun[0], min(first[id][0] for id in named if id in first))
    latest = told.between(r"^The last that I noticed was .*? at tick (\d+)")
    if latest is not None:
        yield from differ("last tick", latest[0], max(first[id][0] for id in named if id in first))
    if told.kind == "overlooked":
        passed = _passed(record)
        never = [id for id in passed if id not in first]
        if told.yes is not None:
            yield from differ("yes", told.yes, bool(never))
        count = told.between(r"^Yes, (\d+) of (\d+) things")
        if count is not None:
            yield from listed("overlooked", count, [len(never), len(passed)])
    if told.kind == "lost_sight":
        lost = {}
        for tick in range(record.first, record.last + 1):
            there = detected(record, tick)
            for each in things_of(record.states[tick]):
                if (
                    each.id not in there
                    and each.id in first
                    and first[each.id][0] < tick
                    and each.cell[1] < _row(record, tick)
                ):
                    lost.setdefault(each.id, tick)
        if told.yes is not None:
            yield from differ("yes", told.yes, bool(lost))


def _passed(record: Record) -> list[str]:
    """What is behind now, having been ahead."""
    ahead, row = set(), _row(record, record.last)
    for tick in range(record.first, record.last + 1):
        ahead |= {each.id for each in things_of(record.states[tick]) if each.cell[1] < _row(record, tick)}
    return [
        each.id for each in things_of(record.states[record.last]) if each.cell[1] > row and each.id in ahead
    ]


def noticed(told: Told) -> Iterator[str]:
    if not told.has("new", "gone"):
        return
    tick = int(told.slots["tick"]) if "tick" in told.question else told.record.timeline.tick
    was, now = detected(told.record, tick - 1), detected(told.record, tick)
    yield from listed("new", sorted(told["new"]), sorted(set(now) - set(was)))
    there = {each.id for each in things_of(told.record.states[tick])}
    yield from listed("gone", sorted(told["gone"]), sorted((set(was) - set(now)) & there))


NOUNS = (
    ("potholes?", Kind.POTHOLE),
    ("barriers?", Kind.BARRIER),
    ("cars?", Kind.VEHICLE),
    ("pedestrians?", Kind.PEDESTRIAN),
)


def _missed_of_kind(told: Told, there: Sequence[Thing], missed: Collection[str]) -> Iterator[str]:
    """How many things of the kind asked about are there, and are not detected."""
    kind = told.thing_kind
    if kind is None:
        if len(missed) > 1:
            yield f"misses {len(missed)}"
        return
    noun = next(noun for noun, each in NOUNS if each is kind)
    of_kind = [each.id for each in there if each.kind is kind]
    gone = len({*of_kind} & {*missed})
    said = told.between(rf"Of (\d+) {noun} I do not detect (\d+)")
    all_seen = told.between(rf"of the {noun} on the road I detect all (\d+)")
    if said is not None:
        yield from listed("said", said, [len(of_kind), gone])
    elif all_seen is not None:
        yield from listed("said", [*all_seen, 0], [len(of_kind), gone])
    elif gone and not (gone == 1 and "I do not detect one" in told.text):
        yield f"misses {gone}"


def truth(told: Told) -> Iterator[str]:
    if not told.has("missed", "things"):
        return
    record, now = told.record, told.record.timeline.tick
    there, seen = things_of(record.state), detected(record, now)
    missed = sorted(each.id for each in there if each.id not in seen)
    yield from listed("missed", sorted(told["missed"]), missed)
    yield from differ("things", told["things"], len(there))
    said = told.between(r"Of (\d+) things I do not detect (\d+)")
    if said is not None:
        yield from listed("said", said, [len(there), len(missed)])
    elif told.kind == "missed":
        yield from _missed_of_kind(told, there, missed)
    if told.kind == "belief":
        counts = Counter(each.kind for each in there)
        for noun, kind in NOUNS:
            count = told.between(rf"there (?:are|is) [^.]*?(\d+) {noun}\b[^.]*on the road")
            if count is not None:
                yield from differ(f"count of {kind}", count[0], counts[kind])
    if told.kind == "phantom":
        cells = {each.id: (each.kind, each.cell) for each in there}
        wrong = [id for id, each in believed(record, now).items() if cells.get(id) != each]
        if not wrong and not told.text.startswith(("Nothing", "No")):
            yield "no phantom"
        if wrong and told.text.startswith("Nothing"):
            yield f"phantoms {wrong}"


def sensor_errors(told: Told) -> Iterator[str]:
    if not told.has("ticks", "right", "imagined") or told["ticks"] == told["right"]:
        return
    record = told.record
    imagined = 0
    for tick in range(record.first, record.last + 1):
        cells = {each.id: (each.kind, each.cell) for each in things_of(record.states[tick])}
        imagined += any(cells.get(id) != each for id, each in believed(record, tick).items())
    yield from listed("ticks", [told["ticks"], told["imagined"]], [record.driven + 1, imagined])
    yield from differ("yes", told.yes, told["right"] < told["ticks"])


def by_device(told: Told) -> Iterator[str]:
    if not told.has("things") or told["what"] != "by_device":
        return
    world = told.record.state.world
    row = world.road.cell(world.av)[1]
    there = [each.id for each in things_of(told.record.state) if each.cell[1] <= row]
    yield from listed("things", sorted(each["id"] for each in told["things"]), sorted(there))
    devices = [each["devices"] for each in told["things"]]
    said = told.between(r"of (\d+) things? .*?: camera (\d+), lidar (\d+) and radar (\d+)")
    if said is not None:
        counts = [sum(name in each for each in devices) for name in ("camera", "lidar", "radar")]
        yield from listed("counts", said, [len(there), *counts])
    by = told.between(r"by all three (\d+), by two (\d+), by one (\d+), by none (\d+)")
    if by is not None:
        yield from listed("by", by, [sum(len(each) == many for each in devices) for many in (3, 2, 1, 0)])
    if told.kind == "sensors_disagree" and told.yes is not None:
        yield from differ("yes", told.yes, any(len(each) in (1, 2) for each in devices))
    alone = told.between(r"alone reports (\d+) of the (\d+)")
    if alone is not None:
        name = told.slots["sensor"]
        yield from listed("alone", alone, [sum(name in each for each in devices), len(there)])


def cell_taken(told: Told) -> Iterator[str]:
    if not told.has("cell", "really") or told["cell"] is None:
        return
    there = next(
        (each.kind for each in things_of(told.record.state) if list(each.cell) == list(told["cell"])), None
    )
    yield from differ("really", told["really"], there)


def cell_entered(told: Told) -> Iterator[str]:
    if not told.has("at", "really") or told["cell"] is None:
        return
    state = told.record.states[told["at"] + 1]
    there = next((each.kind for each in things_of(state) if list(each.cell) == list(told["cell"])), None)
    yield from differ("really", told["really"], there)
    said = told.between(r"with (\d+(?:\.\d+)?) %")
    if said is not None and told["taken"] is not None:
        share = 1 - told["taken"] if "free" in told.text.split("%")[0] else told["taken"]
        yield from near("share", said[0], 100 * share, 0.051)


def within(told: Told) -> Iterator[str]:
    if not told.has("seen"):
        return
    record, now, kind = told.record, told.record.timeline.tick, told.thing_kind or Kind.VEHICLE
    column, row = record.state.world.road.cell(record.state.world.av)
    found = {id: cell for id, (each, cell) in believed(record, now).items() if kind in (None, each)}
    if told.kind == "within_now":
        cells = 2 if "two cells" in told.question else int(told.slots["n"])
        near_by = [cell for cell in found.values() if max(abs(cell[0] - column), abs(cell[1] - row)) <= cells]
        said = told.between(r"^(\d+) within")
        if said is None and len(near_by) > 1:
            yield f"not said: {len(near_by)}"
        if said is not None:
            yield from differ("within", said[0], len(near_by))
        if not near_by and not re.match(r"^(No|None|I see no|0: )", told.text):
            yield "none is within"
    else:
        lanes = Counter(cell[0] + 1 for cell in found.values())
        most = max(lanes.values(), default=0)
        said = re.search(r"in lanes? ([\d, and]+): (\d+)(?: each)?,? of (\d+)", told.text)
        if said is not None:
            yield from listed(
                "lanes",
                re.findall(r"\d+", said[1]),
                [str(each) for each in sorted(lanes) if lanes[each] == most],
            )
            yield from listed("counts", [int(said[2]), int(said[3])], [most, len(found)])
        elif found:
            yield "no lanes"
        ahead = Counter(row - cell[1] for cell in found.values() if cell[1] < row)
        dense = told.between(r"densest (?:from )?(\d+)(?: to (\d+))? m ahead: (\d+)")
        if ahead:
            best = max(sum(ahead[at + more] for more in range(3)) for at in range(1, max(ahead) + 1))
            if dense is None or dense[-1] != best:
                yield f"densest {dense}, not {best}"
            else:
                size = record.config.cell_m
                rows = range(round(dense[0] / size), round(dense[-2] / size) + 1)
                yield from differ("rows", sum(ahead[at] for at in rows), best)


def gaps(told: Told) -> Iterator[str]:
    if not told.has("rows") or told["what"] != "gaps":
        return
    world = told.record.state.world
    row = world.road.cell(world.av)[1]
    cells = {
        kind: {each.cell for each in things_of(told.record.state) if each.kind is kind}
        for kind in (Kind.BARRIER, Kind.POTHOLE)
    }
    barred = Counter(cell[1] for cell in cells[Kind.BARRIER] if cell[1] < row)
    most = [each for each in barred if barred[each] > 1] or list(barred)
    yield from listed("rows", [each["row"] for each in told["rows"]], sorted(most, reverse=True))
    for each in told["rows"]:
        lanes = range(world.road.columns)
        barriers = [lane + 1 for lane in lanes if (lane, each["row"]) in cells[Kind.BARRIER]]
        free = [
            lane + 1 for lane in lanes if not any((lane, each["row"]) in taken for taken in cells.values())
        ]
        yield from listed("barriers", each["barriers"], barriers)
        yield from listed("free", each["free"], free)
    for gap in told.answer.get("gaps", ()):
        if gap["ticks"] is not None and gap["shut_off"]:
            yield f"shut off, and got to: {gap}"
        if gap["leads_on"] and gap["ticks"] is None:
            yield f"leads on, and not got to: {gap}"


def last_detected(told: Told) -> Iterator[str]:
    if not told.has("last_detected"):
        return
    now = told.record.timeline.tick
    seen = believed(told.record, now)
    yield from listed("believed", sorted(each["id"] for each in told["last_detected"]), sorted(seen))
    ticks = [each["tick"] for each in told["last_detected"]]
    if told["faithful"] and any(tick != now for tick in ticks):
        yield "perfect, and not of now"
    said = told.between(r"It is (\d+) ticks?")
    if told.kind == "last_detected_all" and said is not None and None not in ticks and ticks:
        yield from differ("oldest", said[0], now - min(ticks))
    fresh = told.between(r"Of (\d+) things that I believe in, (\d+) were")
    if fresh is not None:
        yield from listed("fresh", fresh, [len(seen), ticks.count(now)])


def row_of(told: Told) -> Iterator[str]:
    if not told.has("seen"):
        return
    record = told.record
    _, row = record.state.world.road.cell(record.state.world.av)
    found = [
        cell for each, cell in believed(record, record.timeline.tick).values() if each is told.thing_kind
    ]
    said = told.between(r"lane (\d+), row (\d+)")
    if said is not None and (said[0] - 1, said[1]) not in found:
        yield f"nothing in {said}"
    more = re.search(r"Other rows ahead with [^:]*: ([\d, and]+)", told.text)
    if more is not None and "more" not in told.text and said is not None:
        rows = sorted({cell[1] for cell in found if cell[1] < row} - {said[1]}, reverse=True)
        yield from listed("rows", [int(each) for each in re.findall(r"\d+", more[1])], rows)


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(
        (
            "sighted_kind",
            "sighted_first",
            "sighted_last",
            "sighted_all",
            "sighted_rate",
            "overlooked",
            "lost_sight",
        ),
        sightings,
    ),
    "noticed": noticed,
    **dict.fromkeys(("belief", "missed", "phantom"), truth),
    "sensor_errors": sensor_errors,
    **dict.fromkeys(("by_device", "only_one_sensor", "sensors_disagree", "alone_sees"), by_device),
    "cell_taken": cell_taken,
    "cell_entered": cell_entered,
    **dict.fromkeys(("within_now", "fullest_lane", "densest"), within),
    "barrier_gap": gaps,
    **dict.fromkeys(("last_detected", "last_detected_all"), last_detected),
    "row_of": row_of,
}
"""By kind of question."""
