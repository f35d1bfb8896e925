"""What is seen as JSON values: all of it, also what words leave out."""

from __future__ import annotations

from typing import Any

from sim.explain.misperception import Misperception
from sim.explain.scene import Detection, Scene
from sim.types import Kind

Json = dict[str, Any]


def scene_json(scene: Scene, kind: Kind | None, cell_m: float, step_seconds: float) -> Json:
    """The things asked for, what is met first first; metres along the road, ahead counting up."""
    return {
        "cell": scene.cell,
        "looked_ahead": {"rows": scene.reach, "metres": scene.reach * cell_m},
        "seen": [_seen_json(thing, cell_m, step_seconds) for thing in scene.of(kind)],
        "threats": [thing.id for thing in scene.threats if kind is None or thing.kind is kind],
    }


def misperception_json(wrong: Misperception) -> Json:
    """Ids of what is seen and not there, and of what is there and not seen; nothing where all is right."""
    told = {"phantoms": wrong.phantoms, "missed": wrong.missed}
    return {key: [thing.id for thing in things] for key, things in told.items() if things}


def _seen_json(thing: Detection, cell_m: float, step_seconds: float) -> Json:
    return {
        "id": thing.id,
        "kind": thing.kind,
        "cell": thing.cell,
        "likelihood": thing.likelihood,
        "lanes": thing.lanes,
        "rows": thing.rows,
        "metres": thing.rows * cell_m,
        "heading": thing.heading,
        "held": thing.held,
        "ticks_to_collision": thing.ticks,
        "seconds_to_collision": None if thing.ticks is None else round(thing.ticks * step_seconds, 6),
    }
