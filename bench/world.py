"""One live tick with its full trace, a road, a digest, and the price of an explanation."""

from __future__ import annotations

from bench.timing import timed
from sim.config import Config
from sim.decide import decide
from sim.explain import QuestionError, why, why_not
from sim.generation import generate
from sim.session.timeline import Timeline
from sim.types import Move


def main() -> None:
    """Print the figures of the default world."""
    timeline = Timeline(Config(seed=1))
    print(timed(lambda _: timeline.advance(), range(20_000)).row("tick, everything"))
    print(timed(lambda _: decide(timeline.state), range(5_000)).row("perceive, forecast, plan"))
    print(
        timed(lambda episode: generate(timeline.config, episode), range(1, 2_000)).row("a road from a seed")
    )
    print(timed(lambda _: timeline.state.world.digest(), range(5_000)).row("digest"))
    print(timed(lambda tick: timeline.at(tick), range(0, 20_000, 97)).row("any of 20,000 past ticks"))
    print(timed(lambda _: timeline.copy(), range(2_000)).row("copy of a session of 20,000 ticks"))
    _explanations()


def _explanations() -> None:
    moments = []
    for seed in range(300):
        timeline = Timeline(Config(seed=seed, potholes=seed % 40))
        for _ in range(1 + seed % 25):
            timeline.advance()
        moments.append(timeline)
    print(timed(lambda moment: why(moment), moments).row("why, 0 to 39 potholes"))
    print(timed(_why_not, moments).row("why not left"))


def _why_not(timeline: Timeline) -> None:
    try:
        why_not(timeline, Move.LEFT)
    except QuestionError:
        return  # it did go left


if __name__ == "__main__":
    main()
