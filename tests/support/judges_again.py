"""Judges of what is said to have come otherwise: sessions are driven again with the public engine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from sim.actions import Remove, Set, SetMode, Where
from sim.config import Config
from sim.session.timeline import Timeline
from sim.transition import next_world
from sim.types import Cell, Mode, Move, Outcome
from tests.support.answer_judge import Judge, Told, differ, listed, near
from tests.support.judges_of_futures import ENDS, MOST, known
from tests.support.judges_of_nearness import misses
from tests.support.recorded_drives import Record, moves_of

PLANNERS = {"Dijkstra": "dijkstra", "A*": "astar", "the rules": "rules", "BFS": "bfs"}
"""By the names that the sentences are filled with."""


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
        if timeline.tick < MOST and known(record):
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
    if not known(record):
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
    **dict.fromkeys(("so_far_same", "so_far_differs", "so_far_clear"), so_far),
    **dict.fromkeys(("factor", "factor_planner"), factor),
    "other_seeds": other_seeds,
    "trouble": trouble,
    **dict.fromkeys(("rival_better", "rival_place", "rival_safer", "rival_smoother"), hand_beside),
    "unsafe_moves": unsafe_moves,
    **dict.fromkeys(("hand_since", "held_back", "hand_would"), by_hand),
    "influence": influence,
    "planner_here": planner_here,
    "best_time": best_time,
    **dict.fromkeys(("stuck_cause", "knowable"), stuck_cause),
    "luck": luck,
}
"""By kind of question."""
