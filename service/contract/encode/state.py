"""A world at a tick, and the figures beside it, as JSON values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sim.metrics import Metrics
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing, World

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class SessionStatus:
    """What of a session is not in its run: who it is and how it stands."""

    session: str
    paused: bool
    sequence: int
    playback_speed: float | str = 1.0
    undo: int = 0
    redo: int = 0
    rules: tuple[Json, ...] = ()


def state_json(status: SessionStatus, run: SimState) -> Json:
    """Everything there is to see at one tick: the `State` of the interface."""
    world, config = run.world, run.config
    things = list(world.things())
    return {
        "session": status.session,
        "tick": world.tick,
        "time_s": round(world.tick * config.step_seconds, 6),
        "episode": world.episode,
        "episode_tick": world.episode_tick,
        "status": world.outcome,
        "cause": cause_json(world),
        "columns": world.road.columns,
        "rows": world.road.rows,
        "visible_rows": config.visible_rows,
        "step_seconds": config.step_seconds,
        "paused": status.paused,
        "playback_speed": status.playback_speed,
        "mode": run.mode,
        "planner": config.planner,
        "sensor": config.sensor,
        "weather": config.weather,
        "time_of_day": config.time_of_day,
        "vehicles": vehicles_json(world),
        "movers": [_mover_json(thing) for thing in things if thing.kind.moves],
        "hazards": [_hazard_json(thing) for thing in things if thing.kind.fixed],
        "metrics": metrics_json(run.metrics),
        "digest": world.digest(),
        "sequence": status.sequence,
        "undo": status.undo,
        "redo": status.redo,
        "rules": status.rules,
    }


def cause_json(world: World) -> Json | None:
    """What a crash was with; None when there was none."""
    cause = world.cause
    if cause is None:
        return None
    return {"kind": cause.kind, "how": cause.how, "ids": cause.ids, "cell": cause.cell}


def vehicles_json(world: World) -> list[Json]:
    """The autonomous vehicles, in order."""
    return [
        {"id": world.id_at(index, Kind.AV), "kind": Kind.AV, "cell": world.road.cell(index)}
        for index in world.avs
    ]


def metrics_json(metrics: Metrics) -> Json:
    """A session's figures."""
    return {
        "episodes": metrics.episodes,
        "successes": metrics.successes,
        "crashes": metrics.crashes,
        "stuck": metrics.stuck,
        "success_rate": metrics.success_rate,
        "steps": metrics.steps,
        "moves": {
            "forward": metrics.forward,
            "lateral": metrics.lateral,
            "diagonal": metrics.diagonal,
            "stay": metrics.stay,
        },
        "distance_m": round(metrics.distance_m, 3),
        "last_episode_ticks": metrics.last_episode_ticks,
    }


def _mover_json(thing: Thing) -> Json:
    return {
        "id": thing.id,
        "kind": thing.kind,
        "cell": thing.cell,
        "heading": thing.heading,
        "disabled": thing.disabled,
    }


def _hazard_json(thing: Thing) -> Json:
    return {"id": thing.id, "kind": thing.kind, "cell": thing.cell}
