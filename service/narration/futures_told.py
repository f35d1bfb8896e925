"""How a future ends, in words: "arrive in 12 s", or how likely it is where that is left to chance."""

from __future__ import annotations

from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from sim.explain.chances import Chances
from sim.explain.foresight import Foresight


def end_told(sayings: Sayings, seen: Foresight, *, since: int | None = None) -> str:
    """How it ends, after "I": its chance of an arrival where it hangs on chance.

    Seconds count from the tick `since`, by default from where the future begins.
    """
    if seen.by_chance:
        return sayings.say("ahead", "ends", "chance", share=share_told(sayings, seen.arrives, seen.chances))
    story, config = seen.story, seen.state.config
    ticks = story.end - (story.tick if since is None else since)
    return sayings.say(
        "whatif",
        "ends",
        "silent" if story.silent is not None else str(story.outcome),
        a="" if story.cause is None else sayings.say("words", "a", story.cause.kind),
        ticks=sayings.say("whatif", "seconds", seconds=in_seconds(sayings, ticks, config)),
        planner=sayings.planner(seen.state.config_of(None).planner, "id"),
    )


def share_told(sayings: Sayings, share: float, found: Chances | None) -> str:
    """A share of futures: exact in per cent, or how many of those that were drawn."""
    if found is not None and found.futures is not None:
        count = round(share * found.futures)
        return sayings.say("confidence", "likely", "drawn", arrived=count, futures=found.futures)
    percent = sayings.number(round(100 * share))
    if 0.0 < share < 0.01:
        percent = sayings.say("confidence", "below")
    elif 0.99 < share < 1.0:
        percent = sayings.say("confidence", "above")
    return sayings.say("confidence", "likely", "exact", percent=percent)
