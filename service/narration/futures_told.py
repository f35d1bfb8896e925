"""How a future ends, in words: "arrive in 12 s", or how likely it is where that is left to chance."""

from __future__ import annotations

from typing import Final

from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.chances import Chances
from sim.explain.foresight import Foresight

CONTRARY: Final = "contrary"
"""What a question supposes that asks the other way round: whether a move is dangerous, a crash inevitable."""


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


def clear_told(sayings: Sayings, seen: Foresight) -> str:
    """The same where it is a crash that matters: its chance, where that is left to chance."""
    if seen.by_chance:
        return sayings.say("ahead", "ends", "clear", share=share_told(sayings, seen.crashes, seen.chances))
    return end_told(sayings, seen)


def share_told(sayings: Sayings, share: float, found: Chances | None) -> str:
    """A share of futures: exact in per cent, or how many of those that were drawn."""
    futures = None if found is None else found.futures
    return counted_told(sayings, share, futures)


def counted_told(sayings: Sayings, share: float, futures: int | None) -> str:
    """A share of so many futures that were drawn; None where the share is exact."""
    key, count = "exact", 0
    if futures is not None:
        count = round(share * futures)
        key = "drawn" if 0 < count < futures else "drawn_all" if count else "drawn_none"
        key += "_one" if futures == 1 else ""
    elif share in (0.0, 1.0):
        key = "all" if share else "none"
    percent = sayings.number(round(100 * share))
    if 0.0 < share < 0.01:
        percent = sayings.say("confidence", "below")
    elif 0.99 < share < 1.0:
        percent = sayings.say("confidence", "above")
    return sayings.say("ahead", "share", key, percent=percent, count=count, futures=futures)


def yes_and_no(sayings: Sayings, asked: Asked) -> dict[str, str]:
    """The words for yes and no; they change places in a question that asks the other way round."""
    words = [sayings.say("ahead", "answer", key) for key in ("agree", "disagree")]
    return dict(zip(("yes", "no"), reversed(words) if asked.supposes == CONTRARY else words, strict=True))
