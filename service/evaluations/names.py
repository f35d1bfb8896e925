"""The names of the kinds of jobs, as they are stored."""

from __future__ import annotations

from typing import Final

EVALUATION: Final = "evaluation"
FIND_WORST: Final = "find_worst"
