"""A crash that lies ahead, in words: when and into what, and what still avoids it."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told, share_told
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.explain.ahead import CrashAhead
from sim.explain.crash import stood_there
from sim.types import Move


class CrashesAhead:
    """Crashes that lie ahead, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, found: CrashAhead, *, plainly: bool = False) -> str:
        """Whether there is one, and how it would come about; `plainly`: without yes or no before it."""
        form = "_plain" if plainly else ""
        seen = found.foresight
        if seen.by_chance:
            if seen.crashes == 0.0:
                return self._say("none_chance")
            share = share_told(self._sayings, seen.crashes, seen.chances)
            run = ""
            if found.last is not None:
                run = self._say("run", seconds=self._seconds(found), what=self._happens(found))
            key = "chance_all" if seen.crashes == 1.0 else "chance"
            return within([Part(0, self._say(f"{key}{form}", share=share)), Part(1, run)])
        if found.last is None:
            return self._say(f"none{form}", end=end_told(self._sayings, seen))
        what = self._say(f"one{form}", seconds=self._seconds(found), what=self._happens(found))
        return within([Part(0, what), Part(2, self._free(found)), *self.avoiding(found)])

    def avoiding(self, found: CrashAhead) -> list[Part]:
        """What still avoids it, where that is known."""
        last = found.avoidable.last
        if last is None:
            return [Part(1, self._say("unavoidable"))] if found.avoidable.proved else []
        later = last.tick - found.state.world.tick
        key, when = "stays" if last.stays else "moves", "later" if later else "now"
        seconds = in_seconds(self._sayings, later, found.state.config)
        doing = self._sayings.move(last.instead, "doing")
        return [Part(1, capital(self._say("avoid", key, when, seconds=seconds, doing=doing)))]

    def _happens(self, found: CrashAhead) -> str:
        """What is done in the last tick, and what is met."""
        story, last, decision = found.foresight.story, found.last, found.decision
        assert story.cause is not None
        assert last is not None
        assert decision is not None
        ids = [name for name in story.cause.ids if name != decision.av]
        key = story.cause.how
        if key not in ("swap", "cross"):
            into = stood_there(last.world, story.cause, ids[0])
            key = "came" if decision.move is Move.STAY else "into" if into else "met"
        who = Naming(self._sayings, last, as_seen=False).things(ids)
        return self._say(key, who=who, do=self._sayings.move(decision.move, "do"))

    def _free(self, found: CrashAhead) -> str:
        """That no other move was free in the last tick, as it was seen."""
        decision = found.decision
        assert decision is not None
        others = [option for option in decision.options if option.move is not decision.move]
        return "" if any(option.verdict == "free" for option in others) else self._say("none_free")

    def _seconds(self, found: CrashAhead) -> str:
        story = found.foresight.story
        return in_seconds(self._sayings, story.ticks, found.state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("ahead", "crash", *keys, **parts)
