"""A session as one small file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from service.contract.model import Answered


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording(Answered):
    """A recorded session; `raw` is the file."""

    format: str
    version: int
    name: str | None
    tick: int
    digest: str
    entries: tuple[Mapping[str, Any], ...]

    def save(self, path: str | Path) -> Path:
        """Writes the file; `roadtalk replay` and `Client.create(recording=...)` read it."""
        written = Path(path)
        written.write_text(json.dumps(self.raw, ensure_ascii=False) + "\n", encoding="utf-8")
        return written
