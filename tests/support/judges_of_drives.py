"""Judges of the figures and counts of a drive: each works them out anew from the recorded states."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from itertools import groupby, pairwise

from sim.state import SimState
from sim.transition import next_world
from sim.types import Move, Outcome
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.judges_of_nearness import misses
from tests.support.recorded_drives import Record, metres, moves_of


def speed(told: Told) -> Iterator[str]:
    if not told.has("distance_m"):
        return
    record = told.record
    way, seconds = metres(record), record.seconds(record.driven)
    yield from near("way", told["distance_m"], way, 1e-3)
    said = told.between(r"(\d+(?:\.\d+)?) km/h.*?: (\d+) m in (\d+(?:\.\d+)?) s")
    if said is None:
        yield "no figures"
        return
    yield from near("speed", said[0], 3.6 * way / seconds, 0.051)
    yield from near("metres", said[1], way, 0.51)
    yield from near("seconds", said[2], seconds, 0.051)
    moving = told.between(r"Without the (\d+(?:\.\d+)?) s of standing still: (\d+(?:\.\d+)?) km/h")
    still = sum(move is Move.STAY for move in moves_of(record))
    if moving is not None:
        yield from near("stood", moving[0], record.seconds(still), 0.051)
        yield from near("moving", moving[1], 3.6 * way / (seconds - record.seconds(still)), 0.051)
    elif still and still < record.driven:
        yield "stops are not told"


def way_share(told: Told) -> Iterator[str]:
    if not told.has("rows_left"):
        return
    cells = told.record.cells
    rows, left = cells[0][1], cells[-1][1]
    yield from listed("rows", [told["rows"], told["rows_left"]], [rows, left])
    half = next((at for at, cell in enumerate(cells) if cell[1] <= rows / 2), None)
    tick = None if half is None else half + told.record.first
    yield from differ("half", told["half_at"], tick)
    if told.kind in ("way_share", "half_way"):
        said = told.between(r"(\d+) % of the way")
        if said is None or abs(said[0] - 100 * (rows - left) / rows) > 0.501:
            yield f"share {said}"
        at = told.between(r"tick (\d+)")
        yield from differ("half said", None if at is None else int(at[0]), tick)
    else:
        said = told.between(r"[Ii]n lane (\d+), (\d+) rows? .*?tick (\d+)")
        if said is None:
            yield "no figures"
        else:
            yield from listed("start", said, [cells[0][0] + 1, rows, told.record.first])
        now = told.between(r"(?:Now I am|[Ee]nded|ended) in lane (\d+)")
        if now is not None:
            yield from differ("lane now", now[0], cells[-1][0] + 1)


def straight_line(told: Told) -> Iterator[str]:
    if not told.has("distance_m"):
        return
    cells, way = told.record.cells, metres(told.record)
    ahead = (cells[0][1] - cells[-1][1]) * told.record.config.cell_m
    said = told.between(r"^(\d+) m longer \((\d+) %\): (\d+) m driven for (\d+) m")
    if said is not None:
        yield from near("longer", said[0], way - ahead, 0.51)
        yield from near("percent", said[1], 100 * (way - ahead) / ahead, 0.51)
        yield from near("driven", said[2], way, 0.51)
        yield from near("ahead", said[3], ahead, 0.51)
    elif ahead and way - ahead > 0.5:
        yield "longer, and not told so"


def _stops(record: Record) -> list[tuple[int, int]] | None:
    """Stops as begin and length; None where steps may be lost on snow."""
    config = record.config
    if config.slip_probability and config.weather == "snow":
        return None
    still = [record.first + at for at, move in enumerate(moves_of(record)) if move is Move.STAY]
    return [
        (run[0], len(run))
        for run in (
            [tick for _, tick in run] for _, run in groupby(enumerate(still), lambda each: each[1] - each[0])
        )
    ]


def stops(told: Told) -> Iterator[str]:
    found = _stops(told.record)
    if not told.has("stops") or found is None or told["what"] != "stopped":
        return
    named = told.thing_kind is not None
    if not named:
        yield from listed("stops", [(each["tick"], each["ticks"]) for each in told["stops"]], found)
    ticks = sum(each for _, each in found)
    if told.kind == "time_still":
        said = told.between(r"took (\d+) % of the time, (\d+(?:\.\d+)?) s of (\d+(?:\.\d+)?) s")
        if said is not None:
            yield from near("percent", said[0], 100 * ticks / told.record.driven, 0.501)
            yield from near("seconds", said[1], told.record.seconds(ticks), 0.051)
            yield from near("of", said[2], told.record.seconds(told.record.driven), 0.051)
    elif told.kind == "longest_stop" and found:
        said = told.between(r"began at tick (\d+) and took (\d+(?:\.\d+)?) s")
        most = max(each for _, each in found)
        if said is None or (int(said[0]), most) not in found:
            yield f"longest {said}"
        else:
            yield from near("took", said[1], told.record.seconds(most), 0.051)
    elif told.kind == "stopped_ever" and not named and told.record.driven:
        yield from differ("ever", told.yes, bool(found))
    elif told.kind in ("stops", "last_stop") and not named and found:
        said = told.between(r"^I stopped (?:once|(\d+) times), for (\d+(?:\.\d+)?) s")
        if said is None:
            yield "no figures"
        else:
            yield from near("seconds", said[-1], told.record.seconds(ticks), 0.051)
            if len(said) == 2:
                yield from differ("count", said[0], len(found))
        last = told.between(r"at tick (\d+),? and took (\d+(?:\.\d+)?) s")
        if last is not None:
            yield from differ("last", last[0], found[-1][0])
            yield from near("last took", last[1], told.record.seconds(found[-1][1]), 0.051)
    elif told.kind == "stops" and named and found:
        said = told.between(r"^Of (\d+) stops")
        if said is not None:
            yield from differ("count", said[0], len(found))


def longest_run(told: Told) -> Iterator[str]:
    found = _stops(told.record)
    if not told.has("stretches") or found is None:
        return
    still = {tick + more for tick, ticks in found for more in range(ticks)}
    going = [tick for tick in range(told.record.first, told.record.last) if tick not in still]
    runs = [[tick for _, tick in run] for _, run in groupby(enumerate(going), lambda each: each[1] - each[0])]
    yield from listed(
        "stretches",
        [(each["tick"], each["ticks"]) for each in told["stretches"]],
        [(run[0], len(run)) for run in runs],
    )
    said = told.between(r"began at tick (\d+) and took (\d+(?:\.\d+)?) s")
    if runs and (said is None or abs(said[1] - told.record.seconds(max(map(len, runs)))) > 0.051):
        yield f"longest {said}"


def lanes_used(told: Told) -> Iterator[str]:
    if not told.has("lanes") or not told.record.driven:
        return
    lanes = Counter(column + 1 for column, _ in told.record.cells[:-1])
    yield from differ("lanes", {each["lane"]: each["ticks"] for each in told["lanes"]}, dict(lanes))
    said = told.between(r"^Lane (\d+) from the left: (\d+(?:\.\d+)?) s of (\d+(?:\.\d+)?) s")
    if said is not None:
        yield from differ("most", lanes[int(said[0])], max(lanes.values()))
        yield from near("seconds", said[1], told.record.seconds(max(lanes.values())), 0.051)


def _changes(record: Record) -> list[tuple[int, int]]:
    cells = record.cells
    return [
        (record.first + at, now[0] - was[0])
        for at, (was, now) in enumerate(pairwise(cells))
        if now[0] != was[0]
    ]


def lane_changes(told: Told) -> Iterator[str]:
    if not told.has("lane_changes") or told["what"] != "lane_changes":
        return
    found = _changes(told.record)
    said = [(each["tick"], each["side"]) for each in told["lane_changes"]]
    yield from listed("changes", said, [(tick, "left" if across < 0 else "right") for tick, across in found])
    count = told.between(r"^(\d+) times .*?: (\d+) to the left and (\d+) to the right")
    left = sum(across < 0 for _, across in found)
    if count is not None:
        yield from listed("counts", count, [len(found), left, len(found) - left])
    elif len(found) > 1:
        yield "no figures"
    last = told.between(r"last one was (\d+(?:\.\d+)?) s after")
    if last is not None:
        yield from near("last", last[0], told.record.seconds(found[-1][0] - told.record.first), 0.051)


def moves(told: Told) -> Iterator[str]:
    config = told.record.config
    if not told.has("moves", "driven") or (config.slip_probability and config.weather == "snow"):
        return
    made = [(told.record.first + at, str(move)) for at, move in enumerate(moves_of(told.record))]
    if told.kind == "last_forward":
        made = [each for each in made if each[1] == "forward"]
        said = told.between(r"at tick (\d+)")
        if (None if said is None else said[0]) != (made[-1][0] if made else None):
            yield f"last {said}"
    yield from listed("moves", [(each["tick"], each["move"]) for each in told["moves"]], made)
    if told.kind == "move_shares" and made:
        counts = Counter(move for _, move in made)
        percents = [int(each) for each in re.findall(r"\((\d+) %\)", told.text)]
        found = [100 * counts[str(move)] / len(made) for move in Move if counts[str(move)]]
        if len(percents) != len(found) or any(
            abs(a - b) > 0.501 for a, b in zip(percents, found, strict=True)
        ):
            yield f"shares {percents}, not {found}"


def advanced(told: Told) -> Iterator[str]:
    if not told.has("rows", "driven") or not told.record.driven:
        return
    states = told.record.episode
    if "in the last" in told.question:
        back = int(told.slots["n"])
        states = told.record.states[-back - 1 :]
        if (
            len(states) <= back
            or states[0].world.episode != states[-1].world.episode
            or states[-1].world.ended
        ):
            return
    rows = [state.world.road.cell(state.world.av)[1] for state in states]
    yield from differ("rows", told["rows"], rows[0] - rows[-1])
    said = told.between(r": (?:(\d+)|no|one) rows?\b.*? in (\d+(?:\.\d+)?) s")
    if said is None:
        yield "no figures"
    else:
        yield from near("seconds", said[-1], told.record.seconds(len(states) - 1), 0.051)
        if len(said) == 2:
            yield from differ("rows said", said[0], rows[0] - rows[-1])


def tight(told: Told) -> Iterator[str]:
    config = told.record.config
    if not told.has("one_free") or (config.slip_probability and config.weather == "snow"):
        return
    one, none = [], []
    for state in told.record.episode[:-1]:
        free = sum(_clear(state, move) for move in Move)
        one += [state.world.tick] if free == 1 else []
        none += [state.world.tick] if free == 0 else []
    ticks = [
        [each["tick"] if isinstance(each, dict) else each for each in told[key]]
        for key in ("one_free", "none_free")
    ]
    yield from listed("one free", ticks[0], one)
    yield from listed("none free", ticks[1], none)
    if told.record.driven:
        yield from differ("yes", told.yes, bool(one or none)) if bool(one) == bool(one or none) else ()


def _clear(state: SimState, move: Move) -> bool:
    """Whether a move is on the road and meets nothing."""
    column, row = state.world.road.cell(state.world.av)
    to = column + move.offset[0], row + move.offset[1]
    if not 0 <= to[0] < state.world.road.columns or to[1] < 0:
        return False
    return next_world(state.world, (move,), state.config).outcome is not Outcome.CRASH


def track(told: Told) -> Iterator[str]:
    if not told.has("here_since"):
        return
    record, cells = told.record, told.record.cells
    first = record.first
    changes = _changes(record)
    turns = [now[0] for was, now in pairwise(changes) if was[1] * now[1] < 0]
    held = [first + at for at, (was, now) in enumerate(pairwise(cells)) if now[1] >= was[1]]
    nearest = first + min(range(len(cells)), key=lambda at: (cells[at][1], at))
    here = next(at for at in range(len(cells)) if all(cell == cells[-1] for cell in cells[at:])) + first
    lane = next(at for at in range(len(cells)) if all(cell[0] == cells[-1][0] for cell in cells[at:])) + first
    yield from listed("turns", told["reversals"], turns)
    yield from listed("not ahead", told["not_advanced"], held)
    yield from listed(
        "since", [told["nearest_at"], told["here_since"], told["lane_since"]], [nearest, here, lane]
    )
    match told.kind:
        case "smoothness" | "ride_comfort":
            said = told.between(r"On (\d+) m: lane changes (\d+), stops (\d+), turns to the other side (\d+)")
            still = [at for at, (was, now) in enumerate(pairwise(cells)) if was == now]
            begun = sum(at - 1 not in still for at in still)
            if said is None or said[1:] != [len(changes), begun, len(turns)]:
                yield f"said {said}, not {[len(changes), begun, len(turns)]}"
            rates = told.between(r"That is (\S+), (\S+) and (\S+) per 100 m")
            if rates is not None:
                for rate, count in zip(rates, (len(changes), begun, len(turns)), strict=True):
                    yield from near("rate", rate, 100 * count / metres(record), 0.051)
        case "reversals":
            yield from differ("yes", told.yes, bool(turns))
        case "nearest_goal":
            yield from differ("yes", told.yes, cells[-1][1] > min(row for _, row in cells))
        case "not_advanced":
            said = told.between(r"^At (\d+) of (\d+) ticks")
            if said is not None:
                yield from listed("ticks", said, [len(held), record.driven])
        case "here_lane" | "here_cell":
            for since, pattern in ((here, r"this place.*?tick (\d+)"), (lane, r"this lane.*?tick (\d+)")):
                said = told.between(pattern)
                if said is not None:
                    yield from differ("since said", said[0], since)


def story(told: Told) -> Iterator[str]:
    if not told.has("events"):
        return
    record = told.record
    near_by = [each for each in told["events"] if each["what"] == "near_miss"]
    yield from differ("near misses", len(near_by), len(misses(record)))
    ends = {Outcome.CRASH: "crash", Outcome.STUCK: "stuck", Outcome.SUCCESS: "success"}
    ended = [each["what"] for each in told["events"] if each["what"] in ends.values()]
    end = ends.get(record.outcome)
    if told.kind == "mishaps":
        yield from listed("end", ended, [end] if end not in (None, "success") else [])
        count = told.between(r"^There are (\d+) things")
        if count is not None:
            yield from differ("count", count[0], len(told["events"]))
        if not told["events"] and "othing" not in told.text and "No" not in told.text[:3]:
            yield "nothing is told otherwise"
        return
    yield from listed("end", ended, [end] if end is not None else [])
    changes = sum(each["ticks"] for each in told["events"] if each["what"] in ("left", "right"))
    yield from differ("lane changes", changes, len(_changes(record)))
    still = sum(each["ticks"] for each in told["events"] if each["what"] == "stop")
    yield from differ("still", still, sum(move is Move.STAY for move in moves_of(record)))
    if any(each["what"] == "changed" for each in told["events"]) and "Remove" not in repr(
        list(record.timeline.entries)
    ):
        yield "the road was not changed"
    said = told.between(r"Tick (\d+): start in lane (\d+)")
    if said is None:
        yield "no start"
    else:
        yield from listed("start", said, [record.first, record.cells[0][0] + 1])
    now = told.between(r"now, tick (\d+): lane (\d+), row (\d+)")
    if now is not None:
        yield from listed("now", now, [record.last, record.cells[-1][0] + 1, record.cells[-1][1]])


def places(told: Told) -> Iterator[str]:
    if not told.has("places"):
        return
    for each in told["places"]:
        world = told.record.states[each["tick"]].world
        thing, own = world.find(told["id"]), world.road.cell(world.av)
        if thing is None:
            yield f"not there at {each['tick']}"
        else:
            yield from listed(
                "place", [each["lanes"], each["rows"]], [thing.cell[0] - own[0], own[1] - thing.cell[1]]
            )


def end(told: Told) -> Iterator[str]:
    if not told.has("rows_to_goal") or told.record.first or told.record.outcome is Outcome.RUNNING:
        return
    column, row = told.record.cells[-1]
    yield from listed(
        "end", [told["lane"], told["rows_to_goal"], told["ended"]], [column + 1, row, told.record.last]
    )
    yield from differ("outcome", told["outcome"], str(told.record.outcome))


def waited(told: Told) -> Iterator[str]:
    found = _stops(told.record)
    if found is None or not told.record.driven or not told.has("what"):
        return
    total = sum(ticks for _, ticks in found)
    seconds = told.between(r"(\d+(?:\.\d+)?) s (?:of|in all)")
    if not total and not re.search(r"not (?:waited|stood)|never|No", told.text):
        yield "has never waited"
    if total and seconds is not None:
        del seconds


def before_crash(told: Told) -> Iterator[str]:
    if told.record.outcome is Outcome.CRASH and "no crash" in told.text.lower():
        yield "there was one"


JUDGES: dict[str, Judge] = {
    "average_speed": speed,
    **dict.fromkeys(("way_share", "half_way", "started", "start_and_end"), way_share),
    "straight_line": straight_line,
    **dict.fromkeys(
        ("stops", "time_still", "longest_stop", "stops_list", "last_stop", "stopped_ever"), stops
    ),
    "longest_run": longest_run,
    "lanes_used": lanes_used,
    "lane_changes": lane_changes,
    **dict.fromkeys(("listed", "move_shares", "last_forward"), moves),
    "advanced": advanced,
    "tight": tight,
    **dict.fromkeys(
        ("smoothness", "reversals", "nearest_goal", "not_advanced", "here_lane", "here_cell"),
        track,
    ),
    **dict.fromkeys(("story", "mishaps"), story),
    **dict.fromkeys(("places_of", "places_before"), places),
    "end": end,
    "waited": waited,
    "before_crash": before_crash,
}
"""By kind of question."""
