"""One of the egos: who drives it, what it was told to do, and what has come of it so far."""

from __future__ import annotations

from dataclasses import dataclass, field

from sim.episode_record import EpisodeRecord
from sim.metrics import Metrics
from sim.perceive import NO_BELIEF, Belief
from sim.repetition import NOTHING_KEPT, Watch
from sim.types import Mode, Move


@dataclass(frozen=True, slots=True)
class Ego:
    """The part of a session's state that belongs to one ego; its cell is in the world."""

    id: str
    planner: str | None = None
    """name of its planner; None: that of the configuration"""
    mode: Mode = Mode.AUTO
    queue: tuple[Move, ...] = ()
    """moves a person asked for, taken one a tick"""
    metrics: Metrics = field(default_factory=Metrics)
    fault: str | None = None
    """what the planner did instead of answering at the latest decision"""
    record: EpisodeRecord = field(default_factory=EpisodeRecord)
    """what the episode has come to so far"""
    watch: Watch = NOTHING_KEPT
    """state of the cycle detection (`sim.repetition`)"""
    belief: Belief = NO_BELIEF
    """what the sensor carries from the ticks before this one (`sim.perceive.sensor`)"""

    @property
    def parked(self) -> bool:
        """Whether it stays where it is: a person has it and has asked for nothing."""
        return self.mode is Mode.MANUAL and not self.queue
