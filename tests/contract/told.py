"""What `running` and `hooks`, which are two processes, know of one another."""

from __future__ import annotations

TOLD = "ROADTALK_GENERATED_TOLD"
"""Names the file that a line is added to for each answer, the call and the status, and for each failure,
the same and what failed."""
SEED = "ROADTALK_GENERATED_SEED"
"""The run's seed."""
