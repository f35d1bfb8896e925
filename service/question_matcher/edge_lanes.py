"""Names the lanes at the edges of the road by their numbers: "is the rightmost lane free?" is of lane 8 of 8.

The grammar takes a lane's number in many questions, and which number the rightmost lane has is known by the
road alone. The words stand in `prompts/questions/<code>/edge_lanes.yaml`; a language may do without.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from service.question_matcher.phrases import any_of
from service.yaml_files import read_yaml

FILE = "edge_lanes.yaml"


class EdgeLanes:
    """The lanes at the edges in one language."""

    def __init__(self, folder: Path) -> None:
        """`folder`: of `prompts/questions`. Its file is read at the first question."""
        self._folder = folder

    def numbered(self, text: str, columns: int) -> str:
        """The text with the number in the place of each lane at an edge of a road of so many `columns`."""
        for pattern, lane in ((self._leftmost, 1), (self._rightmost, columns)):
            if pattern is not None:
                text = pattern.sub(self._data["numbered"].format(n=lane), text)
        return text

    @cached_property
    def _data(self) -> Mapping[str, Any]:
        path = self._folder / FILE
        data: Mapping[str, Any] = read_yaml(path) if path.exists() else {}
        return data

    @cached_property
    def _leftmost(self) -> re.Pattern[str] | None:
        return self._pattern("leftmost")

    @cached_property
    def _rightmost(self) -> re.Pattern[str] | None:
        return self._pattern("rightmost")

    def _pattern(self, edge: str) -> re.Pattern[str] | None:
        patterns = self._data.get(edge)
        return any_of(patterns) if patterns else None
