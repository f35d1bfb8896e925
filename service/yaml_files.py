"""Reading the project's YAML files."""

from __future__ import annotations

from pathlib import Path
from typing import Any


class YamlError(Exception):
    """A file that is not YAML."""


def read_yaml(path: Path) -> Any:
    """What one YAML file holds. Raises `YamlError`, and `OSError` where it cannot be read."""
    import yaml  # when words are read, and not where only the types are needed

    try:
        # The parser in C is ten times as fast; some builds of PyYAML come without it.
        return yaml.load(path.read_bytes(), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except yaml.YAMLError as error:
        raise YamlError(f"{path.name}: {error}") from error
