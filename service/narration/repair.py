"""What would make the ego arrive, or keep it from crashing, in words."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.futures_told import clear_told, end_told
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.explain.foresight import Foresight
from sim.explain.repair import Repair

SIZES = ("one", "two", "three")


class Repairs:
    """Smallest changes of the road that help, in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def text(self, found: Repair) -> str:
        """What would help; that it is so already, where it is."""
        if found.reached:
            return self._say("arrives" if found.aim == "arrive" else "clear", end=self._end(found.now, found))
        return within(self.parts(found))

    def parts(self, found: Repair) -> list[Part]:
        """Things to be taken away, another planner, another wish; and that the way is shut, where it is."""
        parts = []
        naming = Naming(self._sayings, found.state, as_seen=False)
        shut = found.outlook is not None and not found.outlook.open
        if found.removed and found.then is not None:
            who = naming.things(found.removed)
            parts.append(Part(0, self._say("without", who=who, end=self._end(found.then, found))))
            if found.searched:
                parts.append(Part(3, self._say("fewer", SIZES[found.searched - 1])))
            if shut and found.aim == "arrive":
                parts.insert(0, Part(2, self._say("shut")))
        else:
            parts += self._none(found, naming, shut=shut)
        if found.planner is not None:
            planner = self._sayings.planner(found.planner.planner, "with")
            end = self._end(found.planner.foresight, found)
            parts.append(Part(1, self._say("planner", planner=planner, end=end)))
        if found.wish is not None:
            wish = self._sayings.say("replies", "preferences", found.wish)
            parts.append(Part(2, self._say("wish", wish=wish)))
        return parts

    def _none(self, found: Repair, naming: Naming, *, shut: bool) -> list[Part]:
        """That no things were found, and up to how many were tried."""
        if found.searched:
            told = self._say("fewer", SIZES[found.searched - 1])
        else:
            told = self._say("tried", count=found.tried)
        if not shut or found.aim == "avoid" or found.outlook is None:
            return [Part(1, told)]
        if not found.outlook.ids:
            return [Part(0, self._say("shut")), Part(1, told)]
        return [Part(0, self._say("shut_by", who=naming.things(found.outlook.ids))), Part(1, told)]

    def _end(self, seen: Foresight, found: Repair) -> str:
        return (end_told if found.aim == "arrive" else clear_told)(self._sayings, seen)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("ahead", "repair", *keys, **parts)
