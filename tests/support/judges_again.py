"""Judges of what is said to come, or to have come otherwise: sessions are driven again to see."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from typing import Any

from sim.actions import Drive, Remove, Set, SetMode, Where
from sim.config import Config
from sim.session.timeline import Timeline
from sim.transition import next_world
from sim.types import Cell, Mode, Move, Outcome
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.judges_of_drives import misses, moves_of
from tests.support.recorded_drives import Record

ENDS = {
    Outcome.SUCCESS: "success",
    Outcome.CRASH: "crash",
    Outcome.STUCK: "stuck",
    Outcome.RUNNING: "running",
}
PLANNERS = {"Dijkstra": "dijkstra", "A*": "astar", "the rules": "rules", "BFS": "bfs"}
WEATHERS = {"foggy": "fog", "rainy": "rain"}
MOST = 400
"""Ticks that a session is driven on at most."""


def again(record: Record, **other: Any) -> Timeline:
    """A fresh session with some settings otherwise, in which the same is said, driven as far or to its end.

    Of a drive that has ended it is driven to its own end.
    """
    timeline = Timeline(record.timeline.config.with_parts(**other))
    said = list(record.timeline.entries)
    ended = record.outcome is not Outcome.RUNNING
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < MOST:
        if not ended and timeline.tick >= record.last:
            break
        for entry in said:
            if entry.tick == timeline.tick:
                timeline.apply(entry.sequence, [entry.action])
        timeline.advance()
    return timeline


def onward(
    record: Record, move: Move | None = None, ticks: int = MOST, *, first: Move | None = None
) -> Timeline:
    """The session driven on by its planner, or with one move in every tick; `first`: one before that."""
    timeline = record.timeline.copy()
    timeline.apply(9_000, [SetMode(mode=Mode.AUTO)] if move is None else [SetMode(mode=Mode.MANUAL)])
    for tick in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        if move is not None:
            timeline.apply(9_001 + tick, [Drive(move=first if first is not None and not tick else move)])
        timeline.advance()
    return timeline


@lru_cache(maxsize=4)
def _planned(record: Record) -> Timeline:
    """The session with its planner to the end."""
    return onward(record)


def _known(record: Record) -> bool:
    """Whether what comes is not left to chance."""
    return record.config.certain and not record.config.slips


def place_then(told: Told) -> Iterator[str]:
    if not told.has("of"):
        return
    record, tick = told.record, told["of"]
    if tick <= record.timeline.tick:
        world = record.states[tick].world
        cell: Cell | None = world.road.cell(world.av)
    elif not _known(record) or record.state.queue:
        return
    else:
        timeline = _planned(record)
        ended = timeline.state.world.ended
        if ended is not None and ended <= tick:
            cell = None
            before = told.between(r"before tick (\d+)")
            if before is not None and ended >= before[0]:
                yield f"it ends at {ended}, not before"
        else:
            world = timeline.at(tick).world
            cell = world.road.cell(world.av)
    found = None if told["lane"] is None else (told["lane"] - 1, told["row"])
    yield from differ("place", found, cell)
    said = told.between(r"lane (\d+), row (\d+)")
    if cell is not None and (said is None or tuple(said) != (cell[0] + 1, cell[1])):
        yield f"said {said}, not {cell}"


def stays_free(told: Told) -> Iterator[str]:
    """The ego stands, and what is in the cells is looked at tick by tick."""
    if not told.has("free_for"):
        return
    record, move, ticks = told.record, Move(told["move"]), told["ticks"]
    config = record.config
    if config.mover_behaviour.draws(config):
        return
    column, row = record.state.world.road.cell(record.state.world.av)
    cells = (
        {(column, row - 1)}
        if move is Move.FORWARD
        else {(column + move.offset[0], row), (column + move.offset[0], row - 1)}
    )

    def taken(state: Any) -> bool:
        return any(each.cell in cells for each in state.world.things())

    states, world = [], record.state.world
    state = record.state
    for _ in range(ticks):
        world = next_world(state.world, (Move.STAY,), config)
        state = replace(state, world=world)
        states.append(state)
        if world.outcome is not Outcome.RUNNING:
            break
    crashed = states[-1].world.outcome is Outcome.CRASH
    now = taken(record.state)
    yield from differ("taken now", told["taken_now"] is not None, now)
    at = next((at for at, each in enumerate(states) if taken(each)), None)
    if now:
        frees = next(
            (
                at
                for at, each in enumerate(states, 1)
                if not taken(each) and each.world.outcome is Outcome.RUNNING
            ),
            None,
        )
        if not crashed:
            yield from differ("frees", told["frees_after"], frees)
    else:
        stop = len(states) - 1 if crashed and (at is None or at >= len(states) - 1) else at
        yield from differ("free for", told["free_for"], ticks if stop is None else stop)
        contrary = told.kind.startswith("closing")
        if told.yes is not None:
            yield from differ("yes", told.yes, (stop is None) is not contrary)
    if now and told.kind.startswith("closing") and told.yes:
        yield "no gap, and said to close"


def others_next(told: Told) -> Iterator[str]:
    if not told.has("others"):
        return
    record = told.record
    if record.state.queue or record.state.mode is Mode.MANUAL or record.config.slips:
        return
    timeline = onward(record, None, 1)
    counts = {"left": 0, "right": 0, "stay": 0}
    kinds: dict[str, list[int]] = {}
    for each in told["others"]:
        was, now = record.state.world.find(each["id"]), timeline.state.world.find(each["id"])
        if was is None or now is None:
            continue
        across = now.cell[0] - was.cell[0]
        found = "stay" if not across else "right" if across > 0 else "left"
        yield from differ(each["id"], each["move"], found)
        counts[found] += 1
        kinds.setdefault(str(was.kind), []).append(across)
    said = told.between(r"of (\d+) cars: (?:(\d+) left)?")
    if said is not None and "vehicle" in kinds:
        yield from differ("cars", said[0], len(kinds["vehicle"]))


def danger(told: Told) -> Iterator[str]:
    """Each move is made and then straight on, and what is met is looked at."""
    if not told.has("dangers"):
        return
    record, config = told.record, told.record.config
    if config.mover_behaviour.draws(config) or config.slips:
        return
    met: dict[str, dict[str, int]] = {}
    for move in Move:
        world = record.state.world
        for ticks in range(1, told["horizon"] + 1):
            step = move if ticks == 1 else Move.STAY if move is Move.STAY else Move.FORWARD
            column, row = world.road.cell(world.av)
            if not 0 <= column + step.offset[0] < world.road.columns or row + step.offset[1] < 0:
                break
            world = next_world(world, (step,), config)
            if world.outcome is Outcome.CRASH and world.cause is not None:
                for id in world.cause.ids:
                    met.setdefault(id, {})[str(move)] = ticks
            if world.outcome is not Outcome.RUNNING:
                break
    kind = told.thing_kind
    for each in told["dangers"]:
        by = met.pop(each["id"], {})
        yield from listed(f"moves to {each['id']}", sorted(each["all_moves"]), sorted(by))
        if each["moves"] and any(by.get(move) != each["ticks"] for move in each["moves"]):
            yield f"ticks to {each['id']}: {each['ticks']}, not {by}"
    left = [id for id in met if kind is None or id.startswith(str(kind))]
    if left:
        yield f"left out: {left}"
    if _known(record) and record.state.mode is Mode.AUTO and not record.state.queue:
        world = _planned(record).state.world
        hits = world.cause.ids if world.outcome is Outcome.CRASH and world.cause is not None else ()
        for each in told["dangers"]:
            ended = None if world.ended is None else world.ended - record.timeline.tick
            found = ended if each["id"] in hits and ended is not None and ended <= told["horizon"] else None
            yield from differ(f"hit {each['id']}", each["hit_after"], found)


def path_ends(told: Told) -> Iterator[str]:
    """The moves of a rule are made, and it is looked at how that ends."""
    policy = told.answer.get("policy")
    if policy is None or not policy["path"] or told.record.first or policy["outcome"] == "running":
        return
    record, config = told.record, told.record.config
    if config.slips or (config.mover_behaviour.draws(config)):
        return
    state = record.states[policy["from_tick"]]
    world = state.world
    inside = 0
    lane = int(told.slots["lane"]) - 1
    reached = None
    for at, move in enumerate(policy["path"], 1):
        if world.outcome is not Outcome.RUNNING:
            yield f"it ends after {at - 1} ticks"
            return
        world = next_world(world, (Move(move),), config)
        if world.road.cell(world.av)[0] == lane:
            inside += 1
            reached = at if reached is None else reached
    if policy["outcome"] in ("crash", "success"):
        yield from differ("outcome", policy["outcome"], ENDS[world.outcome])
    elif world.outcome in (Outcome.CRASH, Outcome.SUCCESS):
        yield f"ends in {world.outcome}"
    said = told.between(r"I am in lane \d+ after (\d+(?:\.\d+)?) s")
    if (
        said is not None
        and reached is not None
        and record.states[policy["from_tick"]].world.road.cell(record.states[policy["from_tick"]].world.av)[0]
        != lane
    ):
        yield from near("in the lane after", said[0], record.seconds(reached), 0.051)
    real = policy["as_it_is"].get("run")
    if (
        real is not None
        and _known(record)
        and not record.asked
        and policy["from_tick"] == record.timeline.tick
        and record.outcome is Outcome.RUNNING
    ):
        yield from differ("as it is", real["outcome"], ENDS[_planned(record).state.world.outcome])


def so_far(told: Told) -> Iterator[str]:
    found = told.answer.get("so_far")
    record = told.record
    if found is None or record.first:
        return
    other = again(record, **found["settings"])
    if other.tick >= MOST:
        return
    differs = None
    for tick in range(min(other.tick, record.last)):
        made, would = record.timeline.decision(tick), other.decision(tick)
        if made is not None and would is not None and made.move is not would.move:
            differs = tick
            break
    yield from differ("differs", None if found["differs"] is None else found["differs"]["tick"], differs)
    yield from differ("outcome", found["outcome"], ENDS[other.state.world.outcome])
    if other.state.world.ended is not None:
        yield from differ("tick", found["tick"], other.state.world.ended)
    there = other.at(min(other.tick, record.last)).world
    rows = record.cells[-1][1] - there.road.cell(there.av)[1]
    yield from differ("rows", found["rows_ahead"], rows)
    same = differs is None and other.tick >= record.last
    yield from differ("same", found["same"], same)
    wanted = {
        "so_far_same": same,
        "so_far_differs": not same,
        "so_far_clear": other.state.world.outcome is not Outcome.CRASH,
    }
    if told.yes is not None:
        yield from differ("yes", told.yes, wanted[told.kind])
    said = told.between(r"first difference is at tick (\d+)")
    if said is not None:
        yield from differ("said", said[0], differs)


def factor(told: Told) -> Iterator[str]:
    record = told.record
    failed = record.outcome in (Outcome.CRASH, Outcome.STUCK)
    if not failed or record.first:
        return
    good = set()
    for each in told.answer.get("driven_again", ()):
        if each["outcome"] is None:
            continue
        other: dict[str, Any] = {each["factor"]: each["value"]}
        if each["factor"] == "weather":
            other = {"weather": "clear", "time_of_day": "day"}
        timeline = again(record, **other)
        if timeline.tick >= MOST:
            continue
        yield from differ(f"with {each['value']}", each["outcome"], ENDS[timeline.state.world.outcome])
        if timeline.state.world.outcome is Outcome.SUCCESS:
            good.add(each["factor"])
    if told.kind == "factor_planner" and told.yes is not None:
        yield from differ("yes", told.yes, "planner" in good)


def other_seeds(told: Told) -> Iterator[str]:
    if not told.has("seeds", "outcomes"):
        return
    config: Config = told.record.config
    for seed, outcome in zip(told["seeds"][:4], told["outcomes"], strict=False):
        timeline = Timeline(config.with_parts(seed=seed))
        while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < MOST:
            timeline.advance()
        if timeline.tick < MOST:
            yield from differ(f"seed {seed}", outcome, ENDS[timeline.state.world.outcome])
    for word, outcome in (("arrived", "success"), ("crashed", "crash")):
        said = told.between(rf"(\d+) {word}")
        if said is not None:
            yield from differ(word, said[0], told["outcomes"].count(outcome))


def trouble(told: Told) -> Iterator[str]:
    record = told.record
    if not told.has("trouble") or record.first or record.asked:
        return
    steps = [move for move in moves_of(record) if move is not Move.FORWARD]
    if not record.config.slips:
        yield from differ("moves", told["moves"], len(steps))
    for each in told["trouble"]:
        if each["outcome_without"] is None:
            continue
        timeline = Timeline(record.timeline.config)
        timeline.apply(
            1, [Remove(kind=str(each["kind"]), count=1, where=Where(cell=_cell(record, each["id"])))]
        )  # type: ignore[arg-type]
        if timeline.state.world.find(each["id"]) is not None:
            continue
        while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < MOST:
            timeline.advance()
        if timeline.tick < MOST and _known(record):
            yield from differ(
                f"without {each['id']}", each["outcome_without"], ENDS[timeline.state.world.outcome]
            )


def _cell(record: Record, id: str) -> tuple[int, int]:
    thing = record.states[0].world.find(id)
    assert thing is not None
    return thing.cell


def hand_beside(told: Told) -> Iterator[str]:
    record = told.record
    if not told.has("planner_instead") or record.first:
        return
    took = next(
        (tick for tick, state in enumerate(record.states) if state.queue or state.mode is Mode.MANUAL), None
    )
    yield from differ("from", told["from_tick"], took)
    if took is None:
        return
    planner = told["planner"]
    timeline = Timeline(record.timeline.config.with_parts())
    cells: list[Cell] = []
    while timeline.tick < record.last and timeline.state.world.outcome is Outcome.RUNNING:
        if timeline.tick == took:
            timeline.apply(1, [Set(parameter="planner", value=planner)])
        if timeline.state.world.episode != record.state.world.episode:
            return  # a road of its own was begun
        timeline.advance()
    for each, states in (
        (told["you"], record.states[took : record.last + 1]),
        (told["planner_instead"], [timeline.at(tick) for tick in range(took, timeline.tick + 1)]),
    ):
        cells = [state.world.road.cell(state.world.av) for state in states]
        still = [was == now for was, now in pairwise(cells)]
        stops = sum(now and not was for was, now in pairwise([False, *still]))
        changes = sum(was[0] != now[0] for was, now in pairwise(cells))
        found = [ENDS[states[-1].world.outcome], cells[0][1] - cells[-1][1], cells[-1][1], stops, changes]
        yield from listed(
            "beside", [each[key] for key in ("outcome", "rows", "rows_left", "stops", "lane_changes")], found
        )
    rows = told.between(r"You are (\d+) rows? .*?(?:ahead of|behind)")
    if rows is not None:
        yield from differ(
            "rows said", rows[0], abs(told["you"]["rows_left"] - told["planner_instead"]["rows_left"])
        )
    if told.kind == "rival_smoother":
        yours, theirs = (
            each["stops"] + each["lane_changes"] for each in (told["you"], told["planner_instead"])
        )
        if (told.text.startswith("You ") and yours >= theirs) or (
            told.text.startswith(("I would", "Dijkstra would")) and theirs >= yours
        ):
            yield f"smoother: {yours} and {theirs}"


def unsafe_moves(told: Told) -> Iterator[str]:
    if not told.has("unsafe") or told.record.first:
        return
    record, found, asked = told.record, [], 0
    for tick in range(record.first, record.last):
        decision = record.timeline.decision(tick)
        if decision is None or decision.asked is None:
            continue
        asked += 1
        if decision.option(decision.asked).reason.blocks:
            found.append(tick)
    yield from listed("unsafe", [each["tick"] for each in told["unsafe"]], found)
    said = told.between(r"\((\d+) moves?\), (\d+)")
    if said is not None:
        yield from listed("said", said, [asked, len(found)])


def by_hand(told: Told) -> Iterator[str]:
    record = told.record
    drove = [
        tick
        for tick in range(record.first, record.last)
        if record.states[tick].queue or record.states[tick].mode is Mode.MANUAL
    ]
    if not told.has("moves", "held_back"):
        if drove and told.record.driven and "not driven" in told.text:
            yield f"drove at {drove}"
        return
    asked = [
        decision
        for tick in range(record.first, record.last)
        if (decision := record.timeline.decision(tick)) is not None and decision.asked is not None
    ]
    yield from differ("moves", told["moves"], len(asked))
    yield from differ("held back", len(told["held_back"]), sum(each.held_back for each in asked))
    for each in told["held_back"]:
        column, row = record.cells[each["tick"] - record.first]
        if record.cells[each["tick"] + 1 - record.first] != (column, row) and not record.config.slips:
            yield f"moved at {each['tick']}"


def influence(told: Told) -> Iterator[str]:
    record = told.record
    if not told.has("swayed"):
        return
    found = []
    for tick in range(record.first, record.last):
        before, after = record.states[tick], record.states[tick + 1]
        if record.config.slips:
            return
        start, end = (each.world.road.cell(each.world.av) for each in (before, after))
        move = next(each for each in Move if each.offset == (end[0] - start[0], end[1] - start[1]))
        other = next_world(before.world, (move,), before.config.with_parts(courtesy=0.0, attentive=0.0))
        for thing in before.world.things():
            one, rather = after.world.find(thing.id), other.find(thing.id)
            if thing.heading is None or one is None or rather is None:
                continue
            if (one.cell, one.heading) != (rather.cell, rather.heading):
                found.append((tick, thing.id))
    yield from listed("swayed", sorted((each["tick"], each["id"]) for each in told["swayed"]), sorted(found))
    if told.yes is not None:
        yield from differ("yes", told.yes, bool(found))


def outlook_end(told: Told) -> Iterator[str]:
    """Whether it crashes, or when it arrives, where nothing is left to chance."""
    record = told.record
    if record.outcome is not Outcome.RUNNING or not _known(record) or record.state.queue:
        return
    world = _planned(record).state.world
    if world.ended is None:
        return
    yes = re.search(r"\b(Yes|No)\b", told.text)
    if told.kind == "crash_ahead" and yes is not None:
        yield from differ("crashes", yes[1] == "Yes", world.outcome is Outcome.CRASH)
    if told.kind == "arrival" and world.outcome is Outcome.SUCCESS:
        said = told.between(r"(\d+(?:\.\d+)?) s\b")
        seconds = record.seconds(world.ended - record.timeline.tick)
        if said is None:
            yield "no time"
        elif abs(said[0] - seconds) > 0.051:
            yield f"arrives in {seconds}, not {said}"


def planner_here(told: Told) -> Iterator[str]:
    """The move of another planner, by setting it in a copy of the session."""
    if told.question.count(" and ") or "tick" in told.question or not told.has("planners"):
        return
    record = told.record
    if record.outcome is not Outcome.RUNNING:
        return
    planner = PLANNERS[told.slots["planner"]]
    timeline = record.timeline.copy()
    timeline.rewind(timeline.tick)
    timeline.apply(9_000, [SetMode(mode=Mode.AUTO), Set(parameter="planner", value=planner)])
    if timeline.state.world.episode != record.state.world.episode:
        return
    decision = timeline.decision(timeline.tick)
    for each in told["planners"]:
        if each.get("planner") == planner and decision is not None and "move" in each:
            yield from differ("move", each["move"], str(decision.move))


def best_time(told: Told) -> Iterator[str]:
    """No drive of any planner is quicker than the least time that is told."""
    if not told.has("least_ticks") or told["least_ticks"] is None:
        return
    record = told.record
    if told["changed"] is False and not record.first:
        column, row = record.cells[0]
        if told["least_ticks"] < row:
            yield f"least {told['least_ticks']} for {row} rows"
        if record.outcome is Outcome.SUCCESS and record.driven < told["least_ticks"]:
            yield f"driven in {record.driven}, least {told['least_ticks']}"
        if not record.config.mover_behaviour.draws(record.config):
            quick = Timeline(record.timeline.config.with_parts(planner="bfs", sensor="perfect"))
            while quick.state.world.outcome is Outcome.RUNNING and quick.tick < MOST:
                quick.advance()
            if quick.state.world.outcome is Outcome.SUCCESS and quick.tick < told["least_ticks"]:
                yield f"BFS takes {quick.tick}, least {told['least_ticks']}"
        del column
    said = told.between(r"At best (\d+(?:\.\d+)?) s")
    if said is not None:
        yield from near("said", said[0], record.seconds(told["least_ticks"]), 0.051)


def stuck_cause(told: Told) -> Iterator[str]:
    """Where a way is said to be open, its plan is driven."""
    if not told.has("plan") or told["plan"] is None or told["open"] is not True:
        return
    record, config = told.record, told.record.config
    if not _known(record):
        return
    start = record.states[told["got_no_further"]] if record.outcome is Outcome.STUCK else record.state
    if record.outcome is not Outcome.RUNNING:
        return
    world = start.world
    for move in told["plan"]:
        if world.outcome is not Outcome.RUNNING:
            break
        world = next_world(world, (Move(move),), config)
    if world.outcome is not Outcome.SUCCESS:
        yield f"the plan ends in {world.outcome}"


def luck(told: Told) -> Iterator[str]:
    outcomes: Sequence[str] | None = told.answer.get("outcomes")
    if not outcomes:
        return
    said = told.between(r"Of (\d+) drives")
    if said is not None:
        yield from differ("drives", said[0], len(outcomes))
    for word, outcome in (("crashed", "crash"), ("arrived", "success")):
        count = told.between(rf"(\d+) {word}")
        if count is not None and told.record.outcome is not Outcome.RUNNING:
            yield from differ(word, count[0], outcomes.count(outcome))
    if (
        told.record.config.certain
        and not told.record.config.slips
        and told.record.config.sensor == "perfect"
        and told.yes is not False
    ):
        yield "nothing is left to chance"


def lost_count(told: Told) -> Iterator[str]:
    """Of a summary: near misses are those of the record."""
    if told.has("near_misses"):
        yield from differ("near misses", len(told["near_misses"]), len(misses(told.record)))


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(("place_then", "place_then_seconds"), place_then),
    **dict.fromkeys(
        ("stays_free_left", "stays_free_right", "stays_free_ahead", "closing_left", "closing_right"),
        stays_free,
    ),
    "others_next": others_next,
    "danger": danger,
    **dict.fromkeys(("lane_why", "lane_had"), path_ends),
    **dict.fromkeys(("so_far_same", "so_far_differs", "so_far_clear"), so_far),
    **dict.fromkeys(("factor", "factor_planner"), factor),
    "other_seeds": other_seeds,
    "trouble": trouble,
    **dict.fromkeys(("rival_better", "rival_place", "rival_safer", "rival_smoother"), hand_beside),
    "unsafe_moves": unsafe_moves,
    **dict.fromkeys(("hand_since", "held_back", "hand_would"), by_hand),
    "influence": influence,
    **dict.fromkeys(("crash_ahead", "arrival"), outlook_end),
    "planner_here": planner_here,
    "best_time": best_time,
    **dict.fromkeys(("stuck_cause", "knowable"), stuck_cause),
    "luck": luck,
}
"""By kind of question."""
