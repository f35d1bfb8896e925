"""The scenarios that come with Roadtalk, each in a file of its own with the reason why it exists."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Final

from service.scenarios.file import ScenarioFile, read_scenario

FOLDER: Final = Path(__file__).parent / "library"
NAMES: Final = tuple(sorted(path.stem for path in FOLDER.glob("*.yaml")))


@cache
def named_scenario(name: str) -> ScenarioFile:
    """A scenario of the library. Raises `KeyError` for an unknown name."""
    if name not in NAMES:
        raise KeyError(name)
    return read_scenario((FOLDER / f"{name}.yaml").read_text(encoding="utf-8"))
