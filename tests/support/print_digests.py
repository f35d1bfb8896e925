"""A session with actions at odd ticks, played out: prints the digest of every state. Run by tests."""

from __future__ import annotations

from sim.actions import Add, Drive, Remove, Reset, Scenario, SetCount, SetMode, Where, WorldAction
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Mode, Move

TICKS = 500
CONFIG = Config(seed=123456789, potholes=12, pedestrians=3, barriers=2, courtesy=0.3)
SCRIPT: dict[int, tuple[WorldAction, ...]] = {
    1: (Add(kind="pothole", count=5),),
    7: (Add(kind="vehicle", count=3, where=Where(lane="left")),),
    13: (Remove(kind="pothole", count=2),),
    29: (SetCount(kind="pedestrian", count=6),),
    31: (Add(kind="barrier", count=1, where=Where(side="ahead", lane=2)),),
    63: (SetMode(mode=Mode.MANUAL), Drive(move=Move.LEFT), Drive(move=Move.FORWARD)),
    71: (SetMode(mode=Mode.AUTO),),
    85: (Remove(kind="everything", count="all", where=Where(lane="middle")),),
    101: (Scenario(road="city", traffic="heavy"),),
    127: (Reset(),),
    129: (Add(kind="vehicle", count=4),),
    155: (SetCount(kind="vehicle", count=2),),
    177: (Scenario(road="rural", potholes=30),),
    203: (Add(kind="pedestrian", count=5), Remove(kind="pedestrian", count=1)),
    241: (Drive(move=Move.STAY),),
    263: (SetCount(kind="barrier", count=9),),
    299: (Scenario(road="highway", vehicles=15),),
    333: (Add(kind="pothole", count=10),),
    381: (Remove(kind="vehicle", count="all"),),
    433: (Add(kind="vehicle", count=20), SetCount(kind="pothole", count=3)),
}


def digests() -> list[str]:
    """The digest of each state, and of its ids, before the actions of each tick."""
    timeline = Timeline(CONFIG)
    told = []
    for tick in range(TICKS):
        timeline.apply(tick, SCRIPT.get(tick, ()))
        world = timeline.state.world
        ids = ",".join(f"{cell}:{name}" for cell, name in sorted({**world.movers, **world.hazards}.items()))
        told.append(f"{tick} {world.digest()} {world.episode} {world.outcome} {ids}")
        timeline.advance()
    return told


if __name__ == "__main__":
    print("\n".join(digests()))
