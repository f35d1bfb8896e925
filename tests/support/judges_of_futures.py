"""Judges of what is said to come: sessions are driven on with the public engine."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

from sim.actions import Drive, SetMode
from sim.session.timeline import Timeline
from sim.transition import next_world
from sim.types import Cell, Mode, Move, Outcome
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.recorded_drives import Record

ENDS = {
    Outcome.SUCCESS: "success",
    Outcome.CRASH: "crash",
    Outcome.STUCK: "stuck",
    Outcome.RUNNING: "running",
}
MOST = 400
"""Ticks that a session is driven on at most."""


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


def known(record: Record) -> bool:
    """Whether what comes is not left to chance."""
    return record.config.certain and not record.config.slips


def place_then(told: Told) -> Iterator[str]:
    if not told.has("of"):
        return
    record, tick = told.record, told["of"]
    if tick <= record.timeline.tick:
        world = record.states[tick].world
        cell: Cell | None = world.road.cell(world.av)
    elif not known(record) or record.state.queue:
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
    if known(record) and record.state.mode is Mode.AUTO and not record.state.queue:
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
        and known(record)
        and not record.asked
        and policy["from_tick"] == record.timeline.tick
        and record.outcome is Outcome.RUNNING
    ):
        yield from differ("as it is", real["outcome"], ENDS[_planned(record).state.world.outcome])


def outlook_end(told: Told) -> Iterator[str]:
    """Whether it crashes, or when it arrives, where nothing is left to chance."""
    record = told.record
    if record.outcome is not Outcome.RUNNING or not known(record) or record.state.queue:
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


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(("place_then", "place_then_seconds"), place_then),
    **dict.fromkeys(
        ("stays_free_left", "stays_free_right", "stays_free_ahead", "closing_left", "closing_right"),
        stays_free,
    ),
    "others_next": others_next,
    "danger": danger,
    **dict.fromkeys(("lane_why", "lane_had"), path_ends),
    **dict.fromkeys(("crash_ahead", "arrival"), outlook_end),
}
"""By kind of question."""
