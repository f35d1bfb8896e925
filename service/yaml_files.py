"""Reading the project's YAML files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from service.cache_files import digest_of, read_cached, write_cached


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


def read_cached_yaml(paths: Sequence[Path]) -> list[Any]:
    """What several files of one folder hold, kept between starts: parsing takes longer than all else.

    For the project's own files, whose place does not change. Raises as `read_yaml` does.
    """
    names = "\n".join(str(path) for path in paths)
    contents = [path.read_bytes() for path in paths]
    sources = digest_of(names.encode(), *contents)
    name = f"yaml-{digest_of(names.encode()).hex()[:16]}"
    cached: list[Any] | None = read_cached(name, sources)
    if cached is not None:
        return cached
    values = [read_yaml(path) for path in paths]
    write_cached(name, sources, values)
    return values
