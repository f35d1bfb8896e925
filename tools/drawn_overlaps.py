"""Counts the frames in which the vehicle is drawn over something, in ticks that did not end in a crash.

    python -m tools.drawn_overlaps --episodes 200

The poses are those the window draws (`sim.render.motion.poses`), at 30 steps a tick. What is seen is what is
judged exactly when there is no such frame.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass, field

from sim.config import Config
from sim.planner_names import names
from sim.render.motion import STEP_FRAMES, Box, Scene, poses
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

TOUCHING = 1e-9
"""sides that meet, within rounding"""


@dataclass(slots=True)
class Found:
    """What was looked at, and what was drawn over what."""

    ticks: int = 0
    crashes: int = 0
    frames: int = 0
    overlapping: int = 0
    """frames with any overlap"""
    ticks_with: int = 0
    """ticks with any such frame"""
    causes: Counter[tuple[Move, str, str]] = field(default_factory=Counter)
    """frames by the vehicle's move, the kind that was drawn over, and what that did"""
    in_crashes: int = 0
    """frames of ticks that ended in a crash in which bodies are one within the other"""


def deep(one: Box, other: Box) -> float:
    """How far one box reaches into the other; negative where they are apart."""
    return min(one[2] - other[0], other[2] - one[0], one[3] - other[1], other[3] - one[1])


def overlaps(seen: Scene) -> list[int]:
    """The places among a scene's things of those that the vehicle's box overlaps."""
    own = seen.av.box
    return [place for place, pose in enumerate(seen.things) if deep(own, pose.box) > TOUCHING]


def watch(config: Config, found: Found) -> None:
    """One episode, looked at frame by frame."""
    state = SimState.start(config)
    while state.world.outcome is Outcome.RUNNING:
        tick = step(state)
        before, state = state.world, tick.state
        assert tick.decision is not None
        crashed = state.world.outcome is Outcome.CRASH
        found.crashes += crashed
        found.ticks += not crashed
        cells = {thing.id: thing.cell for thing in before.things()}
        seen_any = False
        for frame in range(STEP_FRAMES + 1):
            seen = poses(before, state.world, frame / STEP_FRAMES)
            over = overlaps(seen)
            if crashed:
                found.in_crashes += bool(over)
                continue
            found.frames += 1
            found.overlapping += bool(over)
            seen_any = seen_any or bool(over)
            for place in over:
                thing = seen.things[place].thing
                how = {-1: "went left", 0: "stood", 1: "went right"}[thing.cell[0] - cells[thing.id][0]]
                found.causes[(tick.decision.move, thing.kind, how)] += 1
        found.ticks_with += seen_any


def main() -> None:
    """The count for some episodes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--planner", choices=names(), default="priority")
    parser.add_argument("--vehicles", type=int, default=30)
    parser.add_argument("--potholes", type=int, default=14)
    parser.add_argument("--pedestrians", type=int, default=4)
    parser.add_argument("--barriers", type=int, default=3)
    asked = parser.parse_args()
    found = Found()
    for seed in range(asked.episodes):
        config = Config(
            seed=seed,
            planner=asked.planner,
            vehicles=asked.vehicles,
            potholes=asked.potholes,
            pedestrians=asked.pedestrians,
            barriers=asked.barriers,
        )
        watch(config, found)
    print(f"{asked.episodes} episodes, {found.ticks} ticks without a crash, {found.crashes} with one")
    print(f"{found.frames} frames, {found.overlapping} with an overlap, in {found.ticks_with} ticks")
    for (move, kind, how), count in found.causes.most_common():
        print(f"  {count:>7}  {move}: {kind} {how}")
    print(f"{found.in_crashes} frames of crashes in which bodies are one within the other")


if __name__ == "__main__":
    main()
