"""Two runs beside each other in words: where they part, and how each ends."""

from __future__ import annotations

from service.narration.sayings import Sayings
from service.sessions.facts import SideBySideTexts
from sim.explain.side_by_side import Side, SideBySide
from sim.types import Outcome


class SidesBySide:
    """Words for counterfactuals that are shown beside the real run, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def texts(self, found: SideBySide) -> SideBySideTexts:
        """What differs in all, and how each of the two ends."""
        told = [self._difference(found)]
        if found.real.story.outcome is found.changed.story.outcome is Outcome.SUCCESS:
            told.append(self._arrival(found.changed.story.driven - found.real.story.driven))
        if found.said_since:
            told.append(self._say("said_since"))
        return SideBySideTexts(" ".join(told), self._end(found.real), self._end(found.changed))

    def _difference(self, found: SideBySide) -> str:
        """Where the two are driven differently for the first time."""
        for (_, first), (_, second) in zip(found.real.ticks, found.changed.ticks, strict=False):
            one, other = first.decision, second.decision
            if one is not None and other is not None and one.move is not other.move:
                changed = self._sayings.move(other.move, "do")
                real = self._sayings.move(one.move, "doing")
                return self._say("differs", tick=one.tick, changed=changed, real=real)
        return self._say("same_moves")

    def _arrival(self, later: int) -> str:
        if later == 0:
            return self._say("arrives", "same")
        return self._say("arrives", "later" if later > 0 else "earlier", _form(abs(later)), count=abs(later))

    def _end(self, side: Side) -> str:
        story = side.story
        ended = story.outcome in (Outcome.SUCCESS, Outcome.CRASH)
        key = "by_hand" if story.by_hand and not ended else str(story.outcome)
        a = "" if story.cause is None else self._sayings.say("words", "a", story.cause.kind)
        ticks = self._say("ticks", _form(story.driven), count=story.driven)
        return self._say("ends", key, ticks=ticks, tick=story.end, a=a)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("side_by_side", *keys, **parts)


def _form(count: int) -> str:
    return "one" if count == 1 else "many"
