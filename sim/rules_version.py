"""The version of the rules, so that what was kept under older ones is replayed as it was."""

from __future__ import annotations

from typing import Final

RULES: Final = 2
"""1: cells alone collide, nobody brakes, STUCK comes at the limit of ticks. 2: bodies collide by what they
sweep within a tick, movers brake for a standing vehicle, and a situation that repeats is STUCK."""
