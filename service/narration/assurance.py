"""How sure a "safe" is, in words: proved whatever the others do, likely, or merely possible."""

from __future__ import annotations

from service.narration.charges import in_seconds
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.explain.assurance import Assurance, Level
from sim.state import SimState


def assurance_told(sayings: Sayings, found: Assurance | None, state: SimState, *, safe: bool) -> str:
    """Which of the three it is, in a sentence; empty where no way is known that keeps clear.

    `safe`: whether no future ends in a crash as the planner drives on.
    """
    if found is None or found.level is Level.NONE:
        return ""
    sure = found.sure
    key = found.level.value
    if found.level is Level.WHATEVER:
        key += "" if safe else "_else"
        key += "" if sure.arrives is None else "_arrives"
    elif found.level is Level.LIKELY and not sure.ticks:
        key += "_who" if found.may_hit else "_not_sure"
    return sayings.say(
        "ahead",
        "assurance",
        key,
        seconds=in_seconds(sayings, sure.arrives or sure.ticks, state.config),
        who=Naming(sayings, state, as_seen=False).things(found.may_hit) if found.may_hit else "",
    )
