"""How sure it is that the ego keeps clear, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.assurance import Assurance

Json = dict[str, Any]


def assurance_json(found: Assurance | None) -> Json | None:
    """How sure it is; ticks from now, and `may_hit` are ids."""
    if found is None:
        return None
    sure = found.sure
    return {
        "level": found.level,
        "ticks": sure.ticks,
        "to_the_end": sure.to_the_end,
        "arrives": sure.arrives,
        "may_hit": list(found.may_hit),
    }
