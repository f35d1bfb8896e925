"""The end of an episode in one line of the log: what it has come to, and what the best would have been."""

from __future__ import annotations

from service.narration.sayings import Sayings
from sim.episode_record import Sake
from sim.explain.summary import Summary, summary
from sim.state import SimState
from sim.types import Outcome


class Ends:
    """Ends in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, run: SimState) -> str:
        """One line about the episode that has ended in this run."""
        found = summary(run)
        match found.outcome:
            case Outcome.SUCCESS:
                parts = [
                    self._say("arrived", ticks=self._many("ticks", found.ticks)),
                    self._detours(found),
                    self._best(found),
                ]
            case Outcome.CRASH:
                parts = [self._crash(found), self._avoidable(found)]
            case _:
                key = "stuck_again" if found.repeated else "stuck"
                parts = [self._say(key, ticks=self._many("ticks", found.ticks)), self._open(found)]
        return f"{self._sayings.listed([part for part in parts if part])}."

    def _detours(self, found: Summary) -> str:
        if not found.sakes:
            return self._say("straight") if found.certain else ""
        if len(found.sakes) == 1:
            ((sake, count),) = found.sakes
            form = {1: "one", 2: "two"}.get(count, "many")
            told = self._say("all", form, sake=self._sake(sake, count))
        else:
            told = self._sayings.joined(
                [
                    self._say("some", count=self._count(count), sake=self._sake(sake, count))
                    for sake, count in found.sakes
                ]
            )
        counts = {"detours": found.detours, "waits": found.waits}
        named = [
            self._say(key, "one" if count == 1 else "many", count=self._count(count))
            for key, count in counts.items()
            if count
        ]
        return self._say("not_straight", moves=self._sayings.joined(named), sakes=told)

    def _best(self, found: Summary) -> str:
        if found.above is None:
            return ""
        return self._many("above", found.above) if found.above else self._say("best")

    def _crash(self, found: Summary) -> str:
        cause = found.cause
        if cause is None:
            raise ValueError("a crash has a cause")
        return self._say(
            f"crashed_{cause.how}",
            a=self._sayings.say("words", "a", cause.kind),
            where=self._sayings.where(cause.cell),
            ticks=self._many("ticks", found.ticks),
        )

    def _avoidable(self, found: Summary) -> str:
        """Whether the crash could have been avoided a tick before."""
        if found.free is None:
            return ""
        if not found.free:
            return self._say("nothing_free")
        if found.open_before is None:
            return self._say("free")
        return self._say("way_open" if found.open_before else "free_but_no_way")

    def _open(self, found: Summary) -> str:
        """Until when a way was open to a vehicle that got stuck."""
        if not found.certain or not found.open_known:
            return ""
        if found.open_until is None:
            return self._say("never_open")
        if found.open_until == found.ticks - 1:
            return self._say("open_to_the_last")
        return self._say("open_until", ticks=self._many("ticks", found.open_until))

    def _sake(self, sake: Sake, count: int) -> str:
        one, many = self._sayings.words("ends", "sakes", sake)
        return str(one if count == 1 else many)

    def _count(self, count: int) -> str:
        words = self._sayings.words("ends", "counts")
        return str(words[count]) if count < len(words) else str(count)

    def _many(self, key: str, count: int) -> str:
        return self._say(key, "one" if count == 1 else "many", count=count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("ends", *keys, **parts)
