"""What a service tells, held against the plain model of it. Every difference raises."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from service import actions as contract
from sim.plan import Decision
from sim.state import SimState
from sim.types import Move, Outcome
from tests.model.plain import Line, Plain

Json = dict[str, Any]

COUNTS = {"pothole": "potholes", "barrier": "barriers", "vehicle": "vehicles", "pedestrian": "pedestrians"}
LETTERS = {
    Move.FORWARD: "F",
    Move.LEFT: "L",
    Move.RIGHT: "R",
    Move.FORWARD_LEFT: "l",
    Move.FORWARD_RIGHT: "r",
    Move.STAY: "s",
}
NOTES = {version: f"Made under rules {version}: it replays as it did then." for version in (1, 2)} | {3: None}
TOLD = re.compile(r"(potholes|barriers|vehicles|pedestrians) (\d+) → (\d+)")


class DifferenceError(AssertionError):
    """The service and the model do not agree."""


def same(what: str, told: Any, thought: Any) -> None:
    if told != thought:
        raise DifferenceError(f"{what}: the service has {_short(told)}, the model {_short(thought)}")


def holds(what: str, true: bool, more: Any = "") -> None:
    if not true:
        raise DifferenceError(f"{what}: {_short(more)}")


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 700 else f"{text[:700]}…"


def state_of(plain: Plain, run: SimState) -> Json:
    """A state as it should be told, from the list of things on the road."""
    world, config = run.world, run.config
    things = list(world.things())
    cause = world.cause
    return {
        "tick": world.tick,
        "time_s": round(world.tick * config.step_seconds, 6),
        "episode": world.episode,
        "episode_tick": world.tick - world.episode_start,
        "status": str(world.outcome),
        "cause": cause
        and {"kind": cause.kind, "how": cause.how, "ids": list(cause.ids), "cell": list(cause.cell)},
        "columns": config.columns,
        "rows": config.rows,
        "visible_rows": config.visible_rows,
        "step_seconds": config.step_seconds,
        "paused": plain.paused,
        "playback_speed": plain.pace,
        "mode": str(run.mode),
        "planner": config.planner,
        "vehicles": [{"id": "av-1", "kind": "av", "cell": list(world.road.cell(world.av))}],
        "movers": [
            {
                "id": each.id,
                "kind": each.kind,
                "cell": list(each.cell),
                "heading": each.heading,
                "disabled": each.disabled,
            }
            for each in things
            if each.heading is not None
        ],
        "hazards": [
            {"id": each.id, "kind": each.kind, "cell": list(each.cell)}
            for each in things
            if each.heading is None
        ],
        "digest": world.digest(),
        "sequence": plain.sequence,
        "undo": len(plain.done),
        "redo": len(plain.undone),
    }


def compare_state(told: Json, plain: Plain, tick: int | None = None) -> None:
    """A state as the service tells it, now or at an earlier tick."""
    run = plain.run if tick is None else plain.runs[tick]
    thought = state_of(plain, run)
    for name, value in thought.items():
        found = told[name]
        if name in ("movers", "hazards"):
            found, value = _by_id(found), _by_id(value)
        same(f"state {name} at tick {run.world.tick}", found, value)
    compare_metrics(told["metrics"], plain, run)


def _by_id(things: Sequence[Json]) -> list[Json]:
    return sorted(things, key=lambda each: each["id"])


def compare_metrics(told: Json, plain: Plain, run: SimState) -> None:
    """Figures add up among themselves, and to what was played."""
    same("moves add up", sum(told["moves"].values()), told["steps"])
    same("episodes add up", told["successes"] + told["crashes"] + told["stuck"], told["episodes"])
    rate = told["successes"] / told["episodes"] if told["episodes"] else None
    same("success rate", told["success_rate"], rate)
    tick = run.world.tick
    past = plain.runs[:tick]
    driven = sum(each.world.outcome is Outcome.RUNNING for each in past)
    same(f"decisions until tick {tick}", told["steps"], driven)


def compare_session(told: Json, plain: Plain) -> None:
    """What a session says of itself."""
    run = plain.run
    thought = {
        "paused": plain.paused,
        "playback_speed": plain.pace,
        "mode": str(run.mode),
        "tick": run.world.tick,
        "episode": run.world.episode,
        "status": str(run.world.outcome),
        "sequence": plain.sequence,
        "seed": run.config.seed,
        "rules": run.config.rules,
        "rules_note": NOTES[run.config.rules],
    }
    for name, value in thought.items():
        same(f"session {name}", told[name], value)
    same("settings of a session", set(told["config"]), set(run.config.__dataclass_fields__))
    for name, value in told["config"].items():
        wanted = getattr(run.config, name)
        same(f"config {name}", value, list(wanted) if isinstance(wanted, tuple) else wanted)


def compare_lines(told: Sequence[Json], lines: Sequence[Line], first: int) -> None:
    """Numbered lines; words that were seen once stay as they were."""
    kinds = [(line["tick"], line["type"]) for line in told]
    same(f"lines from {first}", kinds, [(line.tick, str(line.type)) for line in lines])
    for number, (line, thought) in enumerate(zip(told, lines, strict=True), start=first):
        same("number of a line", line["number"], number)
        same(f"line {number}, ids", line["ids"], list(thought.ids))
        same(f"line {number}, cell", line["cell"], thought.cell and list(thought.cell))
        if thought.text is None:
            thought.text = line["text"]
        same(f"line {number}, words", line["text"], thought.text)


def compare_decision(told: Json, decision: Decision) -> None:
    """A decision with its whole trace."""
    thought = {
        "tick": decision.tick,
        "planner": decision.planner,
        "move": str(decision.move),
        "asked": decision.asked and str(decision.asked),
    }
    for name, value in thought.items():
        same(f"decision {decision.tick} {name}", told[name], value)
    options = [
        (each["move"], each["verdict"], each["cost"], each["reason"], sorted(each["causes"]))
        for each in told["options"]
    ]
    wanted = [
        (str(each.move), str(each.verdict), each.cost, str(each.reason), sorted(each.causes))
        for each in decision.options
    ]
    same(f"decision {decision.tick} options", options, wanted)
    holds(f"decision {decision.tick} is told in words", bool(told["narration"]))


def compare_result(told: Json, before: Plain, after: Plain, actions: Sequence[Any]) -> None:
    """What is told of a change agrees with what has changed."""
    same("sequence", told["sequence"], after.sequence)
    if any(action.do == "step" for action in actions):
        return  # what the ticks themselves have changed is no part of it
    told_of = {each["path"]: (each["before"], each["after"]) for each in told["changes"]}
    same("each figure is told once", len(told_of), len(told["changes"]))
    was, now = figures(before), figures(after)
    differ = {path: (was[path], now[path]) for path in was if was[path] != now[path]}
    same("changes", told_of, differ)
    if len(actions) == 1:
        for path, one, other in TOLD.findall(told["reply"]):
            same(f"reply's {path}", (int(one), int(other)), differ.get(path))


def figures(plain: Plain) -> Json:
    """All that a change can be told of."""
    run = plain.run
    config = {
        f"config.{name}": list(value) if isinstance(value, tuple) else value
        for name, value in ((name, getattr(run.config, name)) for name in run.config.__dataclass_fields__)
    }
    return {
        **{COUNTS[kind]: count for kind, count in run.world.counts().items()},
        **config,
        "episode": run.world.episode,
        "mode": str(run.mode),
        "queue": [str(move) for move in run.queue],
        "paused": plain.paused,
        "playback_speed": plain.pace,
        "tick": run.world.tick,
    }


def letters_of(plain: Plain) -> str:
    """The run as `timeline` tells it."""
    told = []
    for run, tick in zip(plain.runs, range(plain.tick), strict=False):
        decision = plain.decision(tick) if run.world.outcome is Outcome.RUNNING else None
        told.append("-" if decision is None else LETTERS[decision.move])
    return "".join(told)


def compare_changes(told: Sequence[Json], plain: Plain) -> None:
    """What was said of the road and stands."""
    same("changes that stand", [(each["tick"], each["sequence"]) for each in told], plain.changes())
    for each in told:
        text = plain.texts.get(each["sequence"])
        if text is not None:
            same(f"words of change {each['sequence']}", each["text"], text)


def compare_saved(told: Sequence[Json], plain: Plain) -> None:
    """Moments with a name."""
    thought = [
        {"name": name, "sequence": sequence, "tick": stand.tick}
        for name, (sequence, stand) in sorted(plain.saved.items())
    ]
    same("saved moments", list(told), thought)


def dumped(actions: Sequence[Any]) -> list[Mapping[str, Any]]:
    return contract.dump(tuple(actions))
