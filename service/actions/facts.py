"""What is always so, and can be asked for by name: `facts.yaml` of the sayings has the answers."""

from __future__ import annotations

from typing import Literal

FactName = Literal["livelock", "space_time", "mind"]
"""Facts of the simulator, its planners and sensors, the page, and driving in the real world."""
