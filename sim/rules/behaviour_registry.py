"""The behaviours there are, by name: a further one is added here."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from sim.rules.behaviour import Behaviour, SidewaysTraffic

BEHAVIOURS: Final[Mapping[str, Behaviour]] = {each.name: each for each in (SidewaysTraffic(),)}
"""Every behaviour by its name in `Config.behaviour`."""
